// SPDX-License-Identifier: Apache-2.0
// Up to sixteen rays that leave one point into nearly one direction, in the tree's units, and their times at boxes.

#if defined(UMBRIX_KERNELS_CLOSEST_PACKET_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_CLOSEST_PACKET_INL_H_
#undef UMBRIX_KERNELS_CLOSEST_PACKET_INL_H_
#else
#define UMBRIX_KERNELS_CLOSEST_PACKET_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "kernels/bvh_walk-inl.h"
#include "kernels/ray_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Least and greatest of sixteen values.
HWY_INLINE Interval range_of(const float (&values)[kRowLanes]) {
  const RayTag f;
  auto low = hn::Load(f, values), high = low;
  for (std::uint32_t i = static_cast<std::uint32_t>(hn::Lanes(f)); i < kRowLanes;
       i += static_cast<std::uint32_t>(hn::Lanes(f))) {
    low = hn::Min(low, hn::Load(f, values + i));
    high = hn::Max(high, hn::Load(f, values + i));
  }
  return {hn::GetLane(hn::MinOfLanes(f, low)), hn::GetLane(hn::MaxOfLanes(f, high))};
}

/// Rays as prepare() makes them. Lanes from `count` on repeat the first.
struct alignas(64) ClosestPacket {
  float direction[3][kRowLanes];
  float tmin[kRowLanes], tmax[kRowLanes];
  float origin[3];
  float inverse_low[3], inverse_high[3];  ///< of each axis; of no use where the rays go both ways
  float middle[3], half[3];               ///< of the directions' box
  float length;                           ///< no direction's 1-norm is larger
  float first_time, last_time;            ///< of all intervals
  double time_scale;
  std::uint32_t up = 0, down = 0;  ///< axes along which all rays go that way
  std::uint32_t count = 0;

  /// Takes rays `first` and following, `rays` of them. False if they are no packet, or one ray is not for floats.
  HWY_INLINE bool read(const RaySpan& span, std::size_t first, std::uint32_t rays, const Tree& tree) {
    const Ray& lead = span[first];
    if (!std::equal(lead.origin, lead.origin + 3, span[first + rays - 1].origin) || !is_valid(lead)) return false;
    WalkRay walk_ray;
    if (prepare(lead, tree, walk_ray) == Reach::far) return false;
    if (walk_ray.time_scale > 0x1p60 || walk_ray.time_scale < 0x1p-60) return false;
    count = rays;
    time_scale = walk_ray.time_scale;
    std::copy(walk_ray.origin, walk_ray.origin + 3, origin);
    const bool is_near_one = std::abs(tree.scale_exponent) <= 6 && time_scale <= 0x1p6;
    for (std::uint32_t i = 0; i < rays && !is_near_one; ++i)
      if (has_denormals(span[first + i])) return false;
    const auto scale = static_cast<float>(time_scale * power_of_two_double(-tree.scale_exponent));
    return load(span, first, 1 / scale) && bound();
  }

 private:
  /// Wider packets had better go as single rays.
  static constexpr float kWidest = 0.25f;

