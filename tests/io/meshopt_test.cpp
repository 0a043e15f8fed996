// SPDX-License-Identifier: Apache-2.0
// Files compressed with EXT_meshopt_compression, by the library's own encoders, hold what the plain ones do.

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>
#include <functional>
#include <random>

#include "gltf_text.h"

namespace umbrix::io {
namespace {

using testing::bytes_of;
using testing::Gltf;
using testing::TempFolder;

constexpr const char* kExtension = "EXT_meshopt_compression";

/// A wavy grid of `side` squared vertices.
Gltf grid(int side) {
  std::vector<float> positions, normals;
  std::vector<std::uint16_t> indices;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (const int c : {x, y}) positions.push_back(static_cast<float>(c) * 0.25f);
      positions.push_back(std::sin(static_cast<float>(x + 2 * y)));
      for (const float c : {0.0f, 0.6f, 0.8f}) normals.push_back(c);
      if (x + 1 == side || y + 1 == side) continue;
      const int v = y * side + x;
      for (const int i : {v, v + 1, v + side, v + 1, v + side + 1, v + side}) {
        indices.push_back(static_cast<std::uint16_t>(i));
      }
    }
  }
  Gltf g;
  const int p = g.floats3(positions), n = g.floats3(normals);
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}, {"indices", g.indices(indices)}})}});
  return g;
}

nlohmann::json& extension(Gltf& g, std::size_t view) { return g.json["bufferViews"][view]["extensions"][kExtension]; }

std::string encoded_vertices(const std::string& bytes, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), bytes.data(), count, stride));
  return {out.begin(), out.end()};
}

std::string encoded_indices(const std::vector<std::uint16_t>& indices, bool triangles) {
  const std::size_t bound = triangles ? meshopt_encodeIndexBufferBound(indices.size(), 65536)
                                      : meshopt_encodeIndexSequenceBound(indices.size(), 65536);
  std::vector<unsigned char> out(bound);
  out.resize(triangles ? meshopt_encodeIndexBuffer(out.data(), out.size(), indices.data(), indices.size())
                       : meshopt_encodeIndexSequence(out.data(), out.size(), indices.data(), indices.size()));
  return {out.begin(), out.end()};
}

/// The bytes of a view, and the view without them.
std::string taken(const Gltf& g, std::size_t view) {
  const nlohmann::json& v = g.json["bufferViews"][view];
  return g.bin.substr(v["byteOffset"].get<std::size_t>(), v["byteLength"].get<std::size_t>());
}

/// Compresses all views of a file as gltfpack does: buffer 0 holds the compressed data, buffer 1 nothing.
Gltf compressed(const Gltf& plain, bool triangles = true) {
  Gltf g = plain;
  g.bin.clear();
  g.json["extensionsUsed"] = g.json["extensionsRequired"] = nlohmann::json::array({kExtension});
  std::size_t fallback_bytes = 0;
  for (std::size_t a = 0; a < g.json["accessors"].size(); ++a) {
    const nlohmann::json& accessor = g.json["accessors"][a];
    const auto v = accessor["bufferView"].get<std::size_t>();
    const std::string bytes = taken(plain, v);
    const auto count = accessor["count"].get<std::size_t>();
    const bool is_vertices = accessor["componentType"] == 5126;
    std::string data;
    if (is_vertices) {
      data = encoded_vertices(bytes, count, bytes.size() / count);
    } else {
      std::vector<std::uint16_t> indices(count);
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(indices.data()));
      data = encoded_indices(indices, triangles);
    }
    nlohmann::json& view = g.json["bufferViews"][v];
    view = {{"buffer", 1}, {"byteOffset", fallback_bytes}, {"byteLength", bytes.size()}};
    extension(g, v) = {{"buffer", 0},
                       {"byteOffset", g.bin.size()},
                       {"byteLength", data.size()},
                       {"byteStride", bytes.size() / count},
                       {"count", count},
                       {"mode", is_vertices ? "ATTRIBUTES"
                                : triangles ? "TRIANGLES"
                                            : "INDICES"}};
    fallback_bytes += (bytes.size() + 3) / 4 * 4;
    g.bin += data;
    g.bin.resize((g.bin.size() + 3) / 4 * 4);
  }
  g.placeholder_bytes = fallback_bytes;
  return g;
}

SceneFile load(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write(name, bytes), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  scene.meshes.resize(std::max<std::size_t>(scene.meshes.size(), 1));
  return scene;
}

