// SPDX-License-Identifier: Apache-2.0
// Rays that come in no order that serves, sorted by their direction from the light: each thread sorts a slice of them,
// and then takes pieces of the view, with the rays of all slices.

#if defined(UMBRIX_KERNELS_LIGHT_SORT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_SORT_INL_H_
#undef UMBRIX_KERNELS_LIGHT_SORT_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_SORT_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "kernels/light_groups-inl.h"
#include "kernels/light_reader-inl.h"
#include "kernels/ray_blocks.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Cells of the view, in the order of a curve through each face (Morton 1966).
class ViewCells {
 public:
  static constexpr std::uint32_t kSide = 64, kOfFace = kSide * kSide, kAll = kViewFaces * kOfFace;

  static HWY_INLINE hn::Vec<RayBitsTag> find(RayVec u, RayVec v, hn::Vec<RayBitsTag> face) {
    const RayBitsTag n;
    const auto base = hn::Mul(face, hn::Set(n, kOfFace));
    return hn::Add(base, hn::Or(place(u), hn::ShiftLeft<1>(place(v))));
  }

 private:
  static HWY_INLINE hn::Vec<RayBitsTag> place(RayVec x) {
    const RayTag f;
    const auto at = hn::Mul(hn::Max(hn::Add(x, hn::Set(f, 1)), hn::Zero(f)), hn::Set(f, 0.5f * kSide));
    return spread_bits(hn::ConvertTo(RayBitsTag(), hn::Min(at, hn::Set(f, kSide - 1))));
  }
  static HWY_INLINE hn::Vec<RayBitsTag> spread_bits(hn::Vec<RayBitsTag> x) {  // a zero before each of 8 bits
    const RayBitsTag n;
    x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(n, 0x0F0F));
    x = hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(n, 0x3333));
    return hn::And(hn::Or(x, hn::ShiftLeft<1>(x)), hn::Set(n, 0x5555));
  }
};

/// Reads a slice of a call's rays, and sorts them by cells.
class LightSlice {
 public:
  /// From `begin` to `end`; what is named must outlive it, and the scratch forgets what it had.
  LightSlice(RaySpan rays, std::size_t begin, std::size_t end, float scale, const LightPoint& light,
             LightViewScratch& scratch)
      : begin_(begin), end_(end), scratch_(scratch), reader_(rays, scale, light, scratch.odd) {}

  /// False if too many do not end at the light.
  bool sort() {
    scratch_.clear(end_ - begin_ + kRowLanes);
    scratch_.make_room_to_sort();
    scratch_.ends.assign(ViewCells::kAll + 1, 0);
    for (std::size_t at = begin_; at < end_; at += kMostRays) {
      take_run(reader_.read(at, static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, end_ - at))));
      if (are_odd(scratch_.odd.size(), at - begin_)) return false;
    }
    scatter();
    return true;
  }

  ViewErrors errors() const { return reader_.errors(); }

 private:
  void take_run(const RayRun& run) {
    const RayTag f;
    const RayBitsTag n;
    const hn::Rebind<std::uint16_t, RayTag> halves;
    const std::size_t first = scratch_.ray_count;
    for_lanes(0, run.count, [&](std::size_t i, RayMask) {
      const auto u = hn::Load(f, run.u + i), v = hn::Load(f, run.v + i);
      hn::StoreU(u, f, scratch_.u.data() + first + i);
      hn::StoreU(v, f, scratch_.v.data() + first + i);
      hn::StoreU(hn::Load(f, run.w + i), f, scratch_.w.data() + first + i);
      hn::StoreU(hn::Load(n, run.name + i), n, scratch_.name.data() + first + i);
      const auto cells = ViewCells::find(u, v, hn::Load(n, run.face + i));
      hn::StoreU(hn::DemoteTo(halves, cells), halves, scratch_.cells.data() + first + i);
    });
    scratch_.ray_count += run.count;
  }

  void scatter() {
    auto& ends = scratch_.ends;
    const std::size_t count = scratch_.ray_count;
    for (std::size_t i = 0; i < count; ++i) ++ends[scratch_.cells[i] + 1];
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    for (std::size_t i = 0; i < count; ++i)
      scratch_.records[ends[scratch_.cells[i]]++] = {scratch_.u[i], scratch_.v[i], scratch_.w[i], scratch_.name[i]};
  }

  std::size_t begin_, end_;
  LightViewScratch& scratch_;
  LightReader reader_;
};

