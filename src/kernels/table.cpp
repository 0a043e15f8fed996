// SPDX-License-Identifier: Apache-2.0
// The one list of kernels. README.md in this folder says how to add one.

#include <cstring>
#include <iterator>

#include "kernels/kernel.h"

// In the order shown to users; the first is the default.
#define UMBRIX_KERNELS(KERNEL) \
  KERNEL(kAutoKernel)          \
  KERNEL(kBvhKernel)           \
  KERNEL(kStandardKernel)      \
  KERNEL(kIndexedKernel)       \
  KERNEL(kIndexedPaperKernel)  \
  KERNEL(kLinkedKernel)        \
  KERNEL(kRopesKernel)         \
  KERNEL(kWideKernel)          \
  KERNEL(kBeamKernel)          \
  KERNEL(kFarFirstKernel)      \
  KERNEL(kSatoBoxKernel)       \
  KERNEL(kSatoAreaKernel)      \
  KERNEL(kSatoCountKernel)     \
  KERNEL(kSatoCellKernel)      \
  KERNEL(kRtsahKernel)         \
  KERNEL(kSrdhKernel)          \
  KERNEL(kSrdhOrderKernel)     \
  KERNEL(kKdRestartKernel)     \
  KERNEL(kPushDownKernel)      \
  KERNEL(kShortStackKernel)    \
  KERNEL(kKdBacktrackKernel)   \
  KERNEL(kRestartTrailKernel)  \
  KERNEL(kBruteKernel)

namespace umbrix {
namespace detail {

#define UMBRIX_DECLARE_KERNEL(name) extern const Kernel name;
UMBRIX_KERNELS(UMBRIX_DECLARE_KERNEL)

namespace {

#define UMBRIX_LIST_KERNEL(name) &name,
const Kernel* const kKernels[] = {UMBRIX_KERNELS(UMBRIX_LIST_KERNEL)};
constexpr std::size_t kDefault = 0;

}  // namespace

std::size_t kernel_table_size() noexcept { return std::size(kKernels); }

std::size_t kernel_place(KernelId id) noexcept {
  const auto index = static_cast<std::size_t>(id.index);
  return id.index >= 0 && index < std::size(kKernels) ? index : kDefault;
}

const Kernel& kernel_at(KernelId id) noexcept { return *kKernels[kernel_place(id)]; }

}  // namespace detail

std::size_t kernel_count() noexcept { return detail::kernel_table_size(); }

const KernelInfo& kernel_info(std::size_t index) noexcept { return detail::kernel_at({static_cast<int>(index)}).info; }

Status find_kernel(const char* name, KernelId& out) {
  std::string known;
  for (std::size_t i = 0; i < kernel_count(); ++i) {
    if (name && std::strcmp(kernel_info(i).name, name) == 0) {
      out.index = static_cast<int>(i);
      return {};
    }
    known += (i ? ", " : "") + std::string(kernel_info(i).name);
  }
  return {StatusCode::invalid_argument, "no kernel named '" + std::string(name ? name : "") + "'; there are: " + known};
}

}  // namespace umbrix
