// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <string>
#include <vector>

namespace umbrix::io::detail {

/// Opens an image whose size is within limits, by its first bytes: OpenEXR, PNG or Radiance HDR. (OpenImageIO would try
/// each of its formats.) Throws LoadError without the file's name.
std::unique_ptr<OIIO::ImageInput> open_image(const std::string& path);

/// The same for an image in memory, which must be PNG or JPEG, of at most `most_pixels`. Colours are not multiplied by
/// alpha. `bytes` must outlive the result.
struct EncodedImage {
  EncodedImage(const std::vector<unsigned char>& bytes, std::uint64_t most_pixels);

  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;  ///< before `input`, which reads from it
  std::unique_ptr<OIIO::ImageInput> input;
};

}  // namespace umbrix::io::detail
