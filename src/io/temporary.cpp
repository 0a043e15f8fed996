// SPDX-License-Identifier: Apache-2.0
#include "io/temporary.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "umbrix/io/image_file.h"

namespace umbrix::io {
namespace detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = ".umbrix-";
constexpr time_t kOldSeconds = 60;

/// The names of files that are being written, where a signal handler finds them: fixed places, lock-free states.
struct Slot {
  enum State : int { free, taken, filled };
  std::atomic<int> state{free};
  char name[PATH_MAX];
};
std::array<Slot, 64> slots;
std::atomic<bool> removing{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// -1 if all are taken: the file is then removed by its owner only.
int take_slot(const std::string& name) noexcept {
  if (name.size() >= sizeof Slot::name) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    int expected = Slot::free;
    if (!slots[i].state.compare_exchange_strong(expected, Slot::taken)) continue;
    std::memcpy(slots[i].name, name.c_str(), name.size() + 1);
    slots[i].state = Slot::filled;
    return static_cast<int>(i);
  }
  return -1;
}

void free_slot(int& slot) noexcept {
  if (slot >= 0) slots[static_cast<std::size_t>(slot)].state = Slot::free;
  slot = -1;
}

/// What all temporaries of a target begin with. Long names are cut, since names end at 255 bytes.
std::string prefix_of(const std::string& target) {
  constexpr std::size_t kMostBytes = 200;
  const fs::path path(target);
  return path.filename().string().substr(0, kMostBytes) + kMark;
}

bool is_number_pair(std::string_view text) {
  const std::size_t dash = text.find('-');
  if (dash == 0 || dash == std::string_view::npos || dash + 1 == text.size()) return false;
  return text.find_first_not_of("0123456789-") == std::string_view::npos && text.find('-', dash + 1) == text.npos;
}

bool is_same_file(int file, const std::string& name) {
  struct stat open {};
  struct stat named {};
  return ::fstat(file, &open) == 0 && ::lstat(name.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

void remove_if_left(const std::string& name) {
  struct stat info {};
  if (::lstat(name.c_str(), &info) != 0 || !S_ISREG(info.st_mode) || ::time(nullptr) - info.st_mtime < kOldSeconds)
    return;
  const int file = ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  if (::flock(file, LOCK_EX | LOCK_NB) == 0 && is_same_file(file, name)) ::unlink(name.c_str());
  ::close(file);
}

}  // namespace

Temporary::~Temporary() {
  if (file_ < 0) return;
  ::unlink(name_.c_str());
  free_slot(slot_);
  ::close(file_);
}

void Temporary::keep() noexcept {
  free_slot(slot_);
  ::close(file_);
  file_ = -1;
}

/// Known before it is there, so that no signal falls in between.
bool Temporary::open_unique(const std::string& name, int& error) {
  slot_ = take_slot(name);
  do {
    file_ = ::open(name.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666);
  } while (file_ < 0 && errno == EINTR);
  error = file_ < 0 ? errno : 0;
  if (file_ >= 0) {
    if (removing) ::unlink(name.c_str());
    // Not all file systems have locks; then the age alone tells.
    const bool is_ours = ::flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (is_ours && is_same_file(file_, name)) return true;
    ::close(file_);
    file_ = -1;
    error = EEXIST;
  }
  free_slot(slot_);
  return false;
}

int Temporary::create(const std::string& target) {
  static std::atomic<unsigned> next{0};
  constexpr int kMostTries = 1000;
  const std::string start =
      (fs::path(target).parent_path() / prefix_of(target)).string() + std::to_string(::getpid()) + '-';
  int error = EEXIST;
  for (int i = 0; i < kMostTries && error == EEXIST; ++i) {
    name_ = start + std::to_string(next++);
    if (open_unique(name_, error)) return 0;
  }
  return error;
}

void sweep_temporaries(const std::string& target) noexcept try {
  const std::string prefix = prefix_of(target);
  const fs::path parent = fs::path(target).parent_path();
  std::error_code error;
  for (fs::directory_iterator entry(parent.empty() ? "." : parent, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.compare(0, prefix.size(), prefix) == 0 && is_number_pair(std::string_view(name).substr(prefix.size())))
      remove_if_left(entry->path().string());
  }
} catch (const std::exception&) {
  // Without memory the next run sweeps.
}

}  // namespace detail

void remove_temporaries() noexcept {
  const int before = errno;
  detail::removing = true;
  for (const detail::Slot& slot : detail::slots) {
    if (slot.state == detail::Slot::filled) ::unlink(slot.name);
  }
  errno = before;
}

}  // namespace umbrix::io
