// SPDX-License-Identifier: Apache-2.0
// Files compressed with KHR_draco_mesh_compression, by Draco's own encoder, hold what the plain ones do.

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::Gltf;
using testing::TempFolder;

constexpr const char* kExtension = "KHR_draco_mesh_compression";

using Corners = std::vector<std::array<Float3, 3>>;

Float3 wave(int x, int y) {
  return {static_cast<float>(x), static_cast<float>(y), std::sin(0.3f * static_cast<float>(x + 2 * y))};
}

/// The triangles of a wavy grid.
Corners grid(int side) {
  Corners out;
  for (int y = 0; y + 1 < side; ++y) {
    for (int x = 0; x + 1 < side; ++x) {
      out.push_back({wave(x, y), wave(x + 1, y), wave(x, y + 1)});
      out.push_back({wave(x + 1, y), wave(x + 1, y + 1), wave(x, y + 1)});
    }
  }
  return out;
}

/// The same with all that Draco leaves free, the order and which corner is first, taken away.
Corners sorted(Corners triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

struct Encoding {
  int method = draco::MESH_EDGEBREAKER_ENCODING;
  int position_bits = 0;  // 0: as they are
};

/// Positions are attribute 0, normals 1, joints (bytes) 2.
std::string encoded(const Corners& triangles, const Encoding& encoding) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(triangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int normal = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const int joint = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const float up[] = {0, 0, 1};
  const std::uint8_t joints[] = {0, 0, 0, 0};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const draco::FaceIndex face(static_cast<std::uint32_t>(t));
    builder.SetAttributeValuesForFace(position, face, triangles[t][0].data(), triangles[t][1].data(),
                                      triangles[t][2].data());
    builder.SetAttributeValuesForFace(normal, face, up, up, up);
    builder.SetAttributeValuesForFace(joint, face, joints, joints, joints);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(encoding.method);
  if (encoding.position_bits > 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, encoding.position_bits);
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

nlohmann::json& primitive(Gltf& g) { return g.json["meshes"][0]["primitives"][0]; }
nlohmann::json& extension(Gltf& g) { return primitive(g)["extensions"][kExtension]; }

/// A file as exporters write it: accessors without views, for what is in the Draco data.
Gltf compressed(const Corners& triangles, const Encoding& encoding = {}, std::size_t vertices = 0) {
  Gltf g;
  g.json["extensionsUsed"] = g.json["extensionsRequired"] = nlohmann::json::array({kExtension});
  const auto accessor = [&](int component_type, std::size_t count, const char* type) {
    g.json["accessors"].push_back({{"componentType", component_type}, {"count", count}, {"type", type}});
    return g.json["accessors"].size() - 1;
  };
  const auto position = accessor(5126, vertices, "VEC3"), normal = accessor(5126, vertices, "VEC3");
  const auto joints = accessor(5121, vertices, "VEC4"), indices = accessor(5125, 3 * triangles.size(), "SCALAR");
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"_JOINT", joints}}},
                           {"indices", indices}})}});
  extension(g) = {{"bufferView", g.view(encoded(triangles, encoding))},
                  {"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"_JOINT", 2}}}};
  return g;
}

Status load(const Gltf& g, SceneFile& scene, const LoadLimits& limits = {}) {
  const TempFolder folder;
  return load_scene(folder.write("scene.glb", g.glb()), scene, limits);
}

Corners corners(const SceneFile& scene) {
  Corners out;
  for (const auto& t : scene.meshes.at(0).triangles) {
    const std::vector<Float3>& p = scene.meshes[0].positions;
    out.push_back({p[t[0]], p[t[1]], p[t[2]]});
  }
  return out;
}

TEST(Draco, AFileHoldsWhatWasEncoded) {
  const Corners triangles = grid(20);
  for (const int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    SCOPED_TRACE(method);
    SceneFile scene;
    const Status status = load(compressed(triangles, {method, 0}, 400), scene);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_EQ(sorted(corners(scene)), sorted(triangles));
    ASSERT_EQ(scene.meshes[0].normals.size(), scene.meshes[0].positions.size());
    for (const Float3& n : scene.meshes[0].normals) EXPECT_EQ(n, (Float3{0, 0, 1}));
    EXPECT_TRUE(scene.ignored.empty());
  }
}

TEST(Draco, QuantizedPositionsAreNearAndSmall) {
  const Corners triangles = grid(60);
  const Gltf exact = compressed(triangles, {draco::MESH_EDGEBREAKER_ENCODING, 0}, 3600);
  const Gltf g = compressed(triangles, {draco::MESH_EDGEBREAKER_ENCODING, 14}, 3600);
  EXPECT_LT(g.bin.size(), exact.bin.size());
  SceneFile scene;
  const Status status = load(g, scene);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_EQ(scene.meshes[0].triangles.size(), triangles.size());
  for (const Float3& p : scene.meshes[0].positions) {
    EXPECT_NEAR(p[2], std::sin(0.3f * (p[0] + 2 * p[1])), 0.02);
  }
}

TEST(Draco, SkinsAreReadFromCompressedData) {
  Gltf g = compressed(grid(4), {draco::MESH_SEQUENTIAL_ENCODING, 0}, 16);
  nlohmann::json& attributes = primitive(g)["attributes"];
  attributes["JOINTS_0"] = attributes["_JOINT"];
  extension(g)["attributes"]["JOINTS_0"] = 2;
  // Weights stay plain: accessors may be of either kind.
  std::vector<float> weights(64, 0.25f);
  attributes["WEIGHTS_0"] = g.accessor(testing::bytes_of(weights), 5126, 16, "VEC4");
  g.json["skins"] = {{{"joints", {1}}}};
  g.json["nodes"][0]["skin"] = 0;
  g.root({{"translation", {0, 0, 8}}});
  SceneFile scene;
  const Status status = load(g, scene);
  ASSERT_TRUE(status.ok()) << status.message();
  for (const Float3& p : scene.meshes[0].positions) EXPECT_NEAR(p[2], 8, 1.001);
}

struct Fault {
  const char* name;
  std::function<void(Gltf&)> make;
  const char* message;
};

// Each breaks a file that loads.
const Fault kFaults[] = {
    {"no_header", [](Gltf& g) { g.bin[0] = 'X'; }, "no header"},
    {"of_another_version", [](Gltf& g) { g.bin[6] = 9; }, "version 2.9"},
    {"point_cloud", [](Gltf& g) { g.bin[7] = 0; }, "no mesh of triangles"},
    {"method_unknown", [](Gltf& g) { g.bin[8] = 5; }, "no mesh of triangles"},
    {"too_many_triangles",
     [](Gltf& g) {
       for (std::size_t i = 11; i < 17; ++i) g.bin[i] = static_cast<char>(i == 15 ? 0x0F : 0xFF);
     },
     "cannot hold"},
    {"cut_off", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = 14; }, "Draco data is damaged"},
    {"cut_off_in_the_header", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = 8; }, "no header"},
    {"half", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = g.bin.size() / 2; }, "Draco data is damaged"},
    {"attribute_unknown", [](Gltf& g) { extension(g)["attributes"]["NORMAL"] = 17; }, "no attribute 17"},
    {"attribute_of_another_type", [](Gltf& g) { extension(g)["attributes"]["NORMAL"] = 2; }, "4 components"},
    {"attribute_no_number", [](Gltf& g) { extension(g)["attributes"]["NORMAL"] = "x"; }, "attributes.NORMAL"},
    {"attributes_missing", [](Gltf& g) { extension(g).erase("attributes"); }, "'attributes' is missing"},
    {"view_unknown", [](Gltf& g) { extension(g)["bufferView"] = 4; }, "bufferView"},
    {"view_missing", [](Gltf& g) { extension(g).erase("bufferView"); }, "'bufferView' is missing"},
};

