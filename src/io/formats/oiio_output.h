// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "umbrix/io/image_file.h"

namespace umbrix::io::detail {

/// Writes `pixels` (of type `type`, interleaved, whole image) with OpenImageIO's writer `format`, whatever the
/// extension of `path`. The message of a failure does not name the file.
Status write_with_oiio(const char* format, const std::string& path, const OIIO::ImageSpec& spec,
                       const OIIO::TypeDesc& type, const void* pixels);

/// What all formats store: who wrote it, the caller's text attributes, and a fixed time, since OpenImageIO would put
/// the clock's and equal images should be equal files.
void set_common_attributes(OIIO::ImageSpec& spec, const Image& image);

}  // namespace umbrix::io::detail
