// SPDX-License-Identifier: Apache-2.0
#include "io/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

namespace fs = std::filesystem;

// Owns a file descriptor.
struct File {
  int number = -1;
  std::uint64_t bytes = 0;
  ~File() {
    if (number >= 0) ::close(number);
  }
};

// Of the OpenedFiles of this thread.
thread_local std::vector<std::string>* opened = nullptr;

void note_opened(const std::string& path) {
  if (opened && std::find(opened->begin(), opened->end(), path) == opened->end()) opened->push_back(path);
}

// Non-blocking, so that a pipe nobody writes to cannot hang the program.
void open_regular(const std::string& path, File& file) {
  note_opened(path);
  do {
    file.number = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  } while (file.number < 0 && errno == EINTR);
  struct stat info {};
  if (file.number < 0 || ::fstat(file.number, &info) != 0) {
    bad_input("cannot be read: {}", std::generic_category().message(errno));
  }
  if (S_ISDIR(info.st_mode)) bad_input("is a folder, not a file");
  if (!S_ISREG(info.st_mode)) bad_input("is not a regular file");
  file.bytes = static_cast<std::uint64_t>(info.st_size);
}

std::vector<unsigned char> read_bytes(const File& file, std::uint64_t count) {
  std::vector<unsigned char> bytes(count);
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::read(file.number, bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) bad_input("cannot be read: {}", std::generic_category().message(errno));
    if (got == 0) bad_input("became shorter while it was read");
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

// Is `path`, with links followed, below `folder`?
bool lies_within(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  const fs::path root = error ? fs::path() : fs::canonical(folder, error);
  if (error == std::errc::not_enough_memory) throw std::bad_alloc();
  if (error) return false;
  const fs::path relative = real.lexically_relative(root);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

OpenedFiles::OpenedFiles(std::vector<std::string>& paths) noexcept : before_(std::exchange(opened, &paths)) {}

OpenedFiles::~OpenedFiles() { opened = before_; }

std::string path_beside(const std::string& from, const std::string& name, bool stay_inside, const std::string& label,
                        const char* kind) {
  if (name.find('\0') != std::string::npos) bad_input("{}: the file name has a zero byte", label);
  fs::path folder = fs::path(from).parent_path();
  if (folder.empty()) folder = ".";
  const fs::path path = folder / name;
  if (stay_inside && (fs::path(name).is_absolute() || !lies_within(path, folder))) {
    bad_input("{}: '{}' leads outside the {}'s folder", label, printable(name, 128), kind);
  }
  return path.string();
}

Status check_readable(const std::string& path) {
  try {
    File file;
    open_regular(path, file);
    if (file.bytes == 0) bad_input("is empty");
    return {};
  } catch (const LoadError& e) {
    return {e.code, printable(path) + ": " + e.what};
  }
}

std::vector<unsigned char> read_file(const std::string& path, std::uint64_t limit) {
  File file;
  open_regular(path, file);
  if (file.bytes == 0) bad_input("is empty");
  if (file.bytes > limit) over_limit("has {} bytes, the limit is {}", file.bytes, limit);
  return read_bytes(file, file.bytes);
}

void read_in_pieces(const std::string& path, const std::function<void(const unsigned char*, std::size_t)>& take) {
  constexpr std::uint64_t kPiece = 1u << 20;
  File file;
  open_regular(path, file);
  for (std::uint64_t left = file.bytes; left > 0;) {
    const std::vector<unsigned char> bytes = read_bytes(file, std::min(left, kPiece));
    take(bytes.data(), bytes.size());
    left -= bytes.size();
  }
}

std::vector<unsigned char> read_start(const std::string& path, std::uint64_t most, std::uint64_t& file_bytes) {
  File file;
  open_regular(path, file);
  if (file.bytes == 0) bad_input("is empty");
  file_bytes = file.bytes;
  return read_bytes(file, std::min(file.bytes, most));
}

}  // namespace umbrix::io::detail
