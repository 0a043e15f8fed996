// SPDX-License-Identifier: Apache-2.0
// The large benchmark scenes, where they are present: UMBRIX_SCENES_DIR, or beside the checkout.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

TEST(SharedScenes, LoadWithTheirTriangleCountsAndSetups) {
  const char* variable = std::getenv("UMBRIX_SCENES_DIR");
  const std::filesystem::path folder = variable ? variable : UMBRIX_SCENES_DIR_DEFAULT;
  std::ifstream in(folder / "scenes.json");
  if (!in) GTEST_SKIP() << "no scenes in " << folder;
  for (const nlohmann::json& entry : nlohmann::json::parse(in)) {
    const auto file = entry.at("file").get<std::string>();
    SCOPED_TRACE(file);
    SceneFile scene;
    const Status status = load_scene((folder / file).string(), scene);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(scene.instanced_triangles(), entry.at("triangles").get<std::uint64_t>());
    std::uint64_t stored = 0;
    for (const Mesh& mesh : scene.meshes) stored += mesh.triangles.size();
    EXPECT_EQ(stored, entry.at("stored_triangles").get<std::uint64_t>());
    io::Setup setup;
    const Status read = load_setup((folder / "scenes.json").string(), scene, setup);
    ASSERT_TRUE(read.ok()) << read.message();
    EXPECT_TRUE(setup.camera.has_value());
    EXPECT_EQ(setup.lights.size(), entry.at("lights").size());
  }
}

}  // namespace
}  // namespace umbrix::io
