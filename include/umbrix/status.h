// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <new>
#include <string>
#include <utility>

namespace umbrix {

/// What kind of thing went wrong; the message says which.
enum class StatusCode {
  ok,
  invalid_argument,  ///< the caller's values make no sense together
  bad_input,         ///< a file or mesh is missing, malformed or asks for what we do not have
  output_failed,     ///< a file could not be written
  resource_limit,    ///< memory or a documented limit ran out
  cancelled,         ///< the caller asked to stop
  internal,          ///< a defect in this library
};

/// The outcome of a call that can fail. Never ignored silently; holds one line fit for a user.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  /// resource_limit with the message or, where there is no memory for it either, with "out of memory".
  static Status out_of_memory(const char* message) noexcept {
    Status status;
    status.code_ = StatusCode::resource_limit;
    try {
      status.message_ = message;
    } catch (const std::bad_alloc&) {
      status.message_ = "out of memory";  // short enough to be held within the string
    }
    return status;
  }

  bool ok() const noexcept { return code_ == StatusCode::ok; }
  explicit operator bool() const noexcept { return ok(); }
  StatusCode code() const noexcept { return code_; }
  const std::string& message() const noexcept { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

}  // namespace umbrix
