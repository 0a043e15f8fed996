// SPDX-License-Identifier: Apache-2.0
// Heat maps: colours mean what the legend says, and the legend is there.
#include "render/heat_map/heat_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/heat_map/color_map.h"
#include "render/heat_map/heat_scale.h"
#include "render/round_ticks.h"

namespace umbrix::render {
namespace {

/// An image with one channel after the colour, left to right `values` in every row.
io::Image strip(const char* channel, const std::vector<float>& values, int height) {
  io::Image image;
  image.width = static_cast<int>(values.size());
  image.height = height;
  image.channels = {"R", "G", "B", "A", channel};
  for (int y = 0; y < height; ++y) {
    for (const float value : values) image.pixels.insert(image.pixels.end(), {0, 0, 0, 1, value});
  }
  return image;
}

std::vector<float> ramp(int width, float end) {
  std::vector<float> values;
  for (int x = 0; x < width; ++x) values.push_back(end * static_cast<float>(x) / static_cast<float>(width - 1));
  return values;
}

Color at(const io::Image& picture, int x, int y) {
  const auto row = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
  const float* pixel = &picture.pixels[(row + static_cast<std::size_t>(x)) * 3];
  return {pixel[0], pixel[1], pixel[2]};
}

bool same(Color a, Color b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

/// How many pixels of a row are of `color`.
int count(const io::Image& picture, int y, Color color) {
  int n = 0;
  for (int x = 0; x < picture.width; ++x) n += same(at(picture, x, y), color);
  return n;
}

/// The row of the ticks' upper ends: the first one below the bar's lower border.
int tick_row(const io::Image& picture, int image_height) {
  const Color ink = display_color(0x1a1a1a);
  const auto is_border = [&](int y) { return count(picture, y, ink) > picture.width * 9 / 10; };
  int y = image_height;
  for (const bool inside_border : {false, true, false, true}) {
    while (y < picture.height && is_border(y) == inside_border) ++y;
  }
  return y;
}

io::Image drawn(const HeatMapContent& content, const io::Image& image, const RenderStats& stats = {}) {
  io::Image picture;
  const Status status = make_heat_map(content, image, stats, picture);
  EXPECT_TRUE(status.ok()) << status.message();
  return picture;
}

TEST(Viridis, EndsMiddleAndOrder) {
  EXPECT_TRUE(same(viridis(0), display_color(0x440154)));
  EXPECT_TRUE(same(viridis(1), display_color(0xfde725)));
  EXPECT_TRUE(same(viridis(-3), viridis(0)));
  EXPECT_TRUE(same(viridis(7), viridis(1)));
  EXPECT_TRUE(same(viridis(std::nan("")), viridis(0)));
  EXPECT_NEAR(viridis(0.5).g, display_color(0x00918c).g, 0.01);  // the published #21918c
  float last = -1;
  for (int i = 0; i <= 255; i += 5) {
    const Color c = viridis(i / 255.0);
    const float luminance = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
    EXPECT_GT(luminance, last) << i;
    last = luminance;
  }
}

TEST(RoundTicks, StepsAndLabels) {
  EXPECT_DOUBLE_EQ(round_step(300, 8), 50);
  EXPECT_DOUBLE_EQ(round_step(0.6, 3), 0.2);
  EXPECT_DOUBLE_EQ(round_step(7, 5), 2);
  EXPECT_DOUBLE_EQ(round_step(1e9, 1), 1e9);
  EXPECT_EQ(tick_label(3 * 0.1, 0.1), "0.3");
  EXPECT_EQ(tick_label(150, 50), "150");
  EXPECT_EQ(tick_label(0.25, 0.05), "0.25");
  EXPECT_EQ(tick_label(0, 0.05), "0");
  EXPECT_EQ(tick_label(-40000, 20000), "-40000");
  EXPECT_EQ(tick_label(1.5e9, 5e8), "1500e6");
  EXPECT_EQ(tick_label(6e-6, 2e-6), "6e-6");
}

TEST(HeatScale, LeavesOutTheFewLargest) {
  std::vector<float> values(1000, 46);
  values[3] = 5000;
  const HeatScale scale = choose_heat_scale(values, 0);
  EXPECT_DOUBLE_EQ(scale.end, 50);
  EXPECT_DOUBLE_EQ(scale.step, 10);
  EXPECT_TRUE(scale.clamps);
  EXPECT_EQ(scale.max, 5000);
  EXPECT_NEAR(scale.mean, (999 * 46 + 5000) / 1000.0, 1e-9);
  EXPECT_FALSE(choose_heat_scale({0, 1, 2}, 0).clamps);
}

TEST(HeatScale, SurvivesNothingAndInfinity) {
  EXPECT_EQ(choose_heat_scale({}, 0).end, 1);
  EXPECT_EQ(choose_heat_scale({0, 0}, 0).end, 1);
  const HeatScale scale = choose_heat_scale({std::numeric_limits<float>::infinity(), 3, std::nanf("")}, 0);
  EXPECT_EQ(scale.without, 2u);
  EXPECT_EQ(scale.max, 3);
  EXPECT_EQ(scale.mean, 3);
  std::vector<float> mostly_zero(1000, 0);
  mostly_zero[0] = 7;
  EXPECT_GE(choose_heat_scale(mostly_zero, 0).end, 7) << "or all would be one colour";
}

TEST(HeatScale, EndsWhereItIsAskedTo) {
  const HeatScale scale = choose_heat_scale({0, 46, 5000}, 137);
  EXPECT_EQ(scale.end, 137);
  EXPECT_DOUBLE_EQ(scale.step, 20);
  EXPECT_TRUE(scale.clamps);
  EXPECT_EQ(scale.max, 5000);
  EXPECT_FALSE(choose_heat_scale({0, 46}, 137).clamps);
  EXPECT_EQ(choose_heat_scale({}, 7).end, 7);
  EXPECT_EQ(choose_heat_scale({0}, 7).end, 7);
}

TEST(HeatMap, RampGoesFromEndToEndAboveItsLegend) {
  const io::Image image = strip("node_tests.Y", ramp(640, 100), 20);
  const io::Image picture = drawn({"node_tests"}, image);
  EXPECT_EQ(picture.width, 640);
  EXPECT_GT(picture.height, 20 + 80);
  EXPECT_LT(picture.height, 20 + 160);
  EXPECT_EQ(picture.channels, (std::vector<std::string>{"R", "G", "B"}));
  for (const int y : {0, 19}) {
    EXPECT_TRUE(same(at(picture, 0, y), viridis(0)));
    EXPECT_TRUE(same(at(picture, 639, y), viridis(1)));
    EXPECT_TRUE(same(at(picture, 300, y), viridis(300.0 / 639)));
  }
}

TEST(HeatMap, LegendHasBarTicksAndText) {
  const io::Image picture = drawn({"node_tests"}, strip("node_tests.Y", ramp(640, 100), 20));
  const Color paper = display_color(0xffffff), ink = display_color(0x1a1a1a);
  EXPECT_EQ(count(picture, 20, paper), 640) << "a margin below the picture";
  EXPECT_EQ(count(picture, picture.height - 1, paper), 640);

  // The bar: a line of ink, the colours from end to end, a line of ink.
  int top = 20;
  while (top < picture.height && count(picture, top, ink) < 600) ++top;
  ASSERT_LT(top, picture.height);
  const int inside = top + 8;
  int first = 0, last = 639;
  while (!same(at(picture, first, inside), viridis(0))) ASSERT_LT(++first, 30);
  while (!same(at(picture, last, inside), viridis(1))) ASSERT_GT(--last, 610);
  EXPECT_NEAR(at(picture, (first + last) / 2, inside).g, viridis(0.5).g, 0.01);

  // Ticks at 0, 20, ... 100.
  const int bottom = tick_row(picture, 20);
  ASSERT_LT(bottom, picture.height);
  for (int i = 0; i <= 5; ++i) EXPECT_TRUE(same(at(picture, first + (last - first) * i / 5, bottom), ink)) << i;
  EXPECT_EQ(count(picture, bottom, ink), 6 * 2);

  // Text above and below.
  const auto ink_between = [&](int low, int high) {
    int n = 0;
    for (int y = low; y < high; ++y) n += count(picture, y, ink);
    return n;
  };
  EXPECT_GT(ink_between(20, top), 500);
  EXPECT_GT(ink_between(bottom + 8, picture.height), 500);
}

TEST(HeatMap, PicturesWithOneEndCompare) {
  const io::Image dim = drawn({"node_tests", 137}, strip("node_tests.Y", {0, 50, 60}, 20));
  const io::Image bright = drawn({"node_tests", 137}, strip("node_tests.Y", {50, 137, 9000}, 20));
  EXPECT_TRUE(same(at(dim, 1, 0), viridis(50 / 137.0)));
  EXPECT_TRUE(same(at(dim, 1, 0), at(bright, 0, 0)));
  EXPECT_TRUE(same(at(bright, 1, 0), viridis(1)));
  EXPECT_TRUE(same(at(bright, 2, 0), viridis(1)));
  EXPECT_EQ(dim.height, bright.height);

  const io::Image wide = drawn({"node_tests", 137}, strip("node_tests.Y", ramp(640, 100), 20));
  const int row = tick_row(wide, 20);
  ASSERT_LT(row, wide.height);
  EXPECT_EQ(count(wide, row, display_color(0x1a1a1a)), 8 * 2) << "ticks at 0, 20, ... 120 and at the end";
}

TEST(HeatMap, SmallPictureMakesRoomForItsLegend) {
  const io::Image picture = drawn({"depth"}, strip("depth.Z", {1, 2, std::numeric_limits<float>::infinity(), 4}, 3));
  EXPECT_GT(picture.width, 200);
  EXPECT_TRUE(same(at(picture, 0, 0), viridis(0.25)));
  EXPECT_TRUE(same(at(picture, 3, 2), viridis(1)));
  EXPECT_TRUE(same(at(picture, 2, 1), display_color(0x808080))) << "nothing there";
  EXPECT_TRUE(same(at(picture, 4, 1), display_color(0xffffff)));
}

TEST(HeatMap, RoutesMixByTheirShares) {
  io::Image image;
  image.width = 3;
  image.height = 1;
  image.channels = {"kernel.cached", "kernel.beam", "kernel.indexed", "kernel.linked", "kernel.other"};
  image.pixels = {1, 0, 0, 0, 0, 0.5f, 0, 0, 0.5f, 0, 0, 0, 0, 0, 0};
  RenderStats stats;
  stats.lights.resize(1);
  stats.lights[0].routes = {3, 0, 0, 1, 0};
  const io::Image picture = drawn({"kernel"}, image, stats);
  const Color cached = route_color(RayRoute::cached), linked = route_color(RayRoute::linked);
  EXPECT_TRUE(same(at(picture, 0, 0), cached));
  EXPECT_FLOAT_EQ(at(picture, 1, 0).r, (cached.r + linked.r) / 2);
  EXPECT_FLOAT_EQ(at(picture, 1, 0).b, (cached.b + linked.b) / 2);
  EXPECT_LT(at(picture, 2, 0).g, 0.05f) << "no ray, no colour";
  for (std::size_t i = 0; i < kRayRoutes; ++i) {
    int pixels = 0;
    for (int y = 1; y < picture.height; ++y) pixels += count(picture, y, route_color(static_cast<RayRoute>(i)));
    EXPECT_EQ(pixels, 9 * 9) << "the legend's square of route " << i;
  }
}

TEST(HeatMap, RefusesWhatCannotBeShown) {
  io::Image picture;
  const io::Image image = strip("node_tests.Y", {1}, 1);
  for (const char* aov : {"normal", "colour", "", "kernel", "depth"}) {
    EXPECT_EQ(make_heat_map({aov}, image, {}, picture).code(), StatusCode::invalid_argument) << aov;
  }
}

}  // namespace
}  // namespace umbrix::render
