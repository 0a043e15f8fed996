// SPDX-License-Identifier: Apache-2.0
// Charts of rates: zeros are shown, names do not cover each other, and pictures come of them.
#include "plot/scatter_chart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "plot/label_places.h"
#include "plot/png.h"
#include "xml_text.h"

namespace umbrix::plot {
namespace {

ScatterChart example() {
  ScatterChart chart;
  chart.title = "Wrong & right";
  chart.x = {"rays", true, {}, {}};
  chart.y = {"wrong", true, {}, {}};
  chart.series = {{"exact", 0, false, {{10, 0, 0, 4, "none"}, {20, 0, 0, 4, "neither"}}},
                  {"other", 1, false, {{30, 100, 80, 120, "many"}}},
                  {"", 1, true, {{30, 10, 0, 15, ""}}}};
  chart.zero_bound = 4;
  chart.zero_note = "bound 4";
  return chart;
}

/// The heights of the circles of a document, markers and rings, in their order.
std::vector<double> circle_heights(const std::string& text) {
  std::vector<double> heights;
  for (std::size_t at = text.find(" cy=\""); at != std::string::npos; at = text.find(" cy=\"", at + 1))
    heights.push_back(std::strtod(text.c_str() + at + 5, nullptr));
  return heights;
}

TEST(ScatterChart, IsWellFormedAndComplete) {
  const std::string text = svg_text(example());
  EXPECT_TRUE(well_formed(text));
  for (const char* said : {">Wrong &amp; right<", ">none<", ">neither<", ">many<", ">bound 4<", ">exact<", ">0<"})
    EXPECT_EQ(count_of(text, said), 1u) << said;
  EXPECT_EQ(count_of(text, "stroke-dasharray"), 1u);
  EXPECT_EQ(count_of(text, "nan") + count_of(text, "inf"), 0u);
  EXPECT_EQ(text, svg_text(example()));
}

TEST(ScatterChart, ZerosStandBelowAllOthers) {
  // In the legend's order: the marker of "exact"; then the points: two zeros of it and the ring at 10.
  const std::vector<double> heights = circle_heights(svg_text(example()));
  ASSERT_EQ(heights.size(), 4u);
  EXPECT_EQ(heights[1], heights[2]);
  EXPECT_LT(heights[3], heights[1]) << "y grows downwards";
  ScatterChart without = example();
  without.series.erase(without.series.begin());
  EXPECT_EQ(count_of(svg_text(without), ">0<"), 0u) << "no row for what there is not";
}

TEST(ScatterChart, OfNothing) { EXPECT_TRUE(well_formed(svg_text(ScatterChart()))); }

TEST(LabelPlaces, NamesCoverNothing) {
  LabelPlaces places(0, 0, 200, 100);
  const Point point = {100, 50};
  places.occupy(point, 4);
  std::vector<Point> found;
  while (const auto at = places.place(point, "name")) {
    for (const Point& other : found) {
      const bool apart = std::abs(at->x - other.x) >= 20 || std::abs(at->y - other.y) >= LabelPlaces::kSize;
      EXPECT_TRUE(apart) << at->x << ", " << at->y;
    }
    found.push_back(*at);
    ASSERT_LT(found.size(), 100u);
  }
  EXPECT_GE(found.size(), 4u);
  EXPECT_FALSE(places.place({2, 2}, "a name that is far too long for the page that it has to stand on"));
}

TEST(WritePng, IsAPictureOfTheChartsSize) {
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("umbrix_chart_" + std::to_string(::getpid()) + ".png");
  if (!can_rasterise()) {
    EXPECT_EQ(write_png(path.string(), svg_text(example()), 1).code(), StatusCode::internal);
    GTEST_SKIP() << "built without librsvg";
  }
  const Status status = write_png(path.string(), svg_text(example()), 0.5);
  ASSERT_TRUE(status.ok()) << status.message();
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  ASSERT_GT(bytes.size(), 1000u);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  const auto number = [&bytes](std::size_t at) {  // big-endian, in the header chunk
    return static_cast<unsigned char>(bytes[at + 2]) * 256 + static_cast<unsigned char>(bytes[at + 3]);
  };
  EXPECT_EQ(number(16), 480);
  EXPECT_EQ(number(20), 260);
  std::filesystem::remove(path);
  EXPECT_EQ(write_png(path.string(), "no SVG", 1).code(), StatusCode::output_failed);
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace umbrix::plot
