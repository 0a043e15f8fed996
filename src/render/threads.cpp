// SPDX-License-Identifier: Apache-2.0
#include "render/threads.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace umbrix::render {

void with_threads(int count, const std::function<void()>& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count));
  tbb::task_arena arena(count);
  arena.execute(work);
}

}  // namespace umbrix::render
