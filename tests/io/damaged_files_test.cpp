// SPDX-License-Identifier: Apache-2.0
// Files cut at every byte and with every bit flipped: each loads or is refused in one line. Nothing is asserted on
// which; sanitizers and the promises of loading.h judge.

#include <gtest/gtest.h>

#include "fuzz/loading.h"
#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::Gltf;
using testing::TempFolder;

// One of each kind of thing that the loader reads.
Gltf rich_file() {
  Gltf g = testing::one_triangle();
  const int sparse = g.view(bytes_of(std::vector<std::uint16_t>{0, 2}));
  g.json["accessors"][0]["sparse"] = {
      {"count", 2}, {"indices", {{"bufferView", sparse}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
  g.json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}, {"alphaMode", "MASK"}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", {{"outerConeAngle", 0.5}}}}};
  g.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  const int node = g.root({{"camera", 0}, {"rotation", {0, 0, 0, 1}}});
  g.animate(0, node, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  return g;
}

void try_all_cuts(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  for (std::size_t length = 1; length < bytes.size(); ++length) {
    SCOPED_TRACE(length);
    SceneFile scene;
    const Status status = load_scene(folder.write(name, bytes.substr(0, length)), scene);
    ASSERT_EQ(status.code(), StatusCode::bad_input) << status.message();
    fuzz::check_refusal(status);
  }
}

TEST(DamagedFiles, CutAnywhere) {
  try_all_cuts("cut.glb", rich_file().glb());
  try_all_cuts("cut.gltf", rich_file().text());
}

// The header admits the cut, so that what comes after it is looked at as well.
TEST(DamagedFiles, CutAnywhereWithAHeaderThatAdmitsIt) {
  const TempFolder folder;
  const std::string whole = rich_file().glb();
  for (std::size_t length = 12; length < whole.size(); ++length) {
    std::string bytes = whole.substr(0, length);
    bytes.replace(8, 4, bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(length)}));
    fuzz::check_loading(folder.write("cut.glb", bytes), true);
  }
}

TEST(DamagedFiles, AnyBitFlipped) {
  const TempFolder folder;
  for (const auto& [name, bytes] :
       {std::pair("flipped.glb", rich_file().glb()), {"flipped.gltf", rich_file().text()}}) {
    for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
      std::string flipped = bytes;
      flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
      fuzz::check_loading(folder.write(name, flipped), true);
    }
  }
}

}  // namespace
}  // namespace umbrix::io
