// SPDX-License-Identifier: Apache-2.0
// Rays that end at one light, brought into groups as it sees their starts.

#if defined(UMBRIX_KERNELS_LIGHT_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/compress-inl.h"
#include "kernels/group_rays.h"
#include "kernels/light_groups-inl.h"
#include "kernels/light_reader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Reads the rays of a batch, and brings them into groups as they come.
class LightRays {
 public:
  /// From `begin` to `end`; what is named must outlive it, and the scratch forgets what it had.
  LightRays(RaySpan rays, std::size_t begin, std::size_t end, float scale, const LightPoint& light,
            LightViewScratch& scratch)
      : begin_(begin), end_(end), scratch_(scratch), groups_(scratch), reader_(rays, scale, light, scratch.odd) {}

  /// False if they had better be sorted, or if too many do not end at the light.
  bool read() {
    scratch_.clear(end_ - begin_ + kRowLanes);
    std::size_t next_look = 16 * kMostRays;
    for (std::size_t done = 0; done < end_ - begin_; done += kMostRays) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, end_ - begin_ - done));
      const RayRun& run = reader_.read(begin_ + done, count);
      if (are_odd(scratch_.odd.size(), done)) return false;
      for (std::uint32_t faces = run.faces; faces != 0; faces &= faces - 1) take_face(run, first_lane(faces));
      if (done < next_look) continue;
      next_look *= 2;
      if (groups_.layers() > kManyLayers) return false;
    }
    return groups_.layers() <= kMostLayers;
  }

  ViewErrors errors() const { return reader_.errors(); }

 private:
  /// More layers of groups had better be sorted: a batch in image order has 0.4 to 3.4, of foliage 8, in random order a
  /// thousand.
  static constexpr float kMostLayers = 5;
  /// Before a batch is read whole: some places have more than the rest, and random order shows soon.
  static constexpr float kManyLayers = 16;
  /// A part has about so many.
  static constexpr std::uint32_t kPartRays = 24;

  /// A rectangle in up to kMost parts, halves of halves.
  class Parts {
   public:
    static constexpr std::uint32_t kMost = 8;

    Parts(const Rectangle& r, std::uint32_t wanted) : r_(r) {
      float du = r.high_u - r.low_u, dv = r.high_v - r.low_v;
      while (static_cast<std::uint32_t>(columns_ * rows_) < kMost &&
             static_cast<std::uint32_t>(columns_ * rows_) < wanted) {
        const bool by_u = du >= dv;
        (by_u ? columns_ : rows_) *= 2;
        (by_u ? du : dv) *= 0.5f;
      }
      by_u_ = static_cast<float>(columns_) / std::max(r.high_u - r.low_u, 0x1p-60f);
      by_v_ = static_cast<float>(rows_) / std::max(r.high_v - r.low_v, 0x1p-60f);
    }
    std::uint32_t count() const { return static_cast<std::uint32_t>(columns_ * rows_); }
    HWY_INLINE hn::Vec<RayBitsTag> find(RayVec u, RayVec v) const {
      const RayTag f;
      const RayBitsTag n;
      const auto place = [&](RayVec x, float low, float scale, std::int32_t count) {
        const auto part = hn::Mul(hn::Sub(x, hn::Set(f, low)), hn::Set(f, scale));
        // Rays of no face may have a NaN, which is no integer.
        const auto whole = hn::ConvertTo(n, hn::IfThenElseZero(hn::Ge(part, hn::Zero(f)), part));
        return hn::Min(whole, hn::Set(n, count - 1));
      };
      return hn::Add(hn::Mul(place(v, r_.low_v, by_v_, rows_), hn::Set(n, columns_)),
                     place(u, r_.low_u, by_u_, columns_));
    }

   private:
    Rectangle r_;
    std::int32_t columns_ = 1, rows_ = 1;
    float by_u_, by_v_;
  };

  /// Picks the run's rays of a face, and cuts them into groups: as many equal parts of their rectangle as may do, which
  /// are cut further where they do not.
  void take_face(const RayRun& run, std::uint32_t number) {
    const RayTag f;
    const RayBitsTag n;
    const auto wanted = hn::Set(n, static_cast<std::int32_t>(number));
    Spread spread;
    std::uint32_t count = 0;
    for_lanes(0, run.count, [&](std::size_t i, RayMask use) {
      const auto keep = hn::And(use, hn::RebindMask(f, hn::Eq(hn::Load(n, run.face + i), wanted)));
      spread.add(hn::Load(f, run.u + i), hn::Load(f, run.v + i), keep);
      count += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
    });
    const Rectangle whole = spread.get();
    const Parts parts(whole, count / kPartRays);
    alignas(64) std::uint8_t part_of[kMostRays + kRowLanes];
    for_lanes(0, run.count, [&](std::size_t i, RayMask use) {
      const auto keep = hn::And(hn::RebindMask(n, use), hn::Eq(hn::Load(n, run.face + i), wanted));
      const auto part = parts.find(hn::Load(f, run.u + i), hn::Load(f, run.v + i));
      const hn::Rebind<std::uint8_t, RayTag> bytes;
      hn::StoreU(hn::DemoteTo(bytes, hn::IfThenElse(keep, part, hn::Set(n, 255))), bytes, part_of + i);
    });
    // All parts before any group: what was just written in several pieces is slow to read in one.
    std::size_t ends[Parts::kMost];
    Rectangle rectangles[Parts::kMost];
    std::size_t first = scratch_.ray_count;
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
      rectangles[part] = take_part(run, RunBits(part_of, run.count, static_cast<std::uint8_t>(part)));
      ends[part] = scratch_.ray_count;
    }
    for (std::uint32_t part = 0; part < parts.count(); ++part) {
      if (ends[part] != first) groups_.split(number, first, ends[part] - first, rectangles[part], kGroupRays);
      first = ends[part];
    }
  }

  /// Rays of a run that have a number, as bits.
  class RunBits {
   public:
    RunBits(const std::uint8_t* numbers, std::uint32_t count, std::uint8_t wanted) {
      const hn::CappedTag<std::uint8_t, 64> bytes;
      for (std::size_t i = 0; i < count; i += hn::Lanes(bytes)) {
        const auto is_wanted = hn::Eq(hn::LoadU(bytes, numbers + i), hn::Set(bytes, wanted));
        words_[i / 64] |= mask_bits<std::uint64_t>(bytes, is_wanted) << i % 64;
#if HWY_TARGET == HWY_SCALAR
        eights_ = ~std::uint32_t{0};
#else
        const hn::Repartition<std::uint64_t, decltype(bytes)> eights;
        const auto some = hn::Ne(hn::BitCast(eights, hn::VecFromMask(bytes, is_wanted)), hn::Zero(eights));
        eights_ |= std::uint32_t{mask_bits<std::uint8_t>(eights, some)} << i / 8;
#endif
      }
      words_[count / 64] &= (std::uint64_t{1} << count % 64) - 1;
    }

    /// Calls each(i, lanes) for those i = 0, 16, ... where there may be any.
    template <class Each>
    HWY_INLINE void for_each(Each&& each) const {
      const auto lanes = static_cast<std::uint32_t>(hn::Lanes(RayTag()));
      for (std::uint32_t rest = (eights_ | eights_ >> 1) & 0x55555555; rest != 0; rest &= rest - 1) {
        const std::uint32_t first = 8 * first_lane(rest);
        const auto bits = static_cast<std::uint32_t>(words_[first / 64] >> first % 64);
        for (std::uint32_t k = 0; k < kRowLanes; k += lanes)
          each(first + k, lane_mask(bits >> k & ((1u << lanes) - 1)));
      }
    }

   private:
    std::uint64_t words_[kMostRays / 64 + 1] = {};
    std::uint32_t eights_ = 0;  ///< in which of eight rays there are some
  };

  Rectangle take_part(const RayRun& run, const RunBits& rays) {
    const RayTag f;
    const RayBitsTag n;
    Spread spread;
    std::size_t at = scratch_.ray_count;
    rays.for_each([&](std::size_t i, RayMask keep) {
      const auto whole = hn::RebindMask(n, keep);
      const auto u = hn::Load(f, run.u + i), v = hn::Load(f, run.v + i), w = hn::Load(f, run.w + i);
      spread.add(u, v, keep);
      hn::StoreU(compress(u, keep), f, scratch_.u.data() + at);
      hn::StoreU(compress(v, keep), f, scratch_.v.data() + at);
      hn::StoreU(compress(w, keep), f, scratch_.w.data() + at);
      hn::StoreU(compress(hn::Load(n, run.name + i), whole), n, scratch_.name.data() + at);
      at += hn::CountTrue(f, keep);
    });
    scratch_.ray_count = at;
    return spread.get();
  }

  std::size_t begin_, end_;
  LightViewScratch& scratch_;
  LightGroups groups_;
  LightReader reader_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
