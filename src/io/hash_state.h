// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace umbrix::io::detail {

/// XXH3 of bytes that come in pieces. The same on every machine, and faster than files are read, which a hash against
/// attackers is not.
class HashState {
 public:
  HashState();
  ~HashState();
  HashState(const HashState&) = delete;
  HashState& operator=(const HashState&) = delete;

  void add(const void* bytes, std::size_t size) noexcept;

  /// A text and its length, so that "ab", "c" is not "a", "bc".
  void add_text(std::string_view text) noexcept;

  /// Of all that was added, as 32 hexadecimal digits.
  std::string digits() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace umbrix::io::detail
