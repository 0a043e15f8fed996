// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/tree.h"
#include "umbrix/executor.h"

namespace umbrix::detail {

// How big the nodes of a tree are, in several ways; by node, in the tree's units. They guide orders and costs, so
// rounding does not matter. All throw std::bad_alloc.

/// Each node's cell.
std::vector<Box> cells_of(const Tree& tree);

/// Half the surface area of the cell.
std::vector<double> cell_areas(const Tree& tree);

/// Half the surface area of the box of what lies in the cell; 0 if nothing does.
std::vector<double> tight_box_areas(const Tree& tree, const Executor* executor);

/// The area of the triangles' parts in the cell.
std::vector<double> triangle_areas(const Tree& tree, const Executor* executor);

/// For leaves, how likely a line through the cell meets none of the triangles, taken as independent; 1 for inner nodes.
std::vector<double> leaf_visibilities(const Tree& tree, const Executor* executor);

/// The number of triangles, each counted once however many leaves name it.
std::vector<double> triangle_counts(const Tree& tree);

}  // namespace umbrix::detail
