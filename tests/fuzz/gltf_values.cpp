// SPDX-License-Identifier: Apache-2.0
// Bytes as the numbers of a .glb whose form is right: views, accessors, primitives, nodes, animations. What JSON can
// get wrong is left to the other targets; this one is about values that do not fit each other.
#include <cstring>
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

// Numbers at which arithmetic breaks.
std::uint64_t take_odd_size(ByteStream& bytes) {
  constexpr std::uint64_t kEdges[] = {0,          1u << 24,   0x7FFFFFFF, 0x80000000u, 0xFFFFFFFFu,
                                      1ull << 32, 1ull << 53, 1ull << 62, ~0ull};
  return bytes.chance(2) ? bytes.one_of(kEdges) : bytes.take<std::uint8_t>();
}

// One in so many is odd; were it more, hardly a file would get past the first checks.
constexpr std::size_t kOddOneIn = 32;

std::uint64_t take_size(ByteStream& bytes, std::size_t limit) {
  return bytes.chance(kOddOneIn) ? take_odd_size(bytes) : bytes.below(limit);
}

double take_real(ByteStream& bytes) {
  if (bytes.chance(kOddOneIn)) return bytes.take<float>();
  return bytes.take<std::int8_t>() / 16.0;
}

double take_positive(ByteStream& bytes) {
  return bytes.chance(kOddOneIn) ? take_real(bytes) : (1 + bytes.take<std::uint8_t>()) / 128.0;
}

json reals(ByteStream& bytes, int count) {
  json out = json::array();
  for (int i = 0; i < count; ++i) out.push_back(take_real(bytes));
  return out;
}

// Words that are floats, indices of 8, 16 or 32 bits, or anything.
std::string take_buffer(ByteStream& bytes) {
  std::string buffer;
  const std::size_t words = 16 + bytes.below(48);
  for (std::size_t i = 0; i < words; ++i) {
    std::uint32_t word = 0;
    switch (bytes.below(5)) {
      case 0:
        word = bytes.take<std::uint32_t>();
        break;
      case 1:
        word = bytes.take<std::uint32_t>() & 0x03030303u;
        break;
      case 2:
        word = bytes.take<std::uint32_t>() & 0x00030003u;
        break;
      case 3:
        word = bytes.take<std::uint8_t>() & 3u;
        break;
      default: {
        const auto number = static_cast<float>(take_real(bytes));
        std::memcpy(&word, &number, sizeof word);
      }
    }
    buffer.append(reinterpret_cast<const char*>(&word), sizeof word);
  }
  return buffer;
}

void add_views(ByteStream& bytes, json& root, std::size_t buffer_bytes) {
  const std::size_t count = 1 + bytes.below(4);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t offset = bytes.chance(kOddOneIn) ? take_odd_size(bytes) : 4 * bytes.below(8);
    const std::uint64_t length = bytes.chance(kOddOneIn) ? take_odd_size(bytes) : buffer_bytes - offset;
    json view = {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
    if (bytes.chance(4)) view["byteStride"] = bytes.chance(kOddOneIn) ? take_odd_size(bytes) : 4 + 4 * bytes.below(8);
    root["bufferViews"].push_back(view);
  }
}

constexpr int kComponentTypes[] = {5120, 5121, 5122, 5123, 5125, 5126, 5124, 5130};
constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT4"};

struct Form {
  int component_type;
  const char* type;
  bool normalized;
};

// What the loader reads, with and without KHR_mesh_quantization.
Form take_form(ByteStream& bytes) {
  constexpr Form kForms[] = {{5126, "VEC3", false},   {5126, "VEC3", false},   {5126, "VEC2", false},
                             {5126, "SCALAR", false}, {5126, "VEC4", false},   {5121, "SCALAR", false},
                             {5123, "SCALAR", false}, {5125, "SCALAR", false}, {5122, "VEC3", true},
                             {5120, "VEC3", true},    {5123, "VEC2", true},    {5122, "VEC4", true},
                             {5121, "VEC3", false},   {5122, "VEC2", false}};
  if (!bytes.chance(kOddOneIn)) return bytes.one_of(kForms);
  return {bytes.one_of(kComponentTypes), bytes.one_of(kTypes), bytes.chance(2)};
}

