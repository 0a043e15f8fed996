// SPDX-License-Identifier: Apache-2.0
// KHR_lights_punctual (Khronos Group 2018): intensity in lux, the irradiance of a facing surface anywhere.
#include <limits>

#include "render/lights/light.h"

namespace umbrix::render {
namespace {

Arrival arrive_from_direction(const io::Light& light, const Vec3&) {
  Arrival arrival;
  arrival.to_light = -to_vec3(light.direction);
  arrival.tmax = std::numeric_limits<float>::infinity();
  arrival.irradiance = to_vec3(light.color) * double{light.intensity};
  if (arrival.irradiance == Rgb(0)) arrival.unreached = Unreached::no_power;
  return arrival;
}

}  // namespace

extern const LightKind k_directional_light = {PunctualLight<arrive_from_direction>::make};

}  // namespace umbrix::render
