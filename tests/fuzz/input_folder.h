// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace umbrix::fuzz {

/// A folder of this process for files made of a fuzzer's bytes: in memory where the machine has such a place. It is
/// removed when the process ends by itself.
class InputFolder {
 public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// Writes a file and returns its path.
  std::string write(const std::string& name, const void* bytes, std::size_t size) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace umbrix::fuzz
