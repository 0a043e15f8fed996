// SPDX-License-Identifier: Apache-2.0
//
// A scene with instances gives the answers of the scene in which each of them is a mesh of its own, to the last bit,
// and those are right.
#include <gtest/gtest.h>

#include <cstring>
#include <optional>

#include "cases/instanced_meshes.h"
#include "oracle/brute_force.h"
#include "test_rays.h"

namespace umbrix {
namespace {

using cases::InstancedMeshes;
using cases::kPlacings;
using cases::Placing;

constexpr std::uint64_t kSeed = 20261126;

class Instances : public testing::TestWithParam<Placing> {};

bool same_bits(const Hit& a, const Hit& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void ask(const Scene& scene, const std::vector<Ray>& rays, const QueryOptions& options,
         std::vector<std::uint8_t>& occluded, std::vector<Hit>& hits) {
  occluded.assign(rays.size(), 7);
  hits.assign(rays.size(), Hit());
  scene.occluded({rays.data(), rays.size()}, occluded.data(), options);
  scene.closest({rays.data(), rays.size()}, hits.data(), options);
}

/// A scene with instances, and what it answers to rays.
struct Answered {
  Answered(Placing placing, std::size_t count, std::uint64_t seed = kSeed)
      : meshes(placing, seed), rays(meshes.rays(test_rays(count), kSeed)) {
    EXPECT_TRUE(meshes.build_instanced(scene).ok());
    ask(scene, rays, {}, occluded, hits);
    blocked = static_cast<std::uint64_t>(std::count(occluded.begin(), occluded.end(), std::uint8_t{1}));
  }

  InstancedMeshes meshes;
  std::vector<Ray> rays;
  Scene scene;
  std::vector<std::uint8_t> occluded;
  std::vector<Hit> hits;
  std::uint64_t blocked = 0;
};

/// All kernels and instruction sets against the flat scene, answered by `brute`.
void expect_same(const InstancedMeshes& meshes, const std::vector<Ray>& rays, QueryOptions options) {
  Scene flat, instanced;
  ASSERT_TRUE(meshes.build_flat(flat).ok());
  ASSERT_TRUE(meshes.build_instanced(instanced).ok());
  const std::vector<Ray> few(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(rays.size() / 8));
  std::vector<std::uint8_t> occluded, expected;
  std::vector<Hit> hits, expected_hits;
  ASSERT_TRUE(find_kernel("brute", options.kernel).ok());
  ask(flat, rays, options, expected, expected_hits);
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    SCOPED_TRACE(simd_target_name(target));
    ASSERT_TRUE(use_simd_target(simd_target_name(target)).ok());
    for (std::size_t k = 0; k < kernel_count(); ++k) {
      // Instances are asked after the kernel, whichever it is: after the first, few rays will do.
      if (target > 0 && k > 0) continue;
      SCOPED_TRACE(kernel_info(k).name);
      ASSERT_TRUE(find_kernel(kernel_info(k).name, options.kernel).ok());
      ask(instanced, k == 0 ? rays : few, options, occluded, hits);
      for (std::size_t i = 0; i < occluded.size(); ++i) {
        ASSERT_EQ(occluded[i], expected[i]) << "ray " << i;
        ASSERT_TRUE(same_bits(hits[i], expected_hits[i]))
            << "ray " << i << ": " << hits[i].primitive.mesh << ' ' << hits[i].primitive.triangle << " at " << hits[i].t
            << " in place of " << expected_hits[i].primitive.mesh << ' ' << expected_hits[i].primitive.triangle
            << " at " << expected_hits[i].t;
      }
    }
  }
  ASSERT_TRUE(use_simd_target(nullptr).ok());
}

TEST_P(Instances, AnswerAsMeshesDo) {
  for (std::uint64_t seed = kSeed; seed < kSeed + 2; ++seed) {
    SCOPED_TRACE(seed);
    const InstancedMeshes meshes(GetParam(), seed);
    expect_same(meshes, meshes.rays(test_rays(1200), seed), {});
  }
}

TEST_P(Instances, HaveMasksOpacityAndSkippedTrianglesOfTheirOwn) {
  InstancedMeshes meshes(GetParam(), kSeed);
  meshes.is_filtered = true;
  const std::vector<Ray> rays = meshes.rays(test_rays(400), kSeed);
  std::vector<Primitive> skip(rays.size());
  Scene flat;
  ASSERT_TRUE(meshes.build_flat(flat).ok());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Hit hit;
    (void)flat.closest(rays[i], hit);
    if (i % 2 == 0) skip[i] = hit.primitive;
  }
  for (const std::uint32_t mask : {6u, 0xFFFFFFFFu}) {
    SCOPED_TRACE(mask);
    QueryOptions options;
    options.mask = mask;
    options.skip = skip.data();
    expect_same(meshes, rays, options);
  }
}

TEST_P(Instances, AgreeWithTheOracle) {
  const Answered answered(GetParam(), 1500, kSeed + 100);
  const std::vector<Ray>& rays = answered.rays;
  const std::vector<Hit>& hits = answered.hits;
  const oracle::BruteForce oracle(answered.meshes.triangles());
  std::size_t hit_count = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::optional<oracle::Closest> truth = oracle.closest(rays[i]);
    hit_count += truth ? 1 : 0;
    ASSERT_EQ(answered.occluded[i] != 0, truth.has_value()) << "ray " << i;
    ASSERT_EQ(hits[i].valid(), truth.has_value()) << "ray " << i;
    if (!truth) continue;
    const Primitive expected = answered.meshes.primitive(truth->triangle);
    ASSERT_EQ(hits[i].primitive.mesh, expected.mesh) << "ray " << i;
    ASSERT_EQ(hits[i].primitive.triangle, expected.triangle) << "ray " << i;
  }
  EXPECT_GT(hit_count, rays.size() / 8);
  EXPECT_LT(hit_count, rays.size());
}

