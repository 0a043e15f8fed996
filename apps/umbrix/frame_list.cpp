// SPDX-License-Identifier: Apache-2.0
#include "frame_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

namespace umbrix::app {
namespace {

constexpr int kLargest = 999999;
/// More than an hour of film; a list that long has a slip in it, or is better rendered in parts.
constexpr std::size_t kMostFrames = 100000;

/// Numbers from `first` to `last`, `step` apart.
struct Range {
  int first = 0, last = 0, step = 1;
};

/// Takes a number off the front.
bool take_number(std::string_view& text, int low, int& out) {
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || out < low || out > kLargest) return false;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return true;
}

/// Takes one of `characters` off the front.
bool take_one_of(std::string_view& text, std::string_view characters) {
  if (text.empty() || characters.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// "A", "A-B", "A-B:S" or "A-BxS".
bool parse_range(std::string_view text, Range& range) {
  if (!take_number(text, -kLargest, range.first)) return false;
  range.last = range.first;
  if (text.empty()) return true;
  if (!take_one_of(text, "-") || !take_number(text, -kLargest, range.last)) return false;
  if (text.empty()) return true;
  return take_one_of(text, ":x") && take_number(text, 1, range.step) && text.empty();
}

Status wrong(const std::string& message) { return {StatusCode::invalid_argument, message}; }

}  // namespace

Status parse_frames(const std::string& text, std::vector<int>& out) {
  out.clear();
  std::set<int> seen;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    begin = end + 1;
    Range range;
    if (!parse_range(part, range)) {
      return wrong(
          fmt::format("'{}' is not of the form 1-3,5,7-20:2 with numbers from {} to {}", part, -kLargest, kLargest));
    }
    if (range.last < range.first) return wrong(fmt::format("'{}' ends before it begins", part));
    for (int frame = range.first; frame <= range.last; frame += range.step) {
      if (seen.insert(frame).second) out.push_back(frame);
      if (out.size() > kMostFrames) return wrong(fmt::format("more than {} frames in one run", kMostFrames));
    }
  }
  return {};
}

}  // namespace umbrix::app
