// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace umbrix {

/// Decides whether a triangle blocks at a point, for alpha-masked surfaces. Called from any thread, only
/// for points that are hit; must return the same answer for the same arguments. `u`, `v` as in Hit. AlphaTest
/// (opacity.h) is one made of an image.
struct OpacityTest {
  bool (*opaque)(const void* user, std::uint32_t triangle, float u, float v) = nullptr;
  const void* user = nullptr;
};

/// Borrowed triangles. Memory is read during Scene::add only; the test's `user` must outlive the scene.
/// Non-finite and zero-area triangles are dropped and counted (BuildStats); indices are checked.
struct MeshView {
  const float* vertices = nullptr;  ///< x, y, z at the start of each vertex
  std::size_t vertex_count = 0;
  std::size_t vertex_stride = 12;          ///< bytes from one vertex to the next; a multiple of 4
  const std::uint32_t* indices = nullptr;  ///< three a triangle; null: vertices 0 1 2, 3 4 5, ...
  std::size_t triangle_count = 0;
  std::size_t index_stride = 12;     ///< bytes from one triangle to the next; a multiple of 4
  std::uint32_t mask = 0xFFFFFFFFu;  ///< a query sees the mesh if (mask & query mask) != 0
  OpacityTest opacity;               ///< none: the mesh is opaque
};

}  // namespace umbrix
