// SPDX-License-Identifier: Apache-2.0
// Bytes as the numbers of a .glb whose form is right: views, accessors, primitives, nodes, animations. What JSON can
// get wrong is left to the other targets; this one is about values that do not fit each other.
#include <nlohmann/json.hpp>
#include <string>

#include "byte_stream.h"
#include "input_folder.h"
#include "io/gltf_text.h"
#include "loading.h"

namespace {

using namespace umbrix;
using fuzz::ByteStream;
using nlohmann::json;

// Small numbers mostly, and those at which arithmetic breaks.
std::uint64_t take_size(ByteStream& bytes) {
  constexpr std::uint64_t kEdges[] = {0,          1u << 24,   0x7FFFFFFF, 0x80000000u, 0xFFFFFFFFu,
                                      1ull << 32, 1ull << 53, 1ull << 62, ~0ull};
  return bytes.chance(16) ? bytes.one_of(kEdges) : bytes.take<std::uint8_t>();
}

double take_real(ByteStream& bytes) {
  if (bytes.chance(8)) return bytes.take<float>();
  return bytes.take<std::int8_t>() / 16.0;
}

json reals(ByteStream& bytes, int count) {
  json out = json::array();
  for (int i = 0; i < count; ++i) out.push_back(take_real(bytes));
  return out;
}

// A few bytes into the buffer are floats of one sign, so that not every vertex is nonsense.
std::string take_buffer(ByteStream& bytes) {
  std::string buffer(4 * bytes.below(64) + bytes.below(4), '\0');
  for (char& byte : buffer) byte = static_cast<char>(bytes.take<std::uint8_t>());
  return buffer;
}

void add_views(ByteStream& bytes, json& root, std::size_t buffer_bytes) {
  const std::size_t count = 1 + bytes.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    json view = {{"buffer", 0}, {"byteLength", buffer_bytes}};
    if (bytes.chance(3)) view["byteOffset"] = take_size(bytes);
    if (bytes.chance(3)) view["byteLength"] = take_size(bytes);
    if (bytes.chance(4)) view["byteStride"] = take_size(bytes);
    root["bufferViews"].push_back(view);
  }
}

int take_component_type(ByteStream& bytes) {
  constexpr int kTypes[] = {5126, 5126, 5126, 5120, 5121, 5122, 5123, 5125, 5124, 5130};
  return bytes.one_of(kTypes);
}

void add_accessors(ByteStream& bytes, json& root) {
  constexpr const char* kTypes[] = {"VEC3", "VEC3", "SCALAR", "VEC2", "VEC4", "MAT4", "MAT2"};
  const std::size_t views = root["bufferViews"].size(), count = 1 + bytes.below(6);
  for (std::size_t i = 0; i < count; ++i) {
    json accessor = {{"componentType", take_component_type(bytes)},
                     {"count", bytes.chance(4) ? take_size(bytes) : bytes.below(8)},
                     {"type", bytes.one_of(kTypes)}};
    if (!bytes.chance(6)) accessor["bufferView"] = bytes.below(views);
    if (bytes.chance(4)) accessor["byteOffset"] = take_size(bytes);
    if (bytes.chance(4)) accessor["normalized"] = true;
    if (bytes.chance(4)) {
      accessor["sparse"] = {{"count", bytes.chance(4) ? take_size(bytes) : bytes.below(4)},
                            {"indices",
                             {{"bufferView", bytes.below(views)},
                              {"byteOffset", bytes.below(16)},
                              {"componentType", take_component_type(bytes)}}},
                            {"values", {{"bufferView", bytes.below(views)}, {"byteOffset", bytes.below(16)}}}};
    }
    root["accessors"].push_back(accessor);
  }
}

