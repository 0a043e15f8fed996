// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// Reads a regular file (see check_readable) that holds a latitude-longitude map, OpenEXR or Radiance HDR, of at most
/// `most_pixels`, which is checked before it is decoded. Throws LoadError without the file's name.
EnvironmentMap read_environment(const std::string& path, std::uint64_t most_pixels);

}  // namespace umbrix::io::detail
