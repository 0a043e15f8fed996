// SPDX-License-Identifier: Apache-2.0
// Rays that end at one light, as it sees their starts. They end only nearly at one point: how far off they are, and how
// far the starts may be, goes into the bounds of all that follows.

#if defined(UMBRIX_KERNELS_LIGHT_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "kernels/group_rays.h"
#include "kernels/light_groups-inl.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Up to kMostRays rays, as offsets of their starts from the light over the largest of the three, the depth.
struct RayRun {
  alignas(64) float place[3][kMostRays + kRowLanes];
  alignas(64) float w[kMostRays + kRowLanes];  ///< one over the depth
  alignas(64) std::int32_t face[kMostRays + kRowLanes];
  alignas(64) std::int32_t name[kMostRays + kRowLanes];
  std::uint32_t count = 0;
};

/// Reads rays, and brings them into groups.
class LightRays {
 public:
  LightRays(const Tree& tree, RaySpan rays, LightViewScratch& scratch)
      : rays_(rays), scratch_(scratch), groups_(scratch), scale_(power_of_two(tree.scale_exponent)) {}

  /// False if there are too many rays that do not end where the first ones do.
  bool read() {
    find_light();
    scratch_.clear(rays_.count + kRowLanes);
    std::size_t next_look = 16 * kMostRays;
    for (std::size_t begin = 0; begin < rays_.count; begin += kMostRays) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, rays_.count - begin));
      run_.count = 0;
      read_run(begin, count);
      if (16 * scratch_.odd.size() > kMostRays + begin) return false;
      for (std::uint32_t face = 0; face < kViewFaces; ++face) take_face(face);
      if (begin < next_look || is_sorting_) continue;
      is_sorting_ = groups_.layers() > kMostLayers;
      next_look *= 2;
    }
    is_sorting_ = is_sorting_ || groups_.layers() > kMostLayers;
    if (is_sorting_) groups_.sort();
    const auto most = [](const float(&x)[kRowLanes]) { return *std::max_element(x, x + kRowLanes); };
    errors_ = {most(start_errors_), most(end_errors_), 0x1p-60f + most(most_errors_)};
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

  /// The end of the shortest of some rays: the nearer the start, the less its direction's rounding moves the end.
  void find_light() {
    constexpr std::size_t kSamples = 64;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
      const Ray& r = rays_[sample * rays_.count / kSamples];
      double end[3], length = 0;
      for (int k = 0; k < 3; ++k) {
        const double along = double{r.direction[k]} * double{r.tmax};
        end[k] = (r.origin[k] + along) * double{scale_};
        length += along * along;
      }
      if (!(length < shortest) || !(length > 0)) continue;
      shortest = length;
      for (int k = 0; k < 3; ++k) {
        light_.high[k] = static_cast<float>(end[k]);
        light_.low[k] = static_cast<float>(end[k] - double{light_.high[k]});
      }
    }
  }

  void read_run(std::size_t begin, std::uint32_t count) {
    const auto step = static_cast<std::uint32_t>(hn::Lanes(RayTag()));
    for (std::uint32_t i = 0; i < count; i += step)
      read_lanes(load_rays(rays_, begin + i), begin + i, std::min(step, count - i));
  }

  HWY_INLINE void read_lanes(const RayFields& r, std::size_t first, std::uint32_t here) {
    const RayTag f;
    const RayBitsTag n;
    const auto zero = hn::Zero(f), scale = hn::Set(f, scale_);
    auto off = zero, start_reach = zero, direction = zero, sum = zero;
    RayVec offset[3];
    for (std::size_t k = 0; k < 3; ++k) {
      direction = hn::Max(direction, hn::Abs(r.direction[k]));
      const auto origin =
          hn::Sub(hn::MulSub(r.origin[k], scale, hn::Set(f, light_.high[k])), hn::Set(f, light_.low[k]));
      const auto to_start = hn::Mul(hn::Mul(r.direction[k], r.tmin), scale),
                 to_end = hn::Mul(hn::Mul(r.direction[k], r.tmax), scale);
      const auto end = hn::Abs(hn::Add(origin, to_end));
      off = hn::Max(off, end);
      start_reach = hn::Max(start_reach, hn::Add(hn::Abs(origin), hn::Abs(to_start)));
      offset[k] = hn::Add(origin, to_start);
      sum = hn::Add(sum, hn::Add(hn::Abs(offset[k]), end));
    }
    const auto ax = hn::Abs(offset[0]), ay = hn::Abs(offset[1]), az = hn::Abs(offset[2]);
    const auto depth = hn::Max(ax, hn::Max(ay, az)), w = hn::Div(hn::Set(f, 1.0f), depth);
    const auto reach = hn::MulAdd(start_reach, hn::Set(f, 0x1p-22f), off);  // with the rounding of the end
    // Only where the end is well away from the start, compared with how far it is off, and where denormals, which the
    // host may flush, are too small to matter. A maximum may lose a NaN, but the sum is one then.
    const auto between = [&](RayVec x, float low, float high) {
      return hn::And(hn::Gt(x, hn::Set(f, low)), hn::Lt(x, hn::Set(f, high)));
    };
    const auto end_error = hn::Mul(reach, w);
    auto good = hn::And(hn::Lt(end_error, hn::Set(f, 0x1p-17f)), between(depth, 0x1p-30f, 0x1p20f));
    good = hn::And(good, hn::Lt(sum, hn::Set(f, 0x1p23f)));
    good = hn::And(good, hn::And(hn::Lt(r.tmin, r.tmax), between(direction, 0x1p-90f, 0x1p30f)));
    const auto present = hn::FirstN(f, here);
    const auto keep = hn::And(good, present);
    for (std::uint32_t rest = ray_bits(hn::AndNot(good, present)); rest != 0; rest &= rest - 1)
      scratch_.odd.push_back(static_cast<std::uint32_t>(first) + first_lane(rest));
    if (hn::AllFalse(f, keep)) return;

    const auto raise = [&](float* most, RayVec x, RayMask use) {
      hn::Store(hn::Max(hn::Load(f, most), hn::IfThenElseZero(use, x)), f, most);
    };
    raise(end_errors_, end_error, keep);
    raise(most_errors_, reach, keep);
    const auto moved = hn::AndNot(hn::Eq(r.tmin, zero), keep);
    if (!hn::AllFalse(f, moved)) {
      const auto error = hn::Mul(start_reach, hn::Set(f, 0x1p-22f));
      raise(start_errors_, hn::Mul(error, w), moved);
      raise(most_errors_, hn::Add(reach, error), moved);
    }
    const auto is_x = hn::Ge(ax, hn::Max(ay, az)), is_y = hn::Ge(ay, az);
    const auto main = hn::IfThenElse(is_x, offset[0], hn::IfThenElse(is_y, offset[1], offset[2]));
    auto face = hn::IfThenElse(hn::RebindMask(n, is_x), hn::Zero(n),
                               hn::IfThenElse(hn::RebindMask(n, is_y), hn::Set(n, 2), hn::Set(n, 4)));
    face = hn::Add(face, hn::IfThenElseZero(hn::RebindMask(n, hn::Lt(main, zero)), hn::Set(n, 1)));
    for (std::size_t k = 0; k < 3; ++k)
      hn::StoreU(hn::Compress(hn::Mul(offset[k], w), keep), f, run_.place[k] + run_.count);
    hn::StoreU(hn::Compress(w, keep), f, run_.w + run_.count);
    const auto whole = hn::RebindMask(n, keep);
    hn::StoreU(hn::Compress(face, whole), n, run_.face + run_.count);
    const auto name = hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(first)));
    hn::StoreU(hn::Compress(name, whole), n, run_.name + run_.count);
    run_.count += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
  }

  /// Picks the run's rays of a face, and cuts them into groups.
  void take_face(std::uint32_t number) {
    const Face face(number);
    const RayTag f;
    const RayBitsTag n;
    const auto wanted = hn::Set(n, static_cast<std::int32_t>(number));
    const std::size_t first = scratch_.ray_count;
    Spread spread;
    for_lanes(0, run_.count, [&](std::size_t i, RayMask use) {
      const auto keep = hn::And(use, hn::RebindMask(f, hn::Eq(hn::LoadU(n, run_.face + i), wanted)));
      if (hn::AllFalse(f, keep)) return;
      const auto u = hn::LoadU(f, run_.place[face.u_axis()] + i), v = hn::LoadU(f, run_.place[face.v_axis()] + i);
      const auto w = hn::LoadU(f, run_.w + i);
      spread.add(u, v, keep);
      const std::size_t at = scratch_.ray_count;
      hn::StoreU(hn::Compress(u, keep), f, scratch_.u.data() + at);
      hn::StoreU(hn::Compress(v, keep), f, scratch_.v.data() + at);
      hn::StoreU(hn::Compress(w, keep), f, scratch_.w.data() + at);
      hn::StoreU(hn::Compress(hn::LoadU(n, run_.name + i), hn::RebindMask(n, keep)), n, scratch_.name.data() + at);
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
  float scale_;
  LightPoint light_;
  ViewErrors errors_;
  alignas(64) float end_errors_[kRowLanes] = {};
  alignas(64) float start_errors_[kRowLanes] = {};
  alignas(64) float most_errors_[kRowLanes] = {};
  RayRun run_;
  bool is_sorting_ = false;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
