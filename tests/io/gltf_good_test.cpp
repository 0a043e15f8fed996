// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::Gltf;
using testing::TempFolder;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

SceneFile load(const std::string& bytes) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.gltf", bytes), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

// Five points in the plane and a primitive of some mode over them.
Gltf primitive(int mode, const std::vector<std::uint16_t>& indices) {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 2, 0});
  nlohmann::json p = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
  if (!indices.empty()) p["indices"] = g.indices(indices);
  g.root({{"mesh", g.mesh(p)}});
  return g;
}

bool mentions(const std::vector<std::string>& lines, const std::string& text) {
  return std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.find(text) != std::string::npos; });
}

TEST(GltfGood, TextAndBinaryAgree) {
  const Gltf g = testing::one_triangle();
  for (const std::string& bytes : {g.text(), g.glb()}) {
    const SceneFile scene = load(bytes);
    ASSERT_EQ(scene.meshes.size(), 1u);
    EXPECT_EQ(scene.meshes[0].positions[1], (Float3{1, 0, 0}));
    EXPECT_EQ(scene.meshes[0].triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(scene.instanced_triangles(), 1u);
    EXPECT_EQ(scene.materials.size(), 1u);
  }
}

TEST(GltfGood, ExternalBufferWithEscapedName) {
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", "a%20b+c.bin"}}};
  folder.write("a b+c.bin", g.bin + "more");
  SceneFile scene;
  const Status status = load_scene(folder.write("s.gltf", g.json.dump()), scene);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_EQ(scene.meshes[0].positions[2], (Float3{0, 1, 0}));
}

TEST(GltfGood, StripsKeepTheirWinding) {
  EXPECT_EQ(load(primitive(5, {}).text()).meshes[0].triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(load(primitive(5, {4, 2, 0, 1}).text()).meshes[0].triangles.size(), 2u);
}

TEST(GltfGood, Fans) {
  EXPECT_EQ(load(primitive(6, {}).text()).meshes[0].triangles, (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfGood, LeftOverIndicesAreWarnedAndLinesReported) {
  const SceneFile scene = load(primitive(4, {0, 1, 2, 3}).text());
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_TRUE(mentions(scene.warnings, "left-over"));
  const SceneFile lines = load(primitive(1, {}).text());
  EXPECT_TRUE(lines.meshes.empty());
  EXPECT_TRUE(mentions(lines.ignored, "points or lines"));
}

TEST(GltfGood, UnusedVerticesAreDropped) {
  const SceneFile scene = load(primitive(4, {4, 2, 1}).text());
  EXPECT_EQ(scene.meshes[0].positions, (std::vector<Float3>{{1, 0, 0}, {0, 1, 0}, {2, 2, 0}}));
  EXPECT_EQ(scene.meshes[0].triangles, (Triangles{{2, 1, 0}}));
}

TEST(GltfGood, StridedPositionsAndNormals) {
  Gltf g;
  // Position and normal interleaved, 24 bytes each.
  std::vector<float> data;
  for (const float x : {0.0f, 1.0f, 2.0f}) data.insert(data.end(), {x, x * x, 0, 0, 0, 1});
  const int positions = g.accessor(bytes_of(data), 5126, 3, "VEC3", 24);
  g.json["accessors"].push_back(
      {{"bufferView", 0}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", 1}}}})}});
  const SceneFile scene = load(g.text());
  EXPECT_EQ(scene.meshes[0].positions[2], (Float3{2, 4, 0}));
  EXPECT_EQ(scene.meshes[0].normals[2], (Float3{0, 0, 1}));
}

TEST(GltfGood, SparseOverAViewAndOverNothing) {
  for (const bool base : {true, false}) {
    Gltf g;
    int positions = 0;
    if (base) {
      positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    } else {
      g.json["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
    }
    const int index_view = g.view(bytes_of(std::vector<std::uint16_t>{0, 2}));
    const int value_view = g.view(bytes_of(std::vector<float>{7, 7, 7, 9, 9, 9}));
    g.json["accessors"][0]["sparse"] = {{"count", 2},
                                        {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                                        {"values", {{"bufferView", value_view}}}};
    g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", positions}}}})}});
    const SceneFile scene = load(g.text());
    const Float3 middle = base ? Float3{1, 0, 0} : Float3{0, 0, 0};
    EXPECT_EQ(scene.meshes[0].positions, (std::vector<Float3>{{7, 7, 7}, middle, {9, 9, 9}}));
  }
}

TEST(GltfGood, QuantizedAttributes) {
  Gltf g;
  g.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  g.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const std::vector<std::int16_t> positions = {0, 0, 0, 0, 300, -20, 5, 0, 32767, -32768, 1, 0};
  const int p = g.accessor(bytes_of(positions), 5122, 3, "VEC3", 8);
  const std::vector<std::int8_t> normals = {127, 0, -128, 0, 0, 127, 0, 0, 0, 0, -127, 0};
  const int n = g.accessor(bytes_of(normals), 5120, 3, "VEC3", 4);
  g.json["accessors"][1]["normalized"] = true;
  const int t = g.accessor(bytes_of(std::vector<std::uint16_t>{0, 65535, 0, 0, 65535, 0}), 5123, 3, "VEC2");
  g.json["accessors"][2]["normalized"] = true;
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}, {"TEXCOORD_0", t}}}})}});
  const Mesh mesh = load(g.text()).meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<Float3>{{0, 0, 0}, {300, -20, 5}, {32767, -32768, 1}}));
  EXPECT_EQ(mesh.normals, (std::vector<Float3>{{1, 0, -1}, {0, 1, 0}, {0, 0, -1}}));
  EXPECT_EQ(mesh.texcoord_sets[0][2], (std::array<float, 2>{1, 0}));
}

