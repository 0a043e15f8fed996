// SPDX-License-Identifier: Apache-2.0
#include "tree/builder.h"

#include <chrono>
#include <cmath>

#include "core/float_mode.h"
#include "tree/clip.h"
#include "tree/pack.h"
#include "tree/scale.h"
#include "tree/splitter.h"

namespace umbrix::detail {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Cell root_cell(ArrayView<Triangle> triangles, ArrayView<std::uint32_t> kept, const Tree& tree) {
  Cell cell;
  cell.box = tree.root;
  cell.references.reserve(kept.size());
  for (const std::uint32_t id : kept) {
    Box box;
    for (const Vec3& v : triangles[id].v) box.extend(v);
    cell.references.push_back({id, grown(box, tree.eps)});
  }
  return cell;
}

SplitOptions split_options(ArrayView<Triangle> triangles, std::size_t count, BuildQuality quality,
                           const Executor* executor, const Tree& tree) {
  SplitOptions options;
  const bool high = quality == BuildQuality::high;
  options.context = {triangles.data(), tree.eps, high, high};
  options.quality = quality;
  options.executor = executor;
  // Depth after Wald & Havran (2006, section 5); the cap on references bounds memory on adversarial input.
  const double depth = 8 + 1.3 * std::log2(static_cast<double>(count));
  options.max_depth = std::min(kMaxDepth, static_cast<std::uint32_t>(depth));
  options.max_references = 4 * static_cast<std::uint64_t>(count) + 1'000'000;
  return options;
}

}  // namespace

Tree tree_around(const Box& bounds) {
  Tree tree;
  if (bounds.empty()) return tree;
  const DefaultFloatMode mode;
  tree.scale_exponent = scale_exponent(bounds);
  // Scaling keeps the order of floats, so these are the bounds of the scaled triangles.
  const Triangle corners = scaled(Triangle{{bounds.lower, bounds.upper, bounds.upper}}, tree.scale_exponent);
  const Box box{corners.v[0], corners.v[1]};
  tree.eps = 0x1p-20f * box.largest_extent();
  tree.root = grown(box, tree.eps);
  tree.root_lanes = BoxLanes(tree.root);
  return tree;
}

Tree build_tree(ArrayView<Triangle> triangles, ArrayView<std::uint32_t> kept, BuildQuality quality,
                const Executor* executor, BuildStats& stats) {
  const DefaultFloatMode mode;
  const auto prepare_start = Clock::now();
  Box bounds;
  for (const std::uint32_t id : kept)
    for (const Vec3& v : triangles[id].v) bounds.extend(v);
  Tree tree = tree_around(bounds);
  if (kept.empty()) {
    tree.nodes.assign(2, Node::leaf(0, 0));
    return tree;
  }
  const std::vector<Triangle> scaled_triangles = scaled(triangles, tree.scale_exponent);
  Cell root = root_cell(scaled_triangles, kept, tree);
  const SplitOptions options = split_options(scaled_triangles, kept.size(), quality, executor, tree);
  if (options.context.keep_events) sort_events(root);
  stats.seconds_prepare = seconds_since(prepare_start);

  const auto tree_start = Clock::now();
  UnpackedTree unpacked = split_recursively(std::move(root), options);
  stats.seconds_tree = seconds_since(tree_start);

  const auto leaves_start = Clock::now();
  pack_leaves(std::move(unpacked), scaled_triangles, options.cost, executor, tree, stats);
  stats.seconds_leaves = seconds_since(leaves_start);
  stats.node_bytes = tree.nodes.size() * sizeof(Node);
  stats.leaf_bytes = tree.blocks.size() * sizeof(Block);
  return tree;
}

}  // namespace umbrix::detail
