// SPDX-License-Identifier: Apache-2.0
// Broken and hostile files: refused with one line that names the file and the fault.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "refusal.h"

namespace umbrix::io {
namespace {

using nlohmann::json;
using testing::expect_refused;
using testing::Fault;
using testing::Gltf;
using testing::TempFolder;

json& node(Gltf& g) { return g.json["nodes"][0]; }
json& positions(Gltf& g) { return g.json["accessors"][0]; }
json& primitive(Gltf& g) { return g.json["meshes"][0]["primitives"][0]; }

// Each breaks a file that loads.
const Fault kFaults[] = {
    {"accessor_beyond_view", [](Gltf& g) { positions(g)["count"] = 4; }, "accessors[0]"},
    {"accessor_offset_beyond", [](Gltf& g) { positions(g)["byteOffset"] = 400; }, "accessors[0]"},
    {"accessor_unaligned", [](Gltf& g) { positions(g)["byteOffset"] = 2; }, "multiple"},
    {"accessor_count_2_62", [](Gltf& g) { positions(g)["count"] = 1ull << 62; }, "accessors[0].count"},
    {"accessor_count_2_50", [](Gltf& g) { positions(g)["count"] = 1ull << 50; }, "1125899906842624",
     StatusCode::resource_limit},
    {"accessor_count_3e9", [](Gltf& g) { positions(g)["count"] = 3000000000u; }, "accessors[0]"},
    {"accessor_count_negative", [](Gltf& g) { positions(g)["count"] = -1; }, "accessors[0].count"},
    {"zeros_without_view",
     [](Gltf& g) {
       positions(g)["count"] = 1000000000;
       positions(g).erase("bufferView");
     },
     "accessors[0]", StatusCode::resource_limit},
    {"position_scalar", [](Gltf& g) { positions(g)["type"] = "SCALAR"; }, "accessors[0]"},
    {"position_quantized_without_extension", [](Gltf& g) { positions(g)["componentType"] = 5122; },
     "KHR_mesh_quantization"},
    {"component_type_unknown", [](Gltf& g) { positions(g)["componentType"] = 1; }, "componentType"},
    {"view_beyond_buffer", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = 1000; }, "bufferViews[0]"},
    {"view_offset_overflow", [](Gltf& g) { g.json["bufferViews"][0]["byteOffset"] = 1ull << 53; }, "bufferViews[0]"},
    {"view_of_no_buffer", [](Gltf& g) { g.json["bufferViews"][0]["buffer"] = 7; }, "bufferViews[0].buffer"},
    {"stride_too_small", [](Gltf& g) { g.json["bufferViews"][0]["byteStride"] = 4; }, "stride"},
    {"index_out_of_range", [](Gltf& g) { g.bin[g.bin.size() - 4] = 9; }, "index 9"},
    {"indices_float", [](Gltf& g) { g.json["accessors"][1]["componentType"] = 5126; }, "accessors[1]"},
    {"sparse_not_increasing",
     [](Gltf& g) {
       const int at = g.view(testing::bytes_of(std::vector<std::uint16_t>{2, 1}));
       positions(g)["sparse"] = {
           {"count", 2}, {"indices", {{"bufferView", at}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
     },
     "sparse index 1"},
    {"sparse_count_above_base",
     [](Gltf& g) {
       positions(g)["sparse"] = {
           {"count", 9}, {"indices", {{"bufferView", 0}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
     },
     "sparse count 9"},
    {"mesh_missing", [](Gltf& g) { node(g)["mesh"] = 5; }, "nodes[0].mesh"},
    {"mesh_index_wraps_int", [](Gltf& g) { node(g)["mesh"] = 1ull << 32; }, "nodes[0].mesh"},
    {"mesh_index_float", [](Gltf& g) { node(g)["mesh"] = 0.5; }, "nodes[0].mesh"},
    {"material_missing", [](Gltf& g) { primitive(g)["material"] = 0; }, "material"},
    {"attribute_missing", [](Gltf& g) { primitive(g)["attributes"]["POSITION"] = 3; }, "POSITION"},
    {"normal_count",
     [](Gltf& g) {
       primitive(g)["attributes"]["NORMAL"] = g.floats3({0, 0, 1});
     },
     "NORMAL"},
    {"mode_unknown", [](Gltf& g) { primitive(g)["mode"] = 7; }, "mode 7"},
    {"primitives_not_array", [](Gltf& g) { g.json["meshes"][0]["primitives"] = 3; }, "meshes[0].primitives"},
    {"node_own_child", [](Gltf& g) { node(g)["children"] = nlohmann::json::array({0}); }, "nodes[0]"},
    {"node_cycle",
     [](Gltf& g) {
       g.json["nodes"].push_back({{"children", {2}}});
       g.json["nodes"].push_back({{"children", {1}}});
     },
     "own ancestor"},
    {"two_parents",
     [](Gltf& g) {
       g.json["nodes"].push_back({{"children", {2}}});
       g.json["nodes"].push_back({});
       g.json["nodes"][2] = json::object();
       node(g)["children"] = nlohmann::json::array({2});
     },
     "nodes[2]"},
    {"root_twice",
     [](Gltf& g) {
       g.json["scenes"][0]["nodes"] = {0, 0};
     },
     "twice"},
    {"scene_missing", [](Gltf& g) { g.json["scene"] = 3; }, "scene"},
    {"matrix_15", [](Gltf& g) { node(g)["matrix"] = std::vector<double>(15, 1); }, "nodes[0].matrix"},
    {"matrix_projective", [](Gltf& g) { node(g)["matrix"] = std::vector<double>(16, 1); }, "nodes[0] 'only'"},
    {"rotation_zero",
     [](Gltf& g) {
       node(g)["rotation"] = {0, 0, 0, 0};
     },
     "nodes[0] 'only'"},
    {"scale_text",
     [](Gltf& g) {
       node(g)["scale"] = {"a", 1, 1};
     },
     "nodes[0].scale"},
    {"transform_overflow",
     [](Gltf& g) {
       node(g)["scale"] = {1e308, 1, 1};
       node(g)["children"] = nlohmann::json::array({1});
       g.json["nodes"].push_back({{"scale", {1e308, 1, 1}}});
     },
     "nodes[1]"},
    {"control_characters_in_name",
     [](Gltf& g) {
       node(g)["name"] = "\x1b[31m";
       node(g)["rotation"] = {0, 0, 0, 0};
     },
     "\\x1b[31m"},
    {"extension_required", [](Gltf& g) { g.json["extensionsRequired"] = {"EXT_of_tomorrow"}; }, "EXT_of_tomorrow"},
#ifndef UMBRIX_READS_DRACO
    {"draco",
     [](Gltf& g) {
       g.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
       positions(g).erase("bufferView");
     },
     "gltf-transform"},
#endif
#ifndef UMBRIX_READS_MESHOPTIMIZER
    {"meshopt", [](Gltf& g) { g.json["extensionsRequired"] = {"EXT_meshopt_compression"}; }, "gltfpack"},
#endif
    {"gltf_1", [](Gltf& g) { g.json["asset"]["version"] = "1.0"; }, "version 1.0"},
    {"no_asset", [](Gltf& g) { g.json.erase("asset"); }, "asset"},
    {"camera_yfov",
     [](Gltf& g) {
       g.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0}, {"znear", 1}}}}};
       node(g)["camera"] = 0;
     },
     "yfov"},
    {"light_negative",
     [](Gltf& g) {
       g.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", -1}}};
       node(g)["extensions"]["KHR_lights_punctual"]["light"] = 0;
     },
     "intensity"},
    {"light_missing", [](Gltf& g) { node(g)["extensions"]["KHR_lights_punctual"]["light"] = 0; }, "light"},
    {"spot_inverted",
     [](Gltf& g) {
       g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
           {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.1}}}}};
       node(g)["extensions"]["KHR_lights_punctual"]["light"] = 0;
     },
     "innerConeAngle"},
};

