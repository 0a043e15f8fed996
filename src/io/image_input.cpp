// SPDX-License-Identifier: Apache-2.0
#include "io/image_input.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "io/exr_header.h"
#include "io/input_file.h"
#include "io/jpeg_scans.h"
#include "io/load_error.h"
#include "io/png_chunks.h"

namespace umbrix::io::detail {
namespace {

using namespace std::string_view_literals;

struct Format {
  std::string_view magic;
  const char* reader;  // OpenImageIO's name
};

constexpr Format kPng = {"\x89PNG\r\n\x1a\n"sv, "png"};
constexpr Format kFormats[] = {{"\x76\x2f\x31\x01"sv, "openexr"}, kPng, {"#?RADIANCE"sv, "hdr"}, {"#?RGBE"sv, "hdr"}};
constexpr Format kTextureFormats[] = {kPng, {"\xff\xd8\xff"sv, "jpeg"}};

// The largest image, and how much larger it may be than its file beyond a size that does no harm. The best of the
// codecs, deflate, makes at most 1032 bytes of one; PNG's bytes become floats.
constexpr std::uint64_t kMostFloats = 1ull << 31;
constexpr std::uint64_t kHarmlessFloats = 1ull << 24;
constexpr std::uint64_t kMostFloatsPerByte = 1032;

template <std::size_t N>
std::string_view find_reader(const Format (&formats)[N], const std::vector<unsigned char>& start,
                             const char* otherwise) {
  const std::string_view text(reinterpret_cast<const char*>(start.data()), start.size());
  for (const Format& format : formats) {
    if (text.substr(0, format.magic.size()) == format.magic) return format.reader;
  }
  bad_input("is {}", otherwise);
}

void check_size(const OIIO::ImageSpec& spec, std::uint64_t file_bytes) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) bad_input("the image is empty");
  const auto pixels = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  const auto channels = static_cast<std::uint64_t>(spec.nchannels);
  const bool too_large = pixels > kMostFloats / channels;
  const bool bomb = pixels * channels > kHarmlessFloats && pixels * channels / kMostFloatsPerByte > file_bytes;
  if (too_large || bomb) {
    over_limit("the image is too large: {} x {} with {} channels in {} bytes", spec.width, spec.height, channels,
               file_bytes);
  }
}

}  // namespace

std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path) {
  std::uint64_t file_bytes = 0;
  const std::vector<unsigned char> start = read_start(path, kExrHeaderBytes, file_bytes);
  const std::string_view reader = find_reader(kFormats, start, "neither OpenEXR nor PNG nor Radiance HDR");
  if (reader == "openexr") check_exr_header(start, file_bytes);
  if (reader == "png") check_png_chunks(start, file_bytes);
  auto input = OIIO::ImageInput::create(reader.data());
  if (!input) bad_input("{}", one_line(OIIO::geterror()));
  OIIO::ImageSpec spec;
  if (!input->open(path, spec)) bad_input("{}", one_line(input->geterror()));
  check_size(spec, file_bytes);
  return input;
}

EncodedImage::EncodedImage(const std::vector<unsigned char>& bytes, std::uint64_t most_pixels) {
  const std::string_view reader = find_reader(kTextureFormats, bytes, "neither PNG nor JPEG");
  if (reader == "png") check_png_chunks(bytes, bytes.size(), true);
  if (reader == "jpeg") check_jpeg_scans(bytes);
  memory = std::make_unique<OIIO::Filesystem::IOMemReader>(const_cast<unsigned char*>(bytes.data()), bytes.size());
  input = OIIO::ImageInput::create(reader.data());
  if (!input) bad_input("{}", one_line(OIIO::geterror()));
  input->set_ioproxy(memory.get());
  OIIO::ImageSpec wishes, spec;
  wishes["oiio:UnassociatedAlpha"] = 1;
  if (!input->open(reader.data(), spec, wishes)) bad_input("{}", one_line(input->geterror()));
  check_size(spec, bytes.size());
  if (static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) > most_pixels) {
    over_limit("the image has {} x {} pixels, the limit is {}", spec.width, spec.height, most_pixels);
  }
  if (spec.nchannels > 4) bad_input("the image has {} channels", spec.nchannels);
}

}  // namespace umbrix::io::detail
