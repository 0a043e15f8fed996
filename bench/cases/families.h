// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cases/cases.h"

/// The generators that table.cpp lists, by the file that has them.
namespace umbrix::cases {

using Make = CaseData(std::uint64_t seed, std::size_t ray_count);

// closed_meshes.cpp
Make closed_interior, closed_corners, closed_midpoints, closed_edges, silhouettes;

// planes.cpp
Make grazing, axis_parallel, split_planes, box_corners, origins_on_geometry, flat_scene, integer_grid;

// degenerate.cpp
Make degenerate_soup, duplicates, slivers, coincident, fan, shared_edge, nested_sizes;

// scales.cpp
Make scaled_power_of_two, scaled_any, translated, mixed_scale, whole_float_range, far_origins;

// invalid_values.cpp
Make invalid_vertices, invalid_rays;

// tiny.cpp
Make tiny_scenes;

// interval_ends.cpp
Make interval_ends, random_segments;

}  // namespace umbrix::cases
