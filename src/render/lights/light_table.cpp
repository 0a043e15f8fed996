// SPDX-License-Identifier: Apache-2.0
// One LightKind for each line of UMBRIX_LIGHT_TYPES, in that order: k_NAME_light, defined in NAME_light.cpp.
#include "render/lights/light.h"

namespace umbrix::render {

#define UMBRIX_DECLARE_LIGHT(name, position, direction, cone) extern const LightKind k_##name##_light;
UMBRIX_LIGHT_TYPES(UMBRIX_DECLARE_LIGHT)
#undef UMBRIX_DECLARE_LIGHT

const LightKind& light_kind(io::LightType type) {
#define UMBRIX_LIST_LIGHT(name, position, direction, cone) &k_##name##_light,
  static const LightKind* const table[] = {UMBRIX_LIGHT_TYPES(UMBRIX_LIST_LIGHT)};
#undef UMBRIX_LIST_LIGHT
  return *table[static_cast<std::size_t>(type)];
}

}  // namespace umbrix::render
