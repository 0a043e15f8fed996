// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "scene.h"

namespace umbrix::scenes {

struct TriangleCounts {
  std::uint64_t stored = 0;
  std::uint64_t flattened = 0;  ///< over all instances
};

TriangleCounts count_triangles(const Scene& scene);

/// The scene as the bytes of a .glb file, the same on every machine.
std::string glb(const Scene& scene);

}  // namespace umbrix::scenes
