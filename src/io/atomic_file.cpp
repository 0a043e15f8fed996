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

// Calls until no signal interrupts it. Returns errno, or 0.
template <class Call>
int error_of(Call call) {
  while (call() < 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

// Not all file systems can sync a folder; the file is complete under its name either way.
void sync_folder(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  ::fsync(file);
  ::close(file);
}

// A network file system tells at close what it could not store. The descriptor itself stays open, for its lock.
int close_error(int file) {
  const int copy = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) return errno;
  // Interrupted or not, Linux has closed it.
  return ::close(copy) == 0 || errno == EINTR ? 0 : errno;
}

int rename_error(const std::string& from, const std::string& to, bool overwrite) {
#ifdef RENAME_NOREPLACE
  if (!overwrite) {
    const int error =
        error_of([&] { return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE); });
    if (error != EINVAL && error != ENOSYS) return error;  // some file systems cannot
  }
#endif
  return error_of([&] { return std::rename(from.c_str(), to.c_str()); });
}

}  // namespace

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
  overwrite_ = overwrite;
  std::error_code error;
  target_ = fs::exists(path, error) ? fs::canonical(path, error).string() : path;
  if (error) return failed(path, error.message());
  sweep_temporaries(target_);
  if (const int number = temporary_.create(target_)) return failed(path, reason_of(number));
  return {};
}

int AtomicFile::write(const void* data, std::size_t size, std::uint64_t offset) noexcept {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t done = ::pwrite(temporary_.file(), next, size, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : ENOSPC;
    next += done;
    size -= static_cast<std::size_t>(done);
    offset += static_cast<std::uint64_t>(done);
  }
  return 0;
}

Status AtomicFile::commit() {
  int error = error_of([&] { return ::fsync(temporary_.file()); });
  if (error == 0) error = close_error(temporary_.file());
  if (error == 0) error = rename_error(temporary_.name(), target_, overwrite_);
  if (error != 0) return failed(path_, error == EEXIST ? "exists already" : reason_of(error));
  temporary_.keep();
  sync_folder(folder_of(target_));
  return {};
}

}  // namespace umbrix::io::detail
