// SPDX-License-Identifier: Apache-2.0
// Numbers in glTF files that do not fit each other, beyond those of gltf_bad_test.cpp: what must be refused, and what
// must load all the same.

#include <gtest/gtest.h>

#include <limits>

#include "refusal.h"

namespace umbrix::io {
namespace {

using nlohmann::json;
using testing::expect_refused;
using testing::Fault;
using testing::Gltf;
using testing::TempFolder;

json& node(Gltf& g) { return g.json["nodes"][0]; }
json& accessor(Gltf& g, int i) { return g.json["accessors"][static_cast<std::size_t>(i)]; }
json& view(Gltf& g, int i) { return g.json["bufferViews"][static_cast<std::size_t>(i)]; }
json& primitive(Gltf& g) { return g.json["meshes"][0]["primitives"][0]; }

void add_sparse(Gltf& g, const std::vector<std::uint16_t>& indices, std::size_t count) {
  const int at = g.view(testing::bytes_of(indices));
  accessor(g, 0)["sparse"] = {
      {"count", count}, {"indices", {{"bufferView", at}, {"componentType", 5123}}}, {"values", {{"bufferView", 0}}}};
}

void add_camera(Gltf& g, const char* type, const json& numbers) {
  g.json["cameras"] = {{{"type", type}, {type, numbers}}};
  node(g)["camera"] = 0;
}

void add_light(Gltf& g, const json& light) {
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
  node(g)["extensions"]["KHR_lights_punctual"]["light"] = 0;
}

const Fault kFaults[] = {
    // Sums that would wrap in 32 or 64 bits.
    {"offsets_sum_2_54",
     [](Gltf& g) {
       view(g, 0)["byteOffset"] = 1ull << 53;
       accessor(g, 0)["byteOffset"] = 1ull << 53;
     },
     "bufferViews[0]"},
    {"accessor_offset_2_53", [](Gltf& g) { accessor(g, 0)["byteOffset"] = 1ull << 53; }, "accessors[0]"},
    {"accessor_offset_2_64", [](Gltf& g) { accessor(g, 0)["byteOffset"] = ~0ull; }, "accessors[0].byteOffset"},
    {"view_length_2_53", [](Gltf& g) { view(g, 0)["byteLength"] = 1ull << 53; }, "bufferViews[0]"},
    {"count_wraps_32_bits_times_stride", [](Gltf& g) { accessor(g, 0)["count"] = 0x15555556; }, "accessors[0]"},

    // Strides and alignment.
    {"stride_3", [](Gltf& g) { view(g, 0)["byteStride"] = 3; }, "tride"},
    {"stride_14", [](Gltf& g) { view(g, 0)["byteStride"] = 14; }, "tride"},
    {"stride_300", [](Gltf& g) { view(g, 0)["byteStride"] = 300; }, "tride"},
    {"stride_2_53", [](Gltf& g) { view(g, 0)["byteStride"] = 1ull << 53; }, "tride"},
    {"view_unaligned",
     [](Gltf& g) {
       view(g, 0)["byteOffset"] = 2;
       view(g, 0)["byteLength"] = 36;
     },
     "multiple"},

    // Types that an attribute or index may not have.
    {"position_vec2", [](Gltf& g) { accessor(g, 0)["type"] = "VEC2"; }, "VEC3"},
    {"type_unknown", [](Gltf& g) { accessor(g, 0)["type"] = "VEC9"; }, "ccessor"},
    {"normal_scalar", [](Gltf& g) { primitive(g)["attributes"]["NORMAL"] = 1; }, "VEC3"},
    {"texcoord_vec3", [](Gltf& g) { primitive(g)["attributes"]["TEXCOORD_0"] = 0; }, "VEC2"},
    {"indices_byte", [](Gltf& g) { accessor(g, 1)["componentType"] = 5120; }, "accessors[1]"},
    {"indices_short", [](Gltf& g) { accessor(g, 1)["componentType"] = 5122; }, "accessors[1]"},
    {"indices_vec3", [](Gltf& g) { accessor(g, 1)["type"] = "VEC3"; }, "accessors[1]"},
    {"indices_normalized", [](Gltf& g) { accessor(g, 1)["normalized"] = true; }, "accessors[1]"},
    {"indices_of_zeros", [](Gltf& g) { accessor(g, 1).erase("bufferView"); }, "accessor[1]"},
    {"position_normalized_float", [](Gltf& g) { accessor(g, 0)["normalized"] = true; }, "accessors[0]"},
    {"restart_index",
     [](Gltf& g) {
       const std::size_t end = g.bin.size();
       g.bin[end - 4] = g.bin[end - 3] = '\xff';
     },
     "index 65535"},

    // Sparse accessors.
    {"sparse_index_beyond",
     [](Gltf& g) {
       add_sparse(g, {0, 3}, 2);
     },
     "sparse index 3"},
    {"sparse_index_twice",
     [](Gltf& g) {
       add_sparse(g, {1, 1}, 2);
     },
     "sparse index 1"},
    {"sparse_count_0",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 0);
     },
     "sparse count 0"},
    {"sparse_count_beyond_its_view", [](Gltf& g) { add_sparse(g, {0}, 3); }, "sparse.indices"},
    {"sparse_count_2_40",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 1ull << 40);
     },
     "sparse.count"},
    {"sparse_indices_float",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 2);
       accessor(g, 0)["sparse"]["indices"]["componentType"] = 5126;
     },
     "sparse"},
    {"sparse_without_values",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 2);
       accessor(g, 0)["sparse"].erase("values");
     },
     "values"},
    {"sparse_values_beyond",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 2);
       accessor(g, 0)["sparse"]["values"]["byteOffset"] = 16;
     },
     "sparse.values"},
    {"sparse_view_missing",
     [](Gltf& g) {
       add_sparse(g, {0, 1}, 2);
       accessor(g, 0)["sparse"]["values"]["bufferView"] = 9;
     },
     "bufferView"},

    // Transforms.
    {"rotation_of_3",
     [](Gltf& g) {
       node(g)["rotation"] = {0, 0, 0};
     },
     "nodes[0].rotation"},
    {"matrix_of_texts", [](Gltf& g) { node(g)["matrix"] = std::vector<std::string>(16, "1"); }, "nodes[0].matrix"},
    {"translation_beyond_doubles_in_a_child",
     [](Gltf& g) {
       node(g)["translation"] = {1.7e308, 0, 0};
       node(g)["children"] = nlohmann::json::array({1});
       g.json["nodes"].push_back({{"translation", {1.7e308, 0, 0}}});
     },
     "nodes[1]"},

    // Lights and cameras.
    {"light_type",
     [](Gltf& g) {
       add_light(g, {{"type", "area"}});
     },
     "'area'"},
    {"light_colour_of_2",
     [](Gltf& g) {
       add_light(g, {{"type", "point"}, {"color", {1, 1}}});
     },
     "color"},
    {"light_colour_negative",
     [](Gltf& g) {
       add_light(g, {{"type", "point"}, {"color", {1, -1, 1}}});
     },
     "color"},
    {"light_intensity_1e39",
     [](Gltf& g) {
       add_light(g, {{"type", "point"}, {"intensity", 1e39}});
     },
     "intensity"},
    {"light_range_negative",
     [](Gltf& g) {
       add_light(g, {{"type", "point"}, {"range", -1}});
     },
     "range"},
    {"light_without_direction",
     [](Gltf& g) {
       add_light(g, {{"type", "directional"}});
       node(g)["scale"] = {0, 0, 0};
     },
     "direction"},
    {"camera_type", [](Gltf& g) { add_camera(g, "fisheye", json::object()); }, "fisheye"},
    {"camera_yfov_pi",
     [](Gltf& g) {
       add_camera(g, "perspective", {{"yfov", 3.1415927}, {"znear", 1}});
     },
     "yfov"},
    {"camera_yfov_negative",
     [](Gltf& g) {
       add_camera(g, "perspective", {{"yfov", -1}, {"znear", 1}});
     },
     "yfov"},
    {"camera_znear_beyond_zfar",
     [](Gltf& g) {
       add_camera(g, "perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 1}});
     },
     "znear"},
    {"camera_aspect_negative",
     [](Gltf& g) {
       add_camera(g, "perspective", {{"yfov", 1}, {"znear", 1}, {"aspectRatio", -1}});
     },
     "aspect"},
    {"camera_xmag_0",
     [](Gltf& g) {
       add_camera(g, "orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}});
     },
     "xmag"},
    {"camera_flattened",
     [](Gltf& g) {
       add_camera(g, "perspective", {{"yfov", 1}, {"znear", 1}});
       node(g)["scale"] = {1, 1, 0};
     },
     "camera"},

    // Scenes.
    {"scene_negative", [](Gltf& g) { g.json["scene"] = -1; }, "scene"},
    {"scene_of_no_node", [](Gltf& g) { g.json["scenes"][0]["nodes"] = nlohmann::json::array({5}); }, "scenes[0].nodes"},
    {"scenes_not_array", [](Gltf& g) { g.json["scenes"] = 1; }, "scenes"},
    {"child_of_no_node", [](Gltf& g) { node(g)["children"] = nlohmann::json::array({7}); }, "nodes[0].children"},
    {"mode_negative", [](Gltf& g) { primitive(g)["mode"] = -1; }, "mode"},
};

TEST(HostileValues, AreRefusedByName) {
  for (const Fault& fault : kFaults) expect_refused(fault);
}

SceneFile load(const Gltf& g) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.glb", g.glb()), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

// A file without a picture in it is no broken file; whoever shows it says so.
TEST(HostileValues, NothingToShowLoadsWithAWarning) {
  const std::vector<std::function<void(Gltf&)>> emptied = {
      [](Gltf& g) { g.json["scenes"][0].erase("nodes"); },
      [](Gltf& g) { g.json["scenes"][0]["nodes"] = json::array(); },
      [](Gltf& g) {
        for (const char* member : {"scenes", "nodes", "meshes", "accessors"}) g.json.erase(member);
      },
      [](Gltf& g) { accessor(g, 0)["count"] = 0, accessor(g, 1)["count"] = 0; },
      [](Gltf& g) { primitive(g)["mode"] = 0; },
      [](Gltf& g) { primitive(g)["attributes"] = json::object(); },
  };
  for (std::size_t i = 0; i < emptied.size(); ++i) {
    SCOPED_TRACE(i);
    Gltf g = testing::one_triangle();
    emptied[i](g);
    const SceneFile scene = load(g);
    EXPECT_TRUE(scene.instances.empty());
    EXPECT_FALSE(scene.warnings.empty());
    EXPECT_GE(scene.materials.size(), 1u);
  }
}

// The tracer drops and counts them (MeshView); the rest of the mesh must not suffer.
TEST(HostileValues, VerticesThatAreNoNumbersAreKeptForTheTracerToCount) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0, kNaN, 0, 0, 1, kInfinity, 0, 0, 0, -kInfinity});
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", positions}}}})}});
  const SceneFile scene = load(g);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_EQ(scene.meshes[0].positions[1], (Float3{1, 0, 0}));
}

