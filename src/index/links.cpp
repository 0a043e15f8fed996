// SPDX-License-Identifier: Apache-2.0
// A link is found by a descent with the face's rectangle: on the face's own axis it keeps to the face's outer side, on
// the others it takes the child that holds the rectangle, and it stops at a leaf or where a plane cuts the rectangle
// (Havran 2000, "Heuristic ray shooting algorithms", section 4.3.3; Popov et al. 2007, section 3.2). It may start from
// any node that covers the face: all builders find the same links.
#include "index/links.h"

#include <algorithm>
#include <limits>

#include "core/parallel_for.h"
#include "index/cells.h"

namespace umbrix::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::uint32_t kOutside = 0;  ///< the root is nobody's neighbour

/// Room for records of leaves that two threads add at once.
constexpr std::size_t kSpareRecords = 1024;

std::size_t count_leaves(const Tree& tree) {
  return static_cast<std::size_t>(
      std::count_if(tree.nodes.begin(), tree.nodes.end(), [](const Node& node) { return node.is_leaf(); }));
}

const Box& everywhere() {
  static const Box box{Vec3(-kInfinity), Vec3(kInfinity)};
  return box;
}

/// The side of the plane on which all of the face's outer side lies: 0 low, 1 high, or -1 if the plane cuts it.
int side_of_face(const float (&faces)[kFaces], std::uint32_t face, const Node& node) {
  const std::uint32_t axis = node.axis_bits();
  const float plane = node.plane();
  if (axis == face % 3) return (face >= 3 ? plane <= faces[face] : plane < faces[face]) ? 1 : 0;
  if (plane <= faces[face_of(axis, false)]) return 1;
  return plane >= faces[face_of(axis, true)] ? 0 : -1;
}

/// The smallest node below `from` that covers the face's outer side.
std::uint32_t tighten(const Tree& tree, std::uint32_t from, const float (&faces)[kFaces], std::uint32_t face) {
  for (;;) {
    const Node& node = tree.nodes[from];
    if (node.is_leaf()) return from;
    const int side = side_of_face(faces, face, node);
    if (side < 0) return from;
    from = node.low_child() + static_cast<std::uint32_t>(side);
  }
}

std::uint32_t leaf_at(const Tree& tree, const Vec3& point) {
  std::uint32_t at = 0;
  while (!tree.nodes[at].is_leaf()) {
    const Node& node = tree.nodes[at];
    at = node.low_child() + (point[static_cast<int>(node.axis_bits())] < node.plane() ? 0 : 1);
  }
  return at;
}

/// Calls visit(leaf node) for the leaves at a face's outer side, from a node that covers it.
template <class Visit>
void for_each_neighbour(const Tree& tree, std::uint32_t from, const float (&faces)[kFaces], std::uint32_t face,
                        Visit&& visit) {
  const Node& node = tree.nodes[from];
  if (node.is_leaf()) return visit(from);
  const int side = side_of_face(faces, face, node);
  if (side != 1) for_each_neighbour(tree, node.low_child(), faces, face, visit);
  if (side != 0) for_each_neighbour(tree, node.low_child() + 1, faces, face, visit);
}

}  // namespace

Links::Links(const Tree& tree, LinkBuilder builder)
    : tree_(tree), builder_(builder), leaves_(count_leaves(tree) + 1 + kSpareRecords), records_(tree.nodes.size()) {}

std::uint64_t Links::bytes() const noexcept {
  return leaf_count() * sizeof(LinkedLeaf) + records_.size() * sizeof(records_[0]);
}

std::uint32_t Links::take_record() const noexcept {
  for (std::atomic<std::uint32_t>& slot : given_back_) {
    if (slot.load(std::memory_order_relaxed) == 0) continue;
    if (const std::uint32_t record = slot.exchange(0, std::memory_order_acquire)) return record;
  }
  if (next_record_.load(std::memory_order_relaxed) >= leaves_.size()) return 0;
  const std::uint32_t record = next_record_.fetch_add(1, std::memory_order_relaxed);
  return record < leaves_.size() ? record : 0;
}

void Links::give_back(std::uint32_t record) const noexcept {
  for (std::atomic<std::uint32_t>& slot : given_back_) {
    std::uint32_t none = 0;
    if (slot.compare_exchange_strong(none, record, std::memory_order_release)) return;
  }
}

std::uint32_t Links::add(std::uint32_t node) const noexcept { return add(node, cell_of(tree_, node, everywhere())); }

