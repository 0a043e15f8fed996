// SPDX-License-Identifier: Apache-2.0
#include "render/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "light_estimates.h"

namespace umbrix::render {
namespace {

const Vec3 kNormal(0, 0, 1);

Vec3 direction(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return Vec3(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
}

BsdfParameters material(double metallic, double roughness) { return {Rgb(1), metallic, roughness}; }

/// The light that leaves towards `wo` if all directions bring 1: at most 1 for a surface that makes no light.
double white_furnace(const BsdfParameters& m, const Vec3& wo) {
  constexpr int kRows = 1024, kColumns = 1024;
  double sum = 0;
  for (int i = 0; i < kRows; ++i) {
    // Equal steps of the squared sine are equal shares of the projected hemisphere.
    const double cosine = std::sqrt(1 - (i + 0.5) / kRows);
    for (int j = 0; j < kColumns; ++j)
      sum += evaluate_bsdf(m, kNormal, wo, direction(cosine, 2 * kPi * (j + 0.5) / kColumns)).r;
  }
  return sum * kPi / (kRows * kColumns);
}

TEST(Bsdf, DoesNotChangeWhenLightTurnsRound) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> cosine(0.05, 1), azimuth(0, 2 * kPi), unit(0, 1);
  for (int i = 0; i < 1000; ++i) {
    BsdfParameters m = material(static_cast<float>(unit(random)), static_cast<float>(unit(random)));
    m.base_color = {0.9f, 0.5f, 0.1f};
    const Vec3 wo = direction(cosine(random), azimuth(random));
    const Vec3 wi = direction(cosine(random), azimuth(random));
    const Rgb there = evaluate_bsdf(m, kNormal, wo, wi), back = evaluate_bsdf(m, kNormal, wi, wo);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-12 * there[c]);
  }
}

TEST(Bsdf, WhiteMetalReflectsAllThatArrives) {
  for (const float roughness : {0.3f, 0.5f, 0.8f, 1.0f}) {
    for (const double cosine : {1.0, 0.7, 0.3, 0.1}) {
      const double reflected = white_furnace(material(1, roughness), direction(cosine, 0.3));
      EXPECT_NEAR(reflected, 1, 0.008) << roughness << " " << cosine;
    }
  }
}

// glTF's mix of Lambert and the layer above may exceed 1 at grazing views of smooth surfaces, by design of the format.
TEST(Bsdf, WhiteDielectricReflectsAboutWhatArrivesAwayFromGrazing) {
  for (const float roughness : {0.3f, 0.6f, 1.0f}) {
    for (const double cosine : {1.0, 0.8, 0.6}) {
      const double reflected = white_furnace(material(0, roughness), direction(cosine, 0.3));
      EXPECT_LE(reflected, 1.01) << roughness << " " << cosine;
      EXPECT_GT(reflected, 0.9) << roughness << " " << cosine;
    }
  }
}

TEST(Bsdf, RoughDielectricSeenStraightOnHasTheClosedForm) {
  // F = 0.04; D = 1/pi and V = 1/4 for alpha = 1.
  EXPECT_NEAR(evaluate_bsdf(material(0, 1), kNormal, kNormal, kNormal).r, (0.96 + 0.04 / 4) / kPi, 1e-12);
}

TEST(Bsdf, SmoothMetalHasTheColourOfItsBase) {
  BsdfParameters m = material(1, 0);
  m.base_color = {1, 0.5f, 0};
  const Rgb f = evaluate_bsdf(m, kNormal, kNormal, kNormal);
  EXPECT_NEAR(f.g / f.r, 0.5, 1e-6);
  EXPECT_NEAR(f.b / f.r, 0, 1e-6);
}

/// The mean over chosen directions of a function over their density is its integral.
TEST(Bsdf, ChosenDirectionsHaveTheDensityThatIsSaid) {
  constexpr std::uint32_t kCount = 40000;
  for (const auto& [metallic, roughness] : {std::pair(0.0, 1.0), {0.0, 0.3}, {1.0, 0.5}, {0.5, 0.2}, {1.0, 1.0}}) {
    for (const double cosine : {1.0, 0.6, 0.2}) {
      const BsdfParameters m = material(metallic, roughness);
      const Vec3 wo = direction(cosine, 0.3);
      MeanSum reflected, solid_angle;
      for (std::uint32_t i = 0; i < kCount; ++i) {
        const SamplePoint u = purpose_sample(0, 0, 1, i, kCount, 5);
        const Vec3 wi = sample_bsdf(m, kNormal, wo, purpose_sample(0, 0, 2, i, kCount, 5).x, u);
        const double density = bsdf_density(m, kNormal, wo, wi);
        reflected.add(wi.z > 0 ? evaluate_bsdf(m, kNormal, wo, wi).r * wi.z / density : 0);
        solid_angle.add(wi.z > 0 ? 1 / density : 0);
      }
      // Quadrature is good to about a thousandth here.
      const Mean mean = reflected.mean();
      EXPECT_NEAR(mean.value, white_furnace(m, wo), 5 * mean.error + 0.002)
          << metallic << " " << roughness << " " << cosine;
      // Sharp lobes choose the rest of the hemisphere too rarely for a mean.
      if (roughness == 1.0) expect_mean(solid_angle.mean(), 2 * kPi);
    }
  }
}

TEST(Bsdf, MirrorAndGrazingStayFinite) {
  for (const double cosine : {1.0, 1e-9, -1e-9}) {
    const Vec3 wo = direction(cosine, 0), wi = direction(std::abs(cosine), kPi);
    const Rgb f = evaluate_bsdf(material(1, 0), kNormal, wo, wi);
    EXPECT_TRUE(std::isfinite(f.r) && f.r >= 0) << cosine;
  }
}

}  // namespace
}  // namespace umbrix::render
