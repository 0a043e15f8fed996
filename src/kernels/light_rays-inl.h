// SPDX-License-Identifier: Apache-2.0
// Rays that end at one light, brought into groups as it sees their starts.

#if defined(UMBRIX_KERNELS_LIGHT_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/group_rays.h"
#include "kernels/light_groups-inl.h"
#include "kernels/light_reader-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Reads rays, and brings them into groups.
class LightRays {
 public:
  LightRays(RaySpan rays, float scale, LightViewScratch& scratch)
      : rays_(rays),
        scratch_(scratch),
        groups_(scratch),
        light_(find_light(rays, scale)),
        reader_(rays, scale, light_, scratch.odd) {}

  /// False if there are too many rays that do not end where the first ones do.
  bool read() {
    scratch_.clear(rays_.count + kRowLanes);
    std::size_t next_look = 16 * kMostRays;
    for (std::size_t begin = 0; begin < rays_.count; begin += kMostRays) {
      const RayRun& run =
          reader_.read(begin, static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, rays_.count - begin)));
      if (16 * scratch_.odd.size() > kMostRays + begin) return false;
      for (std::uint32_t face = 0; face < kViewFaces; ++face) take_face(run, face);
      if (begin < next_look || is_sorting_) continue;
      is_sorting_ = groups_.layers() > kMostLayers;
      next_look *= 2;
    }
    is_sorting_ = is_sorting_ || groups_.layers() > kMostLayers;
    if (is_sorting_) groups_.sort();
    errors_ = reader_.errors();
    return true;
  }

  /// Sorts what was read, which may cost less to walk then. False if it is sorted.
  bool sort() {
    if (is_sorting_) return false;
    is_sorting_ = true;
    groups_.sort();
    return true;
  }

  const LightPoint& light() const { return light_; }
  const ViewErrors& errors() const { return errors_; }

 private:
  static constexpr float kMostLayers = 5;

  /// Picks the run's rays of a face, and cuts them into groups.
  void take_face(const RayRun& run, std::uint32_t number) {
    const RayTag f;
    const RayBitsTag n;
    const auto wanted = hn::Set(n, static_cast<std::int32_t>(number));
    const std::size_t first = scratch_.ray_count;
    Spread spread;
    for_lanes(0, run.count, [&](std::size_t i, RayMask use) {
      const auto keep = hn::And(use, hn::RebindMask(f, hn::Eq(hn::LoadU(n, run.face + i), wanted)));
      if (hn::AllFalse(f, keep)) return;
      const auto u = hn::LoadU(f, run.u + i), v = hn::LoadU(f, run.v + i);
      const auto w = hn::LoadU(f, run.w + i);
      spread.add(u, v, keep);
      const std::size_t at = scratch_.ray_count;
      hn::StoreU(hn::Compress(u, keep), f, scratch_.u.data() + at);
      hn::StoreU(hn::Compress(v, keep), f, scratch_.v.data() + at);
      hn::StoreU(hn::Compress(w, keep), f, scratch_.w.data() + at);
      hn::StoreU(hn::Compress(hn::LoadU(n, run.name + i), hn::RebindMask(n, keep)), n, scratch_.name.data() + at);
      scratch_.ray_count += hn::CountTrue(f, keep);
    });
    const std::size_t count = scratch_.ray_count - first;
    if (count == 0) return;
    scratch_.segments.push_back({number, first, count});
    if (!is_sorting_) groups_.split(number, first, count, spread.get());
  }

  RaySpan rays_;
  LightViewScratch& scratch_;
  LightGroups groups_;
  const LightPoint light_;
  LightReader reader_;
  ViewErrors errors_;
  bool is_sorting_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
