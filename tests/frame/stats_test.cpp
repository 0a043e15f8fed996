// SPDX-License-Identifier: Apache-2.0
//
// What a frame's statistics say: sums add up, and what a static scene teaches is put to use.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "cases/cases.h"
#include "frame_test.h"
#include "judge/judge.h"
#include "oracle/test_rays.h"

namespace umbrix::frame_tests {
namespace {

std::uint64_t sum(const std::uint64_t (&row)[2]) { return row[0] + row[1]; }

std::uint64_t right(const Confusion& c) { return c.predicted_occluded[1] + c.predicted_unoccluded[0]; }
std::uint64_t wrong(const Confusion& c) { return c.predicted_occluded[0] + c.predicted_unoccluded[1]; }

constexpr std::uint64_t RayCounts::*kFields[] = {
    &RayCounts::rays,           &RayCounts::invalid_rays,    &RayCounts::node_tests,
    &RayCounts::leaf_visits,    &RayCounts::primitive_tests, &RayCounts::double_tests,
    &RayCounts::exact_tests,    &RayCounts::far_rays,        &RayCounts::index_tests,
    &RayCounts::links_followed, &RayCounts::links_missing,   &RayCounts::restarts};

void expect_equal(const RayCounts& a, const RayCounts& b) {
  for (std::size_t i = 0; i < std::size(kFields); ++i) EXPECT_EQ(a.*kFields[i], b.*kFields[i]) << "field " << i;
}

/// One frame's sums against each other, and against what was told of each ray.
void expect_sums(const FrameStats& stats, const std::vector<std::uint8_t>& out, const std::vector<RayRoute>& routes,
                 const std::vector<RayCounts>& each) {
  EXPECT_EQ(stats.rays, out.size());
  EXPECT_EQ(stats.occluded, static_cast<std::uint64_t>(std::count(out.begin(), out.end(), 1)));
  EXPECT_EQ(std::accumulate(stats.routes, stats.routes + kRayRoutes, std::uint64_t{0}), stats.rays);
  EXPECT_LE(stats.cache_hits, stats.cache_tries);
  EXPECT_EQ(stats.cache_hits, stats.routes[static_cast<std::size_t>(RayRoute::cached)]);
  const Confusion& c = stats.confusion;
  EXPECT_LE(sum(c.predicted_occluded) + sum(c.predicted_unoccluded) + sum(c.not_predicted), stats.rays);
  EXPECT_LE(c.predicted_occluded[1] + c.predicted_unoccluded[1] + c.not_predicted[1], stats.occluded);

  OcclusionCounts all;
  RayCounts by_route[kRayRoutes][2];
  for (std::size_t i = 0; i < out.size(); ++i) {
    (out[i] ? all.occluded : all.unoccluded) += each[i];
    by_route[static_cast<std::size_t>(routes[i])][out[i]] += each[i];
  }
  expect_equal(all.occluded, stats.counts.occluded);
  expect_equal(all.unoccluded, stats.counts.unoccluded);
  for (std::size_t route = 0; route < kRayRoutes; ++route) {
    EXPECT_EQ(stats.routes[route],
              static_cast<std::uint64_t>(std::count(routes.begin(), routes.end(), static_cast<RayRoute>(route))));
    for (const int occluded : {0, 1}) expect_equal(by_route[route][occluded], stats.route_counts[route][occluded]);
  }
}

TEST(FrameStatistics, SumsAddUp) {
  for (const char* const name : {"random_segments", "invalid_rays", "far_origins", "inside_star"}) {
    constexpr std::uint64_t kSeed = 51;
    SCOPED_TRACE(testing::Message() << name << " seed " << kSeed);
    const cases::CaseData data = cases::find_case(name)->make(kSeed, test_rays(600));
    const std::vector<Pixel> pixels = pixel_rows(data.rays.size(), 24);
    Scene scene;
    ASSERT_TRUE(judge::build(data.triangles, scene).ok());
    for (FrameOptions options : all_options()) {
      SCOPED_TRACE(describe(options));
      options.count_work = true;
      FrameTracer tracer;
      ASSERT_TRUE(tracer.start(scene, options).ok());
      for (std::int64_t frame = 0; frame < 3; ++frame) {
        ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
        std::vector<RayRoute> routes(data.rays.size());
        std::vector<RayCounts> each(data.rays.size());
        Handover how;
        how.pixels = pixels.data();
        how.routes = routes.data();
        how.each = each.data();
        const std::vector<std::uint8_t> out = trace(tracer, data.rays, how);
        expect_sums(tracer.end_frame(), out, routes, each);
      }
    }
  }
}

/// The routes of a frame's rays.
std::vector<std::uint64_t> routes_of(const FrameTracer& tracer, const std::vector<Ray>& rays) {
  std::vector<RayRoute> routes(rays.size());
  Handover how;
  how.routes = routes.data();
  trace(tracer, rays, how);
  std::vector<std::uint64_t> counts(kRayRoutes);
  for (const RayRoute route : routes) ++counts[static_cast<std::size_t>(route)];
  return counts;
}

TEST(FrameStatistics, RoutesSayHowRaysWereAnswered) {
  const Hall hall;
  std::vector<Ray> rays = hall.rays();
  for (std::size_t i = 0; i < rays.size(); i += 10) rays[i].tmin = rays[i].tmax;
  const std::uint64_t invalid = (rays.size() + 9) / 10, valid = rays.size() - invalid;
  const auto expect = [&](FrameMethod method, std::int64_t frames, const std::vector<std::uint64_t>& expected) {
    FrameOptions options;
    options.method = method;
    SCOPED_TRACE(describe(options));
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(hall.scene, options).ok());
    std::vector<std::uint64_t> routes;
    for (std::int64_t frame = 0; frame < frames; ++frame) {
      ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
      routes = routes_of(tracer, rays);
      tracer.end_frame();
    }
    EXPECT_EQ(routes, expected);
  };
  // In the order of RayRoute: cached, beam, indexed, linked, other.
  expect(FrameMethod::beam, 1, {0, valid, 0, 0, invalid});
  expect(FrameMethod::linked, 1, {0, 0, 0, valid, invalid});
  expect(FrameMethod::standard, 1, {0, 0, 0, 0, rays.size()});
  expect(FrameMethod::paper, 1, {0, 0, 0, valid, invalid});    // nothing is guessed to be occluded yet
  expect(FrameMethod::indexed, 1, {0, 0, 0, 0, rays.size()});  // nothing is learned yet: the stack
}

TEST(FrameStatistics, EachRayIsCountedOnce) {
  const Hall hall;
  const std::vector<Ray> rays = hall.rays();
  for (FrameOptions options : all_options()) {
    SCOPED_TRACE(describe(options));
    options.count_work = true;
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(hall.scene, options).ok());
    for (std::int64_t frame = 0; frame < 2; ++frame) {
      ASSERT_TRUE(tracer.begin_frame(numbered(frame)).ok());
      trace(tracer, rays);
      const FrameStats stats = tracer.end_frame();
      EXPECT_EQ(stats.counts.occluded.rays, stats.occluded);
      EXPECT_EQ(stats.counts.unoccluded.rays, stats.rays - stats.occluded);
    }
  }
}

