// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace umbrix::io::detail {

/// A new, empty file "TARGET.umbrix-PROCESS-NUMBER", locked for as long as it is open, and removed unless `keep` is
/// called. What a killed process left is told by its name, by its age and by having no lock.
class Temporary {
 public:
  Temporary() = default;
  ~Temporary();
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  /// Makes it beside `target`; returns errno, or 0.
  int create(const std::string& target);

  const std::string& name() const noexcept { return name_; }
  int file() const noexcept { return file_; }

  /// The file has another name by now.
  void keep() noexcept;

 private:
  bool open_unique(const std::string& name, int& error);

  std::string name_;
  int file_ = -1;
  int slot_ = -1;  ///< among those that remove_temporaries knows
};

/// Removes what killed processes left beside `target`: not written to for a minute, and locked by nobody. The age is
/// for file systems whose locks do not reach other machines.
void sweep_temporaries(const std::string& target) noexcept;

}  // namespace umbrix::io::detail
