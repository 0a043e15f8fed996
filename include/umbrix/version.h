// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "umbrix/export.h"

/// The version, read from here by the build system as well.
#define UMBRIX_VERSION_MAJOR 0
#define UMBRIX_VERSION_MINOR 1
#define UMBRIX_VERSION_PATCH 0

namespace umbrix {

/// "major.minor.patch" of the library that is linked (the macros above say what was compiled against).
UMBRIX_API const char* version_string() noexcept;

}  // namespace umbrix
