// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual (Khronos Group 2018), "Inner and Outer Cone Angles": a point light whose intensity falls smoothly
// from the inner to the outer cone, as the square of a ramp in the cosine.
#include <algorithm>
#include <cmath>

#include "render/lights/light.h"

namespace umbrix::render {
namespace {

Arrival arrive_from_spot(const io::Light& light, const Vec3& point) {
  Arrival arrival = arrive_from_position(light, point);
  if (arrival.unreached != Unreached::no) return arrival;
  const double cos_outer = std::cos(double{light.outer_cone_angle});
  const double cos_inner = std::cos(double{light.inner_cone_angle});
  const double cosine = -glm::dot(glm::normalize(arrival.to_light), to_vec3(light.direction));
  const double ramp = (cosine - cos_outer) / std::max(0.001, cos_inner - cos_outer);
  if (ramp <= 0) {
    arrival.unreached = Unreached::outside_cone;
    return arrival;
  }
  const double inside = std::min(ramp, 1.0);
  arrival.irradiance *= inside * inside;
  return arrival;
}

}  // namespace

extern const LightKind k_spot_light = {PunctualLight<arrive_from_spot>::make};

}  // namespace umbrix::render
