// SPDX-License-Identifier: Apache-2.0
// Rays that the light sees near each other, in groups: cut by halves of their rectangle.

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

 private:
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
