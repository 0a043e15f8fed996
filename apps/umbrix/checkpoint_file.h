// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/pixel_rect.h"
#include "umbrix/io/image_file.h"
#include "umbrix/status.h"

namespace umbrix::app {

/// Writes the pixels of an image's finished tiles, replacing what is there. `key` tells what they are of: job, frame
/// and part. The file is for the next run on a like machine: floats as they are in memory.
Status write_checkpoint(const std::string& path, const std::string& key, const io::Image& image,
                        const std::vector<render::PixelRect>& tiles, const std::vector<std::uint8_t>& finished);

/// Fills in the pixels of the tiles that such a file has, and sets `finished`. Returns false, and changes nothing, if
/// there is none, it is not whole, or of another key.
bool read_checkpoint(const std::string& path, const std::string& key, const std::vector<render::PixelRect>& tiles,
                     io::Image& image, std::vector<std::uint8_t>& finished);

}  // namespace umbrix::app
