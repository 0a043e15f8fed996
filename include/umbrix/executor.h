// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace umbrix {

/// How the library runs work in parallel. Results never depend on it.
/// `parallel_for` calls body(data, i) once for each i < count, in any order and from any threads, and returns
/// when all have returned. It must allow nested calls (running them inline is enough).
struct Executor {
  void (*parallel_for)(void* context, std::size_t count, void (*body)(void* data, std::size_t index),
                       void* data) = nullptr;
  void* context = nullptr;
};

}  // namespace umbrix
