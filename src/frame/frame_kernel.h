// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "frame/tile_memory.h"
#include "index/links.h"
#include "index/primitive_index.h"
#include "kernels/group_rays.h"
#include "kernels/light_view.h"

namespace umbrix::detail {

/// What a frame's rays may use; what its method does not need is null.
struct FrameTables {
  const WideTree* wide = nullptr;
  const LightViewTable* view = nullptr;
  const Links* links = nullptr;
  const PrimitiveIndex* index = nullptr;
};

/// A tile, what is known of it, and what was done.
struct FrameTile {
  const SceneView& scene;
  const FrameTables& tables;
  FrameMethod method;
  GroupRays rays;
  TileMemory& memory;
  CandidateTries tries = {};
};

/// Answers a tile by its frame's method, on the instruction set in use; rays.counts() says whether work is counted.
void trace_tile(FrameTile& tile) noexcept;

}  // namespace umbrix::detail
