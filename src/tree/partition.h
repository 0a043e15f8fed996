// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tree/split.h"

namespace umbrix::detail {

/// What a partition needs to know of the scene.
struct PartitionContext {
  const Triangle* triangles;  ///< scaled
  float eps;
  bool clip;  ///< bound straddlers by their part in the cell, not by their box
  bool keep_events;
};

/// The cell of all references, before the first split: builds and sorts the events if the mode keeps them.
void sort_events(Cell& cell);

/// Moves the cell's references to the two sides of the split; the cell is left empty. Sorted events stay sorted: only
/// those of triangles on both sides are made anew (Wald & Havran 2006, section 4.2).
void partition(Cell& cell, const Split& split, const PartitionContext& context, Cell& low, Cell& high);

}  // namespace umbrix::detail
