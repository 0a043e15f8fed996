// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "kernels/kernel.h"

namespace umbrix::detail {

/// The queries of all kernels whose side table is a ChildOrder; they differ in how it is made.
const EntryPoints& ordered_entry_points();

}  // namespace umbrix::detail
