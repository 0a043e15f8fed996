// SPDX-License-Identifier: Apache-2.0
// Surface area traversal order (Nah & Manocha 2014, "SATO: surface area traversal order for shadow ray tracing"): the
// larger child is the likelier to block. In a KD-tree a cell may be large and empty, hence measures of what it holds.
#include "index/sato_order.h"

#include "index/subtree_measures.h"

namespace umbrix::detail {
namespace {

/// The cells' areas, but 0 where a cell holds nothing.
std::vector<double> filled_cell_areas(const Tree& tree) {
  std::vector<double> areas = cell_areas(tree);
  for (std::size_t i = areas.size(); i-- > 0;) {
    const Node& node = tree.nodes[i];
    const bool is_empty =
        node.is_leaf() ? node.block_count() == 0 : areas[node.low_child()] == 0 && areas[node.low_child() + 1] == 0;
    if (is_empty) areas[i] = 0;
  }
  return areas;
}

std::vector<double> measure_nodes(const Tree& tree, SatoMeasure measure, const Executor* executor) {
  switch (measure) {
    case SatoMeasure::tight_box:
      return tight_box_areas(tree, executor);
    case SatoMeasure::triangle_area:
      return triangle_areas(tree, executor);
    case SatoMeasure::triangle_count:
      return triangle_counts(tree);
    case SatoMeasure::cell:
      break;
  }
  return filled_cell_areas(tree);
}

}  // namespace

std::unique_ptr<ChildOrder> make_sato_order(const Tree& tree, SatoMeasure measure, const Executor* executor) {
  const std::vector<double> size = measure_nodes(tree, measure, executor);
  auto order = std::make_unique<ChildOrder>(tree);
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Node& node = tree.nodes[i];
    if (!node.is_leaf() && size[node.low_child() + 1] > size[node.low_child()]) order->set_high_first(i);
  }
  return order;
}

}  // namespace umbrix::detail
