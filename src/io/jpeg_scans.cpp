// SPDX-License-Identifier: Apache-2.0
// After ITU-T T.81 (1992), annex B: markers are a byte 0xFF and one that is not zero; most begin a segment, whose
// length (big endian) counts itself.
#include "io/jpeg_scans.h"

#include <cstddef>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// Encoders make about ten; libjpeg-turbo's own fuzzers stop at 500.
constexpr int kMostScans = 100;

constexpr unsigned char kStartOfScan = 0xDA, kEndOfImage = 0xD9;

// 0xFF00 is a byte of the image's, the others of these have no segment.
bool stands_alone(unsigned char marker) { return marker == 0 || marker == 1 || (marker >= 0xD0 && marker <= 0xD8); }

}  // namespace

void check_jpeg_scans(const std::vector<unsigned char>& bytes) {
  int scans = 0;
  for (std::size_t at = 0; at + 4 <= bytes.size();) {
    const unsigned char marker = bytes[at + 1];
    if (bytes[at] != 0xFF || marker == 0xFF) {
      ++at;
    } else if (stands_alone(marker)) {
      at += 2;
    } else if (marker == kEndOfImage) {
      return;
    } else {
      if (marker == kStartOfScan && ++scans > kMostScans)
        over_limit("the JPEG file has more than {} scans", kMostScans);
      at += 2 + (std::size_t{bytes[at + 2]} << 8 | bytes[at + 3]);
    }
  }
}

}  // namespace umbrix::io::detail
