// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace umbrix::app {

/// What SIGINT and SIGTERM do. A second signal ends the program at once, unless held.
enum class OnSignal {
  exit,  ///< end the program: there is nothing to leave in order
  stop,  ///< set the flag that rendering polls
  hold,  ///< set the flag, and let a file that is being written be finished
};

/// From now on signals are answered, by OnSignal::exit to begin with, with exit code 128 + signal.
void catch_signals();

/// Set by the first signal, unless it ends the program.
const std::atomic<bool>& interrupted();

/// SIGINT or SIGTERM; 0 if there was none.
int received_signal();

/// Answers signals in another way while it lives.
class SignalScope {
 public:
  explicit SignalScope(OnSignal answer);
  ~SignalScope();
  SignalScope(const SignalScope&) = delete;
  SignalScope& operator=(const SignalScope&) = delete;

 private:
  OnSignal before_;
};

}  // namespace umbrix::app
