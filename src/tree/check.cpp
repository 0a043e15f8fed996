// SPDX-License-Identifier: Apache-2.0
#include "tree/check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tree/scale.h"

namespace umbrix::detail {
namespace {

/// Separating axes of a triangle and a box (Akenine-Moeller 2001, "Fast 3D triangle-box overlap testing").
bool overlaps(const Triangle& triangle, const Box& box, double margin) {
  const DVec3 center = 0.5 * (DVec3(box.lower) + DVec3(box.upper));
  const DVec3 half = 0.5 * (DVec3(box.upper) - DVec3(box.lower)) + DVec3(margin);
  const std::array<DVec3, 3> v = {DVec3(triangle.v[0]) - center, DVec3(triangle.v[1]) - center,
                                  DVec3(triangle.v[2]) - center};
  const std::array<DVec3, 3> edges = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const auto separates = [&](const DVec3& axis) {
    const double p0 = glm::dot(axis, v[0]), p1 = glm::dot(axis, v[1]), p2 = glm::dot(axis, v[2]);
    const double radius = glm::dot(glm::abs(axis), half);
    return std::min({p0, p1, p2}) > radius || std::max({p0, p1, p2}) < -radius;
  };
  if (separates(glm::cross(edges[0], edges[1]))) return false;
  for (int k = 0; k < 3; ++k) {
    DVec3 axis(0);
    axis[k] = 1;
    if (separates(axis)) return false;
    for (const DVec3& e : edges)
      if (separates(glm::cross(axis, e))) return false;
  }
  return true;
}

class Checker {
 public:
  Checker(const Tree& tree, std::vector<Triangle> scaled_triangles)
      : tree_(tree),
        triangles_(std::move(scaled_triangles)),
        node_seen_(tree.nodes.size(), false),
        block_seen_(tree.blocks.size(), false) {}

  std::string run(const std::vector<std::uint32_t>& kept) {
    visit(0, tree_.root, 0);
    for (std::size_t i = 0; i < block_seen_.size() && fault_.empty(); ++i)
      if (!block_seen_[i]) fail("block " + std::to_string(i) + " belongs to no leaf");
    for (const std::uint32_t id : kept) {
      if (!fault_.empty()) break;
      find_references(id, 0, tree_.root);
    }
    return fault_;
  }

 private:
  void fail(std::string what) {
    if (fault_.empty()) fault_ = std::move(what);
  }

  static Box child_cell(const Box& cell, const Node& node, int side) {
    Box child = cell;
    (side ? child.lower : child.upper)[static_cast<int>(node.axis_bits())] = node.plane();
    return child;
  }

  void visit(std::uint32_t index, const Box& cell, std::uint32_t depth) {
    const std::string name = "node " + std::to_string(index);
    if (index >= tree_.nodes.size()) return fail(name + " is out of range");
    if (node_seen_[index]) return fail(name + " has two parents");
    node_seen_[index] = true;
    const Node& node = tree_.nodes[index];
    if (node.is_leaf()) return visit_leaf(node, cell, name);
    const int axis = static_cast<int>(node.axis_bits());
    if (depth >= kMaxDepth) return fail(name + " is too deep");
    if (node.low_child() % 2 != 0 || node.low_child() < 2) return fail(name + " has misplaced children");
    if (!(node.plane() > cell.lower[axis] && node.plane() < cell.upper[axis]))
      return fail(name + " has its plane outside its cell");
    for (std::uint32_t side = 0; side < 2; ++side)
      visit(node.low_child() + side, child_cell(cell, node, static_cast<int>(side)), depth + 1);
  }

  void visit_leaf(const Node& leaf, const Box& cell, const std::string& name) {
    const double diagonal = glm::length(DVec3(cell.extent()));
    for (std::uint32_t i = 0; i < leaf.block_count(); ++i) {
      const std::size_t b = leaf.first_block() + i;
      if (b >= tree_.blocks.size()) return fail(name + " names a block out of range");
      if (block_seen_[b]) return fail(name + " shares a block");
      block_seen_[b] = true;
      const Block& block = tree_.blocks[b];
      if (block.count == 0 || block.count > kBlockLanes) return fail(name + " has a block of a wrong size");
      for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) check_lane(block, lane, diagonal, name);
    }
  }

  void check_lane(const Block& block, std::uint32_t lane, double diagonal, const std::string& name) {
    if (block.id[lane] >= triangles_.size()) return fail(name + " names a triangle out of range");
    if (lane >= block.count && block.id[lane] != block.id[0]) return fail(name + " has unknown padding");
    const Triangle& t = triangles_[block.id[lane]];
    for (int k = 0; k < 3; ++k)
      if (block.v0[k][lane] != t.v[0][k] || block.e1[k][lane] != t.v[1][k] - t.v[0][k] ||
          block.e2[k][lane] != t.v[2][k] - t.v[0][k])
        return fail(name + " holds other vertices than its triangles");
    const double longest =
        std::max(glm::length(DVec3(t.v[1]) - DVec3(t.v[0])), glm::length(DVec3(t.v[2]) - DVec3(t.v[0])));
    if (static_cast<double>(block.edge_bound) < longest || static_cast<double>(block.reach) < longest + diagonal)
      fail(name + " has bounds that are too small");
  }

  void find_references(std::uint32_t id, std::uint32_t index, const Box& cell) {
    if (!overlaps(triangles_[id], cell, 0.5 * static_cast<double>(tree_.eps))) return;
    const Node& node = tree_.nodes[index];
    if (!node.is_leaf()) {
      for (std::uint32_t side = 0; side < 2; ++side)
        find_references(id, node.low_child() + side, child_cell(cell, node, static_cast<int>(side)));
      return;
    }
    for (std::uint32_t i = 0; i < node.block_count(); ++i) {
      const Block& block = tree_.blocks[node.first_block() + i];
      if (std::find(block.id, block.id + block.count, id) != block.id + block.count) return;
    }
    fail("leaf " + std::to_string(index) + " lacks triangle " + std::to_string(id));
  }

  const Tree& tree_;
  std::vector<Triangle> triangles_;
  std::vector<bool> node_seen_, block_seen_;
  std::string fault_;
};

}  // namespace

std::string check_tree(const Tree& tree, const std::vector<Triangle>& triangles,
                       const std::vector<std::uint32_t>& kept) {
  if (tree.nodes.size() < 2 || tree.nodes.size() % 2 != 0) return "the nodes do not come in pairs";
  return Checker(tree, scaled(triangles, tree.scale_exponent)).run(kept);
}

}  // namespace umbrix::detail
