// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tree/tree.h"

namespace umbrix::detail {

/// Checks all that the kernels rely on, with a triangle/box test of its own: the shape of the tree, planes inside their
/// cells, blocks that hold their triangles' vertices and true bounds, and that every kept triangle is referenced by
/// each leaf whose cell, grown by half of eps (twice what the walk needs), it meets. Returns the first fault, or
/// nothing.
std::string check_tree(const Tree& tree, const std::vector<Triangle>& triangles,
                       const std::vector<std::uint32_t>& kept);

}  // namespace umbrix::detail
