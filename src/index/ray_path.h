// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tree/tree.h"
#include "umbrix/ray.h"

namespace umbrix::detail {

/// An inner node that a ray enters, and what its walk has cost before, in node steps.
struct PathStep {
  std::uint32_t node;
  float before;
};

/// Appends the inner nodes that a walk near child first enters until it comes to a leaf that holds `blocker` (none:
/// Primitive::kNone), and returns the cost of all of it. For estimates: in double, without the kernels' care.
float follow_ray(const Tree& tree, const Ray& ray, std::uint32_t blocker, std::vector<PathStep>& path);

}  // namespace umbrix::detail
