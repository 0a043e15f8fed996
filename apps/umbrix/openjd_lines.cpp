// SPDX-License-Identifier: Apache-2.0
#include "openjd_lines.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "message.h"

namespace umbrix::app {
namespace {

std::atomic<bool> in_use{false};

/// Past any buffer: a line is told when it is true, and a signal handler may do so too.
void write_out(const char* text, std::size_t size) noexcept {
  while (size > 0) {
    const ssize_t done = write(STDOUT_FILENO, text, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return;
    text += done;
    size -= static_cast<std::size_t>(done);
  }
}

void say_out(const std::string& line) {
  const std::string text = printable(line) + '\n';
  write_out(text.data(), text.size());
}

}  // namespace

void use_openjd_lines() noexcept { in_use = true; }

void say_openjd_progress(double percent) { say_out(fmt::format("openjd_progress: {:.1f}", percent)); }

void say_openjd_status(const std::string& text) { say_out("openjd_status: " + text); }

void say_openjd_failure(const char* text) noexcept {
  if (!in_use) return;
  constexpr char kStart[] = "openjd_fail: ";
  write_out(kStart, sizeof kStart - 1);
  write_out(text, std::strcspn(text, "\n"));
  write_out("\n", 1);
}

}  // namespace umbrix::app