void add_accessors(ByteStream& bytes, json& root) {
  const std::size_t views = root["bufferViews"].size(), count = 2 + bytes.below(6);
  for (std::size_t i = 0; i < count; ++i) {
    const Form form = take_form(bytes);
    json accessor = {{"componentType", form.component_type}, {"count", take_size(bytes, 7)}, {"type", form.type}};
    if (form.normalized) accessor["normalized"] = true;
    if (!bytes.chance(8)) accessor["bufferView"] = bytes.below(views);
    if (bytes.chance(4)) accessor["byteOffset"] = 4 * take_size(bytes, 5);
    if (bytes.chance(6)) {
      accessor["sparse"] = {{"count", take_size(bytes, 4)},
                            {"indices",
                             {{"bufferView", bytes.below(views)},
                              {"byteOffset", 4 * take_size(bytes, 5)},
                              {"componentType", bytes.chance(kOddOneIn) ? 5126 : 5121 + 2 * bytes.below(3)}}},
                            {"values", {{"bufferView", bytes.below(views)}, {"byteOffset", 4 * take_size(bytes, 5)}}}};
    }
    root["accessors"].push_back(accessor);
  }
}

// An accessor of a type, if there is one.
std::size_t take_accessor(ByteStream& bytes, const json& root, const char* type) {
  const json& accessors = root["accessors"];
  const std::size_t start = bytes.below(accessors.size());
  for (std::size_t i = 0; i < accessors.size() && !bytes.chance(kOddOneIn); ++i) {
    const std::size_t candidate = (start + i) % accessors.size();
    if (accessors[candidate]["type"] == type) return candidate;
  }
  return start;
}

void add_meshes(ByteStream& bytes, json& root) {
  const std::size_t count = 1 + bytes.below(2);
  for (std::size_t i = 0; i < count; ++i) {
    json primitives = json::array();
    const std::size_t parts = 1 + bytes.below(3);
    for (std::size_t p = 0; p < parts; ++p) {
      json primitive = {{"attributes", {{"POSITION", take_accessor(bytes, root, "VEC3")}}}};
      if (bytes.chance(6)) primitive["attributes"]["NORMAL"] = take_accessor(bytes, root, "VEC3");
      if (bytes.chance(6)) primitive["attributes"]["TEXCOORD_0"] = take_accessor(bytes, root, "VEC2");
      if (bytes.chance(2)) primitive["indices"] = take_accessor(bytes, root, "SCALAR");
      if (bytes.chance(2)) primitive["mode"] = bytes.below(8);
      primitives.push_back(primitive);
    }
    root["meshes"].push_back({{"primitives", primitives}});
  }
}

void add_cameras_and_lights(ByteStream& bytes, json& root) {
  root["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", take_positive(bytes)}, {"znear", take_positive(bytes)}}}},
      {{"type", "orthographic"},
       {"orthographic",
        {{"xmag", take_real(bytes)}, {"ymag", take_real(bytes)}, {"znear", 0}, {"zfar", take_positive(bytes)}}}}};
  json light = {{"type", bytes.chance(2) ? "spot" : "directional"}, {"intensity", take_positive(bytes)}};
  if (bytes.chance(2)) light["range"] = take_positive(bytes);
  light["spot"] = {{"innerConeAngle", take_positive(bytes) / 8}, {"outerConeAngle", take_positive(bytes)}};
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
    if (i + 1 < count && bytes.chance(2)) node["children"] = {bytes.chance(kOddOneIn) ? bytes.below(count) : i + 1};
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
  const std::size_t channels = bytes.below(4);
  for (std::size_t i = 0; i < channels; ++i) {
    const std::size_t path = bytes.below(4);
    root["animations"][0]["samplers"].push_back({{"input", take_accessor(bytes, root, "SCALAR")},
                                                 {"output", take_accessor(bytes, root, path == 1 ? "VEC4" : "VEC3")},
                                                 {"interpolation", bytes.one_of(kWays)}});
    root["animations"][0]["channels"].push_back(
        {{"sampler", i}, {"target", {{"node", bytes.below(root["nodes"].size())}, {"path", kPaths[path]}}}});
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
