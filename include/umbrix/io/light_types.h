// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace umbrix::io {

/// What a type of light has, which is what of a Light it reads and what files may say of it.
enum LightTrait : unsigned {
  kHasPosition = 1,
  kHasDirection = 2,
  kHasCone = 4,
  kHasArea = 8,        ///< points of its own: Light::intensity is a radiance, and its rays are chosen at random
  kHasEdges = 16,      ///< Light::half_edges
  kHasRadius = 32,     ///< Light::radius
  kSurrounds = 64,     ///< infinitely far in all directions; Light::environment
  kFromMaterial = 128  ///< an emissive mesh: Light::instance
};

/// The types of light, one line each: the name that files use, and traits. Those without an area are the types of
/// KHR_lights_punctual.
#define UMBRIX_LIGHT_TYPES(TYPE)                                       \
  TYPE(point, kHasPosition)                                            \
  TYPE(spot, kHasPosition | kHasDirection | kHasCone)                  \
  TYPE(directional, kHasDirection)                                     \
  TYPE(rectangle, kHasPosition | kHasDirection | kHasArea | kHasEdges) \
  TYPE(sphere, kHasPosition | kHasArea | kHasRadius)                   \
  TYPE(environment, kHasArea | kSurrounds)                             \
  TYPE(mesh, kHasArea | kFromMaterial)

#define UMBRIX_ENUMERATE(name, traits) name,
enum class LightType { UMBRIX_LIGHT_TYPES(UMBRIX_ENUMERATE) };
#undef UMBRIX_ENUMERATE

struct LightTypeInfo {
  const char* name;
  unsigned traits;  ///< LightTrait

  constexpr bool has(LightTrait trait) const noexcept { return (traits & trait) != 0; }
};

#define UMBRIX_DESCRIBE(name, traits) {#name, traits},
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
