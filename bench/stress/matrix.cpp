// SPDX-License-Identifier: Apache-2.0
#include "stress/matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

namespace umbrix::bench {
namespace {

bool to_number(const std::string& text, int& out) {
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, out);
  return error == std::errc() && parsed == end;
}

// Marks what "7", "5-9" or a name means; false if that is nothing.
bool mark(const std::string& word, std::vector<bool>& chosen) {
  const std::vector<MatrixRow>& rows = stress_matrix();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (word != rows[i].name) continue;
    chosen[i] = true;
    return true;
  }
  const std::size_t dash = word.find('-');
  int first = 0, last = 0;
  if (!to_number(word.substr(0, dash), first)) return false;
  last = first;
  if (dash != std::string::npos && !to_number(word.substr(dash + 1), last)) return false;
  const auto count = static_cast<int>(rows.size());
  if (first < 1 || last > count || first > last) return false;
  std::fill(chosen.begin() + first - 1, chosen.begin() + last, true);
  return true;
}

}  // namespace

const std::vector<MatrixRow>& stress_matrix() {
  static const std::vector<MatrixRow> rows = {
      {1, "closed-interior", "closed meshes from inside: always occluded"},
      {2, "closed-vertices", "the same at vertices"},
      {3, "closed-edges", "the same at midpoints and points of edges"},
      {4, "silhouettes", "past outlines: as exact arithmetic"},
      {5, "grazing", "1e-7 to 1 radians to a plane: as exact arithmetic"},
      {6, "axis-parallel", "one or two zeros, signed: as exact arithmetic"},
      {7, "split-planes", "within planes of the tree: as exact arithmetic"},
      {8, "cell-corners", "through corners and edges of cells: as exact arithmetic"},
      {9, "origins", "from planes, corners, vertices: as exact arithmetic; moved off, no acne and no leak"},
      {10, "degenerate", "half of the triangles without area: as exact arithmetic"},
      {11, "duplicates", "2 to 1000 copies: as one"},
      {12, "slivers", "aspect 1e2 to 1e7: as exact arithmetic"},
      {13, "powers-of-two", "1e-18 to 1e18: the answers of scale 1"},
      {14, "scales", "the same, rounded: as exact arithmetic"},
      {15, "translated", "1e2 to 1e6 sizes away: as exact arithmetic"},
      {16, "mixed-scale", "ratio 1e6: as exact arithmetic"},
      {17, "bad-vertices", "NaN, infinite, denormal: the rest is right"},
      {18, "bad-rays", "NaN, infinite, zero, denormal: the others are right"},
      {19, "garbage", "random bits: refused or right", check_garbage, 1e5},
      {20, "tiny", "no triangle, one, two: as exact arithmetic"},
      {21, "pile-ups", "1e6 coincident, through one vertex, on one edge: as exact arithmetic"},
      {22, "deep-trees", "sizes 2^-k, Cantor dust: as exact arithmetic"},
      {23, "flat", "all in one plane: as exact arithmetic"},
      {24, "lights", "inside, on faces, edges, vertices, planes, far: as exact arithmetic"},
      {25, "no-distance", "light at the point or 1 ulp off: as exact arithmetic"},
      {26, "acne", "in front of convex meshes: none occluded"},
      {27, "thin-walls", "from within walls of 4 offsets: all occluded"},
      {28, "soups", "1e6 and 1e7 triangles: as exact arithmetic"},
      {29, "metamorphic", "permuted, flipped, mirrored, swapped, reversed, split: the same answers"},
      {30, "links", "links visit the leaves of the stack walk", check_leaf_walks, 1e6},
      {31, "threads", "1 to 64 threads, tables growing: the same hash", check_threads, 1e7},
      {32, "host-modes", "flushed denormals, directed rounding: as exact arithmetic"},
      {33, "instances", "instances as meshes of placed vertices, to the last bit", check_instances, 1e6},
  };
  return rows;
}

Status choose_rows(const std::string& list, std::vector<MatrixRow>& out) {
  const std::vector<MatrixRow>& rows = stress_matrix();
  std::vector<bool> chosen(rows.size(), list.empty());
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    if (mark(word, chosen)) continue;
    std::string known;
    for (const MatrixRow& row : rows) known += std::string(known.empty() ? "" : ", ") + row.name;
    return {StatusCode::invalid_argument,
            fmt::format("no row '{}'; there are 1 to {}, or: {}", word, rows.size(), known)};
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (chosen[i]) out.push_back(rows[i]);
  }
  return {};
}

}  // namespace umbrix::bench
