// SPDX-License-Identifier: Apache-2.0
#include "index/ray_path.h"

#include <cmath>

#include "tree/split.h"

namespace umbrix::detail {
namespace {

/// A ray in the tree's units, its times unchanged.
struct PathRay {
  double origin[3], inverse[3];
  double t0, t1;

  PathRay(const Tree& tree, const Ray& ray) : t0(ray.tmin), t1(ray.tmax) {
    const double scale = std::ldexp(1.0, tree.scale_exponent);
    for (int k = 0; k < 3; ++k) {
      origin[k] = ray.origin[k] * scale;
      inverse[k] = 1 / (ray.direction[k] * scale);
      const double low = time(tree.root.lower[k], k), high = time(tree.root.upper[k], k);
      // fmin and fmax pass over the NaN of a ray within a face.
      t0 = std::fmax(t0, std::fmin(low, high));
      t1 = std::fmin(t1, std::fmax(low, high));
    }
  }

  double time(float plane, int axis) const { return (static_cast<double>(plane) - origin[axis]) * inverse[axis]; }
};

/// The cost of testing a leaf, up to the block that holds the blocker.
double leaf_cost(const Tree& tree, const Node& leaf, std::uint32_t blocker, bool& found) {
  const CostModel model;
  double cost = 0;
  for (std::uint32_t b = 0; b < leaf.block_count() && !found; ++b) {
    const Block& block = tree.blocks[leaf.first_block() + b];
    cost += model.leaf(block.count);
    for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) found |= block.id[lane] == blocker;
  }
  return cost;
}

}  // namespace

float follow_ray(const Tree& tree, const Ray& ray, std::uint32_t blocker, std::vector<PathStep>& path) {
  struct Pending {
    std::uint32_t node;
    double t1;
  };
  Pending stack[kMaxDepth + 1];
  std::uint32_t pending = 0, index = 0;
  double cost = 0;
  PathRay at(tree, ray);
  if (!(at.t0 <= at.t1)) return 0;
  for (;;) {
    const Node& node = tree.nodes[index];
    if (!node.is_leaf()) {
      path.push_back({index, static_cast<float>(cost)});
      cost += 1;
      const int axis = static_cast<int>(node.axis_bits());
      const double t = at.time(node.plane(), axis);
      const std::uint32_t near = node.low_child() + (at.inverse[axis] < 0 ? 1 : 0);
      index = near;
      if (t <= at.t0) {
        index = near ^ 1u;
      } else if (t < at.t1) {
        stack[pending++] = {near ^ 1u, at.t1};
        at.t1 = t;
      }
      continue;
    }
    bool found = false;
    cost += 1 + leaf_cost(tree, node, blocker, found);
    if (found || pending == 0) return static_cast<float>(cost);
    at.t0 = at.t1;
    index = stack[--pending].node;
    at.t1 = stack[pending].t1;
  }
}

}  // namespace umbrix::detail
