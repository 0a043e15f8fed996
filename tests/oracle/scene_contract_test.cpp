// SPDX-License-Identifier: Apache-2.0
//
// What a host may do to the scene: masks, skipped triangles, opacity tests, and a floating-point mode of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "cases/cases.h"
#include "judge/judge.h"
#include "oracle/brute_force.h"
#include "test_rays.h"
#include "umbrix/umbrix.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace umbrix {
namespace {

constexpr std::uint32_t kMeshes = 3;

// A case's triangles dealt out to three meshes, so that ids, masks and order are all put to use.
class ThreeMeshes {
 public:
  explicit ThreeMeshes(std::vector<oracle::Triangle> triangles) : oracle_(std::move(triangles)) {
    for (std::size_t i = 0; i < oracle_.triangles().size(); ++i) {
      parts_[i * kMeshes / oracle_.triangles().size()].push_back(oracle_.triangles()[i]);
    }
  }

  Status build(Scene& scene, const std::uint32_t (&masks)[kMeshes], const OpacityTest& opacity) const {
    for (std::uint32_t m = 0; m < kMeshes; ++m) {
      MeshView mesh = judge::mesh_of(parts_[m]);
      mesh.mask = masks[m];
      mesh.opacity = opacity;
      if (Status status = scene.add(mesh); !status) return status;
    }
    return scene.commit();
  }

  const oracle::BruteForce& oracle() const { return oracle_; }

  Primitive primitive(std::uint32_t triangle) const {
    std::uint32_t mesh = 0;
    while (triangle >= parts_[mesh].size()) triangle -= static_cast<std::uint32_t>(parts_[mesh++].size());
    return {mesh, triangle};
  }

 private:
  oracle::BruteForce oracle_;
  std::vector<oracle::Triangle> parts_[kMeshes];
};

using VisibleTo = std::function<bool(std::size_t ray, std::uint32_t triangle)>;

// Each kernel's answers against brute force over the triangles that `visible` lets each ray see.
void expect_right(Scene& scene, const ThreeMeshes& meshes, const std::vector<Ray>& rays, QueryOptions options,
                  const VisibleTo& visible) {
  Training training;
  training.rays = {rays.data(), rays.size()};
  training.skip = options.skip;
  std::vector<std::optional<oracle::Closest>> truths(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    truths[i] = meshes.oracle().closest(rays[i], [&](std::uint32_t triangle) { return visible(i, triangle); });
  }
  std::vector<std::uint8_t> occluded(rays.size());
  std::vector<Hit> hits(rays.size());
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    SCOPED_TRACE(kernel_info(k).name);
    ASSERT_TRUE(find_kernel(kernel_info(k).name, options.kernel).ok());
    ASSERT_TRUE(scene.prepare(options.kernel, training).ok());
    scene.occluded({rays.data(), rays.size()}, occluded.data(), options);
    scene.closest({rays.data(), rays.size()}, hits.data(), options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& truth = truths[i];
      ASSERT_EQ(occluded[i] != 0, truth.has_value()) << "ray " << i;
      ASSERT_EQ(hits[i].valid(), truth.has_value()) << "ray " << i;
      if (!truth) continue;
      const Primitive expected = meshes.primitive(truth->triangle);
      ASSERT_EQ(hits[i].primitive.mesh, expected.mesh) << "ray " << i;
      ASSERT_EQ(hits[i].primitive.triangle, expected.triangle) << "ray " << i;
    }
  }
}

cases::CaseData make_case(const char* name, std::uint64_t seed) {
  return cases::find_case(name)->make(seed, test_rays(1500));
}

constexpr const char* kCases[] = {"random_segments", "origins_on_geometry", "integer_grid", "duplicates"};

TEST(SceneContract, MasksHideMeshes) {
  constexpr std::uint32_t kMasks[kMeshes] = {1, 6, 4};
  for (const char* name : kCases) {
    SCOPED_TRACE(name);
    const cases::CaseData data = make_case(name, 11);
    const ThreeMeshes meshes(data.triangles);
    Scene scene;
    ASSERT_TRUE(meshes.build(scene, kMasks, {}).ok());
    for (const std::uint32_t mask : {0u, 1u, 2u, 4u, 5u, 0xFFFFFFFFu}) {
      SCOPED_TRACE(mask);
      QueryOptions options;
      options.mask = mask;
      expect_right(scene, meshes, data.rays, options, [&](std::size_t, std::uint32_t triangle) {
        return (kMasks[meshes.primitive(triangle).mesh] & mask) != 0;
      });
    }
  }
}

