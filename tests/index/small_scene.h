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

/// From three walls, in blocks of 16 by 16, to a light between them.
inline std::vector<Ray> rays_from_walls(std::size_t count, const Vec3& light) {
  std::vector<Ray> rays;
  constexpr std::size_t kBlocks = 16;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t block = i / 256, wall = block / (kBlocks * kBlocks) % 3;
    const auto place = [](std::size_t b, std::size_t k) { return static_cast<float>(16 * b + k) / (8 * kBlocks) - 1; };
    Vec3 start;
    start[static_cast<int>(wall)] = 1.25f;
    start[static_cast<int>((wall + 1) % 3)] = place(block % kBlocks, i % 16);
    start[static_cast<int>((wall + 2) % 3)] = place(block / kBlocks % kBlocks, i / 16 % 16);
    const Vec3 way = light - start;
    rays.push_back({{start.x, start.y, start.z}, 0, {way.x, way.y, way.z}, 1});
  }
  return rays;
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
