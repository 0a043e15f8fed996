// SPDX-License-Identifier: Apache-2.0
#include "index/instance_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/float_mode.h"
#include "core/mesh_triangles.h"
#include "core/parallel_for.h"
#include "index/placed_bounds.h"
#include "tree/scale.h"

namespace umbrix::detail {

std::uint32_t InstanceTree::add_prototype(Prototype prototype) {
  prototypes_.push_back(std::make_shared<Prototype>(std::move(prototype)));
  return static_cast<std::uint32_t>(prototypes_.size() - 1);
}

bool InstanceTree::add(const Instance& instance, std::uint32_t mesh) {
  PlacedInstance placed{};
  placed.prototype = instance.prototype;
  placed.mesh = mesh;
  placed.mask = instance.mask;
  placed.opacity = instance.opacity;
  if (!place(instance.to_world, placed)) return false;
  instances_.push_back(placed);
  return true;
}

bool InstanceTree::place(const double (&to_world)[3][4], PlacedInstance& instance) const {
  const DefaultFloatMode mode;
  const Prototype& prototype = *prototypes_[instance.prototype];
  if (!prototype.is_exact() || prototype.bounds().empty()) return false;
  // By powers of two, so that placed vertices have the same bits.
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      instance.to_world[row][column] = std::ldexp(to_world[row][column], -prototype.exponent());
    instance.to_world[row][3] = to_world[row][3];
  }
  return make_local_frame(instance.to_world, prototype.bounds(), instance.frame);
}

void InstanceTree::build(const Executor* executor) {
  std::vector<bool> used(prototypes_.size());
  for (const PlacedInstance& instance : instances_) used[instance.prototype] = true;
  for (std::size_t i = 0; i < prototypes_.size(); ++i) {
    if (used[i])
      prototypes_[i]->build(executor);
    else
      *prototypes_[i] = Prototype({});
  }
  build_boxes(std::vector<bool>(instances_.size(), true), executor);
}

void InstanceTree::build_boxes(const std::vector<bool>& moved, const Executor* executor) {
  bounds_ = Box();
  if (empty()) return;
  instance_boxes_.resize(instances_.size());
  constexpr std::size_t kChunk = 64;
  parallel_for(executor, (instances_.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const DefaultFloatMode mode;
    for (std::size_t i = chunk * kChunk; i < std::min(instances_.size(), (chunk + 1) * kChunk); ++i) {
      if (!moved[i]) continue;
      PlacedInstance& instance = instances_[i];
      const Box box = placed_bounds(prototypes_[instance.prototype]->bvh(), instance.to_world);
      instance_boxes_[i] = {{box.lower, box.upper, box.lower}};
      instance.reach = instance.edge = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double low = static_cast<double>(box.lower[axis]), high = static_cast<double>(box.upper[axis]);
        instance.reach += std::max(std::abs(low), std::abs(high));
        instance.edge += high - low;
      }
    }
  });
  for (const Triangle& box : instance_boxes_) bounds_.extend(Box{box.v[0], box.v[1]});
  const int exponent = scale_exponent(bounds_);
  frame_ = scaled_frame(exponent);
  std::vector<std::uint32_t> all(instance_boxes_.size());
  std::iota(all.begin(), all.end(), 0u);
  boxes_ = TriangleBvh(instance_boxes_.data(), all.data(), all.size(), exponent, 0, executor);
}

bool InstanceTree::updated(const SceneUpdate& update, InstanceTree& out) const {
  out.prototypes_ = prototypes_;
  out.instances_ = instances_;
  out.instance_boxes_ = instance_boxes_;
  std::vector<bool> moved(instances_.size());
  if (!out.reshape(update, moved) || !out.move(update, moved)) return false;
  for (std::size_t i = 0; i < update.shape_count; ++i)
    out.prototypes_[update.shapes[i].prototype]->build(update.executor);
  out.build_boxes(moved, update.executor);
  return true;
}

// Marks the instances that need another place for it.
bool InstanceTree::reshape(const SceneUpdate& update, std::vector<bool>& moved) {
  std::vector<bool> reshaped(prototypes_.size());
  for (std::size_t i = 0; i < update.shape_count; ++i) {
    const std::uint32_t number = update.shapes[i].prototype;
    if (number >= prototypes_.size() || reshaped[number]) return false;
    prototypes_[number] = std::make_shared<Prototype>(triangles_of(update.shapes[i].mesh));
    reshaped[number] = true;
  }
  for (std::size_t i = 0; i < instances_.size(); ++i) moved[i] = reshaped[instances_[i].prototype];
  return true;
}

bool InstanceTree::move(const SceneUpdate& update, std::vector<bool>& moved) {
  std::vector<bool> waiting = moved;
  for (std::size_t i = 0; i < update.move_count; ++i) {
    const SceneUpdate::Move& to = update.moves[i];
    const auto found = std::lower_bound(instances_.begin(), instances_.end(), to.mesh,
                                        [](const PlacedInstance& p, std::uint32_t mesh) { return p.mesh < mesh; });
    if (found == instances_.end() || found->mesh != to.mesh || !place(to.to_world, *found)) return false;
    const auto number = static_cast<std::size_t>(found - instances_.begin());
    moved[number] = true;
    waiting[number] = false;
  }
  return std::none_of(waiting.begin(), waiting.end(), [](bool waits) { return waits; });
}

std::uint64_t InstanceTree::bytes() const noexcept {
  std::uint64_t sum = boxes_.bytes() + instances_.size() * (sizeof(PlacedInstance) + sizeof(Triangle));
  for (const std::shared_ptr<Prototype>& prototype : prototypes_)
    sum += prototype->bvh().bytes() + prototype->triangles().size() * sizeof(Triangle);
  return sum;
}

}  // namespace umbrix::detail
