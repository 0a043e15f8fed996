// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "io/atomic_file.h"
#include "umbrix/io/image_file.h"

namespace umbrix::io::detail {

/// Encodes `pixels` (of type `type`, interleaved, whole image) with OpenImageIO's writer `format` into `file`.
Status write_with_oiio(const char* format, AtomicFile& file, const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type,
                       const void* pixels);

/// What all formats store: who wrote it, the caller's text attributes, and a fixed time, since OpenImageIO would put
/// the clock's and equal images should be equal files.
void set_common_attributes(OIIO::ImageSpec& spec, const Image& image);

}  // namespace umbrix::io::detail