std::uint32_t Links::add(std::uint32_t node, const Box& cell) const noexcept {
  const std::uint32_t record = take_record();
  if (record == 0) return 0;
  LinkedLeaf& leaf = leaves_[record];
  for (int axis = 0; axis < 3; ++axis) {
    leaf.faces[axis] = cell.lower[axis];
    leaf.faces[axis + 3] = cell.upper[axis];
  }
  leaf.blocks = tree_.nodes[node].blocks();
  leaf.node = node;
  // If another thread was first, its record counts, and the next leaf gets this one.
  std::uint32_t first = 0;
  const bool added = records_[node].compare_exchange_strong(first, record, std::memory_order_acq_rel);
  if (!added) {
    give_back(record);
    return first;
  }
  leaf_count_.fetch_add(1, std::memory_order_relaxed);
  return record;
}

Link Links::find(const LinkedLeaf& leaf, std::uint32_t face) const noexcept {
  const std::uint32_t node = tighten(tree_, 0, leaf.faces, face);
  const std::uint32_t record = tree_.nodes[node].is_leaf() ? record_of(node) : 0;
  const Link link = !tree_.nodes[node].is_leaf() ? Link::to_inner(node) : record != 0 ? Link::to_leaf(record) : Link();
  // Every thread finds the same: it does not matter who stores it.
  const_cast<LinkedLeaf&>(leaf).links[face].store(link.bits(), std::memory_order_release);
  return link;
}

void Links::add_below(std::uint32_t at, const Box& cell) {
  const Node& node = tree_.nodes[at];
  if (node.is_leaf()) {
    add(at, cell);
    return;
  }
  for (const bool high : {false, true}) add_below(node.low_child() + (high ? 1 : 0), half_cell(cell, node, high));
}

void Links::find_all(std::uint32_t at, const std::uint32_t (&outside)[kFaces]) {
  const Node& node = tree_.nodes[at];
  if (!node.is_leaf()) {
    // The children are each other's neighbours at the plane.
    for (const bool high : {false, true}) {
      std::uint32_t around[kFaces];
      std::copy(outside, outside + kFaces, around);
      around[face_of(node.axis_bits(), !high)] = node.low_child() + (high ? 0 : 1);
      find_all(node.low_child() + (high ? 1 : 0), around);
    }
    return;
  }
  LinkedLeaf& leaf = leaves_[record_of(at)];
  for (std::uint32_t face = 0; face < kFaces; ++face) {
    if (outside[face] == kOutside) continue;
    const std::uint32_t target = tighten(tree_, outside[face], leaf.faces, face);
    const Link link = tree_.nodes[target].is_leaf() ? Link::to_leaf(record_of(target)) : Link::to_inner(target);
    leaf.links[face].store(link.bits(), std::memory_order_relaxed);
  }
}

void Links::build_full(const Executor* executor) {
  add_below(0, everywhere());
  // Subtrees a few levels down, in parallel.
  struct Part {
    std::uint32_t node;
    std::uint32_t outside[kFaces];
  };
  std::vector<Part> parts{{0, {kOutside, kOutside, kOutside, kOutside, kOutside, kOutside}}};
  constexpr std::size_t kParts = 256;
  for (std::size_t i = 0; i < parts.size() && parts.size() < kParts; ++i) {
    const Node& node = tree_.nodes[parts[i].node];
    if (node.is_leaf()) continue;
    Part low = parts[i], high = parts[i];
    low.node = high.outside[face_of(node.axis_bits(), false)] = node.low_child();
    high.node = low.outside[face_of(node.axis_bits(), true)] = node.low_child() + 1;
    parts[i] = low;
    parts.push_back(high);
  }
  parallel_for(executor, parts.size(), [&](std::size_t i) { find_all(parts[i].node, parts[i].outside); });
}

void Links::build_reached(const std::vector<Vec3>& lights, const std::vector<bool>& touched) {
  for (std::uint32_t node = 0; node < touched.size(); ++node)
    if (touched[node]) add(node);
  std::vector<bool> reached(tree_.nodes.size());
  std::vector<std::uint32_t> queue;
  const auto reach = [&](std::uint32_t node) {
    if (touched[node] && !reached[node]) {
      reached[node] = true;
      queue.push_back(node);
    }
  };
  for (const Vec3& light : lights) reach(leaf_at(tree_, light));
  for (std::size_t i = 0; i < queue.size(); ++i) {
    LinkedLeaf& leaf = leaves_[record_of(queue[i])];
    for (std::uint32_t face = 0; face < kFaces; ++face) {
      if (leaf.faces[face] == (face < 3 ? -kInfinity : kInfinity)) continue;
      const std::uint32_t target = tighten(tree_, 0, leaf.faces, face);
      for_each_neighbour(tree_, target, leaf.faces, face, reach);
      const bool is_leaf = tree_.nodes[target].is_leaf();
      if (is_leaf && !touched[target]) continue;
      const Link link = is_leaf ? Link::to_leaf(record_of(target)) : Link::to_inner(target);
      leaf.links[face].store(link.bits(), std::memory_order_relaxed);
    }
  }
}

}  // namespace umbrix::detail
