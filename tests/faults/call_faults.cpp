// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program, makes one call of the system fail: UMBRIX_FAIL=CALL:N:HOW fails the N-th call, of those on
// files below the folder UMBRIX_FAIL_IN. HOW is an error's name, or "short" for half of a read or write. When the call
// has failed the file UMBRIX_FAIL_MARK is made.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

namespace {

struct Fault {
  char call[16] = {};
  long number = 0;
  int error = 0;  ///< 0: a short read or write
  const char* folder = nullptr;
  std::atomic<long> seen{0};

  Fault() {
    const char* const text = std::getenv("UMBRIX_FAIL");
    folder = std::getenv("UMBRIX_FAIL_IN");
    if (!text || !folder) return;
    const char* const first = std::strchr(text, ':');
    const char* const second = first ? std::strchr(first + 1, ':') : nullptr;
    if (!second || static_cast<std::size_t>(first - text) >= sizeof call) return;
    std::memcpy(call, text, static_cast<std::size_t>(first - text));
    number = std::atol(first + 1);
    const char* const how = second + 1;
    error = std::strcmp(how, "ENOSPC") == 0  ? ENOSPC
            : std::strcmp(how, "EIO") == 0   ? EIO
            : std::strcmp(how, "EINTR") == 0 ? EINTR
                                             : 0;
  }

  bool is_below(const char* path) const { return std::strncmp(path, folder, std::strlen(folder)) == 0; }

  /// Is this call of this name on this file the one to fail?
  bool hits(const char* name, const char* path) {
    if (number == 0 || std::strcmp(name, call) != 0 || !is_below(path) || ++seen != number) return false;
    if (const char* mark = std::getenv("UMBRIX_FAIL_MARK"))
      syscall(SYS_close, syscall(SYS_openat, AT_FDCWD, mark, O_CREAT | O_WRONLY, 0600));
    errno = error;
    return true;
  }

  bool hits(const char* name, int file) {
    if (number == 0) return false;
    char link[] = "/proc/self/fd/0123456789";
    char path[4096] = {};
    char digits[12];
    int count = 0;
    do digits[count++] = static_cast<char>('0' + file % 10);
    while ((file /= 10) > 0);
    char* at = link + std::strlen("/proc/self/fd/");
    while (count > 0) *at++ = digits[--count];
    *at = 0;
    return readlink(link, path, sizeof path - 1) > 0 && hits(name, path);
  }
};

Fault& fault() {
  static Fault the_fault;
  return the_fault;
}

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// How many bytes to ask for when a call is to be short.
std::size_t half(std::size_t size) { return size > 1 ? size / 2 : size; }

}  // namespace

#define NEXT(name) next(&name, #name)

extern "C" {

int open(const char* path, int flags, ...) {
  va_list list;
  va_start(list, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(list, mode_t) : 0;
  va_end(list);
  if (fault().hits("open", path)) return -1;
  return static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}

ssize_t read(int file, void* data, size_t size) {
  if (fault().hits("read", file)) {
    if (fault().error != 0) return -1;
    size = half(size);
  }
  return NEXT(read)(file, data, size);
}

ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  if (fault().hits("pwrite", file)) {
    if (fault().error != 0) return -1;
    size = half(size);
  }
  return NEXT(pwrite)(file, data, size, offset);
}

int fsync(int file) { return fault().hits("fsync", file) ? -1 : NEXT(fsync)(file); }

// A close that fails has closed.
int close(int file) {
  const bool fails = fault().hits("close", file);
  const int result = NEXT(close)(file);
  if (fails) errno = fault().error;
  return fails ? -1 : result;
}

int rename(const char* from, const char* to) { return fault().hits("rename", from) ? -1 : NEXT(rename)(from, to); }

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  return fault().hits("rename", from) ? -1 : NEXT(renameat2)(from_folder, from, to_folder, to, flags);
}
}
