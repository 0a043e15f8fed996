// SPDX-License-Identifier: Apache-2.0
#include "index/prototype.h"

#include <cmath>
#include <utility>

#include "core/float_mode.h"
#include "tree/scale.h"

namespace umbrix::detail {
namespace {

bool loses_nothing(const Triangle& triangle, int exponent) {
  const Triangle there = scaled(triangle, exponent), back = scaled(there, -exponent);
  for (int i = 0; i < 3; ++i)
    if (back.v[i] != triangle.v[i]) return false;
  return true;
}

}  // namespace

Prototype::Prototype(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), triangle_count_(triangles_.size()) {
  const DefaultFloatMode mode;
  Box bounds;
  for (const Triangle& t : triangles_) {
    if (!is_finite(t)) continue;
    ++kept_count_;
    for (const Vec3& v : t.v) bounds.extend(v);
  }
  if (kept_count_ == 0) return;
  exponent_ = scale_exponent(bounds);
  for (const Triangle& t : triangles_) is_exact_ = is_exact_ && (!is_finite(t) || loses_nothing(t, exponent_));
  const Triangle corners = scaled(Triangle{{bounds.lower, bounds.upper, bounds.upper}}, exponent_);
  bounds_ = {corners.v[0], corners.v[1]};
}

void Prototype::build(const Executor* executor) {
  // Triangles with no area stay: rounding may give them one when they are placed.
  std::vector<std::uint32_t> kept;
  kept.reserve(kept_count_);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    if (is_finite(triangles_[i])) kept.push_back(static_cast<std::uint32_t>(i));
  bvh_ = TriangleBvh(triangles_.data(), kept.data(), kept.size(), exponent_, 0, executor);
  triangles_ = {};
}

}  // namespace umbrix::detail
