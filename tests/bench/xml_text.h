// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace umbrix::plot {

/// How often a part is in a text.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// Whether every element is closed in its order and no '&' or '<' stands alone: what makes XML of this text.
inline testing::AssertionResult well_formed(const std::string& text) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '&' && text.compare(at, 4, "&lt;") != 0 && text.compare(at, 4, "&gt;") != 0 &&
        text.compare(at, 5, "&amp;") != 0 && text.compare(at, 6, "&quot;") != 0) {
      return testing::AssertionFailure() << "a bare & at " << at;
    }
    if (text[at] != '<') continue;
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos || text.find('<', at + 1) < end) {
      return testing::AssertionFailure() << "a bare < at " << at;
    }
    const std::string tag = text.substr(at + 1, end - at - 1);
    if (count_of(tag, "\"") % 2 != 0) return testing::AssertionFailure() << "quotes of " << tag;
    at = end;
    if (tag.front() == '?' || tag.back() == '/') continue;
    const std::string name = tag.substr(0, tag.find(' '));
    if (name.front() != '/') {
      open.push_back(name);
    } else if (open.empty() || "/" + open.back() != name) {
      return testing::AssertionFailure() << name << " closes nothing";
    } else {
      open.pop_back();
    }
  }
  return open.empty() ? testing::AssertionSuccess() : testing::AssertionFailure() << open.back() << " stays open";
}

}  // namespace umbrix::plot
