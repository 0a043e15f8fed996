// SPDX-License-Identifier: Apache-2.0
// A shaft against sixteen triangles, seen from the middle c of its starts, where offsets are rounded by up to e = 2^-24
// of their own size. For R the 1-norm of the farthest vertex and of the boxes of starts and ends from c, normals of
// triangles and of the shaft's plane give distances that are wrong by less than 6 e R.

#if defined(UMBRIX_KERNELS_SHAFT_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_TEST_INL_H_
#undef UMBRIX_KERNELS_SHAFT_TEST_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_TEST_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>

#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class ShaftTest {
 public:
  explicit ShaftTest(const Shaft& s) {
    const float margin = 0x1p-19f * s.largest;
    reach_ = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      middle_[k] = s.middle[k];
      normal_[k] = s.normal[k];
      const float start_low = s.start_low[k] - s.middle[k], start_high = s.start_high[k] - s.middle[k];
      const float end_low = s.end_low[k] - s.middle[k], end_high = s.end_high[k] - s.middle[k];
      lines_[0][k] = ShaftLine(start_low - margin, end_low - margin);
      lines_[1][k] = ShaftLine(start_high + margin, end_high + margin);
      start_half_[k] = std::max(-start_low, start_high) * (1 + 0x1p-20f);
      end_middle_[k] = 0.5f * (end_low + end_high);
      end_half_[k] = 0.5f * (end_high - end_low) + 0x1p-20f * s.largest;
      reach_ += start_half_[k] + std::max(-end_low, end_high) + margin;
    }
    base_ = s.base;
  }

  /// Lanes that some ray of the shaft may meet.
  HWY_INLINE std::uint32_t operator()(const TriangleRows& rows) const {
    const RayTag f;
    std::uint32_t result = 0;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      auto t0 = hn::Zero(f), t1 = hn::Set(f, 1.0f);
      auto reach = hn::Set(f, reach_), start_off = hn::Zero(f), end_off = hn::Zero(f);
      RayVec above[3] = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
      auto plane = hn::Zero(f), end = hn::Zero(f);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const auto c = hn::Set(f, middle_[k]), n = hn::Set(f, normal_[k]);
        RayVec v[3];
        for (std::uint32_t vertex = 0; vertex < 3; ++vertex) {
          v[vertex] = hn::Sub(hn::Load(f, rows.v[vertex][k] + i), c);
          above[vertex] = hn::MulAdd(n, v[vertex], above[vertex]);
        }
        const auto low = hn::Min(v[0], hn::Min(v[1], v[2])), high = hn::Max(v[0], hn::Max(v[1], v[2]));
        keep(lines_[0][k], high, lines_[0][k].rises, t0, t1);
        keep(lines_[1][k], low, !lines_[1][k].rises, t0, t1);
        reach = hn::Add(reach, hn::Max(hn::Neg(low), high));
        const auto own = hn::Load(f, rows.normal[k] + i);
        plane = hn::MulAdd(own, v[0], plane);
        end = hn::MulAdd(own, hn::Set(f, end_middle_[k]), end);
        start_off = hn::MulAdd(hn::Abs(own), hn::Set(f, start_half_[k]), start_off);
        end_off = hn::MulAdd(hn::Abs(own), hn::Set(f, end_half_[k]), end_off);
      }
      const auto error = hn::MulAdd(reach, hn::Set(f, kError), hn::Set(f, 0x1p-100f));
      const auto highest = hn::Max(above[0], hn::Max(above[1], above[2]));
      auto met = hn::And(hn::Le(t0, t1), hn::Ge(hn::Add(highest, error), hn::Set(f, base_)));
      // Starts and ends on one side of the triangle's plane.
      const auto end_side = hn::Sub(end, plane);
      const auto least = hn::Min(hn::Sub(hn::Neg(plane), start_off), hn::Sub(end_side, end_off));
      const auto most = hn::Max(hn::Sub(start_off, plane), hn::Add(end_side, end_off));
      met = hn::And(met, hn::And(hn::Le(least, error), hn::Ge(most, hn::Neg(error))));
      result |= ray_bits(met) << i;
    }
    return result;
  }

 private:
  static constexpr float kError = 16 * 0x1p-24f;

  static HWY_INLINE void keep(const ShaftLine& line, RayVec x, bool before, RayVec& t0, RayVec& t1) {
    const RayTag f;
    const auto t = hn::MulAdd(x, hn::Set(f, line.inverse), hn::Set(f, line.offset));
    if (before)
      t1 = hn::Min(t1, t);
    else
      t0 = hn::Max(t0, t);
  }

  float middle_[3], normal_[3], base_;
  ShaftLine lines_[2][3];
  float start_half_[3], end_middle_[3], end_half_[3], reach_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
