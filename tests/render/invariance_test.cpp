// SPDX-License-Identifier: Apache-2.0
// What must not change a picture, and does not by a single bit.
#include <gtest/gtest.h>

#include <cstring>

#include "built_scenes.h"
#include "render/threads.h"

namespace umbrix::render {
namespace {

class Invariance : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(build_world(clutter_.scene, {}, world_).ok()); }
  void TearDown() override { ASSERT_TRUE(use_simd_target(nullptr).ok()); }

  RenderOptions options() const {
    RenderOptions options;
    options.width = 150;
    options.height = 90;
    options.samples = 3;
    options.aovs = {"normal", "depth", "albedo", "shadow"};
    return options;
  }

  io::Image image(const RenderOptions& options, int threads = 2) {
    io::Image result;
    RenderStats stats;
    with_threads(threads, [&] {
      const Status status = render(world_, clutter_.view, options, result, stats);
      EXPECT_TRUE(status.ok()) << status.message();
    });
    return result;
  }

  Clutter clutter_ = clutter(5);
  World world_;
};

void expect_same(const io::Image& a, const io::Image& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0);
}

TEST_F(Invariance, PictureShowsLightAndShadow) {
  RenderStats stats;
  io::Image picture;
  ASSERT_TRUE(render(world_, clutter_.view, options(), picture, stats).ok());
  for (const LightStats& light : stats.lights) {
    EXPECT_GT(light.occluded, 500u);
    EXPECT_GT(light.unoccluded, 500u);
  }
}

TEST_F(Invariance, Threads) {
  const io::Image one = image(options(), 1);
  expect_same(one, image(options(), 2));
  expect_same(one, image(options(), 7));
}

TEST_F(Invariance, Kernels) {
  const io::Image usual = image(options());
  ASSERT_GE(kernel_count(), 1u);
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    SCOPED_TRACE(kernel_info(i).name);
    RenderOptions with_kernel = options();
    ASSERT_TRUE(find_kernel(kernel_info(i).name, with_kernel.kernel).ok());
    ASSERT_TRUE(world_.scene.prepare(with_kernel.kernel).ok());
    expect_same(usual, image(with_kernel));
  }
}

TEST_F(Invariance, SimdTargets) {
  const io::Image best = image(options());
  ASSERT_GE(simd_target_count(), 1u);
  for (std::size_t i = 0; i < simd_target_count(); ++i) {
    SCOPED_TRACE(simd_target_name(i));
    ASSERT_TRUE(use_simd_target(simd_target_name(i)).ok());
    expect_same(best, image(options()));
  }
}

TEST_F(Invariance, BuildQuality) {
  const io::Image high = image(options());
  BuildOptions fast;
  fast.quality = BuildQuality::fast;
  ASSERT_TRUE(build_world(clutter_.scene, fast, world_).ok());
  expect_same(high, image(options()));
}

TEST_F(Invariance, CountingAndWorkChannels) {
  RenderOptions counted = options();
  counted.count_work = true;
  const io::Image plain = image(options());
  expect_same(plain, image(counted));
}

TEST_F(Invariance, CropIsAPartOfTheWhole) {
  const io::Image whole = image(options());
  RenderOptions part = options();
  part.crop = Crop{37, 11, 50, 64};
  const io::Image crop = image(part);
  ASSERT_EQ(crop.width, 50);
  ASSERT_EQ(crop.height, 64);
  const std::size_t row_bytes = 50 * crop.channels.size() * sizeof(float);
  for (int y = 0; y < 64; ++y) {
    const float* in_whole = &whole.pixels[static_cast<std::size_t>((11 + y) * 150 + 37) * whole.channels.size()];
    const float* in_crop = &crop.pixels[static_cast<std::size_t>(y * 50) * crop.channels.size()];
    ASSERT_EQ(std::memcmp(in_whole, in_crop, row_bytes), 0) << "row " << y;
  }
}

TEST_F(Invariance, FramesRenderedBefore) {
  const io::Camera rest = clutter_.view.camera;
  const auto frame = [&](int number) {
    clutter_.view.camera = rest;
    clutter_.view.camera.to_world[0][3] = 0.2 * number;
    return image(options());
  };
  const io::Image third = frame(3), first = frame(1);
  for (int number = 0; number < 3; ++number) frame(number);
  expect_same(third, frame(3));
  expect_same(first, frame(1));
}

TEST_F(Invariance, SeedChangesThePictureAndNothingElseDoes) {
  RenderOptions other = options();
  other.seed = 1;
  const io::Image first = image(options()), second = image(other);
  EXPECT_NE(first.pixels, second.pixels);
  expect_same(first, image(options()));
}

TEST_F(Invariance, CountsDoNotDependOnThreads) {
  RenderOptions counted = options();
  counted.count_work = true;
  RenderStats one, seven;
  io::Image unused;
  with_threads(1, [&] { ASSERT_TRUE(render(world_, clutter_.view, counted, unused, one).ok()); });
  with_threads(7, [&] { ASSERT_TRUE(render(world_, clutter_.view, counted, unused, seven).ok()); });
  for (std::size_t i = 0; i < one.lights.size(); ++i) {
    const LightStats &a = one.lights[i], &b = seven.lights[i];
    EXPECT_EQ(a.occluded, b.occluded);
    EXPECT_EQ(a.counts.occluded.rays, a.occluded);
    EXPECT_EQ(a.counts.unoccluded.rays, a.unoccluded);
    EXPECT_EQ(a.counts.occluded.node_tests, b.counts.occluded.node_tests);
    EXPECT_EQ(a.counts.unoccluded.primitive_tests, b.counts.unoccluded.primitive_tests);
    EXPECT_EQ(a.rays() + a.skipped(), one.camera_hits);
  }
}

TEST_F(Invariance, CancelledRenderStops) {
  std::atomic<bool> cancel{false};
  RenderOptions cancelled = options();
  cancelled.cancel = &cancel;
  std::size_t tiles = 0;
  cancelled.progress = [&](std::size_t done, std::size_t) {
    tiles = done;
    cancel = true;
  };
  io::Image unused;
  RenderStats stats;
  with_threads(
      1, [&] { EXPECT_EQ(render(world_, clutter_.view, cancelled, unused, stats).code(), StatusCode::cancelled); });
  EXPECT_EQ(tiles, 1u);
}

TEST_F(Invariance, ImpossibleOptionsAreRefused) {
  io::Image unused;
  RenderStats stats;
  const auto refused = [&](const RenderOptions& bad) {
    return render(world_, clutter_.view, bad, unused, stats).code() == StatusCode::invalid_argument;
  };
  RenderOptions bad = options();
  bad.aovs = {"colour"};
  EXPECT_TRUE(refused(bad));
  bad = options();
  bad.crop = Crop{149, 0, 2, 1};
  EXPECT_TRUE(refused(bad));
  bad = options();
  bad.width = 0;
  EXPECT_TRUE(refused(bad));
}

}  // namespace
}  // namespace umbrix::render
