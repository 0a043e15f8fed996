// SPDX-License-Identifier: Apache-2.0
// Khronos Group 2021, glTF 2.0, appendix B.2 and B.3: Lambert under a microfacet layer with the GGX distribution and
// Schlick's Fresnel (1994). Light that leaves a metal after more than one reflection, which the appendix drops (so that
// rough metal is too dark), is added as a lobe of its own (Kulla & Conty 2017; with a Fresnel term for each reflection,
// Hill 2018). Of dielectrics it would be less than a hundredth.
#include "render/bsdf.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "render/ggx.h"
#include "render/sampling/directions.h"

namespace umbrix::render {
namespace {

/// A perfect mirror shows a punctual light in no direction or as an infinity; a floor makes it a tiny, finite spot.
constexpr double kSmallestAlpha = 1e-3;

/// Interpolated normals may turn away from the viewer at silhouettes; the surface is seen all the same.
constexpr double kSmallestCosine = 1e-4;

double clamped_cosine(const Vec3& normal, const Vec3& direction) {
  return std::max(glm::dot(normal, direction), kSmallestCosine);
}

double strongest(const Rgb& color) { return std::max({color.r, color.g, color.b}); }

double power5(double x) { return x * x * x * x * x; }

/// The material as its lobes need it.
struct Lobes {
  explicit Lobes(const BsdfParameters& material)
      : diffuse(material.base_color * (1 - material.metallic)),
        f0(glm::mix(material.dielectric_f0, material.base_color, material.metallic)),
        complement((strongest(material.dielectric_f0) - material.dielectric_f0) * (1 - material.metallic)),
        f90(glm::mix(material.dielectric_f90, 1.0, material.metallic)),
        metallic(material.metallic),
        alpha(std::max(material.roughness * material.roughness, kSmallestAlpha)) {}

  Rgb fresnel(double view_half) const { return f0 + (f90 - f0) * power5(1 - view_half); }

  /// What gets below the layer. Of a coloured dielectric its strongest channel counts for all (KHR_materials_specular):
  /// else the layer's complement would show.
  Rgb transmitted(double view_half) const {
    return 1.0 - fresnel(view_half) - complement * (1 - power5(1 - view_half));
  }

  /// Of light that was reflected more than once: 1 for a white metal.
  Rgb repeated_fresnel(double mean_albedo) const {
    const Rgb mean = f0 + (1.0 - f0) / 21.0;
    return metallic * mean * mean * mean_albedo / (1.0 - mean * (1 - mean_albedo));
  }

  /// How often a direction is chosen by the microfacets, else by the cosine.
  double specular_share(double normal_view) const {
    const double mirrored = luminance(fresnel(normal_view));
    double spread = luminance(diffuse) * (1 - mirrored);
    if (metallic > 0) {
      const double mean = ggx_mean_albedo(alpha);
      spread += luminance(repeated_fresnel(mean)) * (1 - mean);
    }
    return mirrored + spread > 0 ? mirrored / (mirrored + spread) : 1;
  }

  Rgb diffuse, f0, complement;
  double f90, metallic, alpha;
};

/// What is reflected more than once, about evenly.
Rgb repeated_reflections(const Lobes& lobes, double normal_light, double normal_view) {
  if (!(lobes.metallic > 0)) return Rgb(0);
  const double mean = ggx_mean_albedo(lobes.alpha);
  if (!(mean < 1)) return Rgb(0);
  const double lost = (1 - ggx_albedo(normal_light, lobes.alpha)) * (1 - ggx_albedo(normal_view, lobes.alpha));
  return lobes.repeated_fresnel(mean) * (lost / (kPi * (1 - mean)));
}

/// In the normal's frame, and above the surface if only just.
Vec3 local_view(const Frame3& frame, const Vec3& wo) {
  const Vec3 local(glm::dot(frame.x, wo), glm::dot(frame.y, wo), glm::dot(frame.z, wo));
  return local.z >= kSmallestCosine ? local : glm::normalize(Vec3(local.x, local.y, kSmallestCosine));
}

}  // namespace

Rgb evaluate_bsdf(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, const Vec3& wi) {
  const Lobes lobes(material);
  const Vec3 half = glm::normalize(wo + wi);
  const double view_half = std::clamp(glm::dot(wo, half), 0.0, 1.0);
  const double normal_light = clamped_cosine(normal, wi), normal_view = clamped_cosine(normal, wo);
  const double alpha2 = lobes.alpha * lobes.alpha;
  const double specular = ggx_distribution(std::clamp(glm::dot(normal, half), 0.0, 1.0), alpha2) *
                          smith_visibility(normal_light, normal_view, alpha2);
  return lobes.transmitted(view_half) * lobes.diffuse / kPi + lobes.fresnel(view_half) * specular +
         repeated_reflections(lobes, normal_light, normal_view);
}

Vec3 sample_bsdf(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, double lobe,
                 const SamplePoint& u) {
  const Lobes lobes(material);
  const Frame3 frame(normal);
  const Vec3 view = local_view(frame, wo);
  if (lobe >= lobes.specular_share(view.z)) return frame.to_world(cosine_hemisphere(u));
  const Vec3 half = sample_visible_normal(view, lobes.alpha, u);
  return glm::normalize(frame.to_world(2 * glm::dot(view, half) * half - view));
}

double bsdf_density(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, const Vec3& wi) {
  const Lobes lobes(material);
  const Frame3 frame(normal);
  const Vec3 view = local_view(frame, wo);
  const double share = lobes.specular_share(view.z);
  const Vec3 light(glm::dot(frame.x, wi), glm::dot(frame.y, wi), glm::dot(frame.z, wi));
  const double normal_half = glm::normalize(view + light).z;
  return share * visible_normal_density(normal_half, view.z, lobes.alpha * lobes.alpha) +
         (1 - share) * std::max(light.z, 0.0) / kPi;
}

}  // namespace umbrix::render
