// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "umbrix/frame.h"
#include "umbrix/io/scene_file.h"
#include "umbrix/ray.h"
#include "umbrix/scene.h"
#include "umbrix/status.h"
#include "workload/geometry.h"

namespace umbrix::workload {

/// Of the scene's bounds; 0 if there is nothing.
double diagonal(const Scene& scene);

/// Where the eye and the lights are.
struct Viewpoint {
  io::Camera camera;
  std::vector<io::Light> lights;
};

/// From `setup_path` if not empty, else from the scene file, else the defaults that the renderer would take.
Status find_viewpoint(const Geometry& geometry, const std::string& setup_path, Viewpoint& out);

/// A frame's shadow rays to one light, tile by tile.
struct TiledRays {
  std::vector<Ray> rays;
  std::vector<Pixel> pixels;             ///< of each ray
  std::vector<float> irradiance;         ///< what each would bring if unoccluded, of a light of intensity 1
  std::vector<std::size_t> tile_starts;  ///< the first ray of each tile, and the end
};

/// One segment from each front-lit primary hit to the light: size x size primary rays, the hit point moved off the
/// surface by 1e-5 of the scene's diagonal, the direction normalised, tmax the distance (infinite for a directional
/// light). In image order: 16x16 tiles of 4x4 blocks, pixels without a segment left out. `scene` holds `geometry`.
TiledRays tiled_shadow_rays(const Scene& scene, const Geometry& geometry, const io::Camera& camera,
                            const io::Light& light, int size);

/// The same rays in the same order.
std::vector<Ray> shadow_rays(const Scene& scene, const Geometry& geometry, const io::Camera& camera,
                             const io::Light& light, int size);

}  // namespace umbrix::workload
