// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render/pixel_samples.h"
#include "render/vec.h"

/// The GGX microfacet distribution (Trowbridge & Reitz 1975; Walter et al. 2007), isotropic; cosines are with the
/// normal.
namespace umbrix::render {

/// Density of microfacets by the cosine of their normal; `alpha2` is alpha squared.
double ggx_distribution(double normal_half, double alpha2);

/// Height-correlated masking and shadowing over 4 (n.l)(n.v) (Heitz 2014), as glTF's appendix B.3.2 has it.
double smith_visibility(double normal_light, double normal_view, double alpha2);

/// A microfacet normal by how much of it the unit direction `wo` sees; both in the frame of the normal, +z, which wo is
/// above (Dupuy & Benyoub 2023).
Vec3 sample_visible_normal(const Vec3& wo, double alpha, const SamplePoint& u);

/// Density, per steradian, of the direction that such a normal mirrors wo to, from the normal's own cosine and wo's.
double visible_normal_density(double normal_half, double normal_view, double alpha2);

/// The share of light along a direction that is reflected by microfacets which are perfect mirrors, at the first
/// reflection; what is left is reflected again. Within 0.004.
double ggx_albedo(double cosine, double alpha);

/// Its mean over all directions, weighted by the cosine.
double ggx_mean_albedo(double alpha);

}  // namespace umbrix::render
