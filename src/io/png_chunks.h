// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

namespace umbrix::io::detail {

/// Looks at the chunks in the start of a PNG file before libpng does, which asks for memory by a chunk's length: only
/// image data may be longer than the file, and compressed texts must be short. Throws LoadError.
///
/// With all of the file at hand, `whole` refuses one that ends before its image does, of which libpng would tell the
/// terminal.
void check_png_chunks(const std::vector<unsigned char>& start, std::uint64_t file_bytes, bool whole = false);

}  // namespace umbrix::io::detail
