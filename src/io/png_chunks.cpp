// SPDX-License-Identifier: Apache-2.0
// After "Portable Network Graphics" (W3C 2003), 5.2 and 5.3: a signature of 8 bytes, then chunks of a length (big
// endian), a type, data and a checksum.
#include "io/png_chunks.h"

#include <string_view>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr std::uint64_t kSignatureBytes = 8, kHeadBytes = 8, kChecksumBytes = 4;
// What is compressed in one may be a thousand times as long.
constexpr std::uint64_t kLongestCompressedText = 1u << 16;

std::uint64_t big_endian(const unsigned char* bytes) {
  return std::uint64_t{bytes[0]} << 24 | std::uint64_t{bytes[1]} << 16 | std::uint64_t{bytes[2]} << 8 | bytes[3];
}

}  // namespace

void check_png_chunks(const std::vector<unsigned char>& start, std::uint64_t file_bytes, bool whole) {
  std::uint64_t at = kSignatureBytes;
  while (at + kHeadBytes <= start.size()) {
    const std::uint64_t length = big_endian(&start[at]);
    const std::string_view type(reinterpret_cast<const char*>(&start[at + 4]), 4);
    if (type == "IEND") return;
    if ((whole || type != "IDAT") && length + kHeadBytes + kChecksumBytes > file_bytes - at)
      bad_input("the PNG file has a chunk of {} bytes at byte {}, and ends before", length, at);
    if ((type == "zTXt" || type == "iTXt") && length > kLongestCompressedText)
      over_limit("the PNG file has a text of {} bytes, the limit is {}", length, kLongestCompressedText);
    at += kHeadBytes + length + kChecksumBytes;
  }
  if (whole) bad_input("the PNG file ends after {} bytes, before its end is told", file_bytes);
}

}  // namespace umbrix::io::detail
