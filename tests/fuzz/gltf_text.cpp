// SPDX-License-Identifier: Apache-2.0
// Bytes as a .gltf file. "a.bin" lies beside it, for buffers kept in files.
#include <string>

#include "input_folder.h"
#include "loading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrix::fuzz;
  static const InputFolder folder;
  static const std::string buffer = folder.write("a.bin", std::string(512, '\x3f').data(), 512);
  check_loading(folder.write("scene.gltf", data, size), size % 8 != 0);
  return 0;
}
