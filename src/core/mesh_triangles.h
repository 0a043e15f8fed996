// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/math.h"
#include "umbrix/mesh.h"
#include "umbrix/status.h"

namespace umbrix::detail {

/// The number of a triangle's vertex: that of three indices, or in order if there are none.
inline std::uint32_t vertex_of(const std::uint32_t* indices, std::size_t stride, std::size_t triangle,
                               std::size_t corner) noexcept {
  if (!indices) return static_cast<std::uint32_t>(3 * triangle + corner);
  const char* const base = reinterpret_cast<const char*>(indices);
  return reinterpret_cast<const std::uint32_t*>(base + triangle * stride)[corner];
}

/// invalid_argument if the view cannot be read: null or misaligned data, an index out of range.
Status check(const MeshView& mesh);

/// Of a view that was checked.
Triangle triangle_of(const MeshView& mesh, std::size_t i) noexcept;

/// All of them. Throws std::bad_alloc.
std::vector<Triangle> triangles_of(const MeshView& mesh);

}  // namespace umbrix::detail
