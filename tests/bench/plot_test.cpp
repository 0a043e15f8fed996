// SPDX-License-Identifier: Apache-2.0
// Charts: documents that any viewer reads, with everything in its place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "plot/axis_scale.h"
#include "xml_text.h"

namespace umbrix::plot {
namespace {

LineChart example() {
  LineChart chart;
  chart.title = "Rays & <kernels>";
  chart.x.title = "depth";
  chart.y.title = "tests a ray";
  chart.series = {{"standard", {{1, 10}, {2, 40}, {3, 70}}}, {"linked", {{1, 12}, {2, 20}, {3, 30}}}};
  return chart;
}

/// The coordinates of all elements lie on the page.
void expect_on_page(const std::string& text, const LineChart& chart) {
  for (const auto& [name, most] : {std::pair<std::string, int>{" x=\"", chart.width}, {" y=\"", chart.height}}) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const double value = std::strtod(text.c_str() + at + name.size(), nullptr);
      EXPECT_GE(value, 0);
      EXPECT_LE(value, most);
    }
  }
  EXPECT_EQ(count_of(text, "nan") + count_of(text, "inf"), 0u);
}

TEST(LineChart, IsWellFormedAndComplete) {
  const std::string text = svg_text(example());
  EXPECT_TRUE(well_formed(text));
  EXPECT_EQ(count_of(text, "<svg "), 1u);
  EXPECT_EQ(count_of(text, "<polyline "), 2u);
  EXPECT_EQ(count_of(text, "<circle "), 3u + 1) << "markers of the first series, and in the legend";
  for (const char* said :
       {">Rays &amp; &lt;kernels&gt;<", ">depth<", ">tests a ray<", ">standard<", ">linked<", ">70<"})
    EXPECT_EQ(count_of(text, said), 1u) << said;
  expect_on_page(text, example());
  EXPECT_EQ(text, svg_text(example()));
}

TEST(LineChart, BarsStandSideBySideFromZero) {
  LineChart chart = example();
  for (Series& series : chart.series) series.mark = Mark::bars;
  const std::string text = svg_text(chart);
  EXPECT_TRUE(well_formed(text));
  EXPECT_EQ(count_of(text, "<polyline "), 0u);
  EXPECT_EQ(count_of(text, "<rect "), 1u + 6 + 2) << "paper, bars, legend";
  expect_on_page(text, chart);
}

TEST(LineChart, RightAxisHasItsOwnScale) {
  LineChart chart = example();
  chart.series[1].on_right_axis = true;
  chart.series[1].points = {{1, 0.1}, {3, 0.7}};
  chart.right.title = "share";
  const std::string text = svg_text(chart);
  EXPECT_TRUE(well_formed(text));
  EXPECT_EQ(count_of(text, ">share<"), 1u);
  EXPECT_EQ(count_of(text, ">0.6<"), 1u);
  EXPECT_EQ(count_of(text, ">linked (right)<"), 1u);
  expect_on_page(text, chart);
}

TEST(LineChart, HolesAndNothing) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  LineChart chart = example();
  chart.y.logarithmic = true;
  chart.series = {{"a", {{1, 10}, {2, 100}, {3, nan}, {4, 0}, {5, infinity}, {6, 10}, {7, 20}, {nan, 3}}}};
  const std::string text = svg_text(chart);
  EXPECT_EQ(count_of(text, "<polyline "), 2u) << "the line has a hole";
  expect_on_page(text, chart);
  for (const bool logarithmic : {false, true}) {
    LineChart empty;
    empty.x.logarithmic = empty.y.logarithmic = logarithmic;
    EXPECT_TRUE(well_formed(svg_text(empty)));
    empty.series = {{"none", {}}, {"one", {{3, 5}}}, {"bar", {{3, 5}}, Mark::bars}};
    EXPECT_TRUE(well_formed(svg_text(empty)));
    expect_on_page(svg_text(empty), empty);
  }
}

std::vector<std::string> labels(const AxisScale& scale) {
  std::vector<std::string> result;
  for (const Tick& tick : scale.ticks) result.push_back(tick.label);
  return result;
}

Range range(double low, double high) { return {low, high, false}; }

TEST(AxisScale, LinearEndsOnTicks) {
  const AxisScale scale = fit_axis({}, range(0, 0.93), 6);
  EXPECT_EQ(labels(scale), (std::vector<std::string>{"0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(scale.place(0), 0);
  EXPECT_EQ(scale.place(0.5), 0.5);
  EXPECT_EQ(labels(fit_axis({}, range(-3, 4), 4)), (std::vector<std::string>{"-4", "-2", "0", "2", "4"}));
}

TEST(AxisScale, FixedEndsStay) {
  Axis axis;
  axis.low = 0.5;
  axis.high = 3.5;
  const AxisScale scale = fit_axis(axis, range(1, 9), 6);
  EXPECT_EQ(scale.low, 0.5);
  EXPECT_EQ(scale.high, 3.5);
  EXPECT_EQ(scale.ticks.front().value, 0.5);
  EXPECT_EQ(scale.ticks.back().value, 3.5);
}

TEST(AxisScale, LogarithmicNamesWhatHasRoom) {
  Axis axis;
  axis.logarithmic = true;
  EXPECT_EQ(labels(fit_axis(axis, range(3, 40), 9)), (std::vector<std::string>{"2", "5", "10", "20", "50"}));
  const AxisScale wide = fit_axis(axis, range(1, 1e7), 9);
  EXPECT_EQ(wide.ticks.front().label, "1");
  EXPECT_EQ(wide.ticks.back().label, "10e6");
  EXPECT_EQ(wide.ticks[1].label, "") << "a tick alone";
  EXPECT_NEAR(wide.place(1000), 3 / 7.0, 1e-12);
  EXPECT_FALSE(wide.shows(0));
}

TEST(WriteSvg, WholeOrNotAtAll) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("umbrix_plot_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const std::string path = (folder / "a.svg").string();
  EXPECT_TRUE(write_svg(path, example(), false).ok());
  EXPECT_EQ(write_svg(path, example(), false).code(), StatusCode::output_failed);
  EXPECT_TRUE(write_svg(path, example(), true).ok());
  std::ifstream in(path, std::ios::binary);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), svg_text(example()));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace umbrix::plot
