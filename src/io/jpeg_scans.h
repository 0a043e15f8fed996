// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace umbrix::io::detail {

/// Counts a JPEG's scans before libjpeg decodes them: each goes over the whole image, however few bytes it takes.
/// Throws LoadError.
void check_jpeg_scans(const std::vector<unsigned char>& bytes);

}  // namespace umbrix::io::detail
