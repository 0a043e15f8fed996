// SPDX-License-Identifier: Apache-2.0
#include "output_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

namespace umbrix::app {
namespace {

/// A part of a path that stands for a number.
struct Place {
  std::size_t begin = 0, length = 0;
  int digits = 0;
};

/// The length of the "%d" or "%04d" at `at`; 0 if there is none.
std::size_t printf_length(const std::string& path, std::size_t at) {
  if (path.compare(at, 2, "%d") == 0) return 2;
  const bool padded = path.compare(at, 2, "%0") == 0 && at + 3 < path.size() && path[at + 2] >= '1' &&
                      path[at + 2] <= '9' && path[at + 3] == 'd';
  return padded ? 4 : 0;
}

std::vector<Place> find_places(const std::string& path) {
  std::vector<Place> places;
  const std::size_t slash = path.find_last_of('/');
  std::size_t at = slash == std::string::npos ? 0 : slash + 1;
  while (at < path.size()) {
    const std::size_t hashes = std::min(path.find_first_not_of('#', at), path.size()) - at;
    const std::size_t printf = printf_length(path, at);
    if (hashes > 0) places.push_back({at, hashes, static_cast<int>(hashes)});
    if (printf > 0) places.push_back({at, printf, printf == 4 ? path[at + 2] - '0' : 1});
    at += std::max({hashes, printf, std::size_t{1}});
  }
  return places;
}

}  // namespace

std::size_t frame_places(const std::string& path) { return find_places(path).size(); }

std::string path_of_frame(const std::string& path, int frame) {
  std::string out;
  std::size_t copied = 0;
  for (const Place& place : find_places(path)) {
    out += path.substr(copied, place.begin - copied) + fmt::format("{:0{}}", frame, place.digits);
    copied = place.begin + place.length;
  }
  return out + path.substr(copied);
}

bool has_extension(const std::string& path, const std::string& extension) {
  std::string own = std::filesystem::path(path).extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return own == extension;
}

}  // namespace umbrix::app
