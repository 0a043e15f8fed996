// SPDX-License-Identifier: Apache-2.0
//
// Answers and everything counted are the same whatever thread takes which tile when.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include "cases/cases.h"
#include "frame_test.h"
#include "judge/judge.h"
#include "oracle/test_rays.h"

namespace umbrix::frame_tests {
namespace {

constexpr std::size_t kTile = 64;

/// Everything a frame counted, as text: a difference shows itself.
std::string all_counts(const FrameStats& s) {
  std::string text;
  const auto put = [&](std::initializer_list<std::uint64_t> values) {
    for (const std::uint64_t value : values) text += std::to_string(value) + " ";
    text += "\n";
  };
  const auto put_work = [&](const RayCounts& c) {
    put({c.rays, c.invalid_rays, c.node_tests, c.leaf_visits, c.primitive_tests, c.double_tests, c.exact_tests,
         c.far_rays, c.index_tests, c.links_followed, c.links_missing, c.restarts});
  };
  put({static_cast<std::uint64_t>(s.frame), s.first, s.cut, s.rays, s.occluded, s.cache_tries, s.cache_hits, s.bytes});
  for (const auto& row : {s.confusion.predicted_occluded, s.confusion.predicted_unoccluded, s.confusion.not_predicted})
    put({row[0], row[1]});
  for (const std::uint64_t route : s.routes) put({route});
  put_work(s.counts.occluded);
  put_work(s.counts.unoccluded);
  for (const auto& route : s.route_counts)
    for (const RayCounts& counts : route) put_work(counts);
  return text;
}

/// A few frames, each of whose tiles the threads take in an order of its own.
std::string run(const Scene& scene, const std::vector<Ray>& rays, const std::vector<std::uint8_t>& truth,
                const FrameOptions& options, unsigned threads, std::uint32_t seed) {
  const std::vector<Pixel> pixels = pixel_rows(rays.size(), 48);
  const float light[1][3] = {{0.1f, 0.2f, 0.3f}};
  FrameTracer tracer;
  EXPECT_TRUE(tracer.start(scene, options).ok());
  std::string counts;
  std::mt19937 random(seed);
  for (std::int64_t frame = 0; frame < 3; ++frame) {
    FrameView view = numbered(frame);
    view.lights = light;
    view.light_count = 1;
    EXPECT_TRUE(tracer.begin_frame(view).ok());
    std::vector<std::size_t> order((rays.size() + kTile - 1) / kTile);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::uint8_t> out(rays.size());
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; (i = next.fetch_add(1)) < order.size();) {
        const std::size_t begin = order[i] * kTile;
        ShadowTile tile;
        tile.light = static_cast<std::uint32_t>(order[i] % 3);
        tile.rays = {rays.data() + begin, std::min(kTile, rays.size() - begin)};
        tile.pixels = pixels.data() + begin;
        tracer.occluded(tile, out.data() + begin);
      }
    };
    std::vector<std::thread> workers;
    for (unsigned t = 1; t < threads; ++t) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
    EXPECT_EQ(out, truth);
    counts += all_counts(tracer.end_frame());
  }
  return counts;
}

TEST(FrameThreads, StatsDoNotDependOnThem) {
  constexpr std::uint64_t kSeed = 41;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  const cases::CaseData data = cases::find_case("random_segments")->make(kSeed, test_rays(2500));
  Scene scene;
  ASSERT_TRUE(judge::build(data.triangles, scene).ok());
  const std::vector<std::uint8_t> truth = brute(scene, data.rays);
  for (FrameOptions options : all_options()) {
    SCOPED_TRACE(describe(options));
    options.count_work = true;
    options.cell = 1.0f / 16;
    const std::string one = run(scene, data.rays, truth, options, 1, 1);
    std::uint32_t seed = 2;
    const bool is_usual = options.method == FrameMethod::cached || options.rule == PredictorRule::sample;
    for (unsigned threads = 1; threads <= (is_usual ? 7u : 3u); ++threads)
      ASSERT_EQ(run(scene, data.rays, truth, options, threads, seed++), one) << threads << " threads";
    ASSERT_EQ(run(scene, data.rays, truth, options, 4, seed), one) << "once more";
  }
}

}  // namespace
}  // namespace umbrix::frame_tests