using Corners = std::vector<std::array<Float3, 3>>;

/// The triangles' corners, each with its smallest first: encoders turn them.
Corners corners(const Mesh& mesh) {
  Corners out;
  for (std::array<std::uint32_t, 3> t : mesh.triangles) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    out.push_back({mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]});
  }
  return out;
}

TEST(Meshopt, AFileHoldsWhatThePlainOneDoes) {
  const Gltf plain = grid(40);
  const Mesh wanted = load("plain.glb", plain.glb()).meshes[0];
  for (const bool triangles : {true, false}) {
    const Gltf packed = compressed(plain, triangles);
    EXPECT_LT(packed.bin.size(), plain.bin.size() / 2);
    for (const bool binary : {true, false}) {
      const SceneFile scene = load(binary ? "a.glb" : "a.gltf", binary ? packed.glb() : packed.text());
      EXPECT_EQ(corners(scene.meshes[0]), corners(wanted));
      EXPECT_EQ(scene.meshes[0].normals, wanted.normals);
      EXPECT_TRUE(scene.ignored.empty());
    }
  }
}

TEST(Meshopt, OctahedralNormalsAndExponentialPositionsAreFiltered) {
  const Gltf plain = grid(9);
  const Mesh wanted = load("plain.glb", plain.glb()).meshes[0];
  Gltf g = compressed(plain);
  constexpr std::size_t kCount = 81;
  // Normals as bytes; four floats each go into the encoder.
  std::vector<float> normals;
  for (const Float3& n : wanted.normals) normals.insert(normals.end(), {n[0], n[1], n[2], 0});
  std::string octahedral(4 * kCount, '\0'), exponential(12 * kCount, '\0');
  meshopt_encodeFilterOct(octahedral.data(), kCount, 4, 8, normals.data());
  meshopt_encodeFilterExp(exponential.data(), kCount, 12, 20, wanted.positions[0].data());
  const auto replace = [&](std::size_t view, const std::string& values, std::size_t stride, const char* filter) {
    const std::string data = encoded_vertices(values, kCount, stride);
    g.json["bufferViews"][view]["byteLength"] = values.size();
    nlohmann::json& e = extension(g, view);
    e["byteOffset"] = g.bin.size(), e["byteLength"] = data.size(), e["byteStride"] = stride, e["filter"] = filter;
    g.bin += data;
    g.bin.resize((g.bin.size() + 3) / 4 * 4);
  };
  replace(0, exponential, 12, "EXPONENTIAL");
  replace(1, octahedral, 4, "OCTAHEDRAL");
  g.json["bufferViews"][1]["byteStride"] = 4;
  g.json["accessors"][1]["componentType"] = 5120;
  g.json["accessors"][1]["normalized"] = true;
  g.json["extensionsUsed"].push_back("KHR_mesh_quantization");
  const Mesh mesh = load("filtered.glb", g.glb()).meshes[0];
  ASSERT_EQ(mesh.positions.size(), kCount);
  for (std::size_t v = 0; v < kCount; ++v) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(mesh.positions[v][c], wanted.positions[v][c], 1e-4);
      EXPECT_NEAR(mesh.normals[v][c], wanted.normals[v][c], 0.02);
    }
  }
}

TEST(Meshopt, ABufferThatIsNoPlaceholderMayStandIn) {
  Gltf g = compressed(grid(5));
  g.json["bufferViews"][0].erase("extensions");  // plain data beside compressed, in a buffer of its own
  const Gltf plain = grid(5);
  const std::string positions = taken(plain, 0);
  g.json["bufferViews"][0] = {{"buffer", 0}, {"byteOffset", g.bin.size()}, {"byteLength", positions.size()}};
  g.bin += positions;
  EXPECT_EQ(load("mixed.glb", g.glb()).meshes[0].positions, load("plain.glb", plain.glb()).meshes[0].positions);
}

struct Fault {
  const char* name;
  std::function<void(Gltf&)> make;
  const char* message;
};

