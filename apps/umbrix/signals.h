// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace umbrix::app {

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once, with exit code 128 + signal and nothing
/// half-written: files appear whole or not at all, so there is nothing to wait for. One that is ignored (by nohup, or
/// by a shell for what it runs in the background) stays ignored. A pipe that nobody reads is an error, not a signal.
void catch_signals() noexcept;

}  // namespace umbrix::app
