// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/shadow_ray.h"
#include "render/surface.h"

namespace umbrix::render {

inline Surface surface_at(const World& world, const Ray& ray, const Hit& hit) {
  Surface surface;
  find_surface(world, ray, hit, surface);
  return surface;
}

inline Ray shadow_ray(const Receiver& receiver, const Arrival& arrival) {
  Ray ray;
  find_shadow_ray(receiver, arrival, ray);
  return ray;
}

}  // namespace umbrix::render
