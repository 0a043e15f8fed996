// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_gpu_instancing.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "posed_scene.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::corner;
using testing::expect_near;
using testing::Gltf;
using testing::load;
using testing::Numbers;
using testing::pose;
using testing::TempFolder;

const float kHalf = std::sqrt(0.5f);

/// The triangle at places of EXT_mesh_gpu_instancing.
Gltf with_instances(const std::vector<float>& translations) {
  Gltf g = testing::one_triangle();
  g.json["extensionsUsed"] = g.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", g.floats3(translations)}};
  return g;
}

nlohmann::json& instancing(Gltf& g) {
  return g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
}

TEST(GpuInstancing, EachElementIsAnInstance) {
  Gltf g = with_instances({0, 0, 0, 1, 2, 3});
  g.json["nodes"][0]["scale"] = {2, 2, 2};
  const std::vector<std::int8_t> turns = {0, 0, 0, 127, 0, 0, 90, 90};  // about z by nothing and by a quarter
  const int rotation = g.accessor(bytes_of(turns), 5120, 2, "VEC4");
  g.json["accessors"][static_cast<std::size_t>(rotation)]["normalized"] = true;
  instancing(g)["ROTATION"] = rotation;
  instancing(g)["SCALE"] = g.floats3({1, 1, 1, 3, 1, 1});
  instancing(g)["_ID"] = rotation;
  SceneFile scene = load(g);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].name, "only");
  EXPECT_EQ(scene.instanced_triangles(), 2u);
  expect_near(corner(scene, 0, 1), {2, 0, 0});
  expect_near(corner(scene, 1, 1), {2, 2 * (2 + 3), 6});
  EXPECT_TRUE(scene.ignored.empty());
}

TEST(GpuInstancing, InstancesMoveWithTheirNode) {
  Gltf g = with_instances({0, 0, 0, 1, 0, 0});
  g.animate(0, 0, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, kHalf, kHalf});
  SceneFile scene = load(g);
  EXPECT_EQ(pose(scene, 1).instances, (Numbers{0, 1}));
  expect_near(corner(scene, 1, 1), {0, 2, 0});
}

TEST(GpuInstancing, FaultsAreRefused) {
  const auto refused = [](const char* message, const std::function<void(Gltf&)>& make, LoadLimits limits = {}) {
    Gltf g = with_instances({0, 0, 0, 1, 0, 0});
    load(g);
    make(g);
    const TempFolder folder;
    SceneFile scene;
    const Status status = load_scene(folder.write("scene.glb", g.glb()), scene, limits);
    EXPECT_FALSE(status.ok()) << message;
    EXPECT_NE(status.message().find(message), std::string::npos) << status.message();
  };
  refused("SCALE of its instances has 1", [](Gltf& g) { instancing(g)["SCALE"] = g.floats3({1, 1, 1}); });
  refused("neither TRANSLATION", [](Gltf& g) { instancing(g) = nlohmann::json::object(); });
  refused("attributes.SCALE", [](Gltf& g) { instancing(g)["SCALE"] = 99; });
  refused("'attributes' is missing", [](Gltf& g) {
    instancing(g).clear(), g.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"].erase("attributes");
  });
  refused("instance 1: the transform", [](Gltf& g) { instancing(g)["TRANSLATION"] = g.floats3({0, 0, 0, 0, NAN, 0}); });
  refused("not a quaternion",
          [](Gltf& g) { instancing(g)["ROTATION"] = g.accessor(bytes_of(std::vector<float>(8, 0)), 5126, 2, "VEC4"); });
  refused("VEC4", [](Gltf& g) { instancing(g)["ROTATION"] = instancing(g)["TRANSLATION"]; });
  LoadLimits few;
  few.triangles = 1;
  refused(
      "more than 1 triangles over all instances", [](Gltf&) {}, few);
  few = {};
  few.nodes = 1;
  refused(
      "more than 16 instances", [](Gltf& g) { instancing(g)["TRANSLATION"] = g.floats3(std::vector<float>(51)); }, few);
  // Not one byte stands behind these.
  refused("over all instances", [](Gltf& g) {
    g.json["accessors"].push_back({{"componentType", 5126}, {"count", 1ull << 40}, {"type", "VEC3"}});
    instancing(g)["TRANSLATION"] = g.json["accessors"].size() - 1;
  });
}

}  // namespace
}  // namespace umbrix::io
