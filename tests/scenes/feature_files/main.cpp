// SPDX-License-Identifier: Apache-2.0
// Writes the files of tests/scenes/features: umbrix_feature_files FOLDER.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "stage.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  umbrix::features::Files files;
  for (const auto add :
       {umbrix::features::add_geometry, umbrix::features::add_placement, umbrix::features::add_materials,
        umbrix::features::add_textures, umbrix::features::add_alpha, umbrix::features::add_views,
        umbrix::features::add_animations, umbrix::features::add_shapes, umbrix::features::add_compressed}) {
    add(files);
  }
  for (const auto& [name, bytes] : files) {
    std::ofstream file(folder / name, std::ios::binary);
    if (!(file << bytes).flush()) {
      std::fprintf(stderr, "cannot write %s\n", (folder / name).c_str());
      return 1;
    }
  }
}
