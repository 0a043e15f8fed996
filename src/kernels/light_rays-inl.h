// SPDX-License-Identifier: Apache-2.0
// Rays that end at one light, as it sees their starts, in groups. Rays end only nearly at one point: how far off they
// are, and how far the starts may be, goes into the bounds of all that follows.

#if defined(UMBRIX_KERNELS_LIGHT_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#undef UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#else
#define UMBRIX_KERNELS_LIGHT_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "kernels/group_rays.h"
#include "kernels/light_view.h"
#include "kernels/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

using RayTag = hn::CappedTag<float, kRowLanes>;
using RayVec = hn::Vec<RayTag>;
using RayMask = hn::Mask<RayTag>;
using RayBitsTag = hn::RebindToSigned<RayTag>;

inline std::uint32_t ray_bits(RayMask mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(RayTag(), mask, bytes);
  return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// The lowest lane of some.
inline std::uint32_t first_lane(std::uint32_t lanes) {
  return static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes));
}

/// Up to kMostRays rays, as offsets of their starts from the light.
struct RayRun {
  alignas(64) float offset[3][kMostRays + kRowLanes];
  alignas(64) std::int32_t face[kMostRays + kRowLanes];
  alignas(64) std::int32_t name[kMostRays + kRowLanes];
  std::uint32_t count = 0;
};

/// Those of one face.
struct FaceRun {
  enum Row : std::uint32_t { u, v, w, kRows };

  alignas(64) float rows[kRows][kMostRays + kRowLanes];
  alignas(64) std::int32_t name[kMostRays + kRowLanes];
};

/// A rectangle of (u, v).
struct Rectangle {
  float low_u, high_u, low_v, high_v;

  float area() const { return (high_u - low_u) * (high_v - low_v); }
};

/// How far the ends of true segments may be from what is computed, over the depth of the start; and at most, anywhere.
struct ViewErrors {
  float start = 0, end = 0;
  float most = 0x1p-60f;
};

/// Where the rays end, as a sum: offsets from it are rounded as if it were a float.
struct LightPoint {
  float high[3] = {}, low[3] = {};
};

/// Reads rays, and sorts them into groups.
class LightRays {
 public:
  LightRays(const Tree& tree, RaySpan rays, LightViewScratch& scratch)
      : rays_(rays), scratch_(scratch), scale_(power_of_two(tree.scale_exponent)) {}

  /// False if there are too many rays that do not end where the first does.
  bool read() {
    find_light();
    scratch_.odd.clear();
    for (auto& face : scratch_.faces) face.groups.clear();
    scratch_.ray_count = 0;
    const std::size_t room = rays_.count + kRowLanes;
    if (scratch_.u.size() < room) {
      scratch_.u.resize(room);
      scratch_.v.resize(room);
      scratch_.w.resize(room);
      scratch_.name.resize(room);
    }
    for (std::size_t begin = 0; begin < rays_.count; begin += kMostRays) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, rays_.count - begin));
      run_.count = 0;
      read_run(begin, count);
      if (16 * scratch_.odd.size() > kMostRays + begin) return false;
      for (std::uint32_t face = 0; face < kViewFaces; ++face) group_face(face);
    }
    return true;
  }

  const LightPoint& light() const { return light_; }
  const ViewErrors& errors() const { return errors_; }

 private:
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
    const RayTag f;
    const auto step = static_cast<std::uint32_t>(hn::Lanes(f));
    for (std::uint32_t i = 0; i < count; i += step) {
      const std::uint32_t here = std::min(step, count - i);
      alignas(64) Ray copies[kRowLanes];
      const float* values = reinterpret_cast<const float*>(&rays_[begin + i]);
      if (rays_.stride != sizeof(Ray) || here < step) {
        std::memset(static_cast<void*>(copies), 0, sizeof copies);
        for (std::uint32_t k = 0; k < here; ++k) copies[k] = rays_[begin + i + k];
        values = reinterpret_cast<const float*>(copies);
      }
      read_lanes(values, begin + i, here);
    }
  }

  HWY_INLINE void read_lanes(const float* values, std::size_t first, std::uint32_t here) {
    const RayTag f;
    const RayBitsTag n;
    [[maybe_unused]] const auto step = hn::Lanes(f);
    RayVec o[3], d[3], tmin, tmax;
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t k = 0; k < 3; ++k) {
      o[k] = hn::LoadU(f, values + k);
      d[k] = hn::LoadU(f, values + 4 + k);
    }
    tmin = hn::LoadU(f, values + 3);
    tmax = hn::LoadU(f, values + 7);
