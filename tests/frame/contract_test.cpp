// SPDX-License-Identifier: Apache-2.0
//
// What a host may ask besides: masks, skipped triangles and opacity tests, which change from tile to tile while the
// same blockers are remembered.
#include <gtest/gtest.h>

#include "cases/cases.h"
#include "frame_test.h"
#include "judge/judge.h"
#include "oracle/test_rays.h"

namespace umbrix::frame_tests {
namespace {

/// Two meshes with masks 1 and 2; of the second every third triangle is opaque.
void build_two_meshes(const std::vector<oracle::Triangle>& triangles, Scene& scene) {
  const auto half = static_cast<std::ptrdiff_t>(triangles.size() / 2);
  const std::vector<oracle::Triangle> first(triangles.begin(), triangles.begin() + half);
  const std::vector<oracle::Triangle> second(triangles.begin() + half, triangles.end());
  MeshView mesh = judge::mesh_of(first);
  mesh.mask = 1;
  ASSERT_TRUE(scene.add(mesh).ok());
  mesh = judge::mesh_of(second);
  mesh.mask = 2;
  mesh.opacity.opaque = [](const void*, std::uint32_t triangle, float, float) { return triangle % 3 == 0; };
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit().ok());
}

/// What each ray meets first.
std::vector<Primitive> first_hits(const Scene& scene, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  scene.closest({rays.data(), rays.size()}, hits.data());
  std::vector<Primitive> result;
  for (const Hit& hit : hits) result.push_back(hit.primitive);
  return result;
}

TEST(FrameContract, MaskSkipAndOpacityHoldForRememberedBlockers) {
  for (const char* const name : {"random_segments", "origins_on_geometry", "integer_grid", "duplicates"}) {
    constexpr std::uint64_t kSeed = 31;
    SCOPED_TRACE(testing::Message() << name << " seed " << kSeed);
    const cases::CaseData data = cases::find_case(name)->make(kSeed, test_rays(600));
    const std::vector<Pixel> pixels = pixel_rows(data.rays.size(), 24);
    Scene scene;
    build_two_meshes(data.triangles, scene);
    const std::vector<Primitive> first = first_hits(scene, data.rays);
    std::vector<Handover> ways(5);
    ways[1].mask = 1;
    ways[2].skip = first.data();
    ways[3].mask = 2;
    ways[3].skip = first.data();
    ways[4].mask = 0;
    std::vector<std::vector<std::uint8_t>> truths;
    for (const Handover& way : ways) truths.push_back(brute(scene, data.rays, way));
    for (const FrameOptions& options : all_options()) {
      SCOPED_TRACE(describe(options));
      FrameTracer tracer;
      ASSERT_TRUE(tracer.start(scene, options).ok());
      for (std::int64_t frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
        for (std::size_t w = 0; w < ways.size(); ++w) {
          Handover how = ways[w];
          how.pixels = pixels.data();
          ASSERT_EQ(trace(tracer, data.rays, how), truths[w]) << "frame " << frame << " way " << w;
        }
        tracer.end_frame();
      }
    }
  }
}

TEST(FrameContract, BlockerThatIsSkippedIsNotThere) {
  const Hall hall;
  const std::vector<Ray> rays = hall.rays();
  const std::vector<Primitive> first = first_hits(hall.scene, rays);
  Handover skipping;
  skipping.skip = first.data();
  const std::vector<std::uint8_t> truth = brute(hall.scene, rays, skipping);
  FrameOptions options;
  options.method = FrameMethod::cached;
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(hall.scene, options).ok());
  // The first two frames make sure that each ray's blocker is remembered where it starts.
  for (std::int64_t frame = 0; frame < 4; ++frame) {
    ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
    const bool skips = frame >= 2;
    EXPECT_EQ(trace(tracer, rays, skips ? skipping : Handover()), skips ? truth : brute(hall.scene, rays));
    const FrameStats stats = tracer.end_frame();
    if (frame == 1) {
      EXPECT_GT(stats.cache_hits, 0u);
    }
  }
}

}  // namespace
}  // namespace umbrix::frame_tests
