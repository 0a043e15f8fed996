// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
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

/// Hands over a regular file's bytes in order, a piece at a time. Throws as read_file does.
void read_in_pieces(const std::string& path, const std::function<void(const unsigned char*, std::size_t)>& take);

/// While it lives, the files that this thread opens are added to `paths`, each once. For what has to know all that a
/// scene was made from, whoever opened it.
class OpenedFiles {
 public:
  explicit OpenedFiles(std::vector<std::string>& paths) noexcept;
  ~OpenedFiles();
  OpenedFiles(const OpenedFiles&) = delete;
  OpenedFiles& operator=(const OpenedFiles&) = delete;

 private:
  std::vector<std::string>* before_;
};

/// The path of a file that another one, `from`, names relative to its own folder. With `stay_inside` it must lie there,
/// links followed, so that a file from elsewhere cannot have others read. `label` and `kind` ("scene file") are for the
/// message. Throws LoadError.
std::string path_beside(const std::string& from, const std::string& name, bool stay_inside, const std::string& label,
                        const char* kind);

}  // namespace umbrix::io::detail