void add_meshes(ByteStream& bytes, json& root) {
  const std::size_t accessors = root["accessors"].size(), count = 1 + bytes.below(2);
  for (std::size_t i = 0; i < count; ++i) {
    json primitives = json::array();
    const std::size_t parts = 1 + bytes.below(3);
    for (std::size_t p = 0; p < parts; ++p) {
      json primitive = {{"attributes", {{"POSITION", bytes.below(accessors)}}}};
      if (bytes.chance(3)) primitive["attributes"]["NORMAL"] = bytes.below(accessors);
      if (bytes.chance(3)) primitive["attributes"]["TEXCOORD_0"] = bytes.below(accessors);
      if (bytes.chance(2)) primitive["indices"] = bytes.below(accessors);
      if (bytes.chance(2)) primitive["mode"] = bytes.below(8);
      primitives.push_back(primitive);
    }
    root["meshes"].push_back({{"primitives", primitives}});
  }
}

void add_cameras_and_lights(ByteStream& bytes, json& root) {
  root["cameras"].push_back({{"type", "perspective"}, {"perspective", {{"yfov", take_real(bytes)}, {"znear", 0.1}}}});
  root["cameras"].push_back({{"type", "orthographic"},
                             {"orthographic",
                              {{"xmag", take_real(bytes)},
                               {"ymag", take_real(bytes)},
                               {"znear", take_real(bytes)},
                               {"zfar", take_real(bytes)}}}});
  json light = {{"type", bytes.chance(2) ? "spot" : "point"}, {"intensity", take_real(bytes)}};
  if (bytes.chance(2)) light["range"] = take_real(bytes);
  light["spot"] = {{"innerConeAngle", take_real(bytes)}, {"outerConeAngle", take_real(bytes)}};
  root["extensions"]["KHR_lights_punctual"]["lights"] = {light};
  root["extensionsUsed"] = {"KHR_lights_punctual"};
  if (bytes.chance(2)) root["extensionsUsed"].push_back("KHR_mesh_quantization");
}

void add_nodes(ByteStream& bytes, json& root) {
  const std::size_t count = 1 + bytes.below(8);
  for (std::size_t i = 0; i < count; ++i) {
    json node = json::object();
    switch (bytes.below(4)) {
      case 0:
        node["mesh"] = bytes.below(root["meshes"].size());
        break;
      case 1:
        node["camera"] = bytes.below(2);
        break;
      case 2:
        node["extensions"]["KHR_lights_punctual"]["light"] = 0;
        break;
      default:
        break;
    }
    if (i + 1 < count && bytes.chance(2)) node["children"] = {bytes.chance(16) ? bytes.below(count) : i + 1};
    if (bytes.chance(3)) node["translation"] = reals(bytes, 3);
    if (bytes.chance(3)) node["rotation"] = reals(bytes, 4);
    if (bytes.chance(3)) node["scale"] = reals(bytes, 3);
    if (bytes.chance(8)) node["matrix"] = reals(bytes, 16);
    root["nodes"].push_back(node);
  }
}

void add_animation(ByteStream& bytes, json& root) {
  constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
  constexpr const char* kWays[] = {"LINEAR", "STEP", "CUBICSPLINE"};
  const std::size_t accessors = root["accessors"].size(), channels = bytes.below(4);
  for (std::size_t i = 0; i < channels; ++i) {
    root["animations"][0]["samplers"].push_back({{"input", bytes.below(accessors)},
                                                 {"output", bytes.below(accessors)},
                                                 {"interpolation", bytes.one_of(kWays)}});
    root["animations"][0]["channels"].push_back(
        {{"sampler", i}, {"target", {{"node", bytes.below(root["nodes"].size())}, {"path", bytes.one_of(kPaths)}}}});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFolder folder;
  ByteStream bytes(data, size);
  io::testing::Gltf gltf;
  gltf.bin = take_buffer(bytes);
  add_views(bytes, gltf.json, gltf.bin.size());
  add_accessors(bytes, gltf.json);
  add_meshes(bytes, gltf.json);
  add_cameras_and_lights(bytes, gltf.json);
  add_nodes(bytes, gltf.json);
  add_animation(bytes, gltf.json);
  const std::string glb = gltf.glb();
  fuzz::check_loading(folder.write("scene.glb", glb.data(), glb.size()), true);
  return 0;
}
