// SPDX-License-Identifier: Apache-2.0
#include "cases/families.h"
#include "cases/meshes.h"

namespace umbrix::cases {

CaseData tiny_scenes(std::uint64_t seed, std::size_t ray_count) {
  Random random(seed);
  const oracle::Triangle one = triangle(random.in_cube(1), random.in_cube(1), random.in_cube(1));
  const oracle::Triangle line = triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  CaseData data;
  switch (seed % 5) {
    case 0:
      break;
    case 1:
      data.triangles = {one};
      break;
    case 2:
      data.triangles = {line};
      break;
    case 3:  // two in one plane that share an edge
      data.triangles = {triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}), triangle({1, 0, 0}, {1, 1, 0}, {0, 1, 0})};
      break;
    default:
      data.triangles = {line, one};
  }
  for (std::size_t i = 0; i < ray_count; ++i) {
    const Float3 target = data.triangles.empty()
                              ? random.in_cube(1)
                              : point_on(data.triangles[random.below(data.triangles.size())], random);
    Float3 origin = random.in_cube(2);
    if (random.chance(0.2)) origin[2] = 0;
    data.rays.push_back(ray_to(origin, target, 0, random.uniform(0.5f, 2)));
  }
  return data;
}

}  // namespace umbrix::cases