  HWY_INLINE bool load(const RaySpan& span, std::size_t first, float direction_scale) {
    const RayTag f;
    std::uint32_t good = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      if (i >= count) break;
      const RayFields r = load_rays(span, first + i);
      auto is_good = hn::And(hn::Ge(r.tmin, hn::Zero(f)), hn::Lt(r.tmin, r.tmax));
      auto largest = hn::Zero(f), sum = hn::Zero(f);
      for (std::size_t k = 0; k < 3; ++k) {
        is_good = hn::And(is_good, hn::Eq(r.origin[k], hn::Set(f, span[first].origin[k])));
        const auto d = hn::Mul(r.direction[k], hn::Set(f, direction_scale));
        hn::Store(d, f, direction[k] + i);
        largest = hn::Max(largest, hn::Abs(d));
        sum = hn::Add(sum, hn::Abs(d));
      }
      // A maximum may lose a NaN, but the sum is one then. Other scales than the first's have other times.
      is_good = hn::And(is_good, hn::And(hn::Ge(largest, hn::Set(f, 1.0f)), hn::Lt(sum, hn::Set(f, 6.0f))));
      is_good = hn::And(is_good, hn::Lt(largest, hn::Set(f, 2.0f)));
      const auto times = hn::Set(f, static_cast<float>(time_scale)), limit = hn::Set(f, static_cast<float>(kTimeLimit));
      hn::Store(hn::Min(hn::Mul(r.tmin, times), limit), f, tmin + i);
      hn::Store(hn::Min(hn::Mul(r.tmax, times), limit), f, tmax + i);
      good |= ray_bits(is_good) << i;
    }
    const std::uint32_t present = (1u << count) - 1;
    for (std::uint32_t i = count; i < kRowLanes; ++i) {
      for (auto& axis : direction) axis[i] = axis[0];
      tmin[i] = tmin[0];
      tmax[i] = tmax[0];
    }
    return (~good & present) == 0;
  }

  /// False if they are wide.
  HWY_INLINE bool bound() {
    up = down = 0;
    length = 0;
    float widest = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [low, high] = range_of(direction[k]);
      middle[k] = 0.5f * (low + high);
      half[k] = 0.5f * (high - low);
      length += std::max(std::abs(low), std::abs(high));
      widest = std::max(widest, high - low);
      // A component of almost zero has its inverse as in prepare(); the axis then bounds the way hardly or not at all.
      if (low >= 0x1p-64f) up |= 1u << k;
      if (high <= -0x1p-64f) down |= 1u << k;
      inverse_low[k] = 1 / high;
      inverse_high[k] = 1 / low;
    }
    // A little more, as a denormal end may have been rounded.
    first_time = range_of(tmin).t0 - 0x1p-100f;
    last_time = range_of(tmax).t1 + 0x1p-100f;
    return widest <= kWidest;
  }
};

/// When the first of a packet's rays enters boxes, and which some may cross: for each plane the times of all rays lie
/// between those with the least and the greatest inverse, as rounding keeps their order.
class PacketTimes {
 public:
  using Time = float;

  PacketTimes(const ClosestPacket& packet, const float& last_time) : packet_(packet), last_time_(last_time) {}

  float start() const { return packet_.first_time; }

  HWY_INLINE void cross(const BvhNode& node, CrossedBoxes<float, kBvhWidth>& out) const {
    const Lanes4 f;
    out.lanes = 0;
    for (std::uint32_t i = 0; i < kBvhWidth; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Set(f, packet_.first_time), t1 = hn::Set(f, last_time_);
      for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const bool up = (packet_.up >> axis & 1) != 0, down = (packet_.down >> axis & 1) != 0;
        if (!up && !down) continue;
        const auto origin = hn::Set(f, packet_.origin[axis]);
        const auto low = hn::Set(f, packet_.inverse_low[axis]), high = hn::Set(f, packet_.inverse_high[axis]);
        const auto entry = hn::Sub(hn::Load(f, (down ? node.upper : node.lower)[axis] + i), origin);
        const auto exit = hn::Sub(hn::Load(f, (down ? node.lower : node.upper)[axis] + i), origin);
        t0 = hn::Max(t0, hn::Min(hn::Mul(entry, low), hn::Mul(entry, high)));
        t1 = hn::Min(t1, hn::Max(hn::Mul(exit, low), hn::Mul(exit, high)));
      }
      alignas(8) std::uint8_t bits[8] = {};
      hn::StoreMaskBits(f, hn::Le(t0, t1), bits);
      out.lanes |= static_cast<std::uint32_t>(bits[0]) << i;
      hn::Store(t0, f, out.t0 + i);
    }
  }

 private:
  const ClosestPacket& packet_;
  const float& last_time_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
