// SPDX-License-Identifier: Apache-2.0
#include "render/ggx.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace umbrix::render {
namespace {

double root(double normal_view, double alpha2) { return std::sqrt(alpha2 + (1 - alpha2) * normal_view * normal_view); }

/// What is reflected at once, tabulated over cosine and roughness (alpha's root), both in equal steps from 0 to 1.
class AlbedoTable {
 public:
  AlbedoTable() {
    for (std::size_t r = 0; r < kSteps; ++r) {
      const double roughness = place(r), alpha = std::max(roughness * roughness, 1e-4);
      for (std::size_t c = 0; c < kSteps; ++c) albedo_[r][c] = integrate(std::max(place(c), 1e-3), alpha);
      // Between the nodes it is linear, and so is the cosine: Simpson's rule is exact.
      for (std::size_t c = 1; c < kSteps; ++c) {
        const double a = albedo_[r][c - 1], b = albedo_[r][c], x = place(c - 1), y = place(c);
        mean_[r] += 2 * (y - x) / 6 * (a * x + (a + b) * (x + y) + b * y);
      }
    }
  }

  double at(double cosine, double alpha) const {
    const Node r = node(std::sqrt(alpha)), c = node(cosine);
    const auto row = [&](std::size_t i) { return glm::mix(albedo_[i][c.below], albedo_[i][c.below + 1], c.rest); };
    return glm::mix(row(r.below), row(r.below + 1), r.rest);
  }

  double mean(double alpha) const {
    const Node r = node(std::sqrt(alpha));
    return glm::mix(mean_[r.below], mean_[r.below + 1], r.rest);
  }

 private:
  static constexpr std::size_t kSteps = 33;

  struct Node {
    std::size_t below;
    double rest;
  };

  static double place(std::size_t i) { return static_cast<double>(i) / (kSteps - 1); }

  static Node node(double x) {
    const double scaled = std::clamp(x, 0.0, 1.0) * (kSteps - 1);
    const auto below = std::min(static_cast<std::size_t>(scaled), kSteps - 2);
    return {below, scaled - static_cast<double>(below)};
  }

  /// The mean, over normals chosen as they are seen, of what shadowing leaves.
  static double integrate(double cosine, double alpha) {
    constexpr int kHeights = 64, kAzimuths = 8;  // of one half: the other is its mirror image
    const Vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
    const double alpha2 = alpha * alpha;
    double sum = 0;
    for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
      for (int height = 0; height < kHeights; ++height) {
        const SamplePoint u = {(azimuth + 0.5) / (2 * kAzimuths), (height + 0.5) / kHeights};
        const Vec3 half = sample_visible_normal(wo, alpha, u);
        const double normal_light = 2 * glm::dot(wo, half) * half.z - wo.z;
        if (!(normal_light > 0)) continue;
        sum += 2 * smith_visibility(normal_light, cosine, alpha2) * normal_light * (cosine + root(cosine, alpha2));
      }
    }
    return std::min(sum / (kAzimuths * kHeights), 1.0);
  }

  std::array<std::array<double, kSteps>, kSteps> albedo_{};  ///< by roughness, then cosine
  std::array<double, kSteps> mean_{};
};

const AlbedoTable& albedo_table() {
  static const AlbedoTable table;
  return table;
}

}  // namespace

double ggx_distribution(double normal_half, double alpha2) {
  const double base = normal_half * normal_half * (alpha2 - 1) + 1;
  return alpha2 / (kPi * base * base);
}

double smith_visibility(double normal_light, double normal_view, double alpha2) {
  return 0.5 / (normal_view * root(normal_light, alpha2) + normal_light * root(normal_view, alpha2));
}

Vec3 sample_visible_normal(const Vec3& wo, double alpha, const SamplePoint& u) {
  // As the hemisphere that the ellipsoid is stretched to sees it: a cap of the sphere, uniformly.
  const Vec3 stretched = glm::normalize(Vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const double azimuth = 2 * kPi * u.x;
  const double height = (1 - u.y) * (1 + stretched.z) - stretched.z;
  const double radius = std::sqrt(std::clamp(1 - height * height, 0.0, 1.0));
  const Vec3 half = Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), height) + stretched;
  return glm::normalize(Vec3(alpha * half.x, alpha * half.y, std::max(half.z, 1e-12)));
}

double visible_normal_density(double normal_half, double normal_view, double alpha2) {
  return ggx_distribution(normal_half, alpha2) / (2 * (normal_view + root(normal_view, alpha2)));
}

double ggx_albedo(double cosine, double alpha) { return albedo_table().at(cosine, alpha); }

double ggx_mean_albedo(double alpha) { return albedo_table().mean(alpha); }

}  // namespace umbrix::render
