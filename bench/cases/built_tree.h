// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "oracle/exact_hit.h"
#include "tree/tree.h"

namespace umbrix::cases {

/// The tree that Scene makes of these triangles.
detail::Tree built_tree(const std::vector<oracle::Triangle>& triangles);

}  // namespace umbrix::cases
