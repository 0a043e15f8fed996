// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "umbrix/export.h"
#include "umbrix/status.h"

/// EXR and PNG out.
namespace umbrix::io {

enum class PixelType { half, single };

/// A float image, rows from the top, channels interleaved. Linear Rec.709 where it is colour.
struct Image {
  int width = 0;
  int height = 0;
  int x = 0, y = 0;                       ///< where its upper left pixel is in the frame that it is a part of
  int frame_width = 0, frame_height = 0;  ///< of that frame; 0: the image is all of it. Only EXR keeps these
  PixelType pixel_type =
      PixelType::single;  ///< of the file it was read from, depths aside; what is written goes by WriteOptions
  std::vector<std::string> channels;                                 ///< "R", "G", "B", "A", "normal.X", "depth.Z", ...
  std::vector<float> pixels;                                         ///< width * height * channels.size()
  std::vector<std::pair<std::string, std::string>> metadata;         ///< text attributes
  std::vector<std::pair<std::string, std::vector<float>>> matrices;  ///< 16 floats each, e.g. worldToCamera
};

enum class ToneMap { none, srgb, aces, agx };

struct WriteOptions {
  PixelType pixel_type = PixelType::half;  ///< EXR; depths (Z, *.Z) are floats always, large halves end at 65504
  float exposure = 0;                      ///< stops, PNG
  ToneMap tone_map = ToneMap::srgb;        ///< PNG; none: linear values clamped and stored without a curve
  bool overwrite = false;                  ///< otherwise an existing file is an error
};

/// Fails as write_image would, for what can be known before rendering: format, folder, existing file.
UMBRIX_API Status check_output(const std::string& path, const WriteOptions& options);

/// Writes by extension: .exr takes all channels, linear, and an `umbrix:checksum` (see image_checksum); .png takes R,
/// G, B through exposure, tone map and sRGB curve. The file appears whole or not at all (written under a temporary
/// name, then renamed); its bytes depend on the arguments only. output_failed names the file and the reason.
UMBRIX_API Status write_image(const std::string& path, const Image& image, const WriteOptions& options);

/// Reads an OpenEXR, PNG or Radiance HDR image as floats (colour not converted). bad_input, or resource_limit for an
/// image that is too large, for us or for its file, names the file; `out` is then empty.
UMBRIX_API Status read_image(const std::string& path, Image& out);

/// Of all that an image holds but its attribute `umbrix:checksum` and texts that are not ours ("umbrix:..."). That of
/// an EXR file as read_image gives it equals its attribute, unless something has changed it: OpenEXR does not notice in
/// what it could not compress.
UMBRIX_API std::string image_checksum(const Image& image);

/// Writes text or bytes atomically, for reports. "-" is standard output: cancelled if it is a pipe that nobody reads
/// any more (and SIGPIPE is ignored).
UMBRIX_API Status write_text(const std::string& path, const std::string& text, bool overwrite);

/// Removes the temporaries of all files that are being written, for a program that is about to end: those writes then
/// fail. Safe in a signal handler, and from any thread.
UMBRIX_API void remove_temporaries() noexcept;

}  // namespace umbrix::io
