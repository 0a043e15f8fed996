// SPDX-License-Identifier: Apache-2.0
//
// Rays in the planes of a built tree, and through the corners and edges of its cells.
#include <cmath>
#include <limits>

#include "cases/built_tree.h"
#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A corner of a leaf's cell, in the scene's units; some walks stop at an inner node's cell.
Float3 cell_corner(const detail::Tree& tree, Random& random) {
  detail::Box cell = tree.root;
  for (std::uint32_t node = 0; !tree.nodes[node].is_leaf() && !random.chance(0.02);) {
    const detail::Node& inner = tree.nodes[node];
    const auto axis = static_cast<int>(inner.axis_bits());
    const bool high = random.chance(0.5);
    (high ? cell.lower : cell.upper)[axis] = inner.plane();
    node = inner.low_child() + (high ? 1 : 0);
  }
  Float3 corner;
  for (int k = 0; k < 3; ++k) {
    const float scaled = random.chance(0.5) ? cell.lower[k] : cell.upper[k];
    corner[static_cast<std::size_t>(k)] = std::ldexp(scaled, -tree.scale_exponent);  // exact
  }
  return corner;
}

Triangles balls_and_floor(Random& random) {
  Triangles result = soup(200, 1, 0.3f, random);
  for (const Triangles& more : {icosphere(2, 0.4f, 0.1f, {0.3f, 0.1f, 0}, random).triangles, sheet(6, 1, -0.5f)}) {
    result.insert(result.end(), more.begin(), more.end());
  }
  return result;
}

float end(Random& random) { return random.chance(0.5) ? kInfinity : random.uniform(0, 3); }

}  // namespace

CaseData tree_planes(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{balls_and_floor(random), {}};
  const detail::Tree tree = built_tree(data.triangles);
  for (std::size_t i = 0; i < ray_count; ++i) {
    // One or two coordinates of a cell's corner are kept all along the ray.
    const Float3 corner = cell_corner(tree, random);
    Float3 origin = random.in_cube(1.5f);
    Float3 d = random.direction();
    const std::size_t axis = random.below(3), second = random.chance(0.3) ? (axis + 1) % 3 : axis;
    for (const std::size_t k : {axis, second}) {
      origin[k] = corner[k];
      d[k] = 0.0f * random.sign();
    }
    data.rays.push_back({{origin[0], origin[1], origin[2]}, 0, {d[0], d[1], d[2]}, end(random)});
  }
  return data;
}

CaseData tree_corners(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  CaseData data{balls_and_floor(random), {}};
  const detail::Tree tree = built_tree(data.triangles);
  for (std::size_t i = 0; i < ray_count; ++i) {
    Float3 through = cell_corner(tree, random);
    // Through the corner itself, or through a point of one of its edges.
    if (random.chance(0.5)) through[random.below(3)] = random.uniform(-1, 1);
    const Float3 origin = random.chance(0.5) ? cell_corner(tree, random) : random.in_cube(1.5f);
    data.rays.push_back(ray_to(origin, through, 0, end(random)));
  }
  return data;
}

}  // namespace umbrix::cases
