// SPDX-License-Identifier: Apache-2.0
// Rays that the light sees near each other, in groups: cut by halves of their rectangle, and sorted by direction first
// where they come in no order that serves.

#if defined(UMBRIX_KERNELS_LIGHT_GROUPS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_GROUPS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_GROUPS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_GROUPS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "kernels/compress-inl.h"
#include "kernels/light_view.h"
#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// A rectangle of (u, v).
struct Rectangle {
  float low_u, high_u, low_v, high_v;
};

/// Smallest and largest of a rectangle, lane by lane.
struct Spread {
  RayVec low_u, high_u, low_v, high_v;

  Spread() {
    const RayTag f;
    low_u = low_v = hn::Set(f, std::numeric_limits<float>::infinity());
    high_u = high_v = hn::Neg(low_u);
  }
  HWY_INLINE void add(RayVec u, RayVec v, RayMask use) {
    low_u = hn::IfThenElse(use, hn::Min(low_u, u), low_u);
    high_u = hn::IfThenElse(use, hn::Max(high_u, u), high_u);
    low_v = hn::IfThenElse(use, hn::Min(low_v, v), low_v);
    high_v = hn::IfThenElse(use, hn::Max(high_v, v), high_v);
  }
  Rectangle get() const {
    const FourLeast least(low_u, hn::Neg(high_u), low_v, hn::Neg(high_v));
    return {least.of[0], -least.of[1], least.of[2], -least.of[3]};
  }
};

/// How many layers of groups there are, on average, where there are any.
class Overlap {
 public:
  void add(std::uint32_t face, const RayGroup& g) {
    const auto cell = [](float x) { return static_cast<std::uint32_t>(std::clamp((x + 1) * 16, 0.0f, 31.0f)); };
    std::uint32_t& row = seen_[face][cell(g.v)];
    const std::uint32_t bit = 1u << cell(g.u);
    cells_ += (row & bit) == 0 ? 1.0f : 0.0f;
    row |= bit;
    area_ += 4 * g.half_u * g.half_v;
  }
  float layers() const { return area_ * 256 / std::max(cells_, 1.0f); }

 private:
  std::uint32_t seen_[kViewFaces][32] = {};
  float cells_ = 0, area_ = 0;
};

/// Cuts what is read into groups.
class LightGroups {
 public:
  explicit LightGroups(LightViewScratch& scratch) : scratch_(scratch) {}

  /// How many layers of groups there are where there are any: what is left to be gained by sorting.
  float layers() const { return overlap_.layers(); }

  /// Rays from `first` on, which are all of the face and within the rectangle: cuts it in the middle of its longer
  /// side, down to `most` rays, at most kGroupRays.
  void split(std::uint32_t face, std::size_t first, std::size_t count, const Rectangle& r, std::uint32_t most) {
    if (count <= most) {
      add_group(face, first, count, r);
      return;
    }
    const bool by_u = r.high_u - r.low_u >= r.high_v - r.low_v;
    Rectangle low, high;
    std::size_t lows =
        partition(first, count, by_u, by_u ? 0.5f * (r.low_u + r.high_u) : 0.5f * (r.low_v + r.high_v), low, high);
    if (lows == 0 || lows == count) {  // starts that cannot be told apart
      lows = most;
      low = high = r;
    }
    split(face, first, lows, low, most);
    split(face, first + lows, count - lows, high, most);
  }

  /// For `sort`: the cells of rays from place `first` on, which lie on a curve through all of a face (Morton 1966).
  HWY_INLINE void put_cells(std::size_t first, RayVec u, RayVec v, hn::Vec<RayBitsTag> face) {
    const RayTag f;
    const RayBitsTag n;
    const hn::Rebind<std::uint16_t, RayTag> halves;
    const auto place = [&](RayVec x) {
      const auto at = hn::Mul(hn::Max(hn::Add(x, hn::Set(f, 1)), hn::Zero(f)), hn::Set(f, 0.5f * kCells));
      return spread_bits(hn::ConvertTo(n, hn::Min(at, hn::Set(f, kCells - 1))));
    };
    const auto base = hn::Mul(face, hn::Set(n, kCells * kCells));
    const auto cell = hn::Add(base, hn::Or(place(u), hn::ShiftLeft<1>(place(v))));
    hn::StoreU(hn::DemoteTo(halves, cell), halves, scratch_.cells.data() + first);
  }