/// How many rays a guess by the majority of each region gets wrong: those of the minority.
std::uint64_t minority(const Hall& hall, const std::vector<std::uint8_t>& truth, std::uint32_t region) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t[2]> votes;
  for (std::size_t i = 0; i < truth.size(); ++i)
    ++votes[{hall.pixels[i].x / region, hall.pixels[i].y / region}][truth[i]];
  std::uint64_t wrong = 0;
  for (const auto& [place, vote] : votes) wrong += std::min(vote[0], vote[1]);
  return wrong;
}

FrameStats frame_after(FrameTracer& tracer, const Hall& hall, const std::vector<std::vector<Ray>>& frames) {
  FrameStats stats;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_TRUE(tracer.begin_frame(numbered(static_cast<std::int64_t>(i))).ok());
    Handover how;
    how.pixels = hall.pixels.data();
    trace(tracer, frames[i], how);
    stats = tracer.end_frame();
  }
  return stats;
}

TEST(FrameStatistics, StaticSceneIsPredictedAsWellAsItsRegionsAllow) {
  const Hall hall;
  const std::vector<Ray> rays = hall.rays();
  const std::vector<std::uint8_t> truth = brute(hall.scene, rays);
  for (const std::uint32_t region : {2u, 4u, 8u, 16u}) {
    for (const PredictorRule rule : {PredictorRule::majority, PredictorRule::counter, PredictorRule::sample}) {
      FrameOptions options;
      options.method = FrameMethod::cached;
      options.key = PredictorKey::screen;
      options.rule = rule;
      options.region = region;
      options.slots = 1u << 20;
      SCOPED_TRACE(testing::Message() << describe(options) << ", region " << region);
      FrameTracer tracer;
      ASSERT_TRUE(tracer.start(hall.scene, options).ok());
      const Confusion c = frame_after(tracer, hall, {rays, rays}).confusion;
      const std::uint64_t least = minority(hall, truth, region);
      EXPECT_EQ(right(c) + wrong(c) + sum(c.not_predicted), rays.size());
      if (rule == PredictorRule::sample) {
        // One ray's outcome says no more than the majority's. It is at worst wrong for all others of a mixed region.
        EXPECT_GE(wrong(c), least);
        EXPECT_LE(wrong(c), least * (region * region - 1));
      } else {
        // A tie is nobody's majority: not predicted by one rule, half right by the other. A slot may be shared by two.
        EXPECT_LE(wrong(c), least + std::uint64_t{region} * region);
      }
    }
  }
}

