// SPDX-License-Identifier: Apache-2.0
// "Portable Network Graphics" (W3C 2003), with data that is stored, not compressed (RFC 1950 and 1951).
#include "picture_bytes.h"

namespace umbrix::io::testing {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 255);
  return out;
}

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
  }
  return ~crc;
}

std::uint32_t adler32(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(crc32(type + data));
}

std::string stored(const std::string& data) {
  constexpr std::size_t kMost = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < data.size(); at += kMost) {
    const std::string block = data.substr(at, kMost);
    out += static_cast<char>(at + kMost >= data.size());
    for (const std::size_t length : {block.size(), ~block.size()}) {
      out += static_cast<char>(length & 255);
      out += static_cast<char>(length >> 8 & 255);
    }
    out += block;
  }
  return out + big_endian(adler32(data));
}

std::string png_head(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
  const char types[] = {0, 4, 2, 6};
  std::string header = big_endian(width) + big_endian(height);
  header += {8, types[channels - 1], 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header);
}

std::string png_of(const std::string& head, const std::string& rows) {
  return head + chunk("IDAT", stored(rows)) + chunk("IEND", "");
}

}  // namespace

std::string png_without_pixels(std::uint32_t width, std::uint32_t height, std::uint32_t channels) {
  return png_of(png_head(width, height, channels), "");
}

std::string png_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                      const std::vector<std::uint8_t>& pixels) {
  std::string rows;
  const std::size_t row_bytes = std::size_t{width} * channels;
  for (std::size_t y = 0; y < height; ++y) {
    rows += '\0';
    rows.append(reinterpret_cast<const char*>(pixels.data()) + y * row_bytes, row_bytes);
  }
  return png_of(png_head(width, height, channels), rows);
}

const char* const kGreyJpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"
    "FRUVDA8XGBYUGBIUFRT/wAALCAAIAAgBAREA/8QAHwAAAQUBAQEBAQEAAAAAAAAAAAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUF"
    "BAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAkM2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVW"
    "V1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKTlJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi"
    "4+Tl5ufo6erx8vP09fb3+Pn6/9oACAEBAAA/APqCv//Z";

}  // namespace umbrix::io::testing
