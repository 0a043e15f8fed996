// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <unistd.h>

#include <csignal>

namespace umbrix::app {
namespace {

std::atomic<bool> interrupted_flag{false};
std::atomic<int> signal_number{0};
std::atomic<bool> held{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

void on_signal(int number) {
  const bool second = interrupted_flag.exchange(true);
  if (!second) signal_number = number;
  if (second && !held) _exit(128 + number);
}

}  // namespace

void catch_signals() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

const std::atomic<bool>& interrupted() { return interrupted_flag; }

int received_signal() { return signal_number; }

SignalHold::SignalHold() { held = true; }

SignalHold::~SignalHold() { held = false; }

}  // namespace umbrix::app
