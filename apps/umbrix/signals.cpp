// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <unistd.h>

#include <csignal>

namespace umbrix::app {
namespace {

std::atomic<bool> interrupted_flag{false};
std::atomic<int> signal_number{0};
std::atomic<OnSignal> answer_now{OnSignal::exit};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
                  std::atomic<OnSignal>::is_always_lock_free,
              "a signal handler may touch lock-free atomics only");

[[noreturn]] void leave(int number) {
  constexpr char kText[] = "umbrix: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kText, sizeof kText - 1);
  _exit(128 + number);
}

void on_signal(int number) {
  const OnSignal answer = answer_now;
  if (answer == OnSignal::exit) leave(number);
  const bool second = interrupted_flag.exchange(true);
  if (second && answer != OnSignal::hold) leave(number);
  if (!second) signal_number = number;
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

SignalScope::SignalScope(OnSignal answer) : before_(answer_now.exchange(answer)) {}

SignalScope::~SignalScope() { answer_now = before_; }

}  // namespace umbrix::app