TEST(FrameStatistics, PlacesHoldWhileTheCameraMoves) {
  const Hall hall;
  std::vector<std::vector<Ray>> frames;
  for (const float shift : {0.0f, 0.7f, 1.4f}) frames.push_back(hall.rays(shift));
  for (const PredictorRule rule : {PredictorRule::majority, PredictorRule::counter}) {
    FrameOptions options;
    options.method = FrameMethod::cached;
    options.rule = rule;
    options.cell = 1.0f / 16;
    options.slots = 1u << 20;
    SCOPED_TRACE(describe(options));
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(hall.scene, options).ok());
    const FrameStats stats = frame_after(tracer, hall, frames);
    // A cell is 6 pixels wide, a shadow 16 with 14 between: two borders in 30 pixels make up to 2 cells of 5 mixed, and
    // the rays that a majority gets wrong are at most half of those.
    EXPECT_GT(stats.confusion.accuracy(), 0.8);
    EXPECT_LT(sum(stats.confusion.not_predicted), stats.rays / 20);
  }
}

TEST(FrameStatistics, RememberedBlockersAnswer) {
  const Hall hall;
  const std::vector<Ray> rays = hall.rays();
  FrameOptions options;
  options.method = FrameMethod::cached;
  options.count_work = true;
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(hall.scene, options).ok());
  const FrameStats stats = frame_after(tracer, hall, {rays, rays});
  // Only a ray whose blocker is neither remembered nor its neighbour's can go without; a shadow is 16 pixels wide.
  EXPECT_GT(stats.cache_hits, stats.occluded / 2);
  EXPECT_GT(stats.cache_hits, stats.cache_tries / 2);
  EXPECT_GT(stats.counts.occluded.index_tests, 0u);
  EXPECT_LE(stats.counts.occluded.index_tests, stats.counts.occluded.primitive_tests);
}

TEST(FrameStatistics, NothingIsCountedUnlessAsked) {
  const Hall hall;
  FrameOptions options;
  options.method = FrameMethod::cached;
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(hall.scene, options).ok());
  const FrameStats stats = frame_after(tracer, hall, {hall.rays(), hall.rays()});
  expect_equal(stats.counts.occluded, RayCounts());
  expect_equal(stats.counts.unoccluded, RayCounts());
  EXPECT_EQ(stats.regret(), 0.0);
  EXPECT_GT(stats.cache_hits, 0u);
}

TEST(FrameStatistics, ThePaperMissesLinksWhereNoRayWasBefore) {
  constexpr std::uint64_t kSeed = 52;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  const cases::CaseData data = cases::find_case("random_segments")->make(kSeed, 2000);  // fewer teach nothing
  Scene scene;
  ASSERT_TRUE(judge::build(data.triangles, scene).ok());
  const std::vector<std::uint8_t> truth = brute(scene, data.rays);
  const std::vector<Pixel> pixels = pixel_rows(data.rays.size(), 48);
  const float light[1][3] = {{0, 0, 0}};
  FrameOptions options = paper_options();
  options.count_work = true;
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(scene, options).ok());
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    FrameView view = numbered(frame);
    view.lights = light;
    view.light_count = 1;
    ASSERT_TRUE(tracer.begin_frame(view).ok());
    Handover how;
    how.pixels = pixels.data();
    EXPECT_EQ(trace(tracer, data.rays, how), truth);
    const FrameStats stats = tracer.end_frame();
    const RayCounts &in = stats.counts.occluded, &out = stats.counts.unoccluded;
    // One ray in sixteen is learned from: the others find gaps. In the first frame there is nothing but gaps.
    EXPECT_GT(in.links_missing + out.links_missing, 0u);
    if (frame == 0) {
      EXPECT_EQ(in.links_followed + out.links_followed, 0u);
    } else {
      EXPECT_GT(in.links_followed + out.links_followed, 0u);
    }
  }
}

}  // namespace
}  // namespace umbrix::frame_tests