TEST(GltfBad, FaultsAreNamed) {
  for (const Fault& fault : kFaults) expect_refused(fault);
}

TEST(GltfBad, NumbersThatAreNone) {
  const TempFolder folder;
  for (const char* number : {"NaN", "1e999", "-1e999", "Infinity"}) {
    SCOPED_TRACE(number);
    expect_refused(folder.write("n.gltf", std::string(R"({"asset":{"version":"2.0"},"nodes":[{"translation":[)") +
                                              number + ",0,0]}]}"),
                   StatusCode::bad_input, "JSON");
  }
}

TEST(GltfBad, GlbCutAtEveryByte) {
  const TempFolder folder;
  const std::string whole = testing::one_triangle().glb();
  for (std::size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    expect_refused(folder.write("cut.glb", whole.substr(0, length)), StatusCode::bad_input, "");
    // The same with a header that admits it.
    if (length < 12) continue;
    std::string honest = whole.substr(0, length);
    honest.replace(8, 4, testing::bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(length)}));
    expect_refused(folder.write("cut.glb", honest), StatusCode::bad_input, "");
  }
}

TEST(GltfBad, PathsOutsideTheFolderAreNotOpened) {
  const TempFolder outside;
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  const std::string secret = outside.write("secret.bin", g.bin);
  std::filesystem::create_symlink(secret, folder.path("link.bin"));
  const std::string up = "../" + std::filesystem::path(secret).parent_path().filename().string() + "/secret.bin";
  std::string escaped = up;
  escaped.replace(0, 3, "%2e%2e%2f");
  for (const std::string& uri : {up, escaped, secret, std::string("link.bin"), "file://" + secret,
                                 std::string("http://example.org/a.bin"), std::string("C:\\a.bin")}) {
    SCOPED_TRACE(uri);
    g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, "buffers[0]");
  }
  g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", up}}};
  LoadLimits limits;
  limits.allow_paths_outside = true;
  SceneFile scene;
  const Status status = load_scene(folder.write("s.gltf", g.json.dump()), scene, limits);
  EXPECT_TRUE(status.ok()) << status.message();
}

