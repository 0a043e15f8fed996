// SPDX-License-Identifier: Apache-2.0
#include "exit_code.h"

#include "message.h"
#include "signals.h"

namespace umbrix::app {

int report_status(const Status& status) {
  if (status.ok()) return kComplete;
  if (status.code() == StatusCode::cancelled) {
    say_error("interrupted");
    return 128 + received_signal();
  }
  say_error(status.message());
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
