// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>

namespace umbrix::io::detail {

/// Opens an image whose size is within limits, by its first bytes: OpenEXR, PNG or Radiance HDR. (OpenImageIO would try
/// each of its formats.) Throws LoadError without the file's name.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path);

}  // namespace umbrix::io::detail