TEST(GltfBad, BuffersMissingShortOrSpecial) {
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  folder.write("short.bin", "abc");
  ASSERT_EQ(::mkfifo(folder.path("pipe.bin").c_str(), 0600), 0);
  const std::pair<const char*, const char*> cases[] = {
      {"gone.bin", "No such file"}, {"short.bin", "3 bytes"}, {"pipe.bin", "regular"}, {"data:,abc", "data URI"}};
  for (const auto& [uri, fault] : cases) {
    SCOPED_TRACE(uri);
    g.json["buffers"] = {{{"byteLength", g.bin.size()}, {"uri", uri}}};
    expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, fault);
  }
  g.json["buffers"][0].erase("uri");
  expect_refused(folder.write("s.gltf", g.json.dump()), StatusCode::bad_input, "'uri' is missing");
}

TEST(GltfBad, FilesThatAreNoScenes) {
  const TempFolder folder;
  expect_refused(folder.path("missing.glb"), StatusCode::bad_input, "No such file");
  expect_refused(folder.write("empty.glb", ""), StatusCode::bad_input, "empty");
  expect_refused(folder.write("one.glb", "g"), StatusCode::bad_input, "JSON");
  expect_refused(folder.write("picture.glb", "\x89PNG\r\n\x1a\n"), StatusCode::bad_input, "JSON");
  expect_refused(folder.write("array.gltf", "[1]"), StatusCode::bad_input, "object");
  expect_refused(folder.write("deep.gltf", std::string(100000, '[')), StatusCode::bad_input, "nested");
  std::filesystem::create_directory(folder.path("folder.glb"));
  expect_refused(folder.path("folder.glb"), StatusCode::bad_input, "folder");
  ASSERT_EQ(::mkfifo(folder.path("pipe.glb").c_str(), 0600), 0);
  expect_refused(folder.path("pipe.glb"), StatusCode::bad_input, "regular");
}

TEST(GltfBad, Limits) {
  const TempFolder folder;
  Gltf g = testing::one_triangle();
  g.root({{"mesh", 0}});
  const std::string path = folder.write("s.gltf", g.text());
  LoadLimits limits;
  limits.triangles = 1;
  expect_refused(path, StatusCode::resource_limit, "triangles", limits);
  limits = {};
  limits.nodes = 1;
  expect_refused(path, StatusCode::resource_limit, "nodes", limits);
  limits = {};
  limits.file_bytes = 100;
  expect_refused(path, StatusCode::resource_limit, "limit", limits);
  limits = {};
  limits.node_depth = 3;
  for (int i = 0; i < 5; ++i) {
    g.json["nodes"].push_back(json::object());
    g.json["nodes"][g.json["nodes"].size() - 2]["children"] = {g.json["nodes"].size() - 1};
  }
  expect_refused(folder.write("deep.gltf", g.text()), StatusCode::resource_limit, "nested", limits);
}

}  // namespace
}  // namespace umbrix::io
