// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "umbrix/status.h"

namespace umbrix::io::detail {

/// Is `path` a file that can be read? Does not wait for pipes. bad_input names the file.
Status check_readable(const std::string& path);

/// Reads a whole regular file of at most `limit` bytes; the size is checked again while reading, since a file can
/// grow. Throws LoadError without the file's name.
std::vector<unsigned char> read_file(const std::string& path, std::uint64_t limit);

/// The first bytes of a regular file, at most `most`, and how many it has. Throws as read_file does.
std::vector<unsigned char> read_start(const std::string& path, std::uint64_t most, std::uint64_t& file_bytes);

}  // namespace umbrix::io::detail
