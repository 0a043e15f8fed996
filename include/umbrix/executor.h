// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace umbrix {

/// How the library runs work in parallel. Results never depend on it. Without a function it is oneTBB.
/// `parallel_for` calls body(data, i) once for each i < count, in any order and from any threads, and returns
/// when all have returned. It must allow nested calls (running them inline is enough).
struct Executor {
  void (*parallel_for)(void* context, std::size_t count, void (*body)(void* data, std::size_t index),
                       void* data) = nullptr;
  void* context = nullptr;
  std::size_t threads = 0;  ///< how many calls run at once, for work that has to be cut well; 0: as many as the machine
};

}  // namespace umbrix
