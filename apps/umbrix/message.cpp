// SPDX-License-Identifier: Apache-2.0
#include "message.h"

#include <fmt/format.h>

#include <cstdio>

namespace umbrix::app {

std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return text;
}

// fputs, not fmt::print: a closed stderr must not end the program with an exception.
void say(const std::string& text) {
  std::fputs((printable(text) + '\n').c_str(), stderr);
  std::fflush(stderr);
}

void say_error(const std::string& text) { say(fmt::format("umbrix: {}", text)); }

void say_warning(const std::string& text) { say(fmt::format("umbrix: warning: {}", text)); }

}  // namespace umbrix::app