TEST(HostileValues, AScaleOfZeroFlattensAndLoads) {
  Gltf g = testing::one_triangle();
  node(g)["scale"] = {1, 0, 1};
  EXPECT_EQ(load(g).instanced_triangles(), 1u);
}

TEST(HostileValues, LimitsHoldBeforeMemoryIsAskedFor) {
  const TempFolder folder;
  const auto refused = [&](const Gltf& g, const char* what, const std::function<void(LoadLimits&)>& set) {
    SCOPED_TRACE(what);
    LoadLimits limits;
    set(limits);
    expect_refused(folder.write("scene.gltf", g.text()), StatusCode::resource_limit, what, limits);
  };
  Gltf g = testing::one_triangle();
  refused(g, "JSON has", [](LoadLimits& l) { l.json_bytes = 100; });
  refused(g, "values", [](LoadLimits& l) { l.json_values = 20; });
  refused(g, "accessors", [](LoadLimits& l) { l.list_elements = 1; });
  refused(g, "bytes are left", [](LoadLimits& l) { l.decoded_bytes = 41; });
  // One accessor in a thousand primitives.
  for (int i = 0; i < 1000; ++i) g.json["meshes"][0]["primitives"].push_back(primitive(g));
  refused(g, "bytes are left", [](LoadLimits& l) { l.decoded_bytes = 10000; });
  refused(g, "triangles", [](LoadLimits& l) { l.triangles = 1000; });
}

