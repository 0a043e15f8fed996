// SPDX-License-Identifier: Apache-2.0
//
// The triangle's bounding sphere against the line, in double; then double_filter.h, then exact numbers.
#include "oracle/brute_force.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace umbrix::oracle {

BruteForce::BruteForce(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  const DefaultFloatMode mode;
  for (std::vector<double>& axis : center_) axis.resize(triangles_.size());
  radius_squared_.resize(triangles_.size());
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto& v = triangles_[i].v;
    for (std::size_t k = 0; k < 3; ++k) center_[k][i] = (double{v[0][k]} + double{v[1][k]} + double{v[2][k]}) / 3;
    double largest = 0;
    for (const auto& corner : v) {
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double offset = corner[k] - center_[k][i];
        squared += offset * offset;
      }
      largest = squared > largest || std::isnan(squared) ? squared : largest;
    }
    // Any centre will do as long as the sphere holds the corners; 1e-12 is thousands of roundings.
    radius_squared_[i] = largest * (1 + 1e-12);
  }
}

// Calls body(triangle) for each whose sphere the line may meet, until it returns false.
template <typename Body>
void BruteForce::for_each_near(const Ray& ray, const Body& body) const {
  const double ox = ray.origin[0], oy = ray.origin[1], oz = ray.origin[2];
  const double dx = ray.direction[0], dy = ray.direction[1], dz = ray.direction[2];
  const double d_squared = dx * dx + dy * dy + dz * dz;
  constexpr std::size_t kBlock = 64;
  std::array<std::uint8_t, kBlock> near;
  for (std::size_t begin = 0; begin < triangles_.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, triangles_.size() - begin);
    const double* cx = center_[0].data() + begin;
    const double* cy = center_[1].data() + begin;
    const double* cz = center_[2].data() + begin;
    const double* r_squared = radius_squared_.data() + begin;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = cx[i] - ox, y = cy[i] - oy, z = cz[i] - oz;
      const double nx = y * dz - z * dy, ny = z * dx - x * dz, nz = x * dy - y * dx;
      // |x cross d| > r |d| is a miss. The cross product's error is below 8 units of |x||d|; 1e-13 is 900 units.
      const double limit = (r_squared[i] * (1 + 1e-12) + 1e-13 * (x * x + y * y + z * z)) * d_squared;
      near[i] = !(nx * nx + ny * ny + nz * nz > limit);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (near[i] != 0 && !body(static_cast<std::uint32_t>(begin + i))) return;
    }
  }
}

bool BruteForce::occluded(const Ray& ray, const Visible& visible) const {
  return decide_occluded(ray, triangles_, visible, [&](const auto& body) { for_each_near(ray, body); });
}

std::optional<Closest> BruteForce::closest(const Ray& ray, const Visible& visible) const {
  return decide_closest(ray, triangles_, visible, [&](const auto& body) { for_each_near(ray, body); });
}

std::vector<std::uint8_t> BruteForce::occluded(const std::vector<Ray>& rays) const {
  std::vector<std::uint8_t> out(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { out[i] = occluded(rays[i]) ? 1 : 0; });
  return out;
}

}  // namespace umbrix::oracle
