// SPDX-License-Identifier: Apache-2.0
#include "leave.h"

#include <unistd.h>

#include <cstring>

#include "log_file.h"
#include "openjd_lines.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {

void leave_at_once(const char* text, int code) noexcept {
  io::remove_temporaries();
  if (text) [[maybe_unused]]
    const auto written = write(STDERR_FILENO, text, std::strlen(text));
  if (text) log_line(text);
  if (text) say_openjd_failure(text);
  _exit(code);
}

}  // namespace umbrix::app
