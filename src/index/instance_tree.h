// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "index/local_frame.h"
#include "index/prototype.h"
#include "umbrix/instance.h"

namespace umbrix::detail {

/// An instance, ready for rays.
struct PlacedInstance {
  double to_world[3][4];  ///< of vertices in the prototype's units
  LocalFrame frame;
  double reach;  ///< sum of the largest coordinates that a placed vertex has
  double edge;   ///< sum of the extents of its box in the world
  std::uint32_t prototype;
  std::uint32_t mesh;  ///< its number among the scene's meshes
  std::uint32_t mask;
  OpacityTest opacity;
};

/// Two levels: boxes of instances in the world, and below each those of its prototype, which are there once. A
/// triangle is placed when a ray comes to its leaf.
class InstanceTree {
 public:
  /// A prototype's number. Throws std::bad_alloc.
  std::uint32_t add_prototype(Prototype prototype);
  std::size_t prototype_count() const noexcept { return prototypes_.size(); }
  const Prototype& prototype(std::uint32_t number) const noexcept { return *prototypes_[number]; }

  /// Adds an instance as the scene's mesh of that number, and returns true; or does nothing if two levels do not serve
  /// for its transform. Throws std::bad_alloc.
  bool add(const Instance& instance, std::uint32_t mesh);

  /// Once, after all is added. Throws what TriangleBvh throws.
  void build(const Executor* executor);

  /// The same instances with some moved and some prototypes of another shape; shares with this what stays. Returns
  /// false if the update names what is not there, leaves out an instance of another shape, or two levels do not serve
  /// for one. Throws as build.
  bool updated(const SceneUpdate& update, InstanceTree& out) const;

  bool empty() const noexcept { return instances_.empty(); }
  std::size_t size() const noexcept { return instances_.size(); }
  std::uint64_t bytes() const noexcept;
  /// Of all that is placed.
  const Box& bounds() const noexcept { return bounds_; }

  /// Boxes of instances: a leaf's "triangles" have the box's lower corner first and the upper one next.
  const TriangleBvh& boxes() const noexcept { return boxes_; }
  const LocalFrame& frame() const noexcept { return frame_; }
  const PlacedInstance& instance(std::uint32_t index) const noexcept { return instances_[index]; }

 private:
  bool place(const double (&to_world)[3][4], PlacedInstance& instance) const;
  bool reshape(const SceneUpdate& update, std::vector<bool>& moved);
  bool move(const SceneUpdate& update, std::vector<bool>& moved);
  void build_boxes(const std::vector<bool>& moved, const Executor* executor);

  std::vector<std::shared_ptr<Prototype>> prototypes_;
  std::vector<PlacedInstance> instances_;  // in the order of their meshes
  std::vector<Triangle> instance_boxes_;
  TriangleBvh boxes_;
  LocalFrame frame_{};
  Box bounds_;
};

}  // namespace umbrix::detail
