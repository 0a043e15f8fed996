// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <csignal>
#include <initializer_list>

#include "leave.h"

namespace umbrix::app {
namespace {

extern "C" void on_signal(int number) { leave_at_once("umbrix: interrupted\n", 128 + number); }

}  // namespace

void catch_signals() noexcept {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(number, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace umbrix::app
