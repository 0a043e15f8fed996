// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cases/cases.h"

/// The generators that table.cpp lists, by the file that has them.
namespace umbrix::cases {

using Make = CaseData(std::uint64_t seed, std::size_t ray_count);

// closed_meshes.cpp; the rest of it in closed_meshes.h
Make silhouettes;

// planes.cpp
Make axis_parallel, split_planes, box_corners, origins_on_geometry, flat_scene, tilted_flat_scene, integer_grid;
/// Angles of 10^exponent to 10^(exponent + 1) radians to a large sheet.
CaseData grazing(int exponent, std::uint64_t seed, std::size_t ray_count);

// tree_places.cpp
Make tree_planes, tree_corners;

// degenerate.cpp
Make degenerate_soup, slivers, coincident, fan, shared_edge, nested_sizes, cantor_dust;

// scales.cpp
Make scaled_power_of_two, scaled_any, translated, mixed_scale, whole_float_range, far_origins;

// same_answers.cpp: each with the plain case it must agree with
Make duplicates, permuted, flipped, mirrored, axes_swapped, reversed, split_in_four, power_of_two_twin;

// invalid_values.cpp
Make invalid_vertices, invalid_rays;

// tiny.cpp
Make tiny_scenes;

// interval_ends.cpp
Make interval_ends, random_segments;

// surface_points.cpp: rays from points of surfaces, moved off by offset_origin
Make offset_outward, offset_inward, no_distance, convex_in_front, inside_single_walls, inside_single_wall_edges;
/// From within thin walls, `thickness` times as thick as the largest offset.
CaseData inside_thin_walls(float thickness, std::uint64_t seed, std::size_t ray_count);
enum class LightPlace { inside, on_face, at_vertex, on_edge, on_split_plane, outside, directional };
CaseData light_at(LightPlace place, std::uint64_t seed, std::size_t ray_count);

/// All rays of a scene go to one light, past vertices, edges and planes as it sees them.
enum class OneLight { anywhere, in_plane, at_vertex, near_triangle, far_off };
CaseData to_one_light(OneLight kind, std::uint64_t seed, std::size_t ray_count);
/// Or come in bundles from points of that kind, as to lights of some size.
CaseData from_points(OneLight kind, std::uint64_t seed, std::size_t ray_count);
/// Or from points of that kind in blocks of sixteen that go nearly one way, as a camera's.
CaseData from_eyes(OneLight kind, std::uint64_t seed, std::size_t ray_count);

// huge.cpp: `count` triangles
CaseData huge_degenerate_soup(std::size_t count, std::uint64_t seed, std::size_t ray_count);
CaseData huge_soup_with_one_bad(std::size_t count, std::uint64_t seed, std::size_t ray_count);
CaseData huge_coincident(std::size_t count, std::uint64_t seed, std::size_t ray_count);
CaseData huge_fan(std::size_t count, std::uint64_t seed, std::size_t ray_count);
CaseData huge_shared_edge(std::size_t count, std::uint64_t seed, std::size_t ray_count);
CaseData huge_soup(std::size_t count, std::uint64_t seed, std::size_t ray_count);

}  // namespace umbrix::cases
