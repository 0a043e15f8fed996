// SPDX-License-Identifier: Apache-2.0
#include "umbrix/version.h"

#define UMBRIX_STRING_OF(x) #x
#define UMBRIX_STRING(x) UMBRIX_STRING_OF(x)

namespace umbrix {

const char* version_string() noexcept {
  return UMBRIX_STRING(UMBRIX_VERSION_MAJOR) "." UMBRIX_STRING(UMBRIX_VERSION_MINOR) "." UMBRIX_STRING(
      UMBRIX_VERSION_PATCH);
}

}  // namespace umbrix