// Each breaks a file that loads. Views 0 and 1 are vertices, 2 are triangles.
const Fault kFaults[] = {
    {"mode_unknown", [](Gltf& g) { extension(g, 0)["mode"] = "POINTS"; }, "'POINTS'"},
    {"mode_missing", [](Gltf& g) { extension(g, 0).erase("mode"); }, "'mode' is missing"},
    {"filter_unknown", [](Gltf& g) { extension(g, 0)["filter"] = "BLUR"; }, "'BLUR'"},
    {"filter_of_indices", [](Gltf& g) { extension(g, 2)["filter"] = "EXPONENTIAL"; }, "does not fit mode TRIANGLES"},
    {"filter_of_another_stride", [](Gltf& g) { extension(g, 0)["filter"] = "OCTAHEDRAL"; }, "does not fit"},
    {"stride_zero", [](Gltf& g) { extension(g, 0)["byteStride"] = 0; }, "byteStride 0"},
    {"stride_odd", [](Gltf& g) { extension(g, 0)["byteStride"] = 13; }, "byteStride 13"},
    {"stride_large", [](Gltf& g) { extension(g, 0)["byteStride"] = 260; }, "byteStride 260"},
    {"stride_of_indices", [](Gltf& g) { extension(g, 2)["byteStride"] = 8; }, "byteStride 8"},
    {"no_whole_triangles", [](Gltf& g) { extension(g, 2)["count"] = 4; }, "no whole number"},
    {"count_enormous", [](Gltf& g) { extension(g, 0)["count"] = 1ull << 50; }, "cannot hold"},
    {"count_of_another_view", [](Gltf& g) { extension(g, 0)["count"] = 26; }, "are not the 300 of the view"},
    {"count_too_large",
     [](Gltf& g) {
       extension(g, 0)["count"] = 100;
       g.json["bufferViews"][0]["byteLength"] = 1200;
       g.placeholder_bytes += 900;
     },
     "damaged"},
    {"count_too_small",
     [](Gltf& g) {
       extension(g, 0)["count"] = 3;
       g.json["bufferViews"][0]["byteLength"] = 36;
     },
     "damaged"},
    {"cut_off", [](Gltf& g) { extension(g, 0)["byteLength"] = 20; }, "damaged"},
    {"beyond_buffer", [](Gltf& g) { extension(g, 0)["byteLength"] = 1 << 20; }, "lie beyond its buffer"},
    {"buffer_unknown", [](Gltf& g) { extension(g, 0)["buffer"] = 9; }, "buffer"},
    {"in_the_placeholder", [](Gltf& g) { extension(g, 0)["buffer"] = 1; }, "lie beyond its buffer of 1 bytes"},
    {"not_compressed", [](Gltf& g) { g.json["bufferViews"][0].erase("extensions"); }, "lies beyond its buffer"},
    {"other_bytes", [](Gltf& g) { g.bin[0] = 7; }, "damaged"},
};

class BadMeshopt : public ::testing::TestWithParam<Fault> {};

TEST_P(BadMeshopt, IsRefusedInOneLine) {
  Gltf g = compressed(grid(5));
  load("good.glb", g.glb());
  GetParam().make(g);
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("bad.glb", g.glb()), scene);
  EXPECT_EQ(status.code(), StatusCode::bad_input) << status.message();
  EXPECT_NE(status.message().find(GetParam().message), std::string::npos) << status.message();
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status.message();
}

INSTANTIATE_TEST_SUITE_P(Faults, BadMeshopt, ::testing::ValuesIn(kFaults),
                         [](const auto& fault) { return std::string(fault.param.name); });

TEST(Meshopt, MemoryIsLimited) {
  const TempFolder folder;
  SceneFile scene;
  LoadLimits limits;
  limits.decoded_bytes = 1000;
  const Status status = load_scene(folder.write("a.glb", compressed(grid(20)).glb()), scene, limits);
  EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
}

TEST(Meshopt, DamagedDataIsRefusedOrLoads) {
  const Gltf good = compressed(grid(8));
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  const TempFolder folder;
  for (int i = 0; i < 300; ++i) {
    Gltf g = good;
    for (int k = 0; k < 3; ++k) g.bin[random() % g.bin.size()] = static_cast<char>(random());
    SceneFile scene;
    const Status status = load_scene(folder.write("a.glb", g.glb()), scene);
    if (status.ok()) {
      for (const auto& t : scene.meshes[0].triangles) {
        for (const std::uint32_t v : t) ASSERT_LT(v, scene.meshes[0].positions.size());
      }
    } else {
      EXPECT_EQ(status.code(), StatusCode::bad_input) << status.message();
    }
  }
}

}  // namespace
}  // namespace umbrix::io
