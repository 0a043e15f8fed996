// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "umbrix/io/image_file.h"

namespace umbrix::io::detail {

inline constexpr const char* kChecksumAttribute = "umbrix:checksum";

/// image_checksum of `image` with `pixels` in place of its own.
std::string checksum_of(const Image& image, const std::vector<float>& pixels);

}  // namespace umbrix::io::detail
