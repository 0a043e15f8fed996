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

#include "kernels/compress-inl.h"
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

/// Are too many of the rays read so far not for the view?
inline bool are_odd(std::size_t odd, std::size_t rays) { return 16 * odd > kMostRays + rays; }

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
    const RayTag f;
    const RayBitsTag n;
    const auto step = static_cast<std::uint32_t>(hn::Lanes(f));
    run_.count = run_.faces = 0;
    Sums sums{hn::Load(f, start_errors_), hn::Load(f, end_errors_), hn::Load(f, most_errors_), hn::Zero(n)};
    for (std::uint32_t i = 0; i < count; i += step) {
      prefetch_rays(rays_, begin + i + kMostRays, step);
      read_lanes(load_rays(rays_, begin + i), begin + i, std::min(step, count - i), sums);
    }
    hn::Store(sums.start_off, f, start_errors_);
    hn::Store(sums.end_off, f, end_errors_);
    hn::Store(sums.most_off, f, most_errors_);
    alignas(64) std::int32_t faces[kRowLanes];
    hn::Store(sums.faces, n, faces);
    for (std::uint32_t lane = 0; lane < step; ++lane) run_.faces |= static_cast<std::uint32_t>(faces[lane]);
    return run_;
  }

  /// Of all rays so far that are not odd.
  ViewErrors errors() const {
    const auto most = [](const float(&x)[kRowLanes]) { return *std::max_element(x, x + kRowLanes); };
    return {most(start_errors_), most(end_errors_), 0x1p-60f + most(most_errors_)};
  }

 private:
  /// Lane by lane.
  struct Sums {
    RayVec start_off, end_off, most_off;  ///< largest so far
    hn::Vec<RayBitsTag> faces;            ///< a bit for each
  };

  HWY_INLINE void read_lanes(const RayFields& rays, std::size_t first, std::uint32_t here, Sums& sums) {
    const RayTag f;
    SeenStarts seen;
    const bool at_once = hn::AllTrue(f, hn::Eq(rays.tmin, hn::Zero(f)));
    const auto good = at_once ? see<true>(rays, seen) : see<false>(rays, seen);
    const auto present = hn::FirstN(f, here), keep = hn::And(good, present);
    if (HWY_LIKELY(hn::AllTrue(f, keep))) {
      add<true>(seen, keep, first, sums);
      return;
    }
    for (std::uint32_t rest = ray_bits(hn::AndNot(good, present)); rest != 0; rest &= rest - 1)
      odd_.push_back(static_cast<std::uint32_t>(first) + first_lane(rest));
    add<false>(seen, keep, first, sums);
  }

  /// Lanes of rays that end near the light. If all rays begin at their origins some of it is known.
  template <bool kAtOnce>
  HWY_INLINE RayMask see(const RayFields& rays, SeenStarts& out) const {
    const RayTag f;
    const auto zero = hn::Zero(f), scale = hn::Set(f, scale_);
    const auto first = hn::Mul(rays.tmin, scale), last = hn::Mul(rays.tmax, scale);
    auto off = zero, start_reach = zero, sum = zero;
    RayVec offset[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto origin =
          hn::Sub(hn::MulSub(rays.origin[k], scale, hn::Set(f, light_.high[k])), hn::Set(f, light_.low[k]));
      const auto end = hn::MulAdd(rays.direction[k], last, origin);
      off = hn::Max(off, hn::Abs(end));
      offset[k] = origin;
      if constexpr (!kAtOnce) {
        const auto to_start = hn::Mul(rays.direction[k], first);
        start_reach = hn::Max(start_reach, hn::Add(hn::Abs(origin), hn::Abs(to_start)));
        offset[k] = hn::Add(origin, to_start);
      }
      sum = hn::Add(sum, hn::Add(offset[k], end));
    }
    const auto depth = hn::Max(hn::Abs(offset[0]), hn::Max(hn::Abs(offset[1]), hn::Abs(offset[2])));
    if constexpr (kAtOnce) start_reach = depth;
    out.w = hn::Div(hn::Set(f, 1.0f), depth);
    const auto rounding = hn::Mul(start_reach, hn::Set(f, 0x1p-22f));
    const auto reach = hn::Add(off, rounding);
    const auto start_error = kAtOnce ? zero : hn::IfThenElseZero(hn::Ne(rays.tmin, zero), rounding);
    out.end_off = hn::Mul(reach, out.w);
    out.start_off = hn::Mul(start_error, out.w);
    out.most_off = hn::Add(reach, start_error);
    find_faces(offset, out);
    // Only where the end is well away from the start, compared with how far it is off; and where times are so large
    // that directions are small, so that what is lost to denormals is too. A maximum may lose a NaN, a sum does not.
    auto good = hn::And(hn::Lt(out.end_off, hn::Set(f, 0x1p-17f)), hn::Gt(depth, hn::Set(f, 0x1p-30f)));
    good = hn::And(good, hn::And(hn::Lt(depth, hn::Set(f, 0x1p20f)), hn::Lt(sum, hn::Set(f, 0x1p23f))));
    return hn::And(good, hn::And(hn::Lt(rays.tmin, rays.tmax), hn::Gt(last, hn::Set(f, 0x1p-70f))));
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

  /// The lanes to keep, which may be all.
  template <bool kAll>
  HWY_INLINE void add(const SeenStarts& seen, RayMask keep, std::size_t first, Sums& sums) {
    const RayTag f;
    const RayBitsTag n;
    const auto or_zero = [&](auto tag, auto x) { return kAll ? x : hn::IfThenElseZero(hn::RebindMask(tag, keep), x); };
    sums.start_off = hn::Max(sums.start_off, or_zero(f, seen.start_off));
    sums.end_off = hn::Max(sums.end_off, or_zero(f, seen.end_off));
    sums.most_off = hn::Max(sums.most_off, or_zero(f, seen.most_off));
    sums.faces = hn::Or(sums.faces, or_zero(n, hn::Shl(hn::Set(n, 1), seen.face)));
    const auto put = [&](auto tag, auto x, auto* row) {
      hn::StoreU(kAll ? x : compress(x, hn::RebindMask(tag, keep)), tag, row + run_.count);
    };
    put(f, seen.u, run_.u);
    put(f, seen.v, run_.v);
    put(f, seen.w, run_.w);
    put(n, seen.face, run_.face);
    put(n, hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(first))), run_.name);
    run_.count += static_cast<std::uint32_t>(kAll ? hn::Lanes(f) : hn::CountTrue(f, keep));
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
