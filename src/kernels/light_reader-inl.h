// SPDX-License-Identifier: Apache-2.0
// Reads rays that end at one light as offsets of their starts from it. They end only nearly at one point: how far off
// they are, and how far the starts may be, goes into the bounds of all that follows.

#if defined(UMBRIX_KERNELS_LIGHT_READER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_READER_INL_H_
#undef UMBRIX_KERNELS_LIGHT_READER_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_READER_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "kernels/group_rays.h"
#include "kernels/light_view.h"
#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Up to kMostRays rays, as offsets of their starts from the light over the largest of the three, the depth.
struct RayRun {
  alignas(64) float u[kMostRays + kRowLanes];
  alignas(64) float v[kMostRays + kRowLanes];
  alignas(64) float w[kMostRays + kRowLanes];  ///< one over the depth
  alignas(64) std::int32_t face[kMostRays + kRowLanes];
  alignas(64) std::int32_t name[kMostRays + kRowLanes];
  std::uint32_t count = 0;
  std::uint32_t faces = 0;  ///< a bit for each face that has some
};

/// The end of the shortest of some rays: the nearer the start, the less its direction's rounding moves the end.
inline LightPoint find_light(RaySpan rays, float scale) {
  LightPoint light;
  constexpr std::size_t kSamples = 64;
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t sample = 0; sample < kSamples; ++sample) {
    const Ray& r = rays[sample * rays.count / kSamples];
    double end[3], length = 0;
    for (int k = 0; k < 3; ++k) {
      const double along = double{r.direction[k]} * double{r.tmax};
      end[k] = (r.origin[k] + along) * double{scale};
      length += along * along;
    }
    if (!(length < shortest) || !(length > 0)) continue;
    shortest = length;
    for (int k = 0; k < 3; ++k) {
      light.high[k] = static_cast<float>(end[k]);
      light.low[k] = static_cast<float>(end[k] - double{light.high[k]});
    }
  }
  return light;
}

/// Starts side by side, as the light sees them.
struct SeenStarts {
  RayVec u, v, w;             ///< on their faces
  hn::Vec<RayBitsTag> face;   ///< its number
  RayVec start_off, end_off;  ///< how far off the ends may be, over the depth,
  RayVec most_off;            ///< and at most
};

/// Reads rays in runs.
class LightReader {
 public:
  /// Of rays that do not end near the light, or are nothing for floats, the numbers go to `odd`.
  LightReader(RaySpan rays, float scale, const LightPoint& light, std::vector<std::uint32_t>& odd)
      : rays_(rays), scale_(scale), light_(light), odd_(odd) {}

  /// At most kMostRays.
  const RayRun& read(std::size_t begin, std::uint32_t count) {
    const auto step = static_cast<std::uint32_t>(hn::Lanes(RayTag()));
    run_.count = run_.faces = 0;
    auto faces = hn::Zero(RayBitsTag());
    for (std::uint32_t i = 0; i < count; i += step) {
      prefetch_rays(rays_, begin + i + kMostRays, step);
      read_lanes(load_rays(rays_, begin + i), begin + i, std::min(step, count - i), faces);
    }
    alignas(64) std::int32_t each[kRowLanes];
    hn::Store(faces, RayBitsTag(), each);
    for (std::uint32_t lane = 0; lane < step; ++lane) run_.faces |= static_cast<std::uint32_t>(each[lane]);
    return run_;
  }

  /// Of all rays so far that are not odd.
  ViewErrors errors() const {
    const auto most = [](const float(&x)[kRowLanes]) { return *std::max_element(x, x + kRowLanes); };
    return {most(start_errors_), most(end_errors_), 0x1p-60f + most(most_errors_)};
  }

 private:
  HWY_INLINE void read_lanes(const RayFields& rays, std::size_t first, std::uint32_t here, hn::Vec<RayBitsTag>& faces) {
    const RayTag f;
    const RayBitsTag n;
    SeenStarts seen;
    const auto good = see(rays, seen);
    const auto present = hn::FirstN(f, here);
    for (std::uint32_t rest = ray_bits(hn::AndNot(good, present)); rest != 0; rest &= rest - 1)
      odd_.push_back(static_cast<std::uint32_t>(first) + first_lane(rest));
    const auto keep = hn::And(good, present);
    if (hn::AllFalse(f, keep)) return;

    const auto raise = [&](float* most, RayVec x) {
      hn::Store(hn::Max(hn::Load(f, most), hn::IfThenElseZero(keep, x)), f, most);
    };
    raise(start_errors_, seen.start_off);
    raise(end_errors_, seen.end_off);
    raise(most_errors_, seen.most_off);
    faces = hn::Or(faces, hn::IfThenElseZero(hn::RebindMask(n, keep), hn::Shl(hn::Set(n, 1), seen.face)));
    add(seen, keep, first);
  }

