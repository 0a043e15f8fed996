// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kernels/kernel.h"

namespace umbrix::detail {

extern const Kernel kStandardKernel;

}  // namespace umbrix::detail
