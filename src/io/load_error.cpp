// SPDX-License-Identifier: Apache-2.0
#include "io/load_error.h"

namespace umbrix::io::detail {

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  for (const char c : text) {
    if (out.size() >= limit) return out + "...";
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      out += fmt::format("\\x{:02x}", byte);
    } else {
      out += c;
    }
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