  /// Before `sort`, for rays that were read by faces; those that come later have their cells put.
  void begin_to_sort() {
    const RayTag f;
    scratch_.make_room_to_sort();
    for (const auto& segment : scratch_.segments) {
      const auto face = hn::Set(RayBitsTag(), static_cast<std::int32_t>(segment.face));
      for_lanes(segment.first, segment.count, [&](std::size_t i, RayMask) {
        put_cells(i, hn::LoadU(f, scratch_.u.data() + i), hn::LoadU(f, scratch_.v.data() + i), face);
      });
    }
  }

  /// Brings rays together that the light sees in one direction: by cells of the view, which are then cut as any others.
  void sort() {
    overlap_ = Overlap();
    auto& ends = scratch_.counts;
    ends.assign(kViewFaces * kCells * kCells + 1, 0);
    const std::size_t count = scratch_.ray_count;
    for (std::size_t i = 0; i < count; ++i) ++ends[scratch_.cells[i] + 1];
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    for (std::size_t i = 0; i < count; ++i)
      scratch_.records[ends[scratch_.cells[i]]++] = {scratch_.u[i], scratch_.v[i], scratch_.w[i], scratch_.name[i]};
    take_records();
    for (auto& face : scratch_.faces) face.groups.clear();
    std::size_t first = 0;
    for (std::uint32_t cell = 0; cell + 1 < ends.size(); ++cell) {
      const std::size_t here = ends[cell] - first;
      if (here != 0) split(cell / (kCells * kCells), first, here, bounds(first, here), kSortedGroupRays);
      first = ends[cell];
    }
  }

 private:
  static constexpr std::uint32_t kCells = 64;  ///< of a face, along a side
  /// Rays that had to be sorted have little in common but their direction.
  static constexpr std::uint32_t kSortedGroupRays = 48;

