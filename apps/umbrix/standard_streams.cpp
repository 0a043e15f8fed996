// SPDX-License-Identifier: Apache-2.0
#include "standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include "umbrix/io/image_file.h"

namespace umbrix::app {

void fill_standard_streams() noexcept {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // Open the wrong way round; the lowest free number is this one.
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF) [[maybe_unused]]
      const int file = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

Status print_result(const std::string& text) { return io::write_text("-", text, false); }

}  // namespace umbrix::app
