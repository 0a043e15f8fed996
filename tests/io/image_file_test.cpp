// SPDX-License-Identifier: Apache-2.0
#include "umbrix/io/image_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::TempFolder;

Image rgb(std::vector<float> pixels, int width) {
  Image image;
  image.channels = {"R", "G", "B"};
  image.width = width;
  image.height = static_cast<int>(pixels.size() / 3) / width;
  image.pixels = std::move(pixels);
  return image;
}

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Image write_and_read(const Image& image, const std::string& name, const WriteOptions& options) {
  const TempFolder folder;
  const Status written = write_image(folder.path(name), image, options);
  EXPECT_TRUE(written.ok()) << written.message();
  Image back;
  const Status read = read_image(folder.path(name), back);
  EXPECT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(folder.names(), std::vector<std::string>{name});
  return back;
}

TEST(ImageFile, FloatExrKeepsEverything) {
  Image image = rgb({0, 1e-8f, 1.0f / 3, 1e9f, -2, 0.5f}, 2);
  image.metadata = {{"umbrix:seed", "7"}};
  image.matrices = {{"worldToCamera", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1}}};
  WriteOptions options;
  options.pixel_type = PixelType::single;
  const Image back = write_and_read(image, "a.exr", options);
  EXPECT_EQ(back.width, 2);
  EXPECT_EQ(back.height, 1);
  EXPECT_EQ(back.channels, image.channels);
  EXPECT_EQ(back.pixels, image.pixels);
  ASSERT_EQ(back.matrices.size(), 1u);
  EXPECT_EQ(back.matrices[0].second, image.matrices[0].second);
  bool seed = false;
  for (const auto& [name, value] : back.metadata) seed = seed || (name == "umbrix:seed" && value == "7");
  EXPECT_TRUE(seed);
}

TEST(ImageFile, HalfExrRoundsStaysFiniteAndKeepsDepths) {
  Image image;
  image.width = image.height = 1;
  image.channels = {"R", "G", "B", "depth.Z"};
  image.pixels = {1.0f / 3, 1e6f, 0.5f, 12345.678f};
  const Image back = write_and_read(image, "a.exr", {});
  ASSERT_EQ(back.channels, image.channels);
  EXPECT_NEAR(back.pixels[0], 1.0f / 3, 1e-3);
  EXPECT_NE(back.pixels[0], 1.0f / 3);
  EXPECT_EQ(back.pixels[1], 65504.0f);
  EXPECT_EQ(back.pixels[2], 0.5f);
  EXPECT_EQ(back.pixels[3], 12345.678f);
}

// The stored byte of a grey value.
int png_value(float linear, const WriteOptions& options) {
  return static_cast<int>(
      std::lround(write_and_read(rgb({linear, linear, linear}, 1), "a.png", options).pixels.at(0) * 255));
}

TEST(ImageFile, PngCurveExposureAndToneMap) {
  WriteOptions options;
  EXPECT_EQ(png_value(0.5f, options), 188);
  EXPECT_EQ(png_value(0, options), 0);
  EXPECT_EQ(png_value(1, options), 255);
  EXPECT_EQ(png_value(50, options), 255);
  EXPECT_EQ(png_value(-1, options), 0);
  EXPECT_EQ(png_value(std::nanf(""), options), 0);
  options.exposure = -1;
  EXPECT_EQ(png_value(1, options), 188);
  options.exposure = 0;
  options.tone_map = ToneMap::none;
  EXPECT_EQ(png_value(0.5f, options), 128);
  options.tone_map = ToneMap::aces;
  // 0.5 -> 0.6163 by the fit, 0.8065 by the curve.
  EXPECT_EQ(png_value(0.5f, options), 206);
  EXPECT_EQ(png_value(1e30f, options), 255);
}

TEST(ImageFile, PngFindsItsChannelsAmongOthers) {
  Image image;
  image.width = image.height = 1;
  image.channels = {"depth.Z", "B", "G", "R"};
  image.pixels = {9, 0, 0.5f, 1};
  const Image back = write_and_read(image, "a.png", {});
  ASSERT_EQ(back.pixels.size(), 3u);
  EXPECT_EQ(back.pixels[0], 1);
  EXPECT_EQ(back.pixels[2], 0);
}

