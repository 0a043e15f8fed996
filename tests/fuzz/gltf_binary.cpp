// SPDX-License-Identifier: Apache-2.0
// Bytes as a .glb file. With libFuzzer, glb_mutator.cpp keeps most of its lengths right.
#include "input_folder.h"
#include "loading.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace umbrix::fuzz;
  static const InputFolder folder;
  check_loading(folder.write("scene.glb", data, size), size % 32 != 0);
  return 0;
}