/// All slices of a call together, in pieces of neighbouring cells.
class LightPieces {
 public:
  /// What is named must outlive it.
  explicit LightPieces(const std::vector<const LightViewScratch*>& slices) : slices_(slices) {
    const std::size_t threads = slices.size();
    std::size_t left = 0, here = 0;
    for (const LightViewScratch* slice : slices) left += slice->ray_count;
    pieces_.push_back({0, 0});
    for (std::uint32_t cell = 0; cell < ViewCells::kAll; ++cell) {
      for (const LightViewScratch* slice : slices) here += count_of(*slice, cell);
      if (threads > 1 && here > 0 && here >= block_size(left, threads, kFewestBatchRays, kMostBatchRays)) {
        pieces_.back().count = here;
        pieces_.push_back({cell + 1, 0});
        left -= std::exchange(here, 0);
      }
    }
    pieces_.back().count = here;
    pieces_.push_back({ViewCells::kAll, 0});
  }

  std::size_t count() const { return pieces_.size() - 1; }

  /// Brings the rays of a piece into groups. Any threads, each with a scratch of its own, which may be that of a slice.
  void take(std::size_t piece, LightViewScratch& scratch) const {
    scratch.clear(pieces_[piece].count + kRowLanes);
    const std::uint32_t first = pieces_[piece].first, last = pieces_[piece + 1].first;
    // All cells before any group: what was just written in several pieces is slow to read in one.
    const std::uint32_t together = slices_.size() == 1 ? last - first : 1;
    for (std::uint32_t cell = first; cell < last; cell += together)
      for (const LightViewScratch* slice : slices_) take_cells(*slice, cell, cell + together, scratch);
    LightGroups groups(scratch);
    std::size_t at = 0;
    for (std::uint32_t cell = first; cell < last; ++cell) {
      std::size_t here = 0;
      for (const LightViewScratch* slice : slices_) here += count_of(*slice, cell);
      if (here != 0) groups.split(cell / ViewCells::kOfFace, at, here, bounds(scratch, at, here), kGroupRaysOfCell);
      at += here;
    }
  }

 private:
  /// Rays that had to be sorted have little in common but their direction.
  static constexpr std::uint32_t kGroupRaysOfCell = 48;

  struct Piece {
    std::uint32_t first;  ///< cell
    std::size_t count;    ///< rays
  };

  static std::uint32_t begin_of(const LightViewScratch& slice, std::uint32_t cell) {
    return cell == 0 ? 0 : slice.ends[cell - 1];
  }

  static std::size_t count_of(const LightViewScratch& slice, std::uint32_t cell) {
    return slice.ends[cell] - begin_of(slice, cell);
  }

  static void take_cells(const LightViewScratch& slice, std::uint32_t first, std::uint32_t last,
                         LightViewScratch& out) {
    const RayTag f;
    const std::size_t begin = begin_of(slice, first), count = slice.ends[last - 1] - begin, at = out.ray_count;
    for_lanes(0, count, [&](std::size_t i, RayMask) {
      RayVec u, v, w, name;
      hn::LoadInterleaved4(f, &slice.records[begin + i].u, u, v, w, name);
      hn::StoreU(u, f, out.u.data() + at + i);
      hn::StoreU(v, f, out.v.data() + at + i);
      hn::StoreU(w, f, out.w.data() + at + i);
      hn::StoreU(hn::BitCast(RayBitsTag(), name), RayBitsTag(), out.name.data() + at + i);
    });
    out.ray_count += count;
  }

  static Rectangle bounds(const LightViewScratch& scratch, std::size_t first, std::size_t count) {
    const RayTag f;
    Spread spread;
    for_lanes(first, count, [&](std::size_t i, RayMask use) {
      spread.add(hn::LoadU(f, scratch.u.data() + i), hn::LoadU(f, scratch.v.data() + i), use);
    });
    return spread.get();
  }

  const std::vector<const LightViewScratch*>& slices_;
  std::vector<Piece> pieces_;  ///< and the end
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
