// SPDX-License-Identifier: Apache-2.0
#include "index/instance_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/float_mode.h"
#include "core/parallel_for.h"
#include "index/placed_bounds.h"
#include "tree/scale.h"

namespace umbrix::detail {

std::uint32_t InstanceTree::add_prototype(Prototype prototype) {
  prototypes_.push_back(std::move(prototype));
  return static_cast<std::uint32_t>(prototypes_.size() - 1);
}

bool InstanceTree::add(const Instance& instance, std::uint32_t mesh) {
  const DefaultFloatMode mode;
  const Prototype& prototype = prototypes_[instance.prototype];
  if (!prototype.is_exact() || prototype.bounds().empty()) return false;
  PlacedInstance placed{};
  // By powers of two, so that placed vertices have the same bits.
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      placed.to_world[row][column] = std::ldexp(instance.to_world[row][column], -prototype.exponent());
    placed.to_world[row][3] = instance.to_world[row][3];
  }
  if (!make_local_frame(placed.to_world, prototype.bounds(), placed.frame)) return false;
  placed.prototype = instance.prototype;
  placed.mesh = mesh;
  placed.mask = instance.mask;
  placed.opacity = instance.opacity;
  instances_.push_back(placed);
  return true;
}

void InstanceTree::build(const Executor* executor) {
  std::vector<bool> used(prototypes_.size());
  for (const PlacedInstance& instance : instances_) used[instance.prototype] = true;
  for (std::size_t i = 0; i < prototypes_.size(); ++i) {
    if (used[i])
      prototypes_[i].build(executor);
    else
      prototypes_[i] = Prototype({});
  }
  if (empty()) return;

  std::vector<Triangle> boxes(instances_.size());
  constexpr std::size_t kChunk = 64;
  parallel_for(executor, (boxes.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const DefaultFloatMode mode;
    for (std::size_t i = chunk * kChunk; i < std::min(boxes.size(), (chunk + 1) * kChunk); ++i) {
      PlacedInstance& instance = instances_[i];
      const Box box = placed_bounds(prototypes_[instance.prototype].bvh(), instance.to_world);
      boxes[i] = {{box.lower, box.upper, box.lower}};
      for (int axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.lower[axis]), high = static_cast<double>(box.upper[axis]);
        instance.reach += std::max(std::abs(low), std::abs(high));
        instance.edge += high - low;
      }
    }
  });
  for (const Triangle& box : boxes) bounds_.extend(Box{box.v[0], box.v[1]});
  const int exponent = scale_exponent(bounds_);
  frame_ = scaled_frame(exponent);
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  boxes_ = TriangleBvh(boxes.data(), all.data(), all.size(), exponent, 0, executor);
}

std::uint64_t InstanceTree::bytes() const noexcept {
  std::uint64_t sum = boxes_.bytes() + instances_.size() * sizeof(PlacedInstance);
  for (const Prototype& prototype : prototypes_)
    sum += prototype.bvh().bytes() + prototype.triangles().size() * sizeof(Triangle);
  return sum;
}

}  // namespace umbrix::detail