#else
    {
      RayVec a0, a1, a2, a3, b0, b1, b2, b3;  // origin and direction of a ray by turns
      hn::LoadInterleaved4(f, values, a0, a1, a2, a3);
      hn::LoadInterleaved4(f, values + 4 * step, b0, b1, b2, b3);
      o[0] = hn::ConcatEven(f, b0, a0);
      o[1] = hn::ConcatEven(f, b1, a1);
      o[2] = hn::ConcatEven(f, b2, a2);
      tmin = hn::ConcatEven(f, b3, a3);
      d[0] = hn::ConcatOdd(f, b0, a0);
      d[1] = hn::ConcatOdd(f, b1, a1);
      d[2] = hn::ConcatOdd(f, b2, a2);
      tmax = hn::ConcatOdd(f, b3, a3);
    }
#endif
    // What may be a denormal, or made one: the host may flush them.
    const auto tiny = hn::Set(f, 0x1p-90f), zero = hn::Zero(f), scale = hn::Set(f, scale_);
    auto good = hn::Or(hn::Gt(hn::Abs(tmin), tiny), hn::Eq(tmin, zero));
    auto off = zero, start_reach = zero, direction = zero;
    RayVec offset[3];
    for (std::size_t k = 0; k < 3; ++k) {
      good = hn::And(good, hn::Or(hn::Gt(hn::Abs(o[k]), tiny), hn::Eq(o[k], zero)));
      good = hn::And(good, hn::Or(hn::Gt(hn::Abs(d[k]), tiny), hn::Eq(d[k], zero)));
      direction = hn::Max(direction, hn::Abs(d[k]));
      const auto origin = hn::Sub(hn::MulSub(o[k], scale, hn::Set(f, light_.high[k])), hn::Set(f, light_.low[k]));
      const auto to_start = hn::Mul(hn::Mul(d[k], tmin), scale), to_end = hn::Mul(hn::Mul(d[k], tmax), scale);
      off = hn::Max(off, hn::Abs(hn::Add(origin, to_end)));
      start_reach = hn::Max(start_reach, hn::Add(hn::Abs(origin), hn::Abs(to_start)));
      offset[k] = hn::Add(origin, to_start);
    }
    const auto ax = hn::Abs(offset[0]), ay = hn::Abs(offset[1]), az = hn::Abs(offset[2]);
    const auto depth = hn::Max(ax, hn::Max(ay, az));
    const auto reach = hn::MulAdd(start_reach, hn::Set(f, 0x1p-21f), off);  // with the rounding of the end
    // Only where the end is well away from the start, compared with how far it is off. NaN is never good.
    good = hn::And(good, hn::And(hn::Lt(hn::Mul(reach, hn::Set(f, 0x1p17f)), depth),
                                 hn::And(hn::Gt(depth, hn::Set(f, 0x1p-30f)), hn::Lt(depth, hn::Set(f, 0x1p20f)))));
    good = hn::And(good, hn::And(hn::Lt(tmin, tmax), hn::Gt(direction, zero)));
    const auto present = hn::FirstN(f, here);
    const auto keep = hn::And(good, present);
    for (std::uint32_t rest = ray_bits(hn::AndNot(good, present)); rest != 0; rest &= rest - 1)
      scratch_.odd.push_back(static_cast<std::uint32_t>(first) + first_lane(rest));
    if (hn::AllFalse(f, keep)) return;

    const auto most = [&](float x, RayVec y) {
      return std::max(x, hn::GetLane(hn::MaxOfLanes(f, hn::IfThenElseZero(keep, y))));
    };
    errors_.end = most(errors_.end, hn::Div(reach, depth));
    errors_.most = most(errors_.most, reach);
    const auto moved = hn::AndNot(hn::Eq(tmin, zero), keep);
    if (!hn::AllFalse(f, moved)) {
      const auto error = hn::IfThenElseZero(moved, hn::Mul(start_reach, hn::Set(f, 0x1p-22f)));
      errors_.start = most(errors_.start, hn::Div(error, depth));
      errors_.most = most(errors_.most, hn::Add(reach, error));
    }
    const auto is_x = hn::Ge(ax, hn::Max(ay, az)), is_y = hn::Ge(ay, az);
    const auto main = hn::IfThenElse(is_x, offset[0], hn::IfThenElse(is_y, offset[1], offset[2]));
    auto face = hn::IfThenElse(hn::RebindMask(n, is_x), hn::Zero(n),
                               hn::IfThenElse(hn::RebindMask(n, is_y), hn::Set(n, 2), hn::Set(n, 4)));
    face = hn::Add(face, hn::IfThenElseZero(hn::RebindMask(n, hn::Lt(main, zero)), hn::Set(n, 1)));
    for (std::size_t k = 0; k < 3; ++k) hn::StoreU(hn::Compress(offset[k], keep), f, run_.offset[k] + run_.count);
    const auto whole = hn::RebindMask(n, keep);
    hn::StoreU(hn::Compress(face, whole), n, run_.face + run_.count);
    const auto name = hn::Add(hn::Iota(n, 0), hn::Set(n, static_cast<std::int32_t>(first)));
    hn::StoreU(hn::Compress(name, whole), n, run_.name + run_.count);
    run_.count += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
  }

  /// Picks the run's rays of a face, and groups them.
  void group_face(std::uint32_t number) {
    const Face face(number);
    const RayTag f;
    const RayBitsTag n;
    const auto wanted = hn::Set(n, static_cast<std::int32_t>(number));
    std::uint32_t count = 0;
    for_lanes(0, run_.count, [&](std::uint32_t i, RayMask use) {
      const auto keep = hn::And(use, hn::RebindMask(f, hn::Eq(hn::LoadU(n, run_.face + i), wanted)));
      if (hn::AllFalse(f, keep)) return;
      const auto w = hn::Div(hn::Set(f, face.sign), hn::LoadU(f, run_.offset[face.axis] + i));
      const auto u = hn::Mul(hn::LoadU(f, run_.offset[face.u_axis()] + i), w);
      const auto v = hn::Mul(hn::LoadU(f, run_.offset[face.v_axis()] + i), w);
      hn::StoreU(hn::Compress(u, keep), f, part_.rows[FaceRun::u] + count);
      hn::StoreU(hn::Compress(v, keep), f, part_.rows[FaceRun::v] + count);
      hn::StoreU(hn::Compress(w, keep), f, part_.rows[FaceRun::w] + count);
      hn::StoreU(hn::Compress(hn::LoadU(n, run_.name + i), hn::RebindMask(n, keep)), n, part_.name + count);
      count += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
    });
    if (count != 0) split(number, 0, count, bounds(0, count));
  }

  template <class Each>
  static HWY_INLINE void for_lanes(std::uint32_t first, std::uint32_t count, Each&& each) {
    const RayTag f;
    const auto step = static_cast<std::uint32_t>(hn::Lanes(f));
    for (std::uint32_t i = 0; i < count; i += step) each(first + i, hn::FirstN(f, count - i));
  }

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
      const RayTag f;
      return {hn::GetLane(hn::MinOfLanes(f, low_u)), hn::GetLane(hn::MaxOfLanes(f, high_u)),
              hn::GetLane(hn::MinOfLanes(f, low_v)), hn::GetLane(hn::MaxOfLanes(f, high_v))};
    }
  };

  Rectangle bounds(std::uint32_t first, std::uint32_t count) const {
    const RayTag f;
    Spread spread;
    for_lanes(first, count, [&](std::uint32_t i, RayMask use) {
      spread.add(hn::LoadU(f, part_.rows[FaceRun::u] + i), hn::LoadU(f, part_.rows[FaceRun::v] + i), use);
    });
    return spread.get();
  }

  /// Cuts the rectangle in the middle of its longer side, down to few rays.
  void split(std::uint32_t face, std::uint32_t first, std::uint32_t count, const Rectangle& r) {
    if (count <= kGroupRays) {
      add_group(face, first, count, r);
      return;
    }
    const bool by_u = r.high_u - r.low_u >= r.high_v - r.low_v;
    Rectangle low, high;
    std::uint32_t lows = partition(first, count, by_u ? FaceRun::u : FaceRun::v,
                                   by_u ? 0.5f * (r.low_u + r.high_u) : 0.5f * (r.low_v + r.high_v), low, high);
    if (lows == 0 || lows == count) {  // starts that cannot be told apart
      lows = kGroupRays;
      low = high = r;
    }
    split(face, first, lows, low);
    split(face, first + lows, count - lows, high);
  }

  std::uint32_t partition(std::uint32_t first, std::uint32_t count, FaceRun::Row key, float middle, Rectangle& low,
                          Rectangle& high) {
    const RayTag f;
    const RayBitsTag n;
    std::uint32_t low_end = first, high_end = 0;
    Spread low_spread, high_spread;
    for_lanes(first, count, [&](std::uint32_t i, RayMask use) {
      const auto u = hn::LoadU(f, part_.rows[FaceRun::u] + i), v = hn::LoadU(f, part_.rows[FaceRun::v] + i);
      const auto w = hn::LoadU(f, part_.rows[FaceRun::w] + i);
      const auto name = hn::LoadU(n, part_.name + i);
      const auto below = hn::And(use, hn::Lt(key == FaceRun::u ? u : v, hn::Set(f, middle)));
      const auto above = hn::AndNot(below, use);
      low_spread.add(u, v, below);
      high_spread.add(u, v, above);
      // What is written past the low ones was read before, as they come no later than here.
      hn::StoreU(hn::Compress(u, above), f, above_.rows[FaceRun::u] + high_end);
      hn::StoreU(hn::Compress(v, above), f, above_.rows[FaceRun::v] + high_end);
      hn::StoreU(hn::Compress(w, above), f, above_.rows[FaceRun::w] + high_end);
      hn::StoreU(hn::Compress(name, hn::RebindMask(n, above)), n, above_.name + high_end);
      const auto lows = hn::CountTrue(f, below);
      high_end += static_cast<std::uint32_t>(hn::CountTrue(f, above));
      const auto first_lows = hn::FirstN(f, lows);
      hn::BlendedStore(hn::Compress(u, below), first_lows, f, part_.rows[FaceRun::u] + low_end);
      hn::BlendedStore(hn::Compress(v, below), first_lows, f, part_.rows[FaceRun::v] + low_end);
      hn::BlendedStore(hn::Compress(w, below), first_lows, f, part_.rows[FaceRun::w] + low_end);
      hn::BlendedStore(hn::Compress(name, hn::RebindMask(n, below)), hn::RebindMask(n, first_lows), n,
                       part_.name + low_end);
      low_end += static_cast<std::uint32_t>(lows);
    });
    for (std::uint32_t row = 0; row < FaceRun::kRows; ++row)
      std::memcpy(part_.rows[row] + low_end, above_.rows[row], high_end * sizeof(float));
    std::memcpy(part_.name + low_end, above_.name, high_end * sizeof(std::int32_t));
    low = low_spread.get();
    high = high_spread.get();
    return low_end - first;
  }

  /// Takes the rays over to the view's order.
  void add_group(std::uint32_t face, std::uint32_t first, std::uint32_t count, const Rectangle& r) {
    const std::size_t at = scratch_.ray_count;
    std::memcpy(scratch_.u.data() + at, part_.rows[FaceRun::u] + first, count * sizeof(float));
    std::memcpy(scratch_.v.data() + at, part_.rows[FaceRun::v] + first, count * sizeof(float));
    std::memcpy(scratch_.w.data() + at, part_.rows[FaceRun::w] + first, count * sizeof(float));
    std::memcpy(scratch_.name.data() + at, part_.name + first, count * sizeof(std::uint32_t));
    RayGroup group;
    group.u = 0.5f * (r.low_u + r.high_u);
    group.v = 0.5f * (r.low_v + r.high_v);
    group.half_u = std::max(r.high_u - group.u, group.u - r.low_u);
    group.half_v = std::max(r.high_v - group.v, group.v - r.low_v);
    group.first = static_cast<std::uint32_t>(at);
    group.count = count;
    fit_plane(first, count, group);
    scratch_.faces[face].groups.push_back(group);
    scratch_.ray_count += count;
  }

  /// A plane has a depth whose inverse is linear in (u, v): that of three starts bounds the others if they are in one.
  void fit_plane(std::uint32_t first, std::uint32_t count, RayGroup& group) const {
    const float* u = part_.rows[FaceRun::u];
    const float* v = part_.rows[FaceRun::v];
    const float* w = part_.rows[FaceRun::w];
    const std::uint32_t a = first, b = first + count / 3, c = first + 2 * count / 3;
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
    for_lanes(first, count, [&](std::uint32_t i, RayMask use) {
      const auto x = hn::LoadU(f, w + i);
      const auto rest = hn::NegMulAdd(sv, hn::LoadU(f, v + i), hn::NegMulAdd(su, hn::LoadU(f, u + i), x));
      low = hn::IfThenElse(use, hn::Min(low, rest), low);
      high = hn::IfThenElse(use, hn::Max(high, rest), high);
      low_w = hn::IfThenElse(use, hn::Min(low_w, x), low_w);
      high_w = hn::IfThenElse(use, hn::Max(high_w, x), high_w);
    });
    const float least = hn::GetLane(hn::MinOfLanes(f, low)), most = hn::GetLane(hn::MaxOfLanes(f, high));
    const float least_w = hn::GetLane(hn::MinOfLanes(f, low_w));
    group.nearest = hn::GetLane(hn::MaxOfLanes(f, high_w));
    group.farthest = least_w;
    const bool is_tighter = most - least < 0.5f * (group.nearest - least_w);
    group.slope_u = is_tighter ? slope_u : 0;
    group.slope_v = is_tighter ? slope_v : 0;
    group.base = is_tighter ? least : least_w;
  }

  RaySpan rays_;
  LightViewScratch& scratch_;
  float scale_;
  LightPoint light_;
  ViewErrors errors_;
  RayRun run_;
  FaceRun part_, above_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
