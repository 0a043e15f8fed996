// SPDX-License-Identifier: Apache-2.0
#include "memory_guard.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "exit_code.h"
#include "leave.h"

namespace umbrix::app {
namespace {

constexpr auto kInterval = std::chrono::milliseconds(5);

std::atomic<const char*> phase{"starting"};

[[noreturn]] void leave_without_memory() noexcept {
  char text[160];
  std::snprintf(text, sizeof text, "umbrix: out of memory while %s\n", phase.load());
  leave_at_once(text, kResourceLimit);
}

/// An exception that nobody could catch.
[[noreturn]] void on_terminate() noexcept {
  try {
    if (const std::exception_ptr last = std::current_exception()) std::rethrow_exception(last);
  } catch (const std::exception& error) {
    if (is_lack_of_memory(error)) leave_without_memory();
  } catch (...) {
  }
  leave_at_once("umbrix: internal error\n", kFailed);
}

void watch(std::uint64_t limit) noexcept {
  while (resident_bytes() <= limit) std::this_thread::sleep_for(kInterval);
  char text[200];
  std::snprintf(text, sizeof text, "umbrix: the memory limit of %.0f MB was reached while %s (--memory-limit)\n",
                static_cast<double>(limit) / (1 << 20), phase.load());
  leave_at_once(text, kResourceLimit);
}

}  // namespace

void guard_memory() noexcept {
  std::set_new_handler(leave_without_memory);
  std::set_terminate(on_terminate);
}

bool is_lack_of_memory(const std::exception& error) noexcept {
  if (dynamic_cast<const std::bad_alloc*>(&error)) return true;
  if (const auto* system = dynamic_cast<const std::system_error*>(&error))
    return system->code().value() == EAGAIN || system->code().value() == ENOMEM;
  // oneTBB tells in words only that it cannot make a thread.
  return std::strstr(error.what(), "pthread_create") != nullptr;
}

void set_phase(const char* what) noexcept { phase = what; }

void limit_memory(std::uint64_t bytes) noexcept {
  if (bytes == 0 || resident_bytes() == 0) return;
  try {
    std::thread(watch, bytes).detach();
  } catch (const std::exception&) {
    leave_without_memory();
  }
}

std::uint64_t resident_bytes() noexcept {
  // The second number (proc(5), statm). No stream: this may not ask for memory.
  static const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  char text[64] = {};
  if (file < 0 || pread(file, text, sizeof text - 1, 0) <= 0) return 0;
  char* rest = nullptr;
  std::strtoull(text, &rest, 10);
  return std::strtoull(rest, nullptr, 10) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace umbrix::app
