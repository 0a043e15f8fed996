// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace umbrix::render {

/// Runs `work` with at most `count` threads (at least 1) for all that it does in parallel, building included; also with
/// more threads than the machine has cores.
void with_threads(int count, const std::function<void()>& work);

}  // namespace umbrix::render
