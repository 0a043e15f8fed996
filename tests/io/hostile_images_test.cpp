// SPDX-License-Identifier: Apache-2.0
// Images that claim what they have not: refused by their headers, before decoders ask for memory.

#include <gtest/gtest.h>
#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
#endif

#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "gltf_text.h"
#include "umbrix/io/image_file.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::TempFolder;

std::string written_image(const TempFolder& folder, const std::string& name) {
  Image image;
  image.width = 5;
  image.height = 3;
  image.channels = {"R", "G", "B"};
  image.pixels.assign(45, 0.5f);
  image.metadata = {{"umbrix:job", "seven"}};
  EXPECT_TRUE(write_image(folder.path(name), image, {}).ok());
  std::ifstream file(folder.path(name), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
std::string raw(T value) {
  return bytes_of(std::vector<T>{value});
}

// Puts `value` at an offset after the attribute's name, type and size.
void patch(std::string& exr, const std::string& name_and_type, std::size_t offset, const std::string& value) {
  const std::size_t at = exr.find(name_and_type);
  ASSERT_NE(at, std::string::npos);
  exr.replace(at + name_and_type.size() + offset, value.size(), value);
}

Status read(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  Image image;
  const Status status = read_image(folder.write(name, bytes), image);
  EXPECT_EQ(status.ok(), !image.pixels.empty());
  EXPECT_EQ(status.message().find('\n'), std::string::npos);
  return status;
}

TEST(HostileImages, OpenExrHeadersThatLie) {
  const TempFolder folder;
  const std::string good = written_image(folder, "good.exr");
  const std::string window("dataWindow\0box2i\0", 17), text("umbrix:job\0string\0", 18);
  struct Lie {
    const char* name;
    std::function<void(std::string&)> tell;
    StatusCode code;
    const char* said;
  };
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  const Lie lies[] = {
      {"wide", [&](auto& exr) { patch(exr, window, 4 + 8, raw(kMost)); }, StatusCode::resource_limit, "2147483648 x 3"},
      {"high", [&](auto& exr) { patch(exr, window, 4 + 12, raw(kMost)); }, StatusCode::resource_limit,
       "5 x 2147483648"},
      {"over_the_whole_range",
       [&](auto& exr) {
         patch(exr, window, 4, raw(std::numeric_limits<std::int32_t>::min()));
         patch(exr, window, 4 + 8, raw(kMost));
       },
       StatusCode::resource_limit, "4294967296 x 3"},
      {"more_rows_than_the_file_can_hold", [&](auto& exr) { patch(exr, window, 4 + 12, raw(130000)); },
       StatusCode::bad_input, "too short"},
      {"inside_out", [&](auto& exr) { patch(exr, window, 4 + 8, raw(-1)); }, StatusCode::bad_input, "empty"},
      {"text_of_2_gigabytes", [&](auto& exr) { patch(exr, text, 0, raw(kMost)); }, StatusCode::bad_input, "cut off"},
      {"text_of_less_than_nothing", [&](auto& exr) { patch(exr, text, 0, raw(-1)); }, StatusCode::bad_input,
       "-1 bytes"},
      {"two_windows",
       [&](auto& exr) { exr.insert(exr.find(window), exr.substr(exr.find(window), window.size() + 4 + 16)); },
       StatusCode::bad_input, "twice: 'dataWindow'"},
  };
  for (const Lie& lie : lies) {
    SCOPED_TRACE(lie.name);
    std::string exr = good;
    lie.tell(exr);
    const Status status = read(folder, "lie.exr", exr);
    EXPECT_EQ(status.code(), lie.code) << status.message();
    EXPECT_NE(status.message().find("lie.exr"), std::string::npos) << status.message();
    EXPECT_NE(status.message().find(lie.said), std::string::npos) << status.message();
  }
}

TEST(HostileImages, PngChunksThatLie) {
  const TempFolder folder;
  const std::string good = written_image(folder, "good.png");
  const std::size_t text = good.find("tEXt");
  ASSERT_NE(text, std::string::npos);
  std::string longer_than_the_file = good;
  longer_than_the_file.replace(text - 4, 4, std::string("\x61\x70\x00\x15", 4));
  const Status status = read(folder, "lie.png", longer_than_the_file);
  EXPECT_EQ(status.code(), StatusCode::bad_input) << status.message();
  EXPECT_NE(status.message().find("1634730005 bytes"), std::string::npos) << status.message();

  const std::string chunk = std::string("\x00\x02\x00\x00zTXt", 8) + std::string((1u << 17) + 4, 'x');
  const Status packed = read(folder, "lie.png", std::string(good).insert(text - 4, chunk));
  EXPECT_EQ(packed.code(), StatusCode::resource_limit) << packed.message();
}

TEST(HostileImages, CutAnywhere) {
#if defined(__SANITIZE_ADDRESS__)
  // libpng leaves OpenImageIO 2.4's reader by a jump, past destructors (docs/fuzzing.md).
  const __lsan::ScopedDisabler no_leaks;
#endif
  const TempFolder folder;
  for (const char* name : {"cut.exr", "cut.png"}) {
    const std::string good = written_image(folder, name);
    for (std::size_t length = 0; length < good.size(); ++length) {
      // Decoders may show a picture whose end is missing; it is then of its full size.
      const Status status = read(folder, name, good.substr(0, length));
      EXPECT_TRUE(status.ok() || status.code() == StatusCode::bad_input) << length << ": " << status.message();
    }
  }
}

// 30000 x 30000 pixels, said by a PNG of 60 bytes.
TEST(HostileImages, AnImageManyTimesLargerThanItsFile) {
  const TempFolder folder;
  std::string png = written_image(folder, "good.png");
  const std::string header("\x00\x00\x75\x30\x00\x00\x75\x30\x08\x02\x00\x00\x00", 13);
  png.replace(16, header.size(), header);
  png.replace(29, 4, std::string("\xE9\x45\x6F\xED", 4));  // the CRC of the new header
  const Status status = read(folder, "bomb.png", png);
  EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
  EXPECT_NE(status.message().find("30000 x 30000"), std::string::npos) << status.message();
}

// OpenImageIO would try all its formats on any file; fewer decoders, fewer faults.
TEST(HostileImages, OtherFormatsAreNotTried) {
  const TempFolder folder;
  for (const std::string& bytes : {std::string("P6 1 1 255 abc"), std::string("GIF89a"), std::string("II*\0", 4),
                                   std::string("BM"), std::string(1000, '\0'), std::string("v")}) {
    for (const char* name : {"other.exr", "other.png", "other.tif"}) {
      const Status status = read(folder, name, bytes);
      EXPECT_EQ(status.code(), StatusCode::bad_input);
      EXPECT_NE(status.message().find("neither OpenEXR"), std::string::npos) << status.message();
    }
  }
}

}  // namespace
}  // namespace umbrix::io