TEST(HostileValues, AsManyAsThereMayBeDoNotWrapTheLimits) {
  const TempFolder folder;
  LoadLimits limits;
  limits.file_bytes = limits.json_bytes = limits.json_values = limits.list_elements = limits.nodes = limits.triangles =
      limits.decoded_bytes = std::numeric_limits<std::uint64_t>::max();
  limits.node_depth = std::numeric_limits<std::uint32_t>::max();
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.gltf", testing::one_triangle().text()), scene, limits);
  EXPECT_TRUE(status.ok()) << status.message();
  limits.nodes = 1ull << 60;
  EXPECT_TRUE(load_scene(folder.path("scene.gltf"), scene, limits).ok());
}

// A chain of nodes and a crowd of instances: two small files that grow when they are unfolded.
TEST(HostileValues, ChainsAndCrowdsAreLimited) {
  const TempFolder folder;
  Gltf chain = testing::one_triangle();
  for (int i = 1; i < 20000; ++i) {
    chain.json["nodes"].push_back(json::object());
    chain.json["nodes"][static_cast<std::size_t>(i) - 1]["children"] = nlohmann::json::array({i});
  }
  expect_refused(folder.write("chain.gltf", chain.text()), StatusCode::resource_limit, "nested deeper than 256");

  Gltf crowd = testing::one_triangle();
  crowd.json["meshes"][0]["primitives"] = std::vector<json>(1000, primitive(crowd));
  crowd.json["nodes"] = std::vector<json>(1000, {{"mesh", 0}});
  crowd.json["scenes"] = json::array();
  LoadLimits limits;
  limits.triangles = 999'999;
  expect_refused(folder.write("crowd.gltf", crowd.text()), StatusCode::resource_limit, "triangles", limits);
}

}  // namespace
}  // namespace umbrix::io
