// SPDX-License-Identifier: Apache-2.0
// glTF 2.0 section 3.9, KHR_materials_unlit, KHR_materials_ior and KHR_materials_specular.
#include "render/materials/material_at.h"

#include <glm/common.hpp>

#include "render/materials/texture.h"

namespace umbrix::render {
namespace {

/// The base colour; vertex colours are linear (glTF 2.0 section 3.7.2.1).
Rgba base_color_at(const MeshPoint& point) {
  const io::Material& material = point.material();
  Rgba base = texture_at(point, material.base_color_texture, Transfer::srgb);
  base.color *= to_vec3(material.base_color);
  base.alpha *= static_cast<double>(material.alpha);
  if (!point.mesh.colors.empty()) {
    double color[4];
    point.blend(point.mesh.colors, color);
    base.color *= Rgb(color[0], color[1], color[2]);
    base.alpha *= color[3];
  }
  return base;
}

Rgb emission_color_at(const MeshPoint& point) {
  const io::Material& material = point.material();
  if (material.emission == io::Float3{0, 0, 0}) return Rgb(0);
  return to_vec3(material.emission) * texture_at(point, material.emissive_texture, Transfer::srgb).color;
}

/// What is not metal reflects (ior - 1)^2 / (ior + 1)^2 at normal incidence.
void set_dielectric(const MeshPoint& point, BsdfParameters& bsdf) {
  const io::Material& material = point.material();
  const double ior = static_cast<double>(material.ior), ratio = (ior - 1) / (ior + 1);
  const double strength =
      static_cast<double>(material.specular) * texture_at(point, material.specular_texture, Transfer::linear).alpha;
  const Rgb tint =
      to_vec3(material.specular_color) * texture_at(point, material.specular_color_texture, Transfer::srgb).color;
  bsdf.dielectric_f0 = glm::min(ratio * ratio * tint, Rgb(1)) * strength;
  bsdf.dielectric_f90 = strength;
}

}  // namespace

MaterialPoint material_at(const MeshPoint& point) {
  const io::Material& material = point.material();
  MaterialPoint out;
  const Rgb base = base_color_at(point).color;
  if (material.unlit) {
    out.bsdf = kBlack;
    out.emission = base;
    return out;
  }
  out.bsdf.base_color = base;
  out.bsdf.metallic = static_cast<double>(material.metallic);
  out.bsdf.roughness = static_cast<double>(material.roughness);
  if (material.metallic_roughness_texture.texture >= 0) {
    const Rgb factors = texture_at(point, material.metallic_roughness_texture, Transfer::linear).color;
    out.bsdf.roughness *= factors.g;
    out.bsdf.metallic *= factors.b;
  }
  set_dielectric(point, out.bsdf);
  out.emission = emission_color_at(point);
  return out;
}

Rgb emission_at(const MeshPoint& point) {
  const io::Material& material = point.material();
  const Rgb emission = emission_color_at(point);
  if (material.alpha_mode == io::AlphaMode::opaque) return emission;
  const double alpha = base_color_at(point).alpha;
  if (material.alpha_mode == io::AlphaMode::blend) return emission * glm::clamp(alpha, 0.0, 1.0);
  return alpha >= static_cast<double>(material.alpha_cutoff) ? emission : Rgb(0);
}

}  // namespace umbrix::render
