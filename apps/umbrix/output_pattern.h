// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace umbrix::app {

/// How many places for a frame number a file's name has: a run of #, one for each digit, or %d, %04d and the like.
/// Folders have none.
std::size_t frame_places(const std::string& path);

/// The path with the frame's number in its places, padded with zeros, and wider where it needs to be.
std::string path_of_frame(const std::string& path, int frame);

/// Whether the name ends so (".png"), in whatever case.
bool has_extension(const std::string& path, const std::string& extension);

}  // namespace umbrix::app
