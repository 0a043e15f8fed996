// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

namespace fs = std::filesystem;

Status failed(const std::string& path, const std::string& reason) {
  return {StatusCode::output_failed, printable(path) + ": " + reason};
}

std::string reason_of(int error) { return std::generic_category().message(error); }

// A new file's folder; "." for a bare name.
fs::path folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  return folder.empty() ? fs::path(".") : folder;
}

// Waits until the disk has the file's (or folder's) bytes. Returns errno, or 0.
int sync_path(const char* path, int flags) {
  const int file = ::open(path, flags | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  return error;
}

}  // namespace

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Status AtomicFile::check(const std::string& path, bool overwrite) {
  if (path.empty()) return failed("output", "the file name is empty");
  std::error_code error;
  const fs::path folder = folder_of(path);
  if (!fs::is_directory(folder, error)) {
    return failed(path, "the folder " + printable(folder.string()) + " does not exist");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    return failed(path, "the folder " + printable(folder.string()) + " is not writable: " + reason_of(errno));
  }
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return {};
  if (status.type() == fs::file_type::none) return failed(path, error.message());
  // A rename would put a file in the place of a device or pipe.
  if (!fs::is_regular_file(status)) return failed(path, "exists and is not a file");
  if (!overwrite) return failed(path, "exists already");
  return {};
}

Status AtomicFile::begin(const std::string& path, bool overwrite) {
  if (Status status = check(path, overwrite); !status) return status;
  path_ = path;
  std::error_code error;
  target_ = fs::exists(path, error) ? fs::canonical(path, error).string() : path;
  if (error) return failed(path, error.message());
  temporary_ = target_ + ".tmp-" + std::to_string(::getpid());
  ::unlink(temporary_.c_str());  // of a dead process with the same number
  return {};
}

Status AtomicFile::commit() {
  if (const int error = sync_path(temporary_.c_str(), O_RDONLY)) return failed(path_, reason_of(error));
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) return failed(path_, reason_of(errno));
  temporary_.clear();
  // Not all file systems can sync a folder; the file is complete under its name either way.
  sync_path(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY);
  return {};
}

}  // namespace umbrix::io::detail
