// SPDX-License-Identifier: Apache-2.0
// After "OpenEXR File Layout" (openexr.com): magic, version, then headers of attributes (name, type, size, value), each
// ended by a zero byte; several headers, ended by one more, if the version says so.

#include "io/exr_header.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <string>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr std::uint32_t kMultiPart = 0x1000;
constexpr std::uint64_t kLongestName = 255;
constexpr std::int64_t kLongestSide = 1 << 17;
constexpr std::uint64_t kMostBufferBytes = 1u << 29;
constexpr std::uint64_t kMostTilePixels = 1u << 22;
constexpr std::uint64_t kTableEntryBytes = 8;

// What of a header decides how much memory OpenEXR asks for.
struct Header {
  std::int64_t width = 0, height = 0;
  std::uint64_t channels = 0;
  std::uint64_t tile_width = 0, tile_height = 0;  // 0: rows
  unsigned compression = 0;
};

// Rows that are compressed together, by the number that the file has for the method.
std::uint64_t rows_of_chunk(unsigned compression) {
  constexpr std::uint64_t kRows[] = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
  return compression < std::size(kRows) ? kRows[compression] : 256;
}

class Reader {
 public:
  Reader(const std::vector<unsigned char>& bytes, std::uint64_t file_bytes) : bytes_(bytes), file_bytes_(file_bytes) {}

  void skip(std::uint64_t count) {
    need(count);
    at_ += count;
  }

  template <class T>
  T number(std::uint64_t offset = 0) const {
    need(offset + sizeof(T));
    T value;
    std::memcpy(&value, &bytes_[at_ + offset], sizeof value);
    return value;
  }

  // Up to the zero byte, which is taken as well.
  std::string text() {
    std::string out;
    for (; number<char>() != 0; ++at_) {
      if (out.size() == kLongestName) bad_input("the OpenEXR header has a name longer than {} bytes", kLongestName);
      out += number<char>();
    }
    ++at_;
    return out;
  }

 private:
  void need(std::uint64_t count) const {
    if (count <= bytes_.size() - at_) return;
    if (count > file_bytes_ - at_) bad_input("the OpenEXR header is cut off, or says more than the file has");
    over_limit("the OpenEXR header is larger than {} bytes", bytes_.size());
  }

  const std::vector<unsigned char>& bytes_;
  std::uint64_t file_bytes_;
  std::uint64_t at_ = 0;
};

// "name\0", then 16 bytes, for each channel; a zero byte at the end.
std::uint64_t count_channels(Reader reader) {
  std::uint64_t count = 0;
  while (!reader.text().empty()) {
    reader.skip(16);
    ++count;
  }
  return count;
}

void read_attribute(const std::string& name, std::uint64_t size, const Reader& value, Header& header) {
  if (name == "channels") header.channels = count_channels(value);
  if (name == "compression" && size >= 1) header.compression = value.number<unsigned char>();
  if (name == "tiles" && size >= 8) {
    header.tile_width = value.number<std::uint32_t>();
    header.tile_height = value.number<std::uint32_t>(4);
  }
  if (name != "dataWindow" || size < 16) return;
  header.width = std::int64_t{value.number<std::int32_t>(8)} - value.number<std::int32_t>(0) + 1;
  header.height = std::int64_t{value.number<std::int32_t>(12)} - value.number<std::int32_t>(4) + 1;
}

// False at the empty header that ends those of several parts.
bool read_header(Reader& reader, Header& header) {
  std::set<std::string> names;
  for (std::string name = reader.text(); !name.empty(); name = reader.text()) {
    // Which of two OpenEXR goes by, no one says.
    if (!names.insert(name).second) bad_input("the OpenEXR header has an attribute twice: '{}'", name);
    reader.text();  // the type
    const auto size = reader.number<std::int32_t>();
    if (size < 0) bad_input("the OpenEXR header has an attribute of {} bytes", size);
    reader.skip(4);
    Reader value = reader;
    reader.skip(static_cast<std::uint64_t>(size));
    read_attribute(name, static_cast<std::uint64_t>(size), value, header);
  }
  return !names.empty();
}

std::uint64_t parts(std::uint64_t whole, std::uint64_t part) { return (whole + part - 1) / part; }

void check_header(const Header& header, std::uint64_t file_bytes) {
  if (header.width <= 0 || header.height <= 0) bad_input("the OpenEXR header's data window is empty");
  if (header.width > kLongestSide || header.height > kLongestSide) {
    over_limit("the image is too large: {} x {}, the limit is {} a side", header.width, header.height, kLongestSide);
  }
  const auto width = static_cast<std::uint64_t>(header.width), height = static_cast<std::uint64_t>(header.height);
  const bool tiled = header.tile_width > 0 && header.tile_height > 0;
  const std::uint64_t rows = rows_of_chunk(header.compression);
  const std::uint64_t chunks =
      tiled ? parts(width, header.tile_width) * parts(height, header.tile_height) : parts(height, rows);
  if (chunks > file_bytes / kTableEntryBytes) bad_input("the file is too short for an image of {} x {}", width, height);
  if (tiled && header.tile_width * header.tile_height > std::max(kMostTilePixels, 4 * width * height)) {
    over_limit("tiles of {} x {} are too large", header.tile_width, header.tile_height);
  }
  const std::uint64_t buffer_pixels = tiled ? header.tile_width * header.tile_height : width * rows;
  if (header.channels * sizeof(float) > kMostBufferBytes / buffer_pixels) {
    over_limit("the image is too large: {} channels, {} pixels at a time", header.channels, buffer_pixels);
  }
}

}  // namespace

void check_exr_header(const std::vector<unsigned char>& start, std::uint64_t file_bytes) {
  Reader reader(start, file_bytes);
  const bool several = (reader.number<std::uint32_t>(4) & kMultiPart) != 0;
  reader.skip(8);
  for (;;) {
    Header header;
    if (!read_header(reader, header)) {
      if (!several) bad_input("the OpenEXR header is empty");
      return;
    }
    check_header(header, file_bytes);
    if (!several) return;
  }
}

bool has_all_exr_rows(const std::vector<unsigned char>& start, std::uint64_t file_bytes) {
  Reader reader(start, file_bytes);
  reader.skip(8);
  Header header;
  read_header(reader, header);
  check_header(header, file_bytes);
  const std::uint64_t chunks = parts(static_cast<std::uint64_t>(header.height), rows_of_chunk(header.compression));
  for (std::uint64_t i = 0; i < chunks; ++i) {
    const auto offset = reader.number<std::uint64_t>();
    if (offset == 0 || offset >= file_bytes) return false;
    reader.skip(sizeof offset);
  }
  return true;
}

}  // namespace umbrix::io::detail
