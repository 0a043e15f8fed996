// SPDX-License-Identifier: Apache-2.0
// `umbrix compare`: its numbers, its picture, and what it refuses.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::json;

class Compare : public ProgramTest {
 protected:
  /// An image of 4x2 pixels of these channels, all of `value`, with one pixel's first channel changed.
  void write_picture(const std::string& name, float value, float at_2_1,
                     std::vector<std::string> channels = {"R", "G", "B"}, int width = 4) const {
    io::Image image;
    image.width = width;
    image.height = 2;
    image.channels = std::move(channels);
    image.pixels.assign(static_cast<std::size_t>(width * 2) * image.channels.size(), value);
    image.pixels[static_cast<std::size_t>(width + 2) * image.channels.size()] = at_2_1;
    io::WriteOptions options;
    options.pixel_type = io::PixelType::single;
    ASSERT_TRUE(io::write_image(path(name), image, options).ok());
  }

  Outcome compare(const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"compare", path(a), path(b)});
    return run(more);
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Compare, TellsHowFarImagesAreApart) {
  write_picture("a.exr", 0.5f, 2.5f);
  write_picture("b.exr", 0.5f, 0.5f);
  const Outcome outcome = compare("a.exr", "b.exr", {"--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Json result = Json::parse(outcome.out);
  EXPECT_DOUBLE_EQ(result["rmse"], std::sqrt(4.0 / 24));
  EXPECT_NEAR(result["relmse"], 4 / (0.25 + 0.01 * 0.25) / 24, 1e-12);
  EXPECT_EQ(result["pixels"], 8);
  EXPECT_EQ(result["different_pixels"], 1);
  EXPECT_EQ(result["channels"][0]["name"], "R");
  EXPECT_DOUBLE_EQ(result["channels"][0]["rmse"], std::sqrt(4.0 / 8));
  EXPECT_DOUBLE_EQ(result["channels"][0]["mean_difference"], 0.25);
  EXPECT_EQ(result["channels"][0]["max"], 2);
  EXPECT_EQ(result["channels"][0]["max_at"], Json({2, 1}));
  EXPECT_EQ(result["channels"][1]["rmse"], 0);
  const Outcome text = compare("a.exr", "b.exr");
  EXPECT_TRUE(contains(text.out, "1 of 8 differ (12.5 %)")) << text.out;
  EXPECT_TRUE(contains(text.out, "RMSE    0.408248")) << text.out;
}

TEST_F(Compare, FailsAboveALimitOnRequest) {
  write_picture("a.exr", 0.5f, 2.5f);
  write_picture("b.exr", 0.5f, 0.5f);
  EXPECT_EQ(compare("a.exr", "b.exr", {"--fail-above", "0.8"}).code, 0);
  EXPECT_EQ(compare("a.exr", "b.exr", {"--fail-above", "0.7"}).code, 1);
  EXPECT_EQ(compare("a.exr", "a.exr", {"--fail-above", "0"}).code, 0);
  EXPECT_EQ(compare("a.exr", "b.exr", {"--fail-above", "-1"}).code, 2);
  write_picture("nan.exr", 0.5f, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(compare("nan.exr", "b.exr", {"--fail-above", "100"}).code, 1);
  EXPECT_EQ(compare("nan.exr", "nan.exr", {"--fail-above", "0"}).code, 0);
  const Json result = Json::parse(compare("nan.exr", "b.exr", {"--json"}).out);
  EXPECT_EQ(result["not_finite_pixels"], 1);
  EXPECT_EQ(result["different_pixels"], 1);
  EXPECT_EQ(result["rmse"], 0);
}

TEST_F(Compare, MatchesChannelsByName) {
  write_picture("a.exr", 1, 1, {"depth.Z", "R", "albedo.R"});
  write_picture("b.exr", 1, 3, {"R", "depth.Z"});
  const Json result = Json::parse(compare("a.exr", "b.exr", {"--json"}).out);
  EXPECT_EQ(result["channels"].size(), 2u);
  EXPECT_EQ(result["only_in_image"], Json({"albedo.R"}));
  EXPECT_FALSE(result.contains("rmse")) << "without all of R, G and B";
  for (const Json& channel : result["channels"]) EXPECT_EQ(channel["max"], channel["name"] == "R" ? 2 : 0);
}

TEST_F(Compare, WritesThePictureOfTheDifferences) {
  write_picture("a.exr", 0.5f, 0.25f);
  write_picture("b.exr", 0.5f, 0.5f);
  ASSERT_EQ(compare("a.exr", "b.exr", {"-o", path("d.exr")}).code, 0);
  ASSERT_EQ(compare("a.exr", "b.exr", {"--output", path("d.png"), "--exposure", "1"}).code, 0);
  io::Image exr, png;
  ASSERT_TRUE(io::read_image(path("d.exr"), exr).ok());
  ASSERT_TRUE(io::read_image(path("d.png"), png).ok());
  EXPECT_EQ(exr.pixels[6 * 3], 0.25f);
  EXPECT_EQ(exr.pixels[5 * 3], 0);
  EXPECT_NEAR(png.pixels[6 * 3], 0.735, 0.01) << "0.5 through the sRGB curve";
  EXPECT_EQ(compare("a.exr", "b.exr", {"-o", path("d.exr")}).code, 4);
  EXPECT_EQ(compare("a.exr", "b.exr", {"-o", path("d.exr"), "--overwrite"}).code, 0);
  EXPECT_EQ(compare("a.exr", "b.exr", {"-o", path("a.exr"), "--overwrite"}).code, 4) << "an input";
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  write_picture("a.exr", 1, 1);
  write_picture("wide.exr", 1, 1, {"R", "G", "B"}, 5);
  write_picture("depth.exr", 1, 1, {"depth.Z"});
  write("broken.exr", read("a.exr").substr(0, 200));
  for (const auto& [other, said] :
       {std::pair("wide.exr", "4x2 and 5x2"), std::pair("depth.exr", "no channel in common"),
        std::pair("broken.exr", "broken.exr"), std::pair("absent.exr", "absent.exr")}) {
    const Outcome outcome = compare("a.exr", other);
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(contains(outcome.err, said)) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, other)) << outcome.err;
  }
}

TEST_F(Compare, MemoryIsLimited) {
  write_picture("a.exr", 1, 1);
  EXPECT_EQ(compare("a.exr", "a.exr", {"--memory-limit", "1M"}).code, 6);
}

}  // namespace
}  // namespace umbrix::app
