// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "umbrix/scene.h"

namespace umbrix {
namespace {

TEST(OffsetOrigin, LeavesTheErrorBoxOnTheRightSide) {
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<float> u(-1, 1);
  for (int i = 0; i < 100000; ++i) {
    const float scale = std::ldexp(1.0f, static_cast<int>(random() % 80) - 40);
    float point[3], error[3], normal[3], toward[3], origin[3];
    for (int k = 0; k < 3; ++k) {
      point[k] = u(random) * scale;
      error[k] = std::abs(u(random)) * scale * 1e-6f;
      normal[k] = u(random);
      toward[k] = u(random);
    }
    offset_origin(point, error, normal, toward, origin);
    // The surface passes somewhere through the error box; its plane nearest to the origin must still be behind it.
    double side = 0, distance = 0, reach = 0;
    for (int k = 0; k < 3; ++k) {
      side += static_cast<double>(normal[k]) * toward[k];
      distance += static_cast<double>(normal[k]) * (static_cast<double>(origin[k]) - point[k]);
      reach += std::abs(static_cast<double>(normal[k])) * error[k];
    }
    ASSERT_GE(std::copysign(1.0, side) * distance, reach * (1 - 1e-12)) << "case " << i;
    ASSERT_LE(std::abs(distance), 2 * reach + 1e-6 * scale) << "case " << i << ": farther than needed";
  }
}

TEST(OffsetOrigin, KeepsThePointIfThereIsNoNormal) {
  const float point[3] = {1, 2, 3}, error[3] = {1, 1, 1}, zero[3] = {0, 0, 0}, toward[3] = {0, 0, 1};
  float origin[3];
  offset_origin(point, error, zero, toward, origin);
  EXPECT_TRUE(std::equal(origin, origin + 3, point));
}

}  // namespace
}  // namespace umbrix
