// SPDX-License-Identifier: Apache-2.0
//
// Whatever a frame tracer remembers, its answers are those of testing every triangle: on the hard cases, in any order
// and in tiles of any size.
#include <gtest/gtest.h>

#include "cases/cases.h"
#include "frame_test.h"
#include "judge/judge.h"
#include "oracle/case_parameters.h"
#include "oracle/test_rays.h"

namespace umbrix::frame_tests {
namespace {

/// What frames ask, and the truth.
struct Script {
  std::vector<std::vector<Ray>> frames;
  std::vector<std::vector<std::uint8_t>> truths;

  /// The rays; the same in another order, so that memories mislead; moved a little; and the first ones again.
  Script(const Scene& scene, const std::vector<Ray>& rays, std::uint32_t seed)
      : frames{rays, shuffled(rays, seed), moved(rays, 1e-3f), rays} {
    for (const auto& frame : frames) truths.push_back(brute(scene, frame));
  }
};

/// `pixels` are those of the first order: in the shuffled frame they mislead, too.
void expect_right(const Scene& scene, const Script& script, FrameOptions options, const std::vector<Pixel>& pixels) {
  SCOPED_TRACE(describe(options));
  const float light[1][3] = {{0.1f, 0.2f, 0.3f}};
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(scene, options).ok());
  for (std::size_t i = 0; i < script.frames.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "frame " << i);
    FrameView view = numbered(static_cast<std::int64_t>(i));
    view.lights = light;
    view.light_count = 1;
    ASSERT_TRUE(tracer.begin_frame(view).ok());
    Handover how;
    how.pixels = pixels.data();
    ASSERT_EQ(trace(tracer, script.frames[i], how), script.truths[i]);
    const FrameStats stats = tracer.end_frame();
    EXPECT_EQ(stats.rays, script.frames[i].size());
    EXPECT_FALSE(stats.cut);
  }
}

class FrameCase : public testing::TestWithParam<const char*> {
 protected:
  void TearDown() override { EXPECT_TRUE(use_simd_target(nullptr).ok()); }
};

TEST_P(FrameCase, EveryMethodIsRight) {
  const cases::Case& c = *cases::find_case(GetParam());
  const std::size_t count = test_rays(180) / (c.is_slow ? 6 : 1) + 1;
  constexpr std::uint64_t kSeed = 21;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed << " rays " << count);
  const cases::CaseData data = c.make(kSeed, count);
  Scene scene;
  ASSERT_TRUE(judge::build(data.triangles, scene).ok());
  const Script script(scene, data.rays, kSeed);
  const std::vector<Pixel> pixels = pixel_rows(data.rays.size(), 24);
  for (const FrameOptions& options : all_options()) expect_right(scene, script, options, pixels);
  FrameOptions counting;
  counting.count_work = true;
  expect_right(scene, script, counting, pixels);
  for (std::size_t t = 0; t < simd_target_count(); ++t) {
    SCOPED_TRACE(simd_target_name(t));
    ASSERT_TRUE(use_simd_target(simd_target_name(t)).ok());
    expect_right(scene, script, FrameOptions(), pixels);
    expect_right(scene, script, paper_options(), pixels);
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, FrameCase, testing::ValuesIn(varied_case_names()), case_test_name);

/// Segments, rays without end, and such as no walk takes, all in one tile.
std::vector<Ray> mixed_rays(const std::vector<Ray>& segments, std::uint32_t seed) {
  std::vector<Ray> rays = segments;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (i % 3 == 0) {
      rays[i].tmax = INFINITY;
      std::copy_n(rays[0].direction, 3, rays[i].direction);  // a directional light's
    }
    if (i % 31 == 5) rays[i].direction[i % 3] = NAN;
    if (i % 37 == 6) std::fill_n(rays[i].direction, 3, 0.0f);
    if (i % 41 == 7) rays[i].tmax = rays[i].tmin;
    if (i % 29 == 8) {
      // From a million scenes away to the same place.
      for (int k = 0; k < 3; ++k) rays[i].origin[k] -= 1e6f * rays[i].direction[k];
      rays[i].tmax = INFINITY;
    }
  }
  return shuffled(rays, seed);
}

TEST(FrameAnswers, TilesMayHaveAnySize) {
  const cases::CaseData data = cases::find_case("random_segments")->make(22, test_rays(1000));
  Scene scene;
  ASSERT_TRUE(judge::build(data.triangles, scene).ok());
  const std::vector<Ray> rays = mixed_rays(data.rays, 23);
  const std::vector<std::uint8_t> truth = brute(scene, rays);
  for (const FrameMethod method : {FrameMethod::best, FrameMethod::cached, FrameMethod::paper, FrameMethod::beam}) {
    FrameOptions options;
    options.method = method;
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(scene, options).ok());
    std::int64_t frame = 0;
    for (const std::size_t size : {1u, 7u, 256u, 257u, 1000u}) {
      SCOPED_TRACE(testing::Message() << describe(options) << ", tiles of " << size);
      ASSERT_TRUE(tracer.begin_frame(numbered(frame++)).ok());
      Handover how;
      how.tile = size;
      EXPECT_EQ(trace(tracer, rays, how), truth);
      tracer.occluded(ShadowTile(), nullptr);  // none
      EXPECT_EQ(tracer.end_frame().rays, rays.size());
    }
  }
}

TEST(FrameAnswers, RaysMayStandApart) {
  const Hall hall;
  const std::vector<Ray> rays = hall.rays();
  const std::vector<std::uint8_t> truth = brute(hall.scene, rays);
  struct Padded {
    Ray ray;
    float other[3];
  };
  std::vector<Padded> padded;
  for (const Ray& ray : rays) padded.push_back({ray, {NAN, NAN, NAN}});
  for (const FrameMethod method : {FrameMethod::best, FrameMethod::cached, FrameMethod::paper}) {
    FrameOptions options;
    options.method = method;
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(hall.scene, options).ok());
    for (std::int64_t frame = 0; frame < 2; ++frame) {
      ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
      ShadowTile tile;
      tile.rays = {&padded[0].ray, padded.size(), sizeof(Padded)};
      std::vector<std::uint8_t> out(padded.size());
      tracer.occluded(tile, out.data());
      EXPECT_EQ(out, truth);
      tracer.end_frame();
    }
  }
}

}  // namespace
}  // namespace umbrix::frame_tests
