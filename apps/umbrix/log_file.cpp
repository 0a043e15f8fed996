// SPDX-License-Identifier: Apache-2.0
#include "log_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "message.h"

namespace umbrix::app {
namespace {

std::atomic<int> log_file{-1};

struct Date {
  long long year;
  int month, day;
};

/// Of the days since 1970 (Richards 2013, "Calendars"). The C library's gmtime takes a lock, which a signal handler may
/// not wait for.
Date date_of(long long days) {
  const long long f = days + 2440588 + 1401 + (((4 * (days + 2440588) + 274277) / 146097) * 3) / 4 - 38;
  const long long e = 4 * f + 3, h = 5 * (e % 1461 / 4) + 2;
  const auto month = static_cast<int>((h / 153 + 2) % 12 + 1);
  return {e / 1461 - 4716 + (14 - month) / 12, month, static_cast<int>(h % 153 / 5 + 1)};
}

}  // namespace

void add_log_file_option(CLI::App& command, std::string& path) {
  command
      .add_option("--log-file", path,
                  "Append what is said on stderr to this file too, with the time (UTC); not the bar of --progress")
      ->type_name("FILE");
}

Status open_log(const std::string& path) {
  if (path.empty()) return {};
  log_file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (log_file >= 0) return {};
  return {StatusCode::output_failed, fmt::format("{}: cannot be opened: {} (--log-file)", path, std::strerror(errno))};
}

void log_line(const char* text) noexcept {
  const int file = log_file;
  if (file < 0) return;
  const int error = errno;
  timespec now = {};
  clock_gettime(CLOCK_REALTIME, &now);
  const Date date = date_of(now.tv_sec / 86400);
  const auto second = static_cast<int>(now.tv_sec % 86400);
  char time[64];
  const int length = std::snprintf(time, sizeof time, "%04lld-%02d-%02dT%02d:%02d:%02dZ ", date.year, date.month,
                                   date.day, second / 3600, second / 60 % 60, second % 60);
  char end[] = "\n";
  // In one call, so that lines of processes with one log do not mix.
  const iovec parts[] = {
      {time, static_cast<std::size_t>(length)}, {const_cast<char*>(text), std::strcspn(text, "\n")}, {end, 1}};
  [[maybe_unused]] const auto written = writev(file, parts, 3);
  errno = error;
}

}  // namespace umbrix::app
