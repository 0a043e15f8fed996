// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "kernels/scene_view.h"
#include "umbrix/kernel.h"

namespace umbrix::detail {

/// A kernel's queries for one instruction set, uncounted and counted.
struct EntryPoints {
  void (*occluded)(const SceneView&, RaySpan, std::uint8_t* out, const QueryOptions&);
  void (*occluded_counted)(const SceneView&, RaySpan, std::uint8_t* out, const QueryOptions&, OcclusionCounts&);
  void (*closest)(const SceneView&, RaySpan, Hit* out, const QueryOptions&);
  void (*closest_counted)(const SceneView&, RaySpan, Hit* out, const QueryOptions&, RayCounts&);
  /// Does `occluded` itself share rays among the executor's threads? Else they come in blocks.
  bool shares_occluded = false;
};

/// What a side table is made from.
struct PrepareInput {
  const SceneView& scene;
  const Training& training;
};

/// A way to walk the scene. All kernels give the same answers.
struct Kernel {
  KernelInfo info;
  const EntryPoints& (*entry_points)();                        ///< those of the instruction set in use
  std::unique_ptr<SideTable> (*prepare)(const PrepareInput&);  ///< null: the kernel needs nothing beside the tree
  bool needs_tree = true;  ///< is the tree to be built before its first query? else it asks for it, if it uses it
};

/// Defines a kernel at the end of its file, within HWY_ONCE. `entry` is the function that each instruction set's
/// namespace has for it.
#define UMBRIX_DEFINE_KERNEL(variable, entry, name, summary, prepare_function) \
  UMBRIX_DEFINE_ANY_KERNEL(variable, entry, name, summary, prepare_function, true)

/// The same for one that does not need the tree.
#define UMBRIX_DEFINE_TREELESS_KERNEL(variable, entry, name, summary, prepare_function) \
  UMBRIX_DEFINE_ANY_KERNEL(variable, entry, name, summary, prepare_function, false)

#define UMBRIX_DEFINE_ANY_KERNEL(variable, entry, name, summary, prepare_function, needs_tree)   \
  namespace umbrix::detail {                                                                     \
  namespace {                                                                                    \
  HWY_EXPORT(entry);                                                                             \
  }                                                                                              \
  extern const Kernel variable;                                                                  \
  const Kernel variable = {{name, summary, (prepare_function) != nullptr},                       \
                           []() -> const EntryPoints& { return HWY_DYNAMIC_DISPATCH(entry)(); }, \
                           prepare_function,                                                     \
                           needs_tree};                                                          \
  }  // namespace umbrix::detail

/// Prepares the kernels that have a WideTree as their side table.
std::unique_ptr<SideTable> make_wide_tree(const PrepareInput& input);

/// The table of kernels, and the place of the default one.
std::size_t kernel_table_size() noexcept;
std::size_t kernel_place(KernelId id) noexcept;
const Kernel& kernel_at(KernelId id) noexcept;

}  // namespace umbrix::detail
