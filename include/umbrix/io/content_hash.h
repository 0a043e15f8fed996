// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "umbrix/export.h"
#include "umbrix/status.h"

/// Hashes that tell equal content from different: XXH3, 128 bits, as 32 hexadecimal digits. Safe against accidents, not
/// against someone who wants two contents to have one hash.
namespace umbrix::io {

UMBRIX_API std::string content_hash(std::string_view bytes);

/// Of a regular file's bytes. bad_input names the file.
UMBRIX_API Status hash_file(const std::string& path, std::string& out);

/// Reads a file of at most `limit` bytes that write_text wrote. bad_input or resource_limit names the file; `out` is
/// then empty.
UMBRIX_API Status read_text(const std::string& path, std::uint64_t limit, std::string& out);

}  // namespace umbrix::io
