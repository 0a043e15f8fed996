// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_samples.h"
#include "render/vec.h"

namespace umbrix::render {

/// What glTF's metallic-roughness material is at a point.
struct BsdfParameters {
  Rgb base_color{1};  ///< linear
  double metallic = 1;
  double roughness = 1;  ///< perceptual: its square is the GGX distribution's alpha
  /// What is not metal reflects at normal incidence, and at grazing angles.
  Rgb dielectric_f0{0.04};
  double dielectric_f90 = 1;
};

/// Reflects nothing.
inline const BsdfParameters kBlack{Rgb(0), 0, 1, Rgb(0), 0};

/// The share of light from `wi` that leaves towards `wo`, per steradian, without the cosine. All unit vectors, pointing
/// away from the surface, the directions on the normal's side.
Rgb evaluate_bsdf(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, const Vec3& wi);

/// A unit direction from which light may come that leaves towards `wo`, about in proportion to how much of it does;
/// `lobe` in [0, 1) and `u` choose. It may lie below the surface: that is no light.
Vec3 sample_bsdf(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, double lobe, const SamplePoint& u);

/// The density of the directions that sample_bsdf makes, per steradian.
double bsdf_density(const BsdfParameters& material, const Vec3& normal, const Vec3& wo, const Vec3& wi);

}  // namespace umbrix::render
