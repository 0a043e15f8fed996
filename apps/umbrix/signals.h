// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace umbrix::app {

/// From now on SIGINT and SIGTERM set the flag that rendering polls; a second one ends the program at once.
void catch_signals();

/// Set by the first signal.
const std::atomic<bool>& interrupted();

/// SIGINT or SIGTERM; 0 if there was none.
int received_signal();

/// While one lives, further signals wait for its end: a file that is being written is finished or not begun.
class SignalHold {
 public:
  SignalHold();
  ~SignalHold();
  SignalHold(const SignalHold&) = delete;
  SignalHold& operator=(const SignalHold&) = delete;
};

}  // namespace umbrix::app
