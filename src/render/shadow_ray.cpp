// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_ray.h"

#include <limits>

namespace umbrix::render {
namespace {

/// Moves the way's end off the light as offset_origin moves a point off its triangle. What may put the end behind the
/// light: the light's own error, the rounding of the end to float, which offset_origin needs, and that of the way,
/// which is what the ray is made of.
Vec3 before_light(const Vec3& origin, const Vec3& way, const Arrival& arrival) {
  const Vec3 end = origin + way;
  const Vec3 error = (glm::abs(end) + glm::abs(way)) * 0x1p-24 + arrival.error;
  // The normal is rounded to float as well, and the way changes a little: a thousandth more is ample.
  constexpr double kMargin = 1.001;
  float point[3], point_error[3], normal[3], moved[3];
  store(end, point);
  store(error * kMargin + double{std::numeric_limits<float>::denorm_min()}, point_error);
  store(arrival.normal, normal);
  offset_origin(point, point_error, normal, normal, moved);
  return load(moved) - origin;
}

}  // namespace

Receiver receiver_at(const Surface& surface) { return {surface.point, surface.origin, surface.shading_normal}; }

void find_shadow_ray(const Receiver& receiver, const Arrival& arrival, Ray& ray) {
  Vec3 way = arrival.to_light;
  if (arrival.tmax == 1) way += receiver.point - receiver.origin;
  if (arrival.normal != Vec3(0)) way = before_light(receiver.origin, way, arrival);
  store(receiver.origin, ray.origin);
  store(way, ray.direction);
  ray.tmin = 0;
  ray.tmax = arrival.tmax;
}

}  // namespace umbrix::render
