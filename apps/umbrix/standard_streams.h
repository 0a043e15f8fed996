// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "umbrix/status.h"

namespace umbrix::app {

/// Puts something in the place of closed standard streams, so that no file that is opened later gets what is printed.
/// Printing to one that was closed still fails.
void fill_standard_streams() noexcept;

/// Prints a result. output_failed says why it cannot be printed; cancelled: nobody reads it any more.
Status print_result(const std::string& text);

}  // namespace umbrix::app
