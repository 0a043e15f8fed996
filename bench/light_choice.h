// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <string>
#include <vector>

#include "umbrix/status.h"

namespace umbrix::bench {

/// Takes a number or "all".
CLI::Validator light_validator();

/// The lights that such a text means, of `count` that the scene at `path` has. invalid_argument if it has no such one.
Status choose_lights(const std::string& text, std::size_t count, const std::string& path,
                     std::vector<std::size_t>& out);

}  // namespace umbrix::bench