TEST(GltfGood, NestedTransformsAndInstances) {
  Gltf g = testing::one_triangle();
  const double h = std::sqrt(0.5);
  g.json["nodes"] = {
      // A quarter turn about z, then twice as large, then moved.
      {{"translation", {10, 0, 0}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 2, 2}}, {"children", {1}}, {"mesh", 0}},
      {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1}}, {"mesh", 0}}};
  g.json["scenes"] = {{{"nodes", {0}}}};
  const SceneFile scene = load(g.text());
  ASSERT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instanced_triangles(), 2u);
  const Transform& m = scene.instances[1].to_world;
  // (1, 2, 3) turned is (-2, 1, 3), doubled (-4, 2, 6), moved (6, 2, 6).
  EXPECT_NEAR(m[0][3], 6, 1e-12);
  EXPECT_NEAR(m[1][3], 2, 1e-12);
  EXPECT_NEAR(m[2][3], 6, 1e-12);
  EXPECT_NEAR(m[1][0], 2, 1e-12);
}

TEST(GltfGood, WithoutScenesAllRootsAreShown) {
  Gltf g = testing::one_triangle();
  g.json.erase("scenes");
  EXPECT_EQ(load(g.text()).instances.size(), 1u);
}

TEST(GltfGood, LightsAndCameras) {
  Gltf g = testing::one_triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 5}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"}, {"range", 7}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}},
      {{"type", "directional"}}};
  for (int light = 0; light < 3; ++light) {
    g.root({{"translation", {0, light, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  }
  g.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}}};
  g.root({{"camera", 0}, {"scale", {3, 3, 3}}, {"translation", {1, 2, 3}}});
  g.root({{"camera", 1}});
  const SceneFile scene = load(g.text());
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].intensity, 5);
  EXPECT_EQ(scene.lights[0].color, (Float3{1, 0.5f, 0}));
  EXPECT_TRUE(std::isinf(scene.lights[0].range));
  EXPECT_EQ(scene.lights[1].range, 7);
  EXPECT_EQ(scene.lights[1].outer_cone_angle, 0.2f);
  EXPECT_EQ(scene.lights[2].type, LightType::directional);
  EXPECT_EQ(scene.lights[2].direction, (Double3{0, 0, -1}));
  EXPECT_EQ(scene.lights[2].position[1], 2);
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_TRUE(std::isinf(scene.cameras[0].zfar));
  EXPECT_EQ(scene.cameras[0].aspect, 0);
  EXPECT_EQ(scene.cameras[0].to_world, (Transform{{{1, 0, 0, 1}, {0, 1, 0, 2}, {0, 0, 1, 3}}}));
  EXPECT_EQ(scene.cameras[1].type, CameraType::orthographic);
  EXPECT_EQ(scene.cameras[1].zfar, 9);
}

TEST(GltfGood, Materials) {
  Gltf g = testing::one_triangle();
  g.json["materials"] = {{{"name", "leaf"},
                          {"doubleSided", true},
                          {"alphaMode", "MASK"},
                          {"alphaCutoff", 0.25},
                          {"emissiveFactor", {1, 0.5, 0}},
                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {0.5, 0.25, 1, 0.75}},
                            {"metallicFactor", 0},
                            {"roughnessFactor", 0.5},
                            {"baseColorTexture", {{"index", 0}}}}}}};
  g.json["textures"] = {{{"source", 0}}};
  g.json["images"] = {{{"uri", "not-there.png"}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  g.json["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_materials_clearcoat"};
  const SceneFile scene = load(g.text());
  ASSERT_EQ(scene.materials.size(), 1u);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.base_color, (Float3{0.5f, 0.25f, 1}));
  EXPECT_EQ(m.alpha, 0.75f);
  EXPECT_EQ(m.emission, (Float3{4, 2, 0}));
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.base_color_texture.texture, 0);
  EXPECT_TRUE(mentions(scene.ignored, "KHR_materials_clearcoat"));
}

TEST(GltfGood, FramingCameraSeesTheSceneAndTheLightShinesWithIt) {
  const SceneFile scene = load(testing::one_triangle().text());
  const Camera camera = framing_camera(scene);
  for (const Float3& p : scene.meshes[0].positions) {
    double local[3] = {0, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t r = 0; r < 3; ++r) {
        local[axis] += camera.to_world[r][axis] * (static_cast<double>(p[r]) - camera.to_world[r][3]);
      }
    }
    ASSERT_LT(local[2], 0);
    EXPECT_LT(std::hypot(local[0], local[1]), -local[2] * std::tan(camera.yfov / 2));
  }
  const std::vector<Light> lights = default_lights(scene, camera);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].type, LightType::directional);
  EXPECT_EQ(lights[1].type, LightType::point);
  double forward = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    forward -= lights[0].direction[r] * camera.to_world[r][2];
    EXPECT_EQ(lights[1].position[r], camera.to_world[r][3]);
  }
  EXPECT_GT(forward, 0.5);
}

}  // namespace
}  // namespace umbrix::io
