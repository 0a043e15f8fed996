// SPDX-License-Identifier: Apache-2.0
// Top-down construction. Large cells fork their children; each small one is built by one task into a fragment of its
// own. Fragments are joined in tree order at the end, so that the layout does not depend on the schedule. The cap on
// references is shared out by count on the way down for the same reason.

#include "tree/splitter.h"

#include <memory>

#include "core/parallel_for.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kForkThreshold = 8192;
constexpr int kMaxBadSplits = 3;

/// An inner node with two children, or a finished fragment.
struct Branch {
  int axis = -1;
  float plane = 0;
  std::unique_ptr<Branch> low, high;
  UnpackedTree fragment;
};

/// What a cell inherits besides its contents.
struct Heritage {
  std::uint32_t depth = 0;
  int bad_splits = 0;  ///< above this cell, splits that cost more than the leaf they replaced
  std::uint64_t reference_budget = 0;
};

class Splitter {
 public:
  explicit Splitter(const SplitOptions& options) : options_(options) {}

  std::unique_ptr<Branch> branch(Cell cell, Heritage heritage) const {
    auto result = std::make_unique<Branch>();
    if (cell.references.size() >= kForkThreshold) {
      const Split split = choose(cell, heritage);
      if (split.valid()) {
        Cell children[2];
        Heritage inherited[2];
        descend(cell, split, heritage, children, inherited);
        result->axis = split.axis;
        result->plane = split.plane;
        std::unique_ptr<Branch>* slots[2] = {&result->low, &result->high};
        parallel_for(options_.executor, 2,
                     [&](std::size_t i) { *slots[i] = branch(std::move(children[i]), inherited[i]); });
        return result;
      }
    }
    result->fragment.nodes.resize(2);
    fill(std::move(cell), heritage, 0, result->fragment);
    return result;
  }

 private:
  /// The split to make, or none if the cell becomes a leaf.
  Split choose(const Cell& cell, Heritage& heritage) const {
    const std::uint64_t count = cell.references.size();
    if (count == 0 || heritage.depth >= options_.max_depth) return {};
    const SplitCost cost(cell.box, options_.cost, options_.context.eps);
    const Split split =
        options_.quality == BuildQuality::high ? find_split_by_sweep(cell, cost) : find_split_by_bins(cell, cost);
    if (!split.valid() || split.low_count + split.high_count > heritage.reference_budget) return {};
    if (split.low_count == count && split.high_count == count) return {};
    const double leaf_cost = options_.cost.leaf(count);
    if (split.cost >= leaf_cost) {
      ++heritage.bad_splits;
      if (heritage.bad_splits >= kMaxBadSplits || count <= kBlockLanes || split.cost > 1.5 * leaf_cost) return {};
    }
    return split;
  }

  void descend(Cell& cell, const Split& split, const Heritage& heritage, Cell (&children)[2],
               Heritage (&inherited)[2]) const {
    const std::uint64_t spare = heritage.reference_budget - (split.low_count + split.high_count);
    partition(cell, split, options_.context, children[0], children[1]);
    const std::uint64_t counts[2] = {children[0].references.size(), children[1].references.size()};
    const double total = static_cast<double>(std::max<std::uint64_t>(1, counts[0] + counts[1]));
    for (int i = 0; i < 2; ++i) {
      const double share = static_cast<double>(counts[i]) / total;
      inherited[i] = {heritage.depth + 1, heritage.bad_splits,
                      counts[i] + static_cast<std::uint64_t>(share * static_cast<double>(spare))};
    }
  }

  /// Builds a whole subtree below the node at `slot`.
  void fill(Cell cell, Heritage heritage, std::size_t slot, UnpackedTree& out) const {
    out.depth = std::max(out.depth, heritage.depth);
    const Split split = choose(cell, heritage);
    if (!split.valid()) {
      const std::size_t first = out.references.size();
      for (const Reference& r : cell.references) out.references.push_back(r.triangle);
      out.nodes[slot] =
          Node::leaf(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(cell.references.size()));
      return;
    }
    Cell children[2];
    Heritage inherited[2];
    descend(cell, split, heritage, children, inherited);
    const std::size_t pair = out.nodes.size();
    out.nodes.resize(pair + 2);
    out.nodes[slot] = Node::inner(split.axis, split.plane, static_cast<std::uint32_t>(pair));
    for (std::size_t i = 0; i < 2; ++i) fill(std::move(children[i]), inherited[i], pair + i, out);
  }

  const SplitOptions& options_;
};

/// Copies a fragment below the node at `slot`, its own node indices and references moved behind what is there.
void append(UnpackedTree fragment, std::size_t slot, UnpackedTree& out) {
  const auto node_shift = static_cast<std::uint32_t>(out.nodes.size() - 2);
  const auto reference_shift = static_cast<std::uint32_t>(out.references.size());
  const auto moved = [&](const Node& n) {
    return n.is_leaf() ? Node::leaf(n.first_block() + reference_shift, n.block_count())
                       : Node::inner(static_cast<int>(n.axis_bits()), n.plane(), n.low_child() + node_shift);
  };
  out.nodes[slot] = moved(fragment.nodes[0]);
  for (std::size_t i = 2; i < fragment.nodes.size(); ++i) out.nodes.push_back(moved(fragment.nodes[i]));
  out.references.insert(out.references.end(), fragment.references.begin(), fragment.references.end());
  out.depth = std::max(out.depth, fragment.depth);
}

void join(Branch& branch, std::size_t slot, UnpackedTree& out) {
  if (branch.axis < 0) {
    append(std::move(branch.fragment), slot, out);
    return;
  }
  const std::size_t pair = out.nodes.size();
  out.nodes.resize(pair + 2);
  out.nodes[slot] = Node::inner(branch.axis, branch.plane, static_cast<std::uint32_t>(pair));
  join(*branch.low, pair, out);
  join(*branch.high, pair + 1, out);
}

}  // namespace

UnpackedTree split_recursively(Cell root, const SplitOptions& options) {
  const std::unique_ptr<Branch> top = Splitter(options).branch(std::move(root), {0, 0, options.max_references});
  UnpackedTree result;
  result.nodes.resize(2);
  join(*top, 0, result);
  return result;
}

}  // namespace umbrix::detail
