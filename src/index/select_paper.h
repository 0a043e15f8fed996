// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "index/primitive_index.h"

namespace umbrix::detail {

/// How equations 2 and 3 of Liang & Huang (2019) are read. p is the chance that a line through the cell is blocked.
enum class PaperReading {
  expected,  ///< E = a^h (p - c / C): p of the box of the triangle's part in the cell, C the subtree's expected cost
  area,      ///< G = share of lines that come to the node x (p C - c): p of that part's area (Cauchy & Crofton)
  literal,   ///< as printed, for comparison only: whole box, C as in a build, children neither weighted nor the step
             ///< counted
};

struct PaperOptions {
  PaperReading reading = PaperReading::expected;
  double least_box = 0.5;    ///< a candidate's box area, by the mean ("0.45 to 0.60")
  double most_share = 0.02;  ///< of the triangles, the largest, are candidates
  std::size_t most_candidates = 20000;
  double decay = 0.6;                        ///< a
  double threshold = 0;                      ///< for E or G
  double band_low = 0.35, band_high = 0.70;  ///< of the tree's depth: where lists may be ("mid-level")
  std::uint32_t least_inner_nodes = 4;       ///< in a node's subtree
  std::uint32_t per_node = 2;                ///< triangles; at most kBlockLanes
  std::uint32_t nodes_per_triangle = 1;      ///< the best ones with none on another's root path
  double least_gain = 0.02;                  ///< of the expected cost of a line: with less, nothing is placed
};

/// Which triangles to test at which nodes, from the shapes alone: `kept` are the triangles that can be hit. Depends on
/// nothing else. Throws std::bad_alloc.
std::vector<Placement> select_paper(const Tree& tree, const Triangle* triangles, const std::uint32_t* kept,
                                    std::size_t kept_count, const PaperOptions& options = {});

}  // namespace umbrix::detail
