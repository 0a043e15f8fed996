// SPDX-License-Identifier: Apache-2.0
// What must not change a picture, and does not by a single bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "built_scenes.h"
#include "render/threads.h"

namespace umbrix::render {
namespace {

/// Lights of all types over the clutter, an emissive sheet among them.
Clutter lit_clutter() {
  Clutter made = clutter(5);
  made.scene.materials.resize(2);
  made.scene.materials[1].emission = {3, 2, 1};
  made.scene.meshes.push_back(quad({-1, -1, 1.8f}, {-1, 1, 1.9f}, {0.5f, 1, 2}, {0.5f, -1, 2}));
  made.scene.meshes.back().material = 1;
  place(made.scene, 2);
  io::Light rectangle = point_light({1, 0, 2}, 5), sphere = point_light({-0.5, 1, 2.2}, 8), sky;
  rectangle.type = io::LightType::rectangle;
  sphere.type = io::LightType::sphere;
  sphere.radius = 0.3f;
  sky.type = io::LightType::environment;
  made.view.lights.insert(made.view.lights.end(), {rectangle, sphere, sky});
  for (const io::Light& light : io::emissive_lights(made.scene)) made.view.lights.push_back(light);
  return made;
}

class Invariance : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(build_world(clutter_.scene, {}, world_).ok()); }
  void TearDown() override { ASSERT_TRUE(use_simd_target(nullptr).ok()); }

  RenderOptions options() const {
    RenderOptions options;
    options.width = 150;
    options.height = 90;
    options.samples = 3;
    options.bounces = 2;
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

  Clutter clutter_ = lit_clutter();
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
  RenderOptions once = options();
  once.samples = 1;
  const io::Image usual = image(once);
  ASSERT_GE(kernel_count(), 1u);
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    SCOPED_TRACE(kernel_info(i).name);
    RenderOptions with_kernel = once;
    ASSERT_TRUE(find_kernel(kernel_info(i).name, with_kernel.kernel).ok());
    ASSERT_TRUE(world_.scene.prepare(with_kernel.kernel).ok());
    expect_same(usual, image(with_kernel));
  }
}

TEST_F(Invariance, FrameTracers) {
  RenderOptions once = options();
  once.samples = 1;
  const io::Image usual = image(once);
  for (const FrameMethod method : {FrameMethod::best, FrameMethod::cached, FrameMethod::paper, FrameMethod::indexed,
                                   FrameMethod::linked, FrameMethod::beam}) {
    SCOPED_TRACE(static_cast<int>(method));
    FrameOptions frame_options;
    frame_options.method = method;
    FrameTracer tracer;
    ASSERT_TRUE(tracer.start(world_.scene, frame_options).ok());
    RenderOptions traced = once;
    traced.tracer = &tracer;
    for (traced.frame = 0; traced.frame < 3; ++traced.frame) expect_same(usual, image(traced));
  }
}

TEST_F(Invariance, ChosenLightsAndMoreSamples) {
  RenderOptions more = options();
  more.width = 64;
  more.samples = 2;
  more.light_samples = 3;
  for (int i = 0; i < 8; ++i) {
    io::Light light = clutter_.view.lights[3];
    light.position[0] -= 0.3 * i;
    clutter_.view.lights.push_back(light);
  }
  const io::Image one = image(more, 1);
  expect_same(one, image(more, 7));
  FrameTracer tracer;
  ASSERT_TRUE(tracer.start(world_.scene).ok());
  more.tracer = &tracer;
  for (more.frame = 0; more.frame < 2; ++more.frame) expect_same(one, image(more));
}

TEST_F(Invariance, SimdTargetsAndThreads) {
  const io::Image best = image(options());
  ASSERT_GE(simd_target_count(), 1u);
  for (std::size_t i = 0; i < simd_target_count(); ++i) {
    SCOPED_TRACE(simd_target_name(i));
    ASSERT_TRUE(use_simd_target(simd_target_name(i)).ok());
    for (const int threads : {1, 3, 7}) expect_same(best, image(options(), threads));
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
    EXPECT_EQ(a.rays() + a.skipped(), one.camera_hits + one.bounce_hits);
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

/// Keeps tiles in memory, and hands over every other one of those that it was given.
class HalfStore : public TileStore {
 public:
  explicit HalfStore(const io::Image* kept) : kept_(kept) {}

  void begin(const std::vector<PixelRect>& tiles, io::Image& image, std::vector<std::uint8_t>& finished) override {
    tiles_ = tiles;
    for (std::size_t i = 0; kept_ && i < tiles.size(); i += 2) {
      const PixelRect& tile = tiles[i];
      const std::size_t channels = image.channels.size(), columns = static_cast<std::size_t>(image.width);
      for (int y = tile.y - image.y; y < tile.y - image.y + tile.height; ++y) {
        const std::size_t at = static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(tile.x - image.x);
        std::copy_n(&kept_->pixels[at * channels], static_cast<std::size_t>(tile.width) * channels,
                    &image.pixels[at * channels]);
      }
      finished[i] = 1;
    }
  }
  void finish(std::size_t i) override { finished_.push_back(i); }

  std::vector<PixelRect> tiles_;
  std::vector<std::size_t> finished_;

 private:
  const io::Image* kept_;
};

TEST_F(Invariance, GoesOnFromTilesThatAreKept) {
  const std::optional<Crop> crops[] = {std::nullopt, Crop{11, 7, 100, 70}};
  for (const std::optional<Crop>& crop : crops) {
    RenderOptions whole = options();
    whole.crop = crop;
    HalfStore none(nullptr);
    whole.store = &none;
    const io::Image first = image(whole);
    ASSERT_GT(none.tiles_.size(), 8u);
    EXPECT_EQ(none.finished_.size(), none.tiles_.size());

    HalfStore half(&first);
    RenderOptions rest = whole;
    rest.store = &half;
    std::size_t least = none.tiles_.size(), most = 0;
    rest.progress = [&](std::size_t done, std::size_t) {
      least = std::min(least, done);
      most = std::max(most, done);
    };
    expect_same(first, image(rest));
    for (const std::size_t i : half.finished_) EXPECT_EQ(i % 2, 1u) << "what was there is rendered again";
    EXPECT_EQ(half.finished_.size(), none.tiles_.size() / 2);
    EXPECT_EQ(least, (none.tiles_.size() + 1) / 2 + 1) << "progress counts what was there";
    EXPECT_EQ(most, none.tiles_.size());
  }
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
