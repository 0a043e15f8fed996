// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace umbrix::bench {

/// What a measurement ran on and with: processor, cores, system, compiler, versions, instruction set, date (UTC).
nlohmann::json machine_json();

/// The load averages of the last 1, 5 and 15 minutes; null where the system does not tell.
nlohmann::json load_json();

}  // namespace umbrix::bench
