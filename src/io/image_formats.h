// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/atomic_file.h"
#include "umbrix/io/image_file.h"

/// The output formats, one line each: name (of the function write_<name> too) and file extension. A writer fills
/// a file that was begun from an image whose fields agree with each other.
#define UMBRIX_IMAGE_FORMATS(FORMAT) \
  FORMAT(exr, ".exr")                \
  FORMAT(png, ".png")

namespace umbrix::io::detail {

#define UMBRIX_DECLARE_WRITER(name, extension) \
  Status write_##name(AtomicFile& file, const Image& image, const WriteOptions& options);
UMBRIX_IMAGE_FORMATS(UMBRIX_DECLARE_WRITER)
#undef UMBRIX_DECLARE_WRITER

}  // namespace umbrix::io::detail