TEST(ImageFile, EqualImagesAreEqualFiles) {
  const TempFolder folder;
  const Image image = rgb(std::vector<float>(3 * 64 * 64, 0.25f), 64);
  for (const char* extension : {".exr", ".png"}) {
    const std::string a = folder.path(std::string("a") + extension);
    const std::string b = folder.path(std::string("b") + extension);
    ASSERT_TRUE(write_image(a, image, {}).ok());
    ::usleep(1100000);  // another second on the clock, for a time stamp to show
    ASSERT_TRUE(write_image(b, image, {}).ok());
    EXPECT_EQ(contents(a), contents(b)) << extension;
  }
}

TEST(ImageFile, ExistingFilesAreKeptUnlessAsked) {
  const TempFolder folder;
  const std::string path = folder.write("a.exr", "old");
  const Image image = rgb({1, 1, 1}, 1);
  WriteOptions options;
  EXPECT_EQ(check_output(path, options).code(), StatusCode::output_failed);
  const Status refused = write_image(path, image, options);
  EXPECT_EQ(refused.code(), StatusCode::output_failed);
  EXPECT_NE(refused.message().find("a.exr"), std::string::npos);
  EXPECT_NE(refused.message().find("exists"), std::string::npos);
  EXPECT_EQ(contents(path), "old");
  options.overwrite = true;
  EXPECT_TRUE(check_output(path, options).ok());
  EXPECT_TRUE(write_image(path, image, options).ok());
  EXPECT_NE(contents(path), "old");
}

TEST(ImageFile, FailuresLeaveNothingBehind) {
  const TempFolder folder;
  const Image image = rgb({1, 1, 1}, 1);
  EXPECT_EQ(write_image(folder.path("none/a.exr"), image, {}).code(), StatusCode::output_failed);
  EXPECT_EQ(write_image(folder.path("a.jpeg2"), image, {}).code(), StatusCode::output_failed);
  EXPECT_EQ(check_output(folder.path("a"), {}).code(), StatusCode::output_failed);
  std::filesystem::create_directory(folder.path("folder.png"));
  WriteOptions overwrite;
  overwrite.overwrite = true;
  EXPECT_EQ(write_image(folder.path("folder.png"), image, overwrite).code(), StatusCode::output_failed);
  Image broken = image;
  broken.pixels.pop_back();
  EXPECT_EQ(write_image(folder.path("b.exr"), broken, {}).code(), StatusCode::invalid_argument);
  Image grey = image;
  grey.channels = {"Y", "U", "V"};
  EXPECT_EQ(write_image(folder.path("b.png"), grey, {}).code(), StatusCode::invalid_argument);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"folder.png"});
}

TEST(ImageFile, UnwritableFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TempFolder folder;
  std::filesystem::permissions(folder.path("."),
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const Status status = check_output(folder.path("a.exr"), {});
  EXPECT_EQ(status.code(), StatusCode::output_failed);
  EXPECT_NE(status.message().find("not writable"), std::string::npos);
}

TEST(ImageFile, ReadingWhatIsNoImage) {
  const TempFolder folder;
  Image image;
  EXPECT_EQ(read_image(folder.path("none.exr"), image).code(), StatusCode::bad_input);
  const Status status = read_image(folder.write("bad.exr", "nonsense"), image);
  EXPECT_EQ(status.code(), StatusCode::bad_input);
  EXPECT_NE(status.message().find("bad.exr"), std::string::npos);
}

TEST(WriteText, WholeOrNotAtAll) {
  const TempFolder folder;
  ASSERT_TRUE(write_text(folder.path("a.json"), "{}", false).ok());
  EXPECT_EQ(write_text(folder.path("a.json"), "[]", false).code(), StatusCode::output_failed);
  EXPECT_EQ(contents(folder.path("a.json")), "{}");
  ASSERT_TRUE(write_text(folder.path("a.json"), "[]", true).ok());
  EXPECT_EQ(contents(folder.path("a.json")), "[]");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.json"});
}

}  // namespace
}  // namespace umbrix::io
