// SPDX-License-Identifier: Apache-2.0
// umbrix_scenes OUT_DIR [NAME...] writes the scenes of this folder as .glb files.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "glb.h"

namespace umbrix::scenes {
namespace {

struct Entry {
  const char* name;
  Scene (*make)();
};
/// A scene is one line here and one file beside this one.
constexpr std::array kEntries{
    Entry{"atrium", atrium},   Entry{"bedroom", bedroom}, Entry{"conference", conference},
    Entry{"cornell", cornell}, Entry{"forest", forest},
};

void write(const Scene& scene, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / (scene.name + ".glb");
  const std::string bytes = glb(scene);
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::runtime_error(fmt::format("{}: cannot write", path.string()));
  const TriangleCounts triangles = count_triangles(scene);
  fmt::print("{:<11}{:>8} triangles stored{:>8} flattened{:>3} lights{:>8} bytes\n", scene.name, triangles.stored,
             triangles.flattened, scene.lights.size(), bytes.size());
}

}  // namespace
}  // namespace umbrix::scenes

int main(int argc, char** argv) {
  using namespace umbrix::scenes;
  CLI::App app{"Writes Umbrix's own scenes as .glb files."};
  std::string folder;
  std::vector<std::string> wanted, names;
  for (const Entry& entry : kEntries) names.emplace_back(entry.name);
  app.add_option("OUT_DIR", folder, "where to write")->required()->check(CLI::ExistingDirectory);
  app.add_option("NAME", wanted, "scenes to write; all by default")->check(CLI::IsMember(names));
  CLI11_PARSE(app, argc, argv);
  try {
    for (const Entry& entry : kEntries) {
      const bool asked = wanted.empty() || std::find(wanted.begin(), wanted.end(), entry.name) != wanted.end();
      if (asked) write(entry.make(), folder);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "umbrix_scenes: {}\n", error.what());
    return 1;
  }
}
