// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/decide.h"

namespace umbrix::oracle {

/// Every triangle against every ray, with exact answers and no tree to trust. Const calls are thread-safe, and do not
/// depend on the caller's floating-point mode.
class BruteForce {
 public:
  explicit BruteForce(std::vector<Triangle> triangles);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  bool occluded(const Ray& ray, const Visible& visible = {}) const;

  /// The smallest t; among equals the lowest triangle.
  std::optional<Closest> closest(const Ray& ray, const Visible& visible = {}) const;

  /// occluded() for each ray, over all cores.
  std::vector<std::uint8_t> occluded(const std::vector<Ray>& rays) const;

 private:
  template <typename Body>
  void for_each_near(const Ray& ray, const Body& body) const;

  std::vector<Triangle> triangles_;
  // A sphere around each triangle, as arrays so that the first rejection is a vector loop.
  std::vector<double> center_[3];
  std::vector<double> radius_squared_;
};

}  // namespace umbrix::oracle
