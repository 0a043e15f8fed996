// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "io/temporary.h"
#include "umbrix/status.h"

namespace umbrix::io::detail {

/// A file that appears whole or not at all: written under a temporary name in the same folder, then renamed. What was
/// there before stays until then; the temporary is removed unless commit succeeded.
class AtomicFile {
 public:
  /// Can `path` be made? output_failed if the folder is missing or not writable, if something that is not a file is
  /// there, or a file and not `overwrite`.
  static Status check(const std::string& path, bool overwrite);

  /// Makes the temporary, after `check`, and removes what dead processes left.
  Status begin(const std::string& path, bool overwrite);

  /// Writes all bytes at the offset, between begin and commit. Returns errno, or 0.
  int write(const void* data, std::size_t size, std::uint64_t offset) noexcept;

  /// Forces the bytes to the disk and gives the file its name. Without `overwrite` it fails if another process made a
  /// file of that name in the meantime.
  Status commit();

 private:
  std::string path_;    // as the caller wrote it, for messages
  std::string target_;  // behind any symbolic link
  bool overwrite_ = false;
  Temporary temporary_;
};

}  // namespace umbrix::io::detail
