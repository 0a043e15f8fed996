// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace umbrix::app {

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once, with exit code 128 + signal and nothing
/// half-written: files appear whole or not at all, so there is nothing to wait for. One that is ignored (by nohup, or
/// by a shell for what it runs in the background) stays ignored. A pipe that nobody reads is an error, not a signal.
void catch_signals() noexcept;

/// From now on the first of these signals, and each SIGUSR1, is left to the one thread that calls wait_for_signal; one
/// that comes more than a second later ends the program at once.
void hand_over_signals() noexcept;

struct WaitResult {
  int signal = 0;      ///< which came; 0: none
  bool woken = false;  ///< by wake_signal_waiter
};

/// Waits for a signal, for wake_signal_waiter or until a time.
WaitResult wait_for_signal(std::chrono::steady_clock::time_point until) noexcept;
/// Ends the waiting; signals end the program at once again.
void wake_signal_waiter() noexcept;

}  // namespace umbrix::app
