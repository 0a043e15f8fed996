// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "cases/families.h"

namespace umbrix::cases {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> table = {
      {"closed_interior", "closed meshes from inside, aimed within triangles", closed_interior},
      {"closed_corners", "closed meshes from inside, aimed at vertices", closed_corners},
      {"closed_midpoints", "closed meshes from inside, aimed at the middle of edges", closed_midpoints},
      {"closed_edges", "closed meshes from inside, aimed at points of edges", closed_edges},
      {"silhouettes", "past the outline of torus and sphere, along their triangles", silhouettes},
      {"grazing", "at 1e-1 to 1e-7 radians to a large sheet", grazing},
      {"axis_parallel", "along axes and coordinate planes, with signed zeros and denormals", axis_parallel},
      {"split_planes", "within planes on which a tree would split", split_planes},
      {"box_corners", "through corners and edges of boxes that a tree would make", box_corners},
      {"origins_on_geometry", "from vertices, edges, faces and their planes", origins_on_geometry},
      {"flat_scene", "all triangles in one plane", flat_scene},
      {"integer_grid", "small integers everywhere: exact ties", integer_grid},
      {"degenerate_soup", "half of the triangles are points or lines", degenerate_soup, 0.7},
      {"duplicates", "each triangle 2 to 100 times", duplicates, 0.4},
      {"slivers", "aspect ratios from 1e2 to 1e7", slivers},
      {"coincident", "one triangle, and up to 1000 copies of it", coincident, 0.05},
      {"fan", "hundreds of triangles through one vertex", fan, 0.1},
      {"shared_edge", "hundreds of triangles through one long edge", shared_edge, 0.2},
      {"nested_sizes", "sizes 1, 1/2, 1/4 ... 2^-60", nested_sizes},
      {"scaled_power_of_two", "one scene at the powers of two nearest 1e-18 ... 1e18", scaled_power_of_two},
      {"scaled_any", "one scene at 1e-18 ... 1e18, rounded", scaled_any},
      {"translated", "1e2, 1e4, 1e6 sizes from the origin, rounded", translated},
      {"mixed_scale", "a small mesh in a room 1e6 times its size", mixed_scale},
      {"whole_float_range", "2^-149 to 2^127, denormals and near overflow", whole_float_range, 0.3},
      {"far_origins", "from 10 to 1e12 extents outside", far_origins},
      {"invalid_vertices", "NaN, infinite and denormal vertices among good ones", invalid_vertices},
      {"invalid_rays", "NaN, infinite, zero and denormal rays among good ones", invalid_rays},
      {"tiny_scenes", "no triangle, one, only degenerate ones, two in a plane", tiny_scenes},
      {"interval_ends", "tmin or tmax within 2 units in the last place of a hit", interval_ends},
      {"random_segments", "segments between random points of a soup", random_segments},
  };
  return table;
}

const Case* find_case(const char* name) {
  for (const Case& c : all_cases()) {
    if (std::strcmp(c.name, name) == 0) return &c;
  }
  return nullptr;
}

}  // namespace umbrix::cases
