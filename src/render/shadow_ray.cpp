// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_ray.h"

#include <cmath>
#include <limits>

namespace umbrix::render {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Ray shadow_ray(const Surface& surface, const Arrival& arrival) {
  // The point as floats, and how far that is from the triangle's plane: its rounding, known to the last bit, and more.
  float point[3], error[3], normal[3], toward[3];
  store(surface.point, point);
  const Vec3 rounding = glm::abs(Vec3(point[0], point[1], point[2]) - surface.point);
  for (int axis = 0; axis < 3; ++axis) {
    error[axis] = std::nextafter(static_cast<float>(rounding[axis] + surface.point_error[axis]), kInfinity);
  }
  store(surface.geometric_normal, normal);
  store(glm::normalize(arrival.to_light), toward);

  Ray ray;
  offset_origin(point, error, normal, toward, ray.origin);
  const Vec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
  const bool has_place = arrival.tmax == 1;
  store(has_place ? arrival.to_light + (surface.point - origin) : arrival.to_light, ray.direction);
  ray.tmin = 0;
  ray.tmax = arrival.tmax;
  return ray;
}

}  // namespace umbrix::render