TEST_P(Instances, CountRaysByTheTrueAnswer) {
  const Answered answered(GetParam(), 600);
  const std::vector<Ray>& rays = answered.rays;
  std::vector<std::uint8_t> occluded(rays.size());
  OcclusionCounts counts;
  answered.scene.occluded({rays.data(), rays.size()}, occluded.data(), counts);
  EXPECT_EQ(occluded, answered.occluded);
  EXPECT_EQ(counts.occluded.rays, answered.blocked);
  EXPECT_EQ(counts.unoccluded.rays, rays.size() - answered.blocked);
  std::vector<Hit> counted(rays.size());
  RayCounts work;
  answered.scene.closest({rays.data(), rays.size()}, counted.data(), work);
  EXPECT_EQ(work.rays, rays.size());
  EXPECT_TRUE(std::equal(answered.hits.begin(), answered.hits.end(), counted.begin(), same_bits));
}

TEST_P(Instances, AnswerFramesAsWell) {
  const Answered answered(GetParam(), 600);
  const std::vector<Ray>& rays = answered.rays;
  std::vector<std::uint8_t> occluded(rays.size());
  for (const FrameMethod method : {FrameMethod::best, FrameMethod::cached, FrameMethod::linked}) {
    for (const bool counted : {false, true}) {
      FrameOptions options;
      options.method = method;
      options.count_work = counted;
      FrameTracer tracer;
      ASSERT_TRUE(tracer.start(answered.scene, options).ok());
      for (int frame = 0; frame < 2; ++frame) {
        ASSERT_TRUE(tracer.begin_frame().ok());
        ShadowTile tile;
        tile.rays = {rays.data(), rays.size()};
        tracer.occluded(tile, occluded.data());
        EXPECT_EQ(occluded, answered.occluded);
        const FrameStats stats = tracer.end_frame();
        EXPECT_EQ(stats.occluded, answered.blocked);
        if (!counted) continue;
        EXPECT_EQ(stats.counts.occluded.rays, answered.blocked);
        EXPECT_EQ(stats.counts.unoccluded.rays, rays.size() - answered.blocked);
      }
    }
  }
}

std::string placing_name(const testing::TestParamInfo<Placing>& info) { return name_of(info.param); }
INSTANTIATE_TEST_SUITE_P(Placings, Instances, testing::ValuesIn(kPlacings), placing_name);

TEST(InstancesInAll, StayInstancesWhereTheyCan) {
  for (const Placing placing : kPlacings) {
    SCOPED_TRACE(name_of(placing));
    const InstancedMeshes meshes(placing, kSeed);
    Scene flat, instanced;
    ASSERT_TRUE(meshes.build_flat(flat).ok());
    ASSERT_TRUE(meshes.build_instanced(instanced).ok());
    const BuildStats& stats = instanced.build_stats();
    EXPECT_EQ(stats.triangles, flat.build_stats().triangles);
    EXPECT_EQ(stats.dropped_nonfinite, flat.build_stats().dropped_nonfinite);
    float box[6], expected[6];
    ASSERT_TRUE(flat.bounds(expected, expected + 3));
    ASSERT_TRUE(instanced.bounds(box, box + 3));
    for (int i = 0; i < 6; ++i) EXPECT_EQ(box[i], expected[i]);
    if (placing == Placing::rigid || placing == Placing::sheared || placing == Placing::mirrored ||
        placing == Placing::scaled) {
      EXPECT_EQ(stats.instances, 6u);
      EXPECT_GT(stats.instance_bytes, 0u);
    }
    if (placing == Placing::flat) {
      EXPECT_EQ(stats.instances, 0u);
    }
  }
}

}  // namespace
}  // namespace umbrix
