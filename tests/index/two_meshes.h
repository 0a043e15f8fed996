// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "small_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::detail {

inline MeshView view_of(const std::vector<Triangle>& triangles) {
  MeshView mesh;
  mesh.triangle_count = triangles.size();
  mesh.vertex_count = 3 * triangles.size();
  mesh.vertices = &triangles[0].v[0].x;
  return mesh;
}

/// Two meshes of loose triangles: one with a mask, one that half lets through.
struct TwoMeshes {
  std::vector<Triangle> plain = random_soup(300, 0.2f, 1), other = random_soup(300, 0.2f, 2);
  Scene scene;

  explicit TwoMeshes(OpacityTest opacity = {}) {
    MeshView first = view_of(plain), second = view_of(other);
    first.mask = 1;
    EXPECT_TRUE(scene.add(first).ok());
    second.mask = 2;
    second.opacity = opacity;
    EXPECT_TRUE(scene.add(second).ok());
    EXPECT_TRUE(scene.commit().ok());
  }
};

/// What each ray meets first.
inline std::vector<Primitive> first_met(const Scene& scene, const std::vector<Ray>& rays) {
  std::vector<Primitive> met(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit hit;
    if (scene.closest(rays[i], hit)) met[i] = hit.primitive;
  }
  return met;
}

/// In one call, counted or not, on every instruction set.
inline void expect_answers(const Scene& scene, const std::vector<Ray>& rays, const std::vector<std::uint8_t>& truth,
                           QueryOptions options = {}) {
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

/// As `brute` answers each.
inline void expect_right(const Scene& scene, const std::vector<Ray>& rays, QueryOptions options = {}) {
  std::vector<std::uint8_t> truth(rays.size());
  QueryOptions brute = options;
  ASSERT_TRUE(find_kernel("brute", brute.kernel).ok());
  scene.occluded(RaySpan{rays.data(), rays.size()}, truth.data(), brute);
  expect_answers(scene, rays, truth, options);
}

}  // namespace umbrix::detail
