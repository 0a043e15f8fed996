// SPDX-License-Identifier: Apache-2.0
#include "throughput/light_order.h"

#include <algorithm>
#include <cmath>

namespace umbrix::bench {
namespace {

constexpr std::uint32_t kCells = 64;  // of a face, along a side

std::uint32_t spread(std::uint32_t x) {  // a zero before each of 8 bits
  x = (x | x << 4) & 0x0F0Fu;
  x = (x | x << 2) & 0x3333u;
  return (x | x << 1) & 0x5555u;
}

std::uint32_t cell_of(const Ray& ray) {
  float d[3];
  std::size_t axis = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    d[k] = -ray.direction[k];
    if (std::abs(d[k]) > std::abs(d[axis])) axis = k;
  }
  const auto place = [&](float x) {
    const float scaled = (x / std::abs(d[axis]) + 1) * (0.5f * kCells);
    return std::min(static_cast<std::uint32_t>(std::max(scaled, 0.0f)), kCells - 1);
  };
  const auto face = static_cast<std::uint32_t>(2 * axis + (d[axis] < 0 ? 1 : 0));
  return face * kCells * kCells + (spread(place(d[(axis + 1) % 3])) | spread(place(d[(axis + 2) % 3])) << 1);
}

}  // namespace

void LightOrder::ask(RaySpan rays, std::uint8_t* out, const std::function<void(RaySpan, std::uint8_t*)>& ask) {
  cells_.resize(rays.count);
  places_.resize(rays.count);
  sorted_.resize(rays.count);
  answers_.resize(rays.count);
  ends_.assign(6 * kCells * kCells + 1, 0);
  for (std::size_t i = 0; i < rays.count; ++i) {
    cells_[i] = cell_of(rays[i]);
    ++ends_[cells_[i] + 1];
  }
  for (std::size_t i = 1; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
  for (std::size_t i = 0; i < rays.count; ++i) {
    places_[i] = ends_[cells_[i]]++;
    sorted_[places_[i]] = rays[i];
  }
  ask({sorted_.data(), sorted_.size()}, answers_.data());
  for (std::size_t i = 0; i < rays.count; ++i) out[i] = answers_[places_[i]];
}

}  // namespace umbrix::bench