TEST(SceneContract, SkippedTriangleIsNotThere) {
  for (const char* name : kCases) {
    SCOPED_TRACE(name);
    const cases::CaseData data = make_case(name, 12);
    const ThreeMeshes meshes(data.triangles);
    Scene scene;
    ASSERT_TRUE(meshes.build(scene, {1, 1, 1}, {}).ok());
    // The triangle that each ray would hit first, and none where it hits nothing.
    std::vector<std::uint32_t> skipped(data.rays.size(), Primitive::kNone);
    std::vector<Primitive> skip(data.rays.size());
    for (std::size_t i = 0; i < data.rays.size(); ++i) {
      const auto first = meshes.oracle().closest(data.rays[i]);
      if (!first) continue;
      skipped[i] = first->triangle;
      skip[i] = meshes.primitive(first->triangle);
    }
    QueryOptions options;
    options.skip = skip.data();
    expect_right(scene, meshes, data.rays, options,
                 [&](std::size_t i, std::uint32_t triangle) { return triangle != skipped[i]; });
  }
}

TEST(SceneContract, OpacityTestDecidesByTriangle) {
  const OpacityTest every_third{[](const void*, std::uint32_t triangle, float, float) { return triangle % 3 == 0; },
                                nullptr};
  for (const char* name : kCases) {
    SCOPED_TRACE(name);
    const cases::CaseData data = make_case(name, 13);
    const ThreeMeshes meshes(data.triangles);
    Scene scene;
    ASSERT_TRUE(meshes.build(scene, {1, 1, 1}, every_third).ok());
    expect_right(scene, meshes, data.rays, {},
                 [&](std::size_t, std::uint32_t triangle) { return meshes.primitive(triangle).triangle % 3 == 0; });
  }
}

TEST(SceneContract, OpacityTestIsToldWhereTheHitIs) {
  const OpacityTest half{[](const void*, std::uint32_t, float u, float v) { return u > v; }, nullptr};
  const cases::CaseData data = make_case("random_segments", 14);
  const ThreeMeshes meshes(data.triangles);
  // Too near to the border between the halves, the rounding of u and v may decide.
  std::vector<Ray> clear;
  for (const Ray& ray : data.rays) {
    const auto is_near_border = [&](const oracle::Triangle& t) {
      const auto hit = oracle::exact_intersection(ray, t.v);
      return hit && std::abs(hit->u() - hit->v()) < 1e-5;
    };
    const auto& all = meshes.oracle().triangles();
    if (std::none_of(all.begin(), all.end(), is_near_border)) clear.push_back(ray);
  }
  ASSERT_GT(clear.size(), data.rays.size() / 2);
  Scene scene;
  ASSERT_TRUE(meshes.build(scene, {1, 1, 1}, half).ok());
  expect_right(scene, meshes, clear, {}, [&](std::size_t i, std::uint32_t triangle) {
    const auto hit = oracle::exact_intersection(clear[i], meshes.oracle().triangles()[triangle].v);
    return hit && hit->u() > hit->v();
  });
}

TEST(SceneContract, HitParametersAreThoseOfTheHit) {
  for (const char* name : {"random_segments", "edges_star", "scaled_any"}) {
    SCOPED_TRACE(name);
    const cases::CaseData data = make_case(name, 15);
    const ThreeMeshes meshes(data.triangles);
    Scene scene;
    ASSERT_TRUE(meshes.build(scene, {1, 1, 1}, {}).ok());
    std::vector<Hit> hits(data.rays.size());
    scene.closest({data.rays.data(), data.rays.size()}, hits.data());
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const auto truth = meshes.oracle().closest(data.rays[i]);
      if (!truth) continue;
      EXPECT_NEAR(hits[i].t, truth->t, 1e-6 * std::abs(truth->t)) << "ray " << i;
      EXPECT_NEAR(hits[i].u, truth->u, 1e-6) << "ray " << i;
      EXPECT_NEAR(hits[i].v, truth->v, 1e-6) << "ray " << i;
    }
  }
}

#if defined(__SSE2__)
// Embree asks its hosts for this mode, so a host of both has it on.
TEST(SceneContract, HostMayFlushDenormals) {
  constexpr unsigned kFlush = 0x8040;
  for (const char* name : {"whole_float_range", "axis_parallel", "invalid_rays", "integer_grid"}) {
    for (std::uint64_t seed = 16; seed < 20; ++seed) {
      SCOPED_TRACE(testing::Message() << name << " seed " << seed);
      const cases::CaseData data = make_case(name, seed);
      const ThreeMeshes meshes(data.triangles);
      const unsigned before = _mm_getcsr();
      _mm_setcsr(before | kFlush);
      Scene scene;
      const Status status = meshes.build(scene, {1, 1, 1}, {});
      if (status.ok()) expect_right(scene, meshes, data.rays, {}, [](std::size_t, std::uint32_t) { return true; });
      const unsigned after = _mm_getcsr();
      _mm_setcsr(before);
      EXPECT_TRUE(status.ok()) << status.message();
      EXPECT_EQ(after & kFlush, kFlush) << "the host's mode is the host's";
    }
  }
}
#endif

}  // namespace
}  // namespace umbrix
