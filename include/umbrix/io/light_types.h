// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace umbrix::io {

/// The types of light, one line each: the name that files use, and what of a Light it reads: its position, its
/// direction, its cone.
#define UMBRIX_LIGHT_TYPES(TYPE)  \
  TYPE(point, true, false, false) \
  TYPE(spot, true, true, true)    \
  TYPE(directional, false, true, false)

#define UMBRIX_ENUMERATE(name, position, direction, cone) name,
enum class LightType { UMBRIX_LIGHT_TYPES(UMBRIX_ENUMERATE) };
#undef UMBRIX_ENUMERATE

struct LightTypeInfo {
  const char* name;
  bool has_position;
  bool has_direction;
  bool has_cone;
};

#define UMBRIX_DESCRIBE(name, position, direction, cone) {#name, position, direction, cone},
inline constexpr LightTypeInfo kLightTypes[] = {UMBRIX_LIGHT_TYPES(UMBRIX_DESCRIBE)};
#undef UMBRIX_DESCRIBE

constexpr const LightTypeInfo& light_type_info(LightType type) noexcept {
  return kLightTypes[static_cast<std::size_t>(type)];
}

/// Finds a type by the name that files use.
constexpr bool find_light_type(std::string_view name, LightType& out) noexcept {
  for (std::size_t i = 0; i < sizeof kLightTypes / sizeof *kLightTypes; ++i) {
    if (name != kLightTypes[i].name) continue;
    out = static_cast<LightType>(i);
    return true;
  }
  return false;
}

}  // namespace umbrix::io
