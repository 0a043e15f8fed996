// SPDX-License-Identifier: Apache-2.0
//
// Rays in bundles from points, as to lights of some size, which the default kernel answers together: each must have the
// answer that it has alone.
#include <gtest/gtest.h>

#include "bundles.h"
#include "two_meshes.h"

namespace umbrix::detail {
namespace {

TEST(Shafts, BundlesOfAnySize) {
  const TwoMeshes two;
  for (const std::size_t each : {2u, 6u, 8u, 15u, 16u, 17u, 40u}) {
    SCOPED_TRACE(each);
    expect_right(two.scene, bundles(2000 / each, each, 0.05f, 3));
  }
}

TEST(Shafts, PointsTogetherAndApart) {
  const TwoMeshes two;
  for (const float spread : {0.0f, 1e-6f, 1e-3f, 1.0f}) {
    SCOPED_TRACE(spread);
    expect_right(two.scene, bundles(200, 16, spread, 4));
  }
}

TEST(Shafts, MoreThanOneBatch) {
  const TwoMeshes two;
  const std::vector<Ray> rays = bundles(3000, 16, 0.02f, 6);
  std::vector<std::uint8_t> answers(rays.size());
  two.scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data());
  for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(answers[i] != 0, two.scene.occluded(rays[i])) << i;
}

}  // namespace
}  // namespace umbrix::detail
