// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "umbrix/status.h"

namespace umbrix::io::detail {

/// Thrown inside a loader, caught at its public function, which adds the file's name. Parsing has a hundred places
/// that can fail; this keeps them readable.
struct LoadError {
  StatusCode code;
  std::string what;
};

template <class... Args>
[[noreturn]] void bad_input(fmt::format_string<Args...> format, Args&&... args) {
  throw LoadError{StatusCode::bad_input, fmt::format(format, std::forward<Args>(args)...)};
}

template <class... Args>
[[noreturn]] void over_limit(fmt::format_string<Args...> format, Args&&... args) {
  throw LoadError{StatusCode::resource_limit, fmt::format(format, std::forward<Args>(args)...)};
}

/// A name from a file or user, fit for a terminal: control characters, and bytes that are not UTF-8, as \xNN; about
/// `limit` bytes long at most.
std::string printable(std::string_view text, std::size_t limit = 256);

/// resource_limit for a file, if there is memory to name it. Does not throw.
Status out_of_memory(const std::string& path) noexcept;

/// The first line of a library's message, made printable and cut, so that data in it cannot flood the terminal.
std::string one_line(std::string_view text);

}  // namespace umbrix::io::detail
