// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "small_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::detail {

/// Two meshes of loose triangles: one with a mask, one that half lets through.
struct TwoMeshes {
  std::vector<Triangle> plain = random_soup(300, 0.2f, 1), other = random_soup(300, 0.2f, 2);
  Scene scene;

  explicit TwoMeshes(OpacityTest opacity = {}) {
    MeshView mesh;
    mesh.triangle_count = plain.size();
    mesh.vertex_count = 3 * plain.size();
    mesh.vertices = &plain[0].v[0].x;
    mesh.mask = 1;
    EXPECT_TRUE(scene.add(mesh).ok());
    mesh.vertices = &other[0].v[0].x;
    mesh.mask = 2;
    mesh.opacity = opacity;
    EXPECT_TRUE(scene.add(mesh).ok());
    EXPECT_TRUE(scene.commit().ok());
  }
};

/// As `brute` answers each, on every instruction set.
inline void expect_right(const Scene& scene, const std::vector<Ray>& rays, QueryOptions options = {}) {
  std::vector<std::uint8_t> truth(rays.size());
  QueryOptions brute = options;
  ASSERT_TRUE(find_kernel("brute", brute.kernel).ok());
  scene.occluded(RaySpan{rays.data(), rays.size()}, truth.data(), brute);
  const auto occluded = std::count(truth.begin(), truth.end(), std::uint8_t{1});
  EXPECT_GT(occluded, 0);
  EXPECT_LT(occluded, static_cast<std::ptrdiff_t>(rays.size()));
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    SCOPED_TRACE(simd_target_name(target));
    ASSERT_TRUE(use_simd_target(simd_target_name(target)).ok());
    std::vector<std::uint8_t> answers(rays.size(), 7);
    scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), options);
    EXPECT_EQ(answers, truth);
    OcclusionCounts counts;
    std::fill(answers.begin(), answers.end(), std::uint8_t{7});
    scene.occluded(RaySpan{rays.data(), rays.size()}, answers.data(), counts, options);
    EXPECT_EQ(answers, truth);
    EXPECT_EQ(counts.occluded.rays, static_cast<std::uint64_t>(occluded));
    EXPECT_EQ(counts.unoccluded.rays, rays.size() - static_cast<std::size_t>(occluded));
  }
  ASSERT_TRUE(use_simd_target(nullptr).ok());
}

}  // namespace umbrix::detail