  /// Lanes of rays that end near the light.
  HWY_INLINE RayMask see(const RayFields& rays, SeenStarts& out) const {
    const RayTag f;
    const auto zero = hn::Zero(f), scale = hn::Set(f, scale_);
    auto off = zero, start_reach = zero, direction = zero, sum = zero;
    RayVec offset[3];
    for (std::size_t k = 0; k < 3; ++k) {
      direction = hn::Max(direction, hn::Abs(rays.direction[k]));
      const auto origin =
          hn::Sub(hn::MulSub(rays.origin[k], scale, hn::Set(f, light_.high[k])), hn::Set(f, light_.low[k]));
      const auto to_start = hn::Mul(hn::Mul(rays.direction[k], rays.tmin), scale);
      const auto end = hn::Abs(hn::Add(origin, hn::Mul(hn::Mul(rays.direction[k], rays.tmax), scale)));
      off = hn::Max(off, end);
      start_reach = hn::Max(start_reach, hn::Add(hn::Abs(origin), hn::Abs(to_start)));
      offset[k] = hn::Add(origin, to_start);
      sum = hn::Add(sum, hn::Add(hn::Abs(offset[k]), end));
    }
    const auto ax = hn::Abs(offset[0]), ay = hn::Abs(offset[1]), az = hn::Abs(offset[2]);
    const auto depth = hn::Max(ax, hn::Max(ay, az));
    out.w = hn::Div(hn::Set(f, 1.0f), depth);
    const auto reach = hn::MulAdd(start_reach, hn::Set(f, 0x1p-22f), off);  // with the rounding of the end
    const auto start_error = hn::IfThenElseZero(hn::Ne(rays.tmin, zero), hn::Mul(start_reach, hn::Set(f, 0x1p-22f)));
    out.end_off = hn::Mul(reach, out.w);
    out.start_off = hn::Mul(start_error, out.w);
    out.most_off = hn::Add(reach, start_error);
    find_faces(offset, out);
    // Only where the end is well away from the start, compared with how far it is off, and where denormals, which the
    // host may flush, are too small to matter. A maximum may lose a NaN, but the sum is one then.
    const auto between = [&](RayVec x, float low, float high) {
      return hn::And(hn::Gt(x, hn::Set(f, low)), hn::Lt(x, hn::Set(f, high)));
    };
    auto good = hn::And(hn::Lt(out.end_off, hn::Set(f, 0x1p-17f)), between(depth, 0x1p-30f, 0x1p20f));
    good = hn::And(good, hn::Lt(sum, hn::Set(f, 0x1p23f)));
    return hn::And(good, hn::And(hn::Lt(rays.tmin, rays.tmax), between(direction, 0x1p-90f, 0x1p30f)));
  }

  static HWY_INLINE void find_faces(const RayVec (&offset)[3], SeenStarts& out) {
    const RayTag f;
    const RayBitsTag n;
    const auto ax = hn::Abs(offset[0]), ay = hn::Abs(offset[1]), az = hn::Abs(offset[2]);
    const auto is_x = hn::Ge(ax, hn::Max(ay, az)), is_y = hn::Ge(ay, az);
    const auto pick = [&](RayVec x, RayVec y, RayVec z) { return hn::IfThenElse(is_x, x, hn::IfThenElse(is_y, y, z)); };
    out.u = hn::Mul(pick(offset[1], offset[2], offset[0]), out.w);
    out.v = hn::Mul(pick(offset[2], offset[0], offset[1]), out.w);
    const auto main = pick(offset[0], offset[1], offset[2]);
    const auto axis = hn::IfThenElse(hn::RebindMask(n, is_x), hn::Zero(n),
                                     hn::IfThenElse(hn::RebindMask(n, is_y), hn::Set(n, 2), hn::Set(n, 4)));
    out.face = hn::Add(axis, hn::IfThenElseZero(hn::RebindMask(n, hn::Lt(main, hn::Zero(f))), hn::Set(n, 1)));
  }

  HWY_INLINE void add(const SeenStarts& seen, RayMask keep, std::size_t first) {
    const RayTag f;
    const RayBitsTag n;
    const auto whole = hn::RebindMask(n, keep);
    hn::StoreU(hn::Compress(seen.u, keep), f, run_.u + run_.count);
    hn::StoreU(hn::Compress(seen.v, keep), f, run_.v + run_.count);
    hn::StoreU(hn::Compress(seen.w, keep), f, run_.w + run_.count);
    hn::StoreU(hn::Compress(seen.face, whole), n, run_.face + run_.count);
    const auto name = hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(first)));
    hn::StoreU(hn::Compress(name, whole), n, run_.name + run_.count);
    run_.count += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
  }

  RaySpan rays_;
  float scale_;
  const LightPoint& light_;
  std::vector<std::uint32_t>& odd_;
  alignas(64) float start_errors_[kRowLanes] = {};
  alignas(64) float end_errors_[kRowLanes] = {};
  alignas(64) float most_errors_[kRowLanes] = {};
  RayRun run_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
