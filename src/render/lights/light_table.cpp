// SPDX-License-Identifier: Apache-2.0
// One LightKind for each line of UMBRIX_LIGHT_TYPES, in that order: k_NAME_light, defined in NAME_light.cpp.
#include "render/lights/light.h"

namespace umbrix::render {

#define UMBRIX_DECLARE_LIGHT(name, traits) extern const LightKind k_##name##_light;
UMBRIX_LIGHT_TYPES(UMBRIX_DECLARE_LIGHT)
#undef UMBRIX_DECLARE_LIGHT

std::unique_ptr<Light> make_light(const io::Light& light, const World& world) {
#define UMBRIX_LIST_LIGHT(name, traits) &k_##name##_light,
  static const LightKind* const table[] = {UMBRIX_LIGHT_TYPES(UMBRIX_LIST_LIGHT)};
#undef UMBRIX_LIST_LIGHT
  return table[static_cast<std::size_t>(light.type)]->make(light, world);
}

double Light::density(const Receiver&, const Vec3&, const Surface*) const { return 0; }

Rgb Light::background(const Vec3&) const { return Rgb(0); }

Rgb radiance_of(const io::Light& light) { return to_vec3(light.color) * double{light.intensity}; }

}  // namespace umbrix::render
