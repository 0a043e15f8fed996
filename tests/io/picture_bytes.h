// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace umbrix::io::testing {

/// A PNG of 8 bits with 1 to 4 channels, rows from the top.
std::string png_bytes(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                      const std::vector<std::uint8_t>& pixels);

/// A PNG that says to have this size, and has no pixels.
std::string png_without_pixels(std::uint32_t width, std::uint32_t height, std::uint32_t channels);

/// A JPEG of 8 x 8 grey pixels, all 188, in base64.
extern const char* const kGreyJpeg;

}  // namespace umbrix::io::testing
