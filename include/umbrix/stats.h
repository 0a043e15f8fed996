// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace umbrix {

/// Work done for a set of rays. Node and primitive tests depend on the scene, the kernel and the rays only; how many
/// tests needed more than float depends on the instruction set as well.
struct RayCounts {
  std::uint64_t rays = 0;
  std::uint64_t invalid_rays = 0;     ///< answered "no hit" without a walk (see Ray)
  std::uint64_t node_tests = 0;       ///< nodes visited, inner and leaf; one with eight children is one
  std::uint64_t leaf_visits = 0;      ///< of those, leaves
  std::uint64_t primitive_tests = 0;  ///< ray/triangle tests; each lane that holds a triangle counts one
  std::uint64_t double_tests = 0;     ///< of those, undecided in float
  std::uint64_t exact_tests = 0;      ///< of those, undecided in double
  std::uint64_t far_rays = 0;         ///< walked with double plane times, or tested against everything
  std::uint64_t index_tests = 0;      ///< of the primitive tests, those of indexed or remembered triangles
  std::uint64_t links_followed = 0;   ///< from leaf to leaf without the root
  std::uint64_t links_missing = 0;    ///< continued from the root for want of a link
  std::uint64_t restarts = 0;         ///< continued from above for want of a stack

  RayCounts& operator+=(const RayCounts& o) noexcept {
    rays += o.rays;
    invalid_rays += o.invalid_rays;
    node_tests += o.node_tests;
    leaf_visits += o.leaf_visits;
    primitive_tests += o.primitive_tests;
    double_tests += o.double_tests;
    exact_tests += o.exact_tests;
    far_rays += o.far_rays;
    index_tests += o.index_tests;
    links_followed += o.links_followed;
    links_missing += o.links_missing;
    restarts += o.restarts;
    return *this;
  }
};

/// Counts split by the true answer, so that kernels can be compared class by class.
struct OcclusionCounts {
  RayCounts occluded;
  RayCounts unoccluded;
};

/// What Scene::commit made and what it cost. What is said of nodes and leaves is of the tree: zeros until it is built.
struct BuildStats {
  std::uint64_t triangles = 0;            ///< added, those of instances for each of them
  std::uint64_t dropped_nonfinite = 0;    ///< with a NaN or infinite vertex
  std::uint64_t dropped_degenerate = 0;   ///< with no area (decided exactly); not told of those that stay instances
  std::uint64_t instances = 0;            ///< that share their prototype's triangles (see Scene::add_instance)
  std::uint64_t instanced_triangles = 0;  ///< of the triangles, those of such instances
  std::uint64_t nodes = 0;                ///< inner and leaf
  std::uint64_t leaves = 0;
  std::uint64_t empty_leaves = 0;
  std::uint64_t references = 0;    ///< triangles summed over the leaves
  std::uint64_t largest_leaf = 0;  ///< triangles
  std::uint32_t depth = 0;         ///< inner nodes above the deepest leaf
  double sah_cost = 0;             ///< expected cost of a line through the scene box, in node steps
  std::uint64_t node_bytes = 0;
  std::uint64_t leaf_bytes = 0;
  std::uint64_t triangle_bytes = 0;  ///< the exact vertices
  std::uint64_t box_bytes = 0;       ///< the hierarchy of boxes, with vertices of its own
  std::uint64_t instance_bytes = 0;  ///< instances, and prototypes with their boxes
  std::uint64_t bytes = 0;           ///< all that stays
  double seconds_prepare = 0;        ///< checking, scaling, bounds, first sort
  double seconds_tree = 0;           ///< choosing and making splits
  double seconds_leaves = 0;         ///< packing leaf blocks
  double seconds = 0;                ///< all of commit, and of the tree if it was built later
};

}  // namespace umbrix
