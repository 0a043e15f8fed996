// SPDX-License-Identifier: Apache-2.0
// The metallic-roughness material of glTF 2.0 (Khronos Group 2021), appendix B.2 and B.3: Lambert under a microfacet
// layer with the GGX distribution (Trowbridge & Reitz 1975; Walter et al. 2007), height-correlated Smith masking
// (Heitz 2014) and Schlick's Fresnel (1994).
#include "render/bsdf.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace umbrix::render {
namespace {

/// A perfect mirror shows a punctual light in no direction or as an infinity; a floor makes it a tiny, finite spot.
constexpr double kSmallestAlpha = 1e-3;

/// Interpolated normals may turn away from the viewer at silhouettes; the surface is seen all the same.
constexpr double kSmallestCosine = 1e-4;

double ggx_distribution(double normal_half, double alpha2) {
  const double base = normal_half * normal_half * (alpha2 - 1) + 1;
  return alpha2 / (kPi * base * base);
}

/// Masking and shadowing over 4 (n.l)(n.v), as in appendix B.3.2's V.
double smith_visibility(double normal_light, double normal_view, double alpha2) {
  const double light = std::sqrt(alpha2 + (1 - alpha2) * normal_light * normal_light);
  const double view = std::sqrt(alpha2 + (1 - alpha2) * normal_view * normal_view);
  return 0.5 / (normal_view * light + normal_light * view);
}

}  // namespace

Rgb evaluate_bsdf(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, const Vec3& wi) {
  const Rgb base = material.base_color;
  const double metallic = material.metallic;
  const Rgb diffuse_color = base * (1 - metallic);
  const Rgb f0 = glm::mix(material.dielectric_f0, base, metallic);
  const double f90 = glm::mix(material.dielectric_f90, 1.0, metallic);
  const double alpha = std::max(material.roughness * material.roughness, kSmallestAlpha);

  const Vec3 half = glm::normalize(wo + wi);
  const double view_half = std::clamp(glm::dot(wo, half), 0.0, 1.0);
  const double grazing = 1 - view_half;
  const Rgb fresnel = f0 + (f90 - f0) * (grazing * grazing * grazing * grazing * grazing);

  const double normal_light = std::max(glm::dot(normal, wi), kSmallestCosine);
  const double normal_view = std::max(glm::dot(normal, wo), kSmallestCosine);
  const double specular = ggx_distribution(std::clamp(glm::dot(normal, half), 0.0, 1.0), alpha * alpha) *
                          smith_visibility(normal_light, normal_view, alpha * alpha);
  return (1.0 - fresnel) * diffuse_color / kPi + fresnel * specular;
}

}  // namespace umbrix::render
