// SPDX-License-Identifier: Apache-2.0
#include "io/load_error.h"

#include <algorithm>
#include <cstdint>

namespace umbrix::io::detail {
namespace {

// Control characters, and those that turn the direction or the line of the text after them (Unicode 15, section 23).
bool is_control(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x061C || c == 0x200E || c == 0x200F ||
         (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

// The bytes of the first character if it may be shown; 0 if it may not, or is not UTF-8 (RFC 3629).
std::size_t shown_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t bytes = first < 0x80   ? 1
                            : first < 0xC2 ? 0
                            : first < 0xE0 ? 2
                            : first < 0xF0 ? 3
                            : first < 0xF5 ? 4
                                           : 0;
  if (bytes == 0 || text.size() < bytes) return 0;
  std::uint32_t c = bytes == 1 ? first : first & (0x7Fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    c = c << 6 | (byte(i) & 0x3F);
  }
  const bool overlong = (bytes == 3 && c < 0x800) || (bytes == 4 && c < 0x10000);
  const bool valid = !overlong && c <= 0x10FFFF && !(c >= 0xD800 && c < 0xE000);
  return valid && !is_control(c) ? bytes : 0;
}

}  // namespace

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  while (!text.empty()) {
    if (out.size() >= limit) return out + "...";
    const std::size_t shown = shown_bytes(text);
    if (shown > 0) {
      out += text.substr(0, shown);
    } else {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text.front()));
    }
    text.remove_prefix(std::max<std::size_t>(shown, 1));
  }
  return out;
}

Status out_of_memory(const std::string& path) noexcept try {
  return {StatusCode::resource_limit, printable(path) + ": not enough memory"};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("not enough memory for a file");
}

std::string one_line(std::string_view text) {
  constexpr std::size_t kLongest = 240;
  return printable(text.substr(0, text.find_first_of("\r\n")), kLongest);
}

}  // namespace umbrix::io::detail
