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

/// Up to kMostRays rays, as offsets of their starts from the light over the largest of the three, the depth.
struct RayRun {
  alignas(64) float place[3][kMostRays + kRowLanes];
  alignas(64) float w[kMostRays + kRowLanes];  ///< one over the depth
  alignas(64) std::int32_t face[kMostRays + kRowLanes];
  alignas(64) std::int32_t name[kMostRays + kRowLanes];
  std::uint32_t count = 0;
};

/// A rectangle of (u, v).
struct Rectangle {
  float low_u, high_u, low_v, high_v;

  float area() const { return (high_u - low_u) * (high_v - low_v); }
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
    scratch_.clear(rays_.count + kRowLanes);
    std::size_t next_look = 16 * kMostRays;
    for (std::size_t begin = 0; begin < rays_.count; begin += kMostRays) {
      const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(kMostRays, rays_.count - begin));
      run_.count = 0;
      read_run(begin, count);
      if (16 * scratch_.odd.size() > kMostRays + begin) return false;
      for (std::uint32_t face = 0; face < kViewFaces; ++face) take_face(face);
      if (begin < next_look || is_sorting_) continue;
      is_sorting_ = overlap_.layers() > kMostLayers;
      next_look *= 2;
    }
    if (is_sorting_ || overlap_.layers() > kMostLayers) sort();
    errors_.end = *std::max_element(end_errors_, end_errors_ + kRowLanes);
    errors_.start = *std::max_element(start_errors_, start_errors_ + kRowLanes);
    errors_.most = 0x1p-60f + *std::max_element(most_errors_, most_errors_ + kRowLanes);
    return true;
  }

  float layers() const { return overlap_.layers(); }
  const LightPoint& light() const { return light_; }
  const ViewErrors& errors() const { return errors_; }

 private:
  static constexpr float kMostLayers = 8;
  static constexpr std::uint32_t kCells = 64;  ///< of a face, along a side

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
    const auto zero = hn::Zero(f), scale = hn::Set(f, scale_);
    auto off = zero, start_reach = zero, direction = zero;
    RayVec offset[3];
    for (std::size_t k = 0; k < 3; ++k) {
      direction = hn::Max(direction, hn::Abs(d[k]));
      const auto origin = hn::Sub(hn::MulSub(o[k], scale, hn::Set(f, light_.high[k])), hn::Set(f, light_.low[k]));
      const auto to_start = hn::Mul(hn::Mul(d[k], tmin), scale), to_end = hn::Mul(hn::Mul(d[k], tmax), scale);
      off = hn::Max(off, hn::Abs(hn::Add(origin, to_end)));
      start_reach = hn::Max(start_reach, hn::Add(hn::Abs(origin), hn::Abs(to_start)));
      offset[k] = hn::Add(origin, to_start);
    }
    const auto ax = hn::Abs(offset[0]), ay = hn::Abs(offset[1]), az = hn::Abs(offset[2]);
    const auto depth = hn::Max(ax, hn::Max(ay, az)), w = hn::Div(hn::Set(f, 1.0f), depth);
    const auto reach = hn::MulAdd(start_reach, hn::Set(f, 0x1p-21f), off);  // with the rounding of the end
    // Only where the end is well away from the start, compared with how far it is off, and where denormals, which the
    // host may flush, are too small to matter. NaN is never good.
    const auto between = [&](RayVec x, float low, float high) {
      return hn::And(hn::Gt(x, hn::Set(f, low)), hn::Lt(x, hn::Set(f, high)));
    };
    const auto end_error = hn::Mul(reach, w);
    auto good = hn::And(hn::Lt(end_error, hn::Set(f, 0x1p-17f)), between(depth, 0x1p-30f, 0x1p20f));
    good = hn::And(good, hn::And(hn::Lt(tmin, tmax), between(direction, 0x1p-90f, 0x1p30f)));
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
    const auto moved = hn::AndNot(hn::Eq(tmin, zero), keep);
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

  /// Picks the run's rays of a face, and groups them.
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
    if (!is_sorting_) split(number, first, count, spread.get());
  }

  /// Brings rays together that the light sees in one direction: by cells of the view, which are then cut as any others.
  void sort() {
    auto& ends = scratch_.counts;
    ends.assign(kViewFaces * kCells * kCells + 1, 0);
    for_rays([&](std::uint32_t cell, std::size_t) { ++ends[cell + 1]; });
    for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
    scratch_.records.resize(scratch_.ray_count + kRowLanes);
    for_rays([&](std::uint32_t cell, std::size_t i) {
      scratch_.records[ends[cell]++] = {scratch_.u[i], scratch_.v[i], scratch_.w[i], scratch_.name[i]};
    });
    for (std::size_t i = 0; i < scratch_.ray_count; ++i) {
      const auto& r = scratch_.records[i];
      scratch_.u[i] = r.u;
      scratch_.v[i] = r.v;
      scratch_.w[i] = r.w;
      scratch_.name[i] = r.name;
    }
    for (auto& face : scratch_.faces) face.groups.clear();
    std::size_t first = 0;
    for (std::uint32_t cell = 0; cell + 1 < ends.size(); ++cell) {
      const std::size_t count = ends[cell] - first;
      if (count != 0) split(cell / (kCells * kCells), first, count, bounds(first, count));
      first = ends[cell];
    }
  }

  static std::uint32_t spread_bits(std::uint32_t x) {  // a zero before each of 8 bits
    x = (x | x << 4) & 0x0F0Fu;
    x = (x | x << 2) & 0x3333u;
    return (x | x << 1) & 0x5555u;
  }
  template <class Each>
  void for_rays(Each&& each) const {
    const auto place = [](float x) {
      return std::min(static_cast<std::uint32_t>(std::max(x + 1, 0.0f) * (0.5f * kCells)), kCells - 1);
    };
    for (const auto& segment : scratch_.segments) {
      const std::uint32_t base = segment.face * kCells * kCells;
      for (std::size_t i = segment.first; i < segment.first + segment.count; ++i)
        each(base + (spread_bits(place(scratch_.u[i])) | spread_bits(place(scratch_.v[i])) << 1), i);
    }
  }

  template <class Each>
  static HWY_INLINE void for_lanes(std::size_t first, std::size_t count, Each&& each) {
    const RayTag f;
    for (std::size_t i = 0; i < count; i += hn::Lanes(f)) each(first + i, hn::FirstN(f, count - i));
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

  Rectangle bounds(std::size_t first, std::size_t count) const {
    const RayTag f;
    Spread spread;
    for_lanes(first, count, [&](std::size_t i, RayMask use) {
      spread.add(hn::LoadU(f, scratch_.u.data() + i), hn::LoadU(f, scratch_.v.data() + i), use);
    });
    return spread.get();
  }

  /// Cuts the rectangle in the middle of its longer side, down to few rays.
  void split(std::uint32_t face, std::size_t first, std::size_t count, const Rectangle& r) {
    if (count <= kGroupRays) {
      add_group(face, first, count, r);
      return;
    }
    const bool by_u = r.high_u - r.low_u >= r.high_v - r.low_v;
    Rectangle low, high;
    std::size_t lows = partition(first, count, by_u, by_u ? 0.5f * (r.low_u + r.high_u) : 0.5f * (r.low_v + r.high_v),
                                 low, high);
    if (lows == 0 || lows == count) {  // starts that cannot be told apart
      lows = kGroupRays;
      low = high = r;
    }
    split(face, first, lows, low);
    split(face, first + lows, count - lows, high);
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
      for (std::size_t k = 0; k < 3; ++k) hn::StoreU(hn::Compress(x[k], above), f, above_rows[k].data() + high_end);
      hn::StoreU(hn::Compress(name, hn::RebindMask(n, above)), n, scratch_.above_name.data() + high_end);
      const auto lows = hn::CountTrue(f, below);
      high_end += hn::CountTrue(f, above);
      const auto first_lows = hn::FirstN(f, lows);
      for (std::size_t k = 0; k < 3; ++k) hn::BlendedStore(hn::Compress(x[k], below), first_lows, f, rows[k] + low_end);
      hn::BlendedStore(hn::Compress(name, hn::RebindMask(n, below)), hn::RebindMask(n, first_lows), n,
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
  alignas(64) float end_errors_[kRowLanes] = {}, start_errors_[kRowLanes] = {}, most_errors_[kRowLanes] = {};
  RayRun run_;
  bool is_sorting_ = false;
  Overlap overlap_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
