// SPDX-License-Identifier: Apache-2.0
// Folding after Wald, Benthin & Boulos (2008), "Getting rid of packets": from a node's two children, the largest inner
// child is replaced by its own two until eight are there. Here for a KD-tree, and lazily.
#include "index/wide_tree.h"

#include <algorithm>
#include <limits>

#include "core/float_mode.h"
#include "tree/clip.h"
#include "tree/scale.h"

namespace umbrix::detail {
namespace {

struct Member {
  std::uint32_t node;
  Box cell;
  double size;  ///< half the cell's area; of a leaf 0, since it cannot be opened
};

bool is_empty_leaf(const Node& node) { return node.is_leaf() && node.block_count() == 0; }

/// A full wide node opens at least seven inner nodes, and one that is not full has no wide children: so there are fewer
/// than 0.6 for each inner node.
std::size_t most_nodes(const Tree& tree) { return tree.nodes.size() / 2 * 5 / 8 + 1; }

class Members {
 public:
  Members(const Tree& tree, std::uint32_t node, const Box& cell) : tree_(tree) { add(node, cell); }

  /// Opens the largest inner member for as long as there is room for its children.
  void open_largest() {
    while (count_ < kBlockLanes) {
      Member* const largest =
          std::max_element(list_, list_ + count_, [](const Member& a, const Member& b) { return a.size < b.size; });
      if (count_ == 0 || !(largest->size > 0)) return;
      const Member opened = *largest;
      *largest = list_[--count_];
      const Node& node = tree_.nodes[opened.node];
      const int axis = static_cast<int>(node.axis_bits());
      Box low = opened.cell, high = opened.cell;
      low.upper[axis] = high.lower[axis] = node.plane();
      add(node.low_child(), low);
      add(node.low_child() + 1, high);
    }
  }

  const Member* begin() const { return list_; }
  const Member* end() const { return list_ + count_; }

 private:
  void add(std::uint32_t node, const Box& cell) {
    if (is_empty_leaf(tree_.nodes[node])) return;
    const bool inner = !tree_.nodes[node].is_leaf();
    list_[count_++] = {node, cell, inner ? std::max(half_area(cell), std::numeric_limits<double>::min()) : 0.0};
  }

  const Tree& tree_;
  Member list_[kBlockLanes + 1];
  std::uint32_t count_ = 0;
};

/// Bounds of the triangle's part in the cell grown by eps. Exact clipping is for triangles that are large in it.
Box part_bounds(const Triangle& triangle, const Box& cell, float eps) {
  Box box;
  for (const Vec3& v : triangle.v) box.extend(v);
  const Box around = grown(cell, eps);
  const Vec3 inside = glm::min(box.upper, around.upper) - glm::max(box.lower, around.lower);
  const Vec3 all = box.extent();
  const bool is_large = all.x > 8 * inside.x || all.y > 8 * inside.y || all.z > 8 * inside.z;
  if (is_large) return clipped_bounds(triangle, cell, static_cast<double>(eps));
  return {glm::max(box.lower, around.lower), glm::min(box.upper, around.upper)};
}

}  // namespace

WideTree::WideTree(const Tree& tree, const Triangle* triangles)
    : tree_(tree), triangles_(triangles), nodes_(most_nodes(tree)) {
  add(0, tree.root);
}

std::uint64_t WideTree::bytes() const noexcept { return next_.load(std::memory_order_relaxed) * sizeof(WideNode); }

/// The bounds of the leaf's triangles within its cell grown by eps, grown once more for the rounding of plane times.
Box WideTree::contents(const Node& leaf, const Box& cell) const noexcept {
  Box result;
  for (std::uint32_t b = 0; b < leaf.block_count(); ++b) {
    const Block& block = tree_.blocks[leaf.first_block() + b];
    for (std::uint32_t lane = 0; lane < block.count; ++lane) {
      const Triangle triangle = scaled(triangles_[block.id[lane]], tree_.scale_exponent);
      result.extend(part_bounds(triangle, cell, tree_.eps));
    }
  }
  return result.empty() ? result : grown(result, tree_.eps);
}

std::uint32_t WideTree::add(std::uint32_t node, const Box& cell) const noexcept {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::uint32_t index = next_.fetch_add(1, std::memory_order_relaxed);
  WideNode& wide = nodes_[index];
  Members members(tree_, node, cell);
  members.open_largest();
  std::uint32_t lane = 0;
  for (const Member& member : members) {
    const Node& child = tree_.nodes[member.node];
    const Box box = child.is_leaf() ? contents(child, member.cell) : member.cell;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      wide.faces[face_of(axis, false)][lane] = box.lower[static_cast<int>(axis)];
      wide.faces[face_of(axis, true)][lane] = box.upper[static_cast<int>(axis)];
    }
    const WideChild link = child.is_leaf() ? WideChild::leaf(child.blocks()) : WideChild::unmade(member.node);
    wide.children[lane++].store(link.bits(), std::memory_order_relaxed);
  }
  for (; lane < kBlockLanes; ++lane) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      wide.faces[face_of(axis, false)][lane] = kInfinity;
      wide.faces[face_of(axis, true)][lane] = -kInfinity;
    }
  }
  return index;
}

std::uint32_t WideTree::make(const WideNode& parent, std::uint32_t lane) const noexcept {
  const auto parent_index = static_cast<std::size_t>(&parent - &nodes_[0]);
  const DefaultFloatMode mode;
  const std::lock_guard<std::mutex> lock(locks_[parent_index % kLocks]);
  const WideChild child(parent.children[lane].load(std::memory_order_relaxed));
  if (!child.is_unmade()) return child.index();
  Box cell;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    cell.lower[static_cast<int>(axis)] = parent.faces[face_of(axis, false)][lane];
    cell.upper[static_cast<int>(axis)] = parent.faces[face_of(axis, true)][lane];
  }
  const std::uint32_t index = add(child.index(), cell);
  nodes_[parent_index].children[lane].store(WideChild::made(index).bits(), std::memory_order_release);
  return index;
}

}  // namespace umbrix::detail
