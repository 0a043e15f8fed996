// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "umbrix/status.h"

namespace umbrix::io::detail {

/// A file that appears whole or not at all: written under a temporary name in the same folder, then renamed. What was
/// there before stays until then; the temporary is removed unless commit succeeded.
class AtomicFile {
 public:
  AtomicFile() = default;
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Can `path` be made? output_failed if the folder is missing or not writable, if something that is not a file is
  /// there, or a file and not `overwrite`.
  static Status check(const std::string& path, bool overwrite);

  /// Chooses the temporary name, after `check`.
  Status begin(const std::string& path, bool overwrite);

  /// The name to write to between begin and commit.
  const std::string& temporary() const noexcept { return temporary_; }

  /// Forces the bytes to the disk and gives the file its name.
  Status commit();

 private:
  std::string path_;    // as the caller wrote it, for messages
  std::string target_;  // behind any symbolic link
  std::string temporary_;
};

}  // namespace umbrix::io::detail
