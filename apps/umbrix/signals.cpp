// SPDX-License-Identifier: Apache-2.0
#include "signals.h"

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <initializer_list>

#include "leave.h"

namespace umbrix::app {
namespace {

sem_t something_came;  // sem_post is what a handler may call
std::atomic<bool> handed_over{false}, woken{false}, snapshot{false};
std::atomic<int> first{0};
std::atomic<std::time_t> first_time{0};

std::time_t now_in_seconds() noexcept {
  timespec time = {};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec;
}

extern "C" void on_signal(int number) {
  const int error = errno;
  const bool second = first != 0;
  // Schedulers send a signal to a process and to its group: what comes at the same time is one.
  if (!handed_over || (second && now_in_seconds() > first_time + 1))
    leave_at_once("umbrix: interrupted\n", 128 + number);
  if (!second) {
    first_time = now_in_seconds();
    first = number;
  }
  sem_post(&something_came);
  errno = error;
}

extern "C" void on_snapshot(int) {
  const int error = errno;
  snapshot = true;
  sem_post(&something_came);
  errno = error;
}

void set_handler(int number, void (*handler)(int)) noexcept {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  struct sigaction before = {};
  sigaction(number, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
}

}  // namespace

void catch_signals() noexcept {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) set_handler(number, &on_signal);
  std::signal(SIGPIPE, SIG_IGN);
}

void hand_over_signals() noexcept {
  sem_init(&something_came, 0, 0);
  handed_over = true;
  set_handler(SIGUSR1, &on_snapshot);
}

WaitResult wait_for_signal(std::chrono::steady_clock::time_point until) noexcept {
  const auto seconds = std::chrono::time_point_cast<std::chrono::seconds>(until);
  timespec time = {};
  time.tv_sec = seconds.time_since_epoch().count();
  time.tv_nsec = std::chrono::duration_cast<std::chrono::nanoseconds>(until - seconds).count();
  while (sem_clockwait(&something_came, CLOCK_MONOTONIC, &time) != 0 && errno == EINTR) {
  }
  if (const int number = first) return {number, false};
  if (woken) return {0, true};
  return {snapshot.exchange(false) ? SIGUSR1 : 0, false};
}

void wake_signal_waiter() noexcept {
  woken = true;
  handed_over = false;
  sem_post(&something_came);
}

}  // namespace umbrix::app
