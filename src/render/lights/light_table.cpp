// SPDX-License-Identifier: Apache-2.0
#include "render/lights/light.h"
#include "render/render.h"

namespace umbrix::render {

extern const LightKind kPointLight, kSpotLight, kDirectionalLight;

const LightKind& light_kind(io::LightType type) {
  static const LightKind* const table[] = {&kPointLight, &kSpotLight, &kDirectionalLight};
  for (const LightKind* kind : table) {
    if (kind->type == type) return *kind;
  }
  return kPointLight;
}

const char* light_type_name(io::LightType type) { return light_kind(type).name; }

}  // namespace umbrix::render
