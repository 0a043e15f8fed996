// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "umbrix/status.h"

namespace umbrix::app {

/// What the program's exit code means. Scripts depend on it.
enum ExitCode : int {
  kComplete = 0,  ///< every requested output exists and is complete
  kFailed = 1,
  kUsage = 2,          ///< bad command line
  kBadInput = 3,       ///< missing, malformed, or needs what we do not have
  kOutputFailed = 4,   ///< cannot be written, or exists and may not be replaced
  kIncomplete = 5,     ///< stopped by a limit before the end
  kResourceLimit = 6,  ///< memory or a documented limit ran out
};

/// Says what is wrong on stderr, if anything is, and returns the code for it. Where nobody reads
/// standard output any more it says nothing and the code is that of SIGPIPE, 141.
int report_status(const Status& status);

}  // namespace umbrix::app
