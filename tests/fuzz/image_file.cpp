// SPDX-License-Identifier: Apache-2.0
// Bytes as an image. The decoders are libraries'; what is ours is what is asked of them, and the memory it takes.
#include "umbrix/io/image_file.h"

#include <cstring>

#include "input_folder.h"
#include "loading.h"
#include "promise.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrix;
  static const fuzz::InputFolder folder;
  const bool is_png = size > 0 && data[0] == 0x89;
  io::Image image;
  const Status status = io::read_image(folder.write(is_png ? "image.png" : "image.exr", data, size), image);
  if (!status) {
    fuzz::check_refusal(status);
    fuzz::promise(image.pixels.empty(), "nothing is left of a refused image");
    return 0;
  }
  fuzz::promise(image.width > 0 && image.height > 0 && !image.channels.empty(), "an image is not empty");
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  fuzz::promise(image.pixels.size() == count * image.channels.size(), "an image's pixels match its size");
  return 0;
}
