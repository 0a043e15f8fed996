// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/math.h"
#include "umbrix/mesh.h"
#include "umbrix/status.h"

namespace umbrix::detail {

/// invalid_argument if the view cannot be read: null or misaligned data, an index out of range.
Status check(const MeshView& mesh);

/// Of a view that was checked.
Triangle triangle_of(const MeshView& mesh, std::size_t i) noexcept;

/// All of them. Throws std::bad_alloc.
std::vector<Triangle> triangles_of(const MeshView& mesh);

}  // namespace umbrix::detail
