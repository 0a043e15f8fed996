// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kernels/scene_view.h"
#include "umbrix/kernel.h"

namespace umbrix::detail {

/// A kernel's queries for one instruction set, uncounted and counted.
struct EntryPoints {
  void (*occluded)(const SceneView&, RaySpan, std::uint8_t* out, const QueryOptions&);
  void (*occluded_counted)(const SceneView&, RaySpan, std::uint8_t* out, const QueryOptions&, OcclusionCounts&);
  void (*closest)(const SceneView&, RaySpan, Hit* out, const QueryOptions&);
  void (*closest_counted)(const SceneView&, RaySpan, Hit* out, const QueryOptions&, RayCounts&);
};

/// A way to walk the scene. All kernels give the same answers.
struct Kernel {
  KernelInfo info;
  const EntryPoints& (*entry_points)();  ///< those of the instruction set in use
};

/// The table of kernels, and the place of the default one.
std::size_t kernel_table_size() noexcept;
const Kernel& kernel_at(KernelId id) noexcept;

}  // namespace umbrix::detail
