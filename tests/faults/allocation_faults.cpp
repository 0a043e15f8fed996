// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program, makes memory run out after main has begun: UMBRIX_FAIL_ALLOCATION=N fails the N-th request,
// "N+" that one and all after it. When main has ended, the number of requests goes to the file UMBRIX_FAIL_COUNT.
#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

std::atomic<bool> counting{false};
std::atomic<long> seen{0};
long number = 0;        ///< of the request that fails
bool fails_on = false;  ///< all after that too
int (*real_main)(int, char**, char**) = nullptr;

bool fails() {
  if (!counting) return false;
  const long request = ++seen;
  if (request < number || (request > number && !fails_on)) return false;
  errno = ENOMEM;
  return true;
}

int counted_main(int argc, char** argv, char** environment) {
  if (const char* text = std::getenv("UMBRIX_FAIL_ALLOCATION")) {
    fails_on = std::strchr(text, '+') != nullptr;
    number = std::atol(text);
    counting = number > 0;
  }
  const int code = real_main(argc, argv, environment);
  counting = false;
  if (const char* path = std::getenv("UMBRIX_FAIL_COUNT")) {
    if (std::FILE* const file = std::fopen(path, "w")) {
      std::fprintf(file, "%ld\n", seen.load());
      std::fclose(file);
    }
  }
  return code;
}

}  // namespace

extern "C" {

void* malloc(size_t size) { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* memory, size_t size) { return fails() ? nullptr : __libc_realloc(memory, size); }
void* memalign(size_t alignment, size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(size_t alignment, size_t size) { return fails() ? nullptr : __libc_memalign(alignment, size); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  if (fails()) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory ? 0 : ENOMEM;
}

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, int (*init)(int, char**, char**),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  real_main = main;
  const auto start = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(&counted_main, argc, argv, init, fini, rtld_fini, stack_end);
}
}