class BadDraco : public ::testing::TestWithParam<Fault> {};

TEST_P(BadDraco, IsRefusedInOneLine) {
  Gltf g = compressed(grid(6), {draco::MESH_SEQUENTIAL_ENCODING, 0}, 36);
  SceneFile scene;
  ASSERT_TRUE(load(g, scene).ok());
  GetParam().make(g);
  const Status status = load(g, scene);
  EXPECT_EQ(status.code(), StatusCode::bad_input) << status.message();
  EXPECT_NE(status.message().find(GetParam().message), std::string::npos) << status.message();
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
}

INSTANTIATE_TEST_SUITE_P(Faults, BadDraco, ::testing::ValuesIn(kFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(Draco, MemoryIsLimited) {
  SceneFile scene;
  LoadLimits limits;
  limits.decoded_bytes = 1000;
  EXPECT_EQ(load(compressed(grid(20), {}, 400), scene, limits).code(), StatusCode::resource_limit);
}

TEST(Draco, DamagedDataIsRefusedOrLoads) {
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (int i = 0; i < 300; ++i) {
    static const Gltf good[] = {compressed(grid(8), {draco::MESH_EDGEBREAKER_ENCODING, 11}, 64),
                                compressed(grid(8), {draco::MESH_SEQUENTIAL_ENCODING, 11}, 64)};
    Gltf g = good[i % 2];
    for (int k = 0; k < 2; ++k) g.bin[11 + random() % (g.bin.size() - 11)] = static_cast<char>(random());
    SceneFile scene;
    const Status status = load(g, scene);
    if (status.ok()) {
      for (const Mesh& mesh : scene.meshes) {
        for (const auto& t : mesh.triangles) {
          for (const std::uint32_t v : t) ASSERT_LT(v, mesh.positions.size());
        }
      }
    } else {
      EXPECT_TRUE(status.code() == StatusCode::bad_input || status.code() == StatusCode::resource_limit)
          << status.message();
    }
  }
}

}  // namespace
}  // namespace umbrix::io
