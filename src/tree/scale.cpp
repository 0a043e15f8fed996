// SPDX-License-Identifier: Apache-2.0
#include "tree/scale.h"

#include <cmath>

namespace umbrix::detail {

int scale_exponent(const Box& bounds) {
  float largest = 0;
  for (const Vec3& v : {bounds.lower, bounds.upper})
    largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  int exponent = 0;
  std::frexp(largest, &exponent);
  return -exponent;
}

Triangle scaled(const Triangle& triangle, int exponent) {
  const double factor = std::ldexp(1.0, exponent);
  Triangle result;
  for (int i = 0; i < 3; ++i) result.v[i] = Vec3(DVec3(triangle.v[i]) * factor);
  return result;
}

std::vector<Triangle> scaled(ArrayView<Triangle> triangles, int exponent) {
  std::vector<Triangle> result(triangles.begin(), triangles.end());
  for (Triangle& t : result) t = scaled(t, exponent);
  return result;
}

}  // namespace umbrix::detail
