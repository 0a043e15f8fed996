// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace umbrix::io::detail {

/// How much of an OpenEXR file check_exr_header wants to see, if there is as much.
inline constexpr std::uint64_t kExrHeaderBytes = 16u << 20;

/// Looks at the start of an OpenEXR file before OpenEXR does, which asks for memory by whatever the header says: texts
/// longer than the file, tables of chunks and buffers of rows for an image of any size. Throws LoadError.
void check_exr_header(const std::vector<unsigned char>& start, std::uint64_t file_bytes);

/// Of a file of one part, written in rows: has its table of offsets a place for each of them? OpenEXR may lose some for
/// want of memory, and say nothing. Throws LoadError if the header is not one.
bool has_all_exr_rows(const std::vector<unsigned char>& start, std::uint64_t file_bytes);

}  // namespace umbrix::io::detail
