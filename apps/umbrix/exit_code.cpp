// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include <csignal>

#include "message.h"
#include "openjd_lines.h"

namespace umbrix::app {

int report_status(const Status& status) {
  if (status.ok()) return kComplete;
  // As if the signal had ended the program, which is what shells and scripts expect of a pipe that was closed.
  if (status.code() == StatusCode::cancelled) return 128 + SIGPIPE;
  say_error(status.message());
  say_openjd_failure(status.message().c_str());
  switch (status.code()) {
    case StatusCode::bad_input:
      return kBadInput;
    case StatusCode::output_failed:
      return kOutputFailed;
    case StatusCode::resource_limit:
      return kResourceLimit;
    case StatusCode::invalid_argument:
      return kUsage;
    default:
      return kFailed;
  }
}

}  // namespace umbrix::app
