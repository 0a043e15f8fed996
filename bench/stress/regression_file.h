// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "judge/regressions.h"

namespace umbrix::bench {

/// Adds those that a file does not have yet, making it if need be; the file is changed as a whole or not at all.
/// `*added` receives how many.
Status append_regressions(const std::string& path, const std::vector<judge::Regression>& regressions,
                          std::size_t* added);

}  // namespace umbrix::bench
