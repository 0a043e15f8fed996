// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual (Khronos Group 2018): intensity in candela, so the irradiance of a facing surface at distance d
// is intensity / d^2, times a window that brings it to zero at the range.
#include <algorithm>

#include "render/lights/light.h"

namespace umbrix::render {

Arrival arrive_from_position(const io::Light& light, const Vec3& point) {
  Arrival arrival;
  arrival.to_light = to_vec3(light.position) - point;
  const double distance2 = glm::dot(arrival.to_light, arrival.to_light);
  const double range2 = double{light.range} * double{light.range};
  if (distance2 >= range2) {
    arrival.unreached = Unreached::beyond_range;
    return arrival;
  }
  const double fall = distance2 / range2;  // 0 for an infinite range
  const double window = std::clamp(1 - fall * fall, 0.0, 1.0);
  arrival.irradiance = to_vec3(light.color) * (double{light.intensity} * window / distance2);
  // The surface may hold the light itself: no direction, no finite irradiance.
  if (distance2 == 0 || arrival.irradiance == Rgb(0)) arrival.unreached = Unreached::no_power;
  return arrival;
}

extern const LightKind k_point_light = {PunctualLight<arrive_from_position>::make};

}  // namespace umbrix::render