  static HWY_INLINE hn::Vec<RayBitsTag> spread_bits(hn::Vec<RayBitsTag> x) {  // a zero before each of 8 bits
    const RayBitsTag n;
    x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(n, 0x0F0F));
    x = hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(n, 0x3333));
    return hn::And(hn::Or(x, hn::ShiftLeft<1>(x)), hn::Set(n, 0x5555));
  }

  /// Puts what is sorted back into columns.
  void take_records() {
    const RayTag f;
    for_lanes(0, scratch_.ray_count, [&](std::size_t i, RayMask) {
      RayVec u, v, w, name;
      hn::LoadInterleaved4(f, &scratch_.records[i].u, u, v, w, name);
      hn::StoreU(u, f, scratch_.u.data() + i);
      hn::StoreU(v, f, scratch_.v.data() + i);
      hn::StoreU(w, f, scratch_.w.data() + i);
      hn::StoreU(hn::BitCast(RayBitsTag(), name), RayBitsTag(), scratch_.name.data() + i);
    });
  }

  Rectangle bounds(std::size_t first, std::size_t count) const {
    const RayTag f;
    Spread spread;
    for_lanes(first, count, [&](std::size_t i, RayMask use) {
      spread.add(hn::LoadU(f, scratch_.u.data() + i), hn::LoadU(f, scratch_.v.data() + i), use);
    });
    return spread.get();
  }

  std::size_t partition(std::size_t first, std::size_t count, bool by_u, float middle, Rectangle& low,
                        Rectangle& high) {
    const RayTag f;
    const RayBitsTag n;
    auto& above_rows = scratch_.above;
    if (above_rows[0].size() < count + kRowLanes) {
      for (auto& row : above_rows) row.resize(count + kRowLanes);
      scratch_.above_name.resize(count + kRowLanes);
    }
    float* const rows[3] = {scratch_.u.data(), scratch_.v.data(), scratch_.w.data()};
    std::size_t low_end = first, high_end = 0;
    Spread low_spread, high_spread;
    for_lanes(first, count, [&](std::size_t i, RayMask use) {
      const RayVec x[3] = {hn::LoadU(f, rows[0] + i), hn::LoadU(f, rows[1] + i), hn::LoadU(f, rows[2] + i)};
      const auto name = hn::LoadU(n, scratch_.name.data() + i);
      const auto below = hn::And(use, hn::Lt(by_u ? x[0] : x[1], hn::Set(f, middle)));
      const auto above = hn::AndNot(below, use);
      low_spread.add(x[0], x[1], below);
      high_spread.add(x[0], x[1], above);
      for (std::size_t k = 0; k < 3; ++k) hn::StoreU(compress(x[k], above), f, above_rows[k].data() + high_end);
      hn::StoreU(compress(name, hn::RebindMask(n, above)), n, scratch_.above_name.data() + high_end);
      const auto lows = hn::CountTrue(f, below);
      high_end += hn::CountTrue(f, above);
      const auto first_lows = hn::FirstN(f, lows);
      for (std::size_t k = 0; k < 3; ++k) hn::BlendedStore(compress(x[k], below), first_lows, f, rows[k] + low_end);
      hn::BlendedStore(compress(name, hn::RebindMask(n, below)), hn::RebindMask(n, first_lows), n,
                       scratch_.name.data() + low_end);
      low_end += lows;
    });
    for (std::size_t k = 0; k < 3; ++k) std::memcpy(rows[k] + low_end, above_rows[k].data(), high_end * sizeof(float));
    std::memcpy(scratch_.name.data() + low_end, scratch_.above_name.data(), high_end * sizeof(std::int32_t));
    low = low_spread.get();
    high = high_spread.get();
    return low_end - first;
  }

  void add_group(std::uint32_t face, std::size_t first, std::size_t count, const Rectangle& r) {
    RayGroup group;
    group.packets = RayGroup::kNone;
    group.u = 0.5f * (r.low_u + r.high_u);
    group.v = 0.5f * (r.low_v + r.high_v);
    group.half_u = std::max(r.high_u - group.u, group.u - r.low_u);
    group.half_v = std::max(r.high_v - group.v, group.v - r.low_v);
    group.first = static_cast<std::uint32_t>(first);
    group.count = static_cast<std::uint32_t>(count);
    fit_plane(first, count, group);
    scratch_.faces[face].groups.push_back(group);
    overlap_.add(face, group);
  }

  /// A plane has a depth whose inverse is linear in (u, v): that of three starts bounds the others if they are in one.
  void fit_plane(std::size_t first, std::size_t count, RayGroup& group) const {
    const float* u = scratch_.u.data();
    const float* v = scratch_.v.data();
    const float* w = scratch_.w.data();
    const std::size_t a = first, b = first + count / 3, c = first + 2 * count / 3;
    const float bu = u[b] - u[a], bv = v[b] - v[a], bw = w[b] - w[a];
    const float cu = u[c] - u[a], cv = v[c] - v[a], cw = w[c] - w[a];
    const float det = bu * cv - bv * cu;
    float slope_u = (bw * cv - bv * cw) / det, slope_v = (bu * cw - bw * cu) / det;
    const float limit = 0x1p20f;
    if (!(std::abs(slope_u) < limit * w[a] && std::abs(slope_v) < limit * w[a])) slope_u = slope_v = 0;
    const RayTag f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity());
    auto low = infinity, high = hn::Neg(infinity), low_w = infinity, high_w = high;
    const auto su = hn::Set(f, slope_u), sv = hn::Set(f, slope_v);
    for_lanes(first, count, [&](std::size_t i, RayMask use) {
      const auto x = hn::LoadU(f, w + i);
      const auto rest = hn::NegMulAdd(sv, hn::LoadU(f, v + i), hn::NegMulAdd(su, hn::LoadU(f, u + i), x));
      low = hn::IfThenElse(use, hn::Min(low, rest), low);
      high = hn::IfThenElse(use, hn::Max(high, rest), high);
      low_w = hn::IfThenElse(use, hn::Min(low_w, x), low_w);
      high_w = hn::IfThenElse(use, hn::Max(high_w, x), high_w);
    });
    const FourLeast ends(low, hn::Neg(high), low_w, hn::Neg(high_w));
    const float least = ends.of[0], most = -ends.of[1], least_w = ends.of[2];
    group.nearest = -ends.of[3];
    group.farthest = least_w;
    const bool is_tighter = most - least < 0.5f * (group.nearest - least_w);
    group.slope_u = is_tighter ? slope_u : 0;
    group.slope_v = is_tighter ? slope_v : 0;
    group.base = is_tighter ? least : least_w;
  }

  LightViewScratch& scratch_;
  Overlap overlap_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
