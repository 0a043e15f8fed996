// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "umbrix/export.h"
#include "umbrix/status.h"

namespace umbrix {

/// A way to walk the scene. All kernels give identical answers; they differ in time and counts.
struct KernelInfo {
  const char* name;
  const char* summary;     ///< one line
  bool needs_preparation;  ///< walks as "standard" does until Scene::prepare, or commit for the default, has made it
};

/// Names a kernel by its place in the list; the default is the recommended one.
struct KernelId {
  int index = -1;
};

/// The number of kernels, and each one's description. Constant; any thread.
UMBRIX_API std::size_t kernel_count() noexcept;
UMBRIX_API const KernelInfo& kernel_info(std::size_t index) noexcept;

/// Finds a kernel by name; invalid_argument names the known ones.
UMBRIX_API Status find_kernel(const char* name, KernelId& out);

/// The instruction sets this machine and build offer, best first ("AVX3", "AVX2", ..., last the portable one).
UMBRIX_API std::size_t simd_target_count() noexcept;
UMBRIX_API const char* simd_target_name(std::size_t index) noexcept;

/// Makes all later queries of the process use one instruction set; null: the best. Answers do not change.
/// Not while queries run.
UMBRIX_API Status use_simd_target(const char* name);

}  // namespace umbrix
