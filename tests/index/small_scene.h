// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numeric>
#include <random>
#include <vector>

#include "kernels/scene_view.h"
#include "tree/builder.h"

namespace umbrix::detail {

inline Vec3 random_point(std::mt19937& random) {
  std::uniform_real_distribution<float> u(-1, 1);
  const float x = u(random), y = u(random);
  return {x, y, u(random)};
}

inline std::vector<Triangle> random_soup(std::size_t count, float size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Triangle> result(count);
  for (Triangle& t : result) {
    const Vec3 center = random_point(random);
    for (Vec3& v : t.v) v = center + size * random_point(random);
  }
  return result;
}

/// From anywhere to one light.
inline std::vector<Ray> rays_to_light(std::size_t count, const Vec3& light, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<Ray> result;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 from = random_point(random), d = light - from;
    result.push_back({{from.x, from.y, from.z}, 0, {d.x, d.y, d.z}, 1});
  }
  return result;
}

/// One mesh, seen from within.
struct SmallScene {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> kept, mesh_of;
  MeshRecord mesh;
  Tree tree;

  explicit SmallScene(std::vector<Triangle> list)
      : triangles(std::move(list)),
        kept(triangles.size()),
        mesh_of(triangles.size()),
        mesh{0, static_cast<std::uint32_t>(triangles.size()), 0xFFFFFFFFu, {}} {
    std::iota(kept.begin(), kept.end(), 0u);
    BuildStats stats;
    tree = build_tree(triangles, kept, BuildQuality::high, nullptr, stats);
  }
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  SceneView view(const SideTable* side = nullptr) const {
    return {&tree, triangles.data(), kept.data(), kept.size(), mesh_of.data(), &mesh, 1, true, side};
  }

  std::vector<std::uint32_t> inner_nodes() const {
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
      if (i != 1 && !tree.nodes[i].is_leaf()) result.push_back(i);  // 1 is nobody's child
    return result;
  }
};

}  // namespace umbrix::detail
