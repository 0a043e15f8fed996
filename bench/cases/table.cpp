// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "cases/closed_meshes.h"
#include "cases/families.h"

namespace umbrix::cases {
namespace {

constexpr std::size_t kOneScene = std::size_t{1} << 40;

// A case that needs no more than its generator.
Case plain(int row, const char* name, double rays, Make* make, const char* summary) {
  Case c;
  c.row = row;
  c.name = name;
  c.rays = rays;
  c.make = make;
  c.summary = summary;
  return c;
}

Case slow(Case c) {
  c.is_slow = true;
  return c;
}

Case claimed(Case c, Claim claim) {
  c.claim = claim;
  return c;
}

// Rows 1 to 3.
void add_closed_meshes(double size, std::vector<Case>& table) {
  struct Target {
    int row;
    const char* name;
    Aim aim;
    double rays;
    const char* summary;
  };
  const Target targets[] = {{1, "inside", Aim::interior, 1e7, "from inside a closed mesh at its triangles: "},
                            {2, "corners", Aim::vertex, 5e6, "from inside a closed mesh at its vertices: "},
                            {3, "edges", Aim::edge, 5e6, "from inside a closed mesh at middles and points of edges: "}};
  for (const Target& target : targets) {
    for (const ClosedMeshKind& kind : closed_mesh_kinds(size)) {
      Case c;
      c.row = target.row;
      c.name = std::string(target.name) + "_" + kind.name;
      c.rays = target.rays;
      c.make = [kind, aim = target.aim](std::uint64_t seed, std::size_t rays) {
        return from_inside(kind, aim, seed, rays);
      };
      c.summary = target.summary + kind.name;
      c.rays_per_scene = 250'000;
      c.claim = Claim::all_occluded;
      c.is_proved = true;
      c.is_variant = kind.name != "grid";
      table.push_back(std::move(c));
    }
  }
}

void add_grazing(std::vector<Case>& table) {
  for (int exponent = -7; exponent < 0; ++exponent) {
    Case c = plain(5, "", 1e6, nullptr, "");
    c.name = "grazing_1e" + std::to_string(exponent);
    c.is_variant = exponent != -4;
    c.summary = "1 to 10 times 1e" + std::to_string(exponent) + " radians to a large sheet";
    c.make = [exponent](std::uint64_t seed, std::size_t rays) { return grazing(exponent, seed, rays); };
    table.push_back(std::move(c));
  }
}

void add_lights(std::vector<Case>& table) {
  struct Light {
    const char* name;
    LightPlace place;
    const char* summary;
  };
  const Light lights[] = {{"light_inside", LightPlace::inside, "shadow rays to a light within a mesh"},
                          {"light_on_face", LightPlace::on_face, "to a light on a triangle"},
                          {"light_at_vertex", LightPlace::at_vertex, "to a light at a vertex"},
                          {"light_on_edge", LightPlace::on_edge, "to a light on an edge"},
                          {"light_on_split_plane", LightPlace::on_split_plane, "to a light on a plane of the tree"},
                          {"light_outside", LightPlace::outside, "to a light 1 to 1e6 scene sizes away"},
                          {"light_directional", LightPlace::directional, "to a light at 1e30"}};
  for (const Light& light : lights) {
    Case c = plain(24, light.name, 1e5, nullptr, light.summary);
    c.is_variant = light.place != LightPlace::at_vertex;
    c.make = [place = light.place](std::uint64_t seed, std::size_t rays) { return light_at(place, seed, rays); };
    table.push_back(std::move(c));
  }
}

/// Rays to one point, or from such, that lies somewhere special.
void add_of_points(std::vector<Case>& table, const std::string& name, const char* summary, const char* point,
                   CaseData (*make)(OneLight, std::uint64_t, std::size_t)) {
  struct Place {
    const char* name;
    OneLight kind;
    const char* where;
  };
  const Place places[] = {{"", OneLight::anywhere, ""},
                          {"_in_plane", OneLight::in_plane, "in planes of triangles"},
                          {"_at_vertex", OneLight::at_vertex, "at a vertex"},
                          {"_near", OneLight::near_triangle, "next to a triangle"},
                          {"_far", OneLight::far_off, "10 to 10000 sizes away"}};
  for (const Place& place : places) {
    Case c = plain(24, "", 1e6, nullptr, summary);
    c.name = name + place.name;
    if (place.kind != OneLight::anywhere) c.summary = std::string("the same, the ") + point + " " + place.where;
    c.make = [make, kind = place.kind](std::uint64_t seed, std::size_t rays) { return make(kind, seed, rays); };
    c.rays_per_scene = 4'000;
    table.push_back(std::move(c));
  }
}

// Row 27: where claims end is what the thinner ones tell.
void add_thin_walls(std::vector<Case>& table) {
  struct Wall {
    const char* name;
    float thickness;
    double rays;
    const char* summary;
  };
  const Wall walls[] = {{"walls_4", 4, 5e6, "from within walls 4 times as thick as the largest offset"},
                        {"walls_2", 2, 1e5, "2 times as thick"},
                        {"walls_1", 1, 1e5, "as thick"},
                        {"walls_half", 0.5f, 1e5, "half as thick"}};
  for (const Wall& wall : walls) {
    Case c = plain(27, wall.name, wall.rays, nullptr, wall.summary);
    c.make = [thickness = wall.thickness](std::uint64_t seed, std::size_t rays) {
      return inside_thin_walls(thickness, seed, rays);
    };
    if (wall.thickness >= 4) c.claim = Claim::all_occluded;
    c.is_variant = wall.thickness < 4;
    table.push_back(std::move(c));
  }
}

void add_huge(double size, std::vector<Case>& table) {
  using MakeHuge = CaseData(std::size_t, std::uint64_t, std::size_t);
  struct Huge {
    int row;
    const char* name;
    double triangles;
    double rays;
    MakeHuge* make;
    const char* summary;
  };
  const Huge scenes[] = {
      {10, "huge_degenerate_soup", 1e5, 5e5, huge_degenerate_soup, "half of 1e5 triangles are points or lines"},
      {17, "huge_soup_with_one_bad", 1e5, 5e5, huge_soup_with_one_bad, "a NaN, two infinities, a denormal in 1e5"},
      {21, "huge_coincident", 1e6, 30, huge_coincident,
       "1e6 times one triangle"},  // a ray at its edge: 1e6 exact tests
      {21, "huge_fan", 1e6, 1e5, huge_fan, "1e6 triangles through one vertex"},
      {21, "huge_shared_edge", 1e6, 3e4, huge_shared_edge, "1e6 triangles that share a long edge"},
      {28, "huge_soup", 1e6, 5e6, huge_soup, "1e6 random triangles"},
      {28, "huger_soup", 1e7, 5e6, huge_soup, "1e7 random triangles"}};
  for (const Huge& scene : scenes) {
    const auto count = static_cast<std::size_t>(std::max(100.0, std::ceil(scene.triangles * std::min(size, 1.0))));
    Case c = plain(scene.row, scene.name, scene.rays, nullptr, scene.summary);
    c.make = [make = scene.make, count](std::uint64_t seed, std::size_t rays) { return make(count, seed, rays); };
    c.rays_per_scene = kOneScene;
    c.is_slow = c.is_huge = count > 200'000;
    table.push_back(std::move(c));
  }
}

// Row 32: hard cases again, called by a host that has set another floating-point mode.
void add_host_modes(std::vector<Case>& table) {
  struct Mode {
    const char* name;
    HostMode mode;
  };
  const Mode modes[] = {{"flush_denormals", HostMode::flush_denormals},
                        {"round_up", HostMode::round_up},
                        {"round_down", HostMode::round_down},
                        {"round_to_zero", HostMode::round_to_zero}};
  const Case cases[] = {plain(32, "nested_sizes", 1e5, nested_sizes, ""),
                        plain(32, "interval_ends", 1e5, interval_ends, ""),
                        plain(32, "whole_float_range", 5e4, whole_float_range, "")};
  for (const Mode& mode : modes) {
    for (Case c : cases) {
      c.summary = c.name + ", while the host's mode is " + mode.name;
      c.name = std::string(mode.name) + "_" + c.name;
      c.mode = mode.mode;
      c.is_variant = true;
      table.push_back(std::move(c));
    }
  }
}

}  // namespace

std::vector<Case> all_cases(double size) {
  std::vector<Case> table;
  const auto add = [&](Case c) { table.push_back(std::move(c)); };
  add_closed_meshes(size, table);
  add(plain(4, "silhouettes", 1e7, silhouettes, "past the outline of torus and sphere, along their triangles"));
  add_grazing(table);
  add(plain(6, "axis_parallel", 6e6, axis_parallel, "along axes and their planes, with signed zeros and denormals"));
  add(plain(7, "tree_planes", 1e6, tree_planes, "within planes of the built tree"));
  add(plain(7, "split_planes", 5e5, split_planes, "within planes on which a tree would split, and their neighbours"));
  add(plain(8, "tree_corners", 1e6, tree_corners, "through corners and edges of the built tree's cells"));
  add(plain(8, "box_corners", 5e5, box_corners, "through corners and edges of boxes that a tree would make"));
  add(plain(8, "integer_grid", 1e6, integer_grid, "small integers everywhere: exact ties"));
  add(plain(9, "origins_on_geometry", 1e6, origins_on_geometry, "from vertices, edges, faces and their planes"));
  add(claimed(plain(9, "offset_outward", 5e5, offset_outward, "moved off a ball: nothing is hit"),
              Claim::none_occluded));
  add(claimed(plain(9, "offset_inward", 5e5, offset_inward, "moved into a ball: none gets out"), Claim::all_occluded));
  add(plain(10, "degenerate_soup", 5e5, degenerate_soup, "half of the triangles are points or lines"));
  add(slow(plain(11, "duplicates", 1e6, duplicates, "each triangle 2 to 1000 times: as once")));
  add(plain(12, "slivers", 1e6, slivers, "aspect ratios from 1e2 to 1e7"));
  add(plain(13, "power_of_two_twin", 7e6, power_of_two_twin, "powers of two nearest 1e-18 ... 1e18: as at scale 1"));
  add(plain(13, "scaled_power_of_two", 1e6, scaled_power_of_two, "the same for full 24-bit coordinates"));
  add(plain(14, "scaled_any", 7e6, scaled_any, "one scene at 1e-18 ... 1e18, rounded"));
  add(plain(14, "whole_float_range", 5e5, whole_float_range, "2^-149 to 2^127, denormals and near overflow"));
  add(plain(15, "translated", 3e6, translated, "1e2, 1e4, 1e6 sizes from the origin, rounded"));
  add(plain(16, "mixed_scale", 1e7, mixed_scale, "a small mesh in a room 1e6 times its size"));
  add(plain(17, "invalid_vertices", 1e6, invalid_vertices, "NaN, infinite and denormal vertices among good ones"));
  add(plain(18, "invalid_rays", 4e6, invalid_rays, "NaN, infinite, zero and denormal rays among good ones"));
  add(plain(20, "tiny_scenes", 1e5, tiny_scenes, "no triangle, one, only degenerate ones, two in a plane"));
  add(slow(plain(21, "coincident", 1e5, coincident, "one triangle, and up to 1000 copies of it")));
  add(slow(plain(21, "fan", 1e5, fan, "hundreds of triangles through one vertex")));
  add(slow(plain(21, "shared_edge", 1e5, shared_edge, "hundreds of triangles through one long edge")));
  add(plain(22, "nested_sizes", 1e6, nested_sizes, "sizes 1, 1/2, 1/4 ... 2^-60"));
  add(plain(22, "cantor_dust", 1e6, cantor_dust, "clusters of clusters, down to 3^-16"));
  add(plain(23, "flat_scene", 1e6, flat_scene, "all triangles in one plane across an axis"));
  add(plain(23, "tilted_flat_scene", 1e6, tilted_flat_scene, "all triangles in one tilted plane"));
  add_lights(table);
  add_of_points(table, "one_light", "all rays to one light, past what it sees at its edge", "light", to_one_light);
  add_of_points(table, "bundles", "rays in bundles from points, past what these see at its edge", "points",
                from_points);
  add_of_points(table, "camera", "rays from a point in blocks that go nearly one way", "point", from_eyes);
  add(plain(24, "far_origins", 1e6, far_origins, "from 10 to 1e12 extents outside"));
  add(plain(25, "no_distance", 1e5, no_distance, "the light at the point itself or one unit in the last place off"));
  add(plain(25, "interval_ends", 1e6, interval_ends, "tmin or tmax within 2 units in the last place of a hit"));
  add(claimed(plain(26, "convex_in_front", 1e7, convex_in_front, "in front of a convex mesh: no acne"),
              Claim::none_occluded));
  add(claimed(plain(27, "single_walls", 5e6, inside_single_walls, "from within a box of single walls"),
              Claim::all_occluded));
  add(plain(27, "wall_edges", 1e5, inside_single_wall_edges, "the same from the edges where two walls meet"));
  add_thin_walls(table);
  add(plain(28, "random_segments", 1e6, random_segments, "segments between random points of a soup"));
  add(plain(29, "permuted", 1e6, permuted, "triangles in another order"));
  add(plain(29, "flipped", 1e6, flipped, "other windings"));
  add(plain(29, "mirrored", 1e6, mirrored, "an axis mirrored"));
  add(plain(29, "axes_swapped", 1e6, axes_swapped, "two axes swapped"));
  add(plain(29, "reversed", 1e6, reversed, "segments from their end to their start"));
  add(plain(29, "split_in_four", 1e6, split_in_four, "each triangle split at exact midpoints"));
  add_huge(size, table);
  add_host_modes(table);
  std::stable_sort(table.begin(), table.end(), [](const Case& a, const Case& b) { return a.row < b.row; });
  return table;
}

const std::vector<Case>& small_cases() {
  static const std::vector<Case> table = all_cases(1e-4);
  return table;
}

const Case* find_case(const char* name) {
  for (const Case& c : small_cases()) {
    if (c.name == name) return &c;
  }
  return nullptr;
}

}  // namespace umbrix::cases
