// SPDX-License-Identifier: Apache-2.0
#include "render/bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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
  constexpr int kSteps = 512;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    // Equal steps of the squared sine are equal shares of the projected hemisphere.
    const double cosine = std::sqrt(1 - (i + 0.5) / kSteps);
    for (int j = 0; j < kSteps; ++j)
      sum += evaluate_bsdf(m, kNormal, wo, direction(cosine, 2 * kPi * (j + 0.5) / kSteps)).r;
  }
  return sum * kPi / (kSteps * kSteps);
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

TEST(Bsdf, WhiteMetalReflectsAtMostWhatArrives) {
  for (const float roughness : {0.3f, 0.5f, 0.8f, 1.0f}) {
    for (const double cosine : {1.0, 0.7, 0.3, 0.1}) {
      const double reflected = white_furnace(material(1, roughness), direction(cosine, 0.3));
      EXPECT_LE(reflected, 1.001) << roughness << " " << cosine;
      EXPECT_GT(reflected, 0.3) << roughness << " " << cosine;
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

TEST(Bsdf, MetalHasTheColourOfItsBase) {
  BsdfParameters m = material(1, 0.5f);
  m.base_color = {1, 0.5f, 0};
  const Rgb f = evaluate_bsdf(m, kNormal, kNormal, kNormal);
  EXPECT_NEAR(f.g, 0.5 * f.r, 1e-12);
  EXPECT_EQ(f.b, 0);
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
