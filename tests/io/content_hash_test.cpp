// SPDX-License-Identifier: Apache-2.0
// Hashes of files and checksums of images: equal for equal content, different for any change.
#include "umbrix/io/content_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gltf_text.h"
#include "umbrix/io/image_file.h"

namespace umbrix::io {
namespace {

using testing::TempFolder;

TEST(ContentHash, IsXxh3OfAllBytes) {
  // Of no bytes: the first test vector of xxHash's own sanity check (XSUM_XXH3_128_withSeed, length 0, seed 0).
  EXPECT_EQ(content_hash(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(content_hash("a"), content_hash("b"));
  EXPECT_NE(content_hash(std::string(1, '\0')), content_hash(""));
}

TEST(ContentHash, OfAFileIsThatOfItsBytes) {
  const TempFolder folder;
  // Longer than what is read at a time.
  std::string text(3'000'001, 'x');
  for (std::size_t i = 0; i < text.size(); i += 997) text[i] = static_cast<char>(i);
  ASSERT_TRUE(write_text(folder.path("a"), text, false).ok());
  std::string hash, back;
  ASSERT_TRUE(hash_file(folder.path("a"), hash).ok());
  EXPECT_EQ(hash, content_hash(text));
  ASSERT_TRUE(read_text(folder.path("a"), text.size(), back).ok());
  EXPECT_TRUE(back == text);
  const Status long_file = read_text(folder.path("a"), text.size() - 1, back);
  EXPECT_EQ(long_file.code(), StatusCode::resource_limit);
  EXPECT_TRUE(back.empty());
}

TEST(ContentHash, WhatCannotBeReadIsNamed) {
  const TempFolder folder;
  std::string out = "before";
  for (const std::string& path : {folder.path("absent"), folder.path("")}) {
    for (const Status& status : {hash_file(path, out), read_text(path, 100, out)}) {
      EXPECT_EQ(status.code(), StatusCode::bad_input);
      EXPECT_NE(status.message().find(path), std::string::npos) << status.message();
      EXPECT_EQ(out, "");
    }
  }
}

Image picture() {
  Image image;
  image.width = 3;
  image.height = 2;
  image.x = 4;
  image.y = 5;
  image.frame_width = 20;
  image.frame_height = 10;
  image.channels = {"R", "G", "B", "depth.Z"};
  for (int i = 0; i < 24; ++i) image.pixels.push_back(0.1f + static_cast<float>(i) / 7);
  image.pixels[5] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[8] = 1e9f;  // beyond halves
  image.metadata = {{"umbrix:job", "1"}, {"umbrix:frame", "3"}};
  image.matrices = {{"worldToCamera", std::vector<float>(16, 0.3f)}};
  return image;
}

std::string checksum_in(const Image& image) {
  for (const auto& [name, value] : image.metadata) {
    if (name == "umbrix:checksum") return value;
  }
  return "";
}

TEST(ImageChecksum, OfAnExrIsInIt) {
  for (const PixelType type : {PixelType::half, PixelType::single}) {
    const TempFolder folder;
    WriteOptions options;
    options.pixel_type = type;
    ASSERT_TRUE(write_image(folder.path("a.exr"), picture(), options).ok());
    Image back;
    ASSERT_TRUE(read_image(folder.path("a.exr"), back).ok());
    EXPECT_EQ(back.pixel_type, type);
    EXPECT_EQ(checksum_in(back), image_checksum(back));
    // Written again it is the same file, so the checksum is of what the file holds.
    ASSERT_TRUE(write_image(folder.path("b.exr"), back, options).ok());
    Image again;
    ASSERT_TRUE(read_image(folder.path("b.exr"), again).ok());
    EXPECT_EQ(checksum_in(again), checksum_in(back));
  }
}

TEST(ImageChecksum, ChangesWithEverything) {
  const std::string before = image_checksum(picture());
  const auto changed = [&](auto change) {
    Image image = picture();
    change(image);
    return image_checksum(image) != before;
  };
  for (std::size_t i = 0; i < picture().pixels.size(); ++i) {
    EXPECT_TRUE(changed([&](Image& image) { image.pixels[i] = std::isnan(image.pixels[i]) ? 0 : -image.pixels[i]; }))
        << i;
  }
  EXPECT_TRUE(changed([](Image& image) { image.x = 3; }));
  EXPECT_TRUE(changed([](Image& image) { image.frame_height = 11; }));
  EXPECT_TRUE(changed([](Image& image) { image.channels[3] = "depth"; }));
  EXPECT_TRUE(changed([](Image& image) { image.metadata[0].second = "2"; }));
  EXPECT_TRUE(changed([](Image& image) { image.metadata.pop_back(); }));
  EXPECT_TRUE(changed([](Image& image) { image.matrices[0].second[15] = 1; }));
  EXPECT_FALSE(changed([](Image& image) { image.metadata.emplace_back("DateTime", "now"); }));
}

TEST(ImageWindow, OfAPartOfAFrameIsKeptByExr) {
  const TempFolder folder;
  ASSERT_TRUE(write_image(folder.path("a.exr"), picture(), {}).ok());
  Image back;
  ASSERT_TRUE(read_image(folder.path("a.exr"), back).ok());
  EXPECT_EQ(back.width, 3);
  EXPECT_EQ(back.height, 2);
  EXPECT_EQ(back.x, 4);
  EXPECT_EQ(back.y, 5);
  EXPECT_EQ(back.frame_width, 20);
  EXPECT_EQ(back.frame_height, 10);
  EXPECT_EQ(back.pixels[3], picture().pixels[3]) << "a depth, which is a float";
}

}  // namespace
}  // namespace umbrix::io
