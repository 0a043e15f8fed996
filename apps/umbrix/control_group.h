// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace umbrix::app {

/// The folders of this process' control group and of the groups around it, by which a container is limited (Linux,
/// Documentation/admin-guide/cgroup-v2.rst; of version 1 those of the controller named).
std::vector<std::filesystem::path> control_groups(const std::string& controller);

}  // namespace umbrix::app
