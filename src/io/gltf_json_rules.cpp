// SPDX-License-Identifier: Apache-2.0
// What the JSON of a glTF file must look like where we use it (glTF 2.0 section 5 and the extensions' schemas), as a
// table. tinygltf leaves out members of a wrong type without a word and follows indices that lead nowhere.

#include <algorithm>
#include <string>
#include <vector>

#include "io/gltf_compression.h"
#include "io/gltf_document.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

enum class Kind { object, index, size, number, numbers, boolean, string };

// `path`: members from the root; [] means each element of an array, {} each member of an object. A rule on a member
// that is absent says nothing, unless it is required in the objects that have a place for it.
struct Rule {
  const char* path;
  Kind kind;
  const char* target = nullptr;  // what an index counts; null: anything that fits 31 bits
  std::size_t length = 0;        // of numbers; 0: any
  bool required = false;
};

#define UMBRIX_TEXTURE_INFO(path)                                                                           \
  {path, Kind::object}, {path ".index", Kind::index, "textures", 0, true}, {path ".texCoord", Kind::index}, \
      {path ".extensions.KHR_texture_transform.offset", Kind::numbers, nullptr, 2},                         \
      {path ".extensions.KHR_texture_transform.scale", Kind::numbers, nullptr, 2},                          \
      {path ".extensions.KHR_texture_transform.rotation", Kind::number}, {                                  \
    path ".extensions.KHR_texture_transform.texCoord", Kind::index                                          \
  }

constexpr const char* kLights = "extensions.KHR_lights_punctual.lights";

// Checked first: another version, or a file that needs more than we have, makes the rest meaningless.
constexpr Rule kHeadRules[] = {
    {"asset", Kind::object, nullptr, 0, true}, {"asset.version", Kind::string, nullptr, 0, true},
    {"asset.minVersion", Kind::string},        {"asset.generator", Kind::string},
    {"extensionsUsed[]", Kind::string},        {"extensionsRequired[]", Kind::string},
};

constexpr Rule kBodyRules[] = {
    {"buffers[].byteLength", Kind::size, nullptr, 0, true},
    {"buffers[].uri", Kind::string},
    {"bufferViews[].buffer", Kind::index, "buffers", 0, true},
    {"bufferViews[].byteOffset", Kind::size},
    {"bufferViews[].byteLength", Kind::size, nullptr, 0, true},
    {"bufferViews[].byteStride", Kind::size},
    {"buffers[].extensions.EXT_meshopt_compression.fallback", Kind::boolean},
    {"bufferViews[].extensions.EXT_meshopt_compression.buffer", Kind::index, "buffers", 0, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteOffset", Kind::size},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteLength", Kind::size, nullptr, 0, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.byteStride", Kind::size, nullptr, 0, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.count", Kind::size, nullptr, 0, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.mode", Kind::string, nullptr, 0, true},
    {"bufferViews[].extensions.EXT_meshopt_compression.filter", Kind::string},
    {"accessors[].bufferView", Kind::index, "bufferViews"},
    {"accessors[].byteOffset", Kind::size},
    {"accessors[].componentType", Kind::index, nullptr, 0, true},
    {"accessors[].normalized", Kind::boolean},
    {"accessors[].count", Kind::size, nullptr, 0, true},
    {"accessors[].type", Kind::string, nullptr, 0, true},
    {"accessors[].sparse.count", Kind::index, nullptr, 0, true},
    {"accessors[].sparse.indices", Kind::object, nullptr, 0, true},
    {"accessors[].sparse.indices.bufferView", Kind::index, "bufferViews", 0, true},
    {"accessors[].sparse.indices.byteOffset", Kind::index},
    {"accessors[].sparse.indices.componentType", Kind::index, nullptr, 0, true},
    {"accessors[].sparse.values", Kind::object, nullptr, 0, true},
    {"accessors[].sparse.values.bufferView", Kind::index, "bufferViews", 0, true},
    {"accessors[].sparse.values.byteOffset", Kind::index},

    {"meshes[].primitives[].attributes", Kind::object, nullptr, 0, true},
    {"meshes[].primitives[].attributes{}", Kind::index, "accessors"},
    {"meshes[].primitives[].indices", Kind::index, "accessors"},
    {"meshes[].primitives[].material", Kind::index, "materials"},
    {"meshes[].primitives[].mode", Kind::index},
    {"meshes[].primitives[].targets[]{}", Kind::index, "accessors"},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.bufferView", Kind::index, "bufferViews", 0, true},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes", Kind::object, nullptr, 0, true},
    {"meshes[].primitives[].extensions.KHR_draco_mesh_compression.attributes{}", Kind::index},
    {"meshes[].weights", Kind::numbers},
    {"skins[].joints[]", Kind::index, "nodes"},
    {"skins[].inverseBindMatrices", Kind::index, "accessors"},

    {"materials[].pbrMetallicRoughness", Kind::object},
    {"materials[].pbrMetallicRoughness.baseColorFactor", Kind::numbers, nullptr, 4},
    UMBRIX_TEXTURE_INFO("materials[].pbrMetallicRoughness.baseColorTexture"),
    UMBRIX_TEXTURE_INFO("materials[].pbrMetallicRoughness.metallicRoughnessTexture"),
    UMBRIX_TEXTURE_INFO("materials[].normalTexture"),
    {"materials[].normalTexture.scale", Kind::number},
    UMBRIX_TEXTURE_INFO("materials[].occlusionTexture"),
    {"materials[].pbrMetallicRoughness.metallicFactor", Kind::number},
    {"materials[].pbrMetallicRoughness.roughnessFactor", Kind::number},
    {"materials[].emissiveFactor", Kind::numbers, nullptr, 3},
    UMBRIX_TEXTURE_INFO("materials[].emissiveTexture"),
    {"materials[].alphaMode", Kind::string},
    {"materials[].alphaCutoff", Kind::number},
    {"materials[].doubleSided", Kind::boolean},
    {"materials[].extensions.KHR_materials_emissive_strength.emissiveStrength", Kind::number},
    {"materials[].extensions.KHR_materials_ior.ior", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularFactor", Kind::number},
    {"materials[].extensions.KHR_materials_specular.specularColorFactor", Kind::numbers, nullptr, 3},
    UMBRIX_TEXTURE_INFO("materials[].extensions.KHR_materials_specular.specularTexture"),
    UMBRIX_TEXTURE_INFO("materials[].extensions.KHR_materials_specular.specularColorTexture"),
    {"materials[].extensions.KHR_materials_unlit", Kind::object},
    {"images[].uri", Kind::string},
    {"images[].bufferView", Kind::index, "bufferViews"},
    {"textures[].source", Kind::index, "images"},
    {"textures[].sampler", Kind::index, "samplers"},
    {"samplers[].magFilter", Kind::index},
    {"samplers[].minFilter", Kind::index},
    {"samplers[].wrapS", Kind::index},
    {"samplers[].wrapT", Kind::index},

    {"cameras[].type", Kind::string, nullptr, 0, true},
    {"cameras[].perspective.yfov", Kind::number, nullptr, 0, true},
    {"cameras[].perspective.aspectRatio", Kind::number},
    {"cameras[].perspective.znear", Kind::number, nullptr, 0, true},
    {"cameras[].perspective.zfar", Kind::number},
    {"cameras[].orthographic.xmag", Kind::number, nullptr, 0, true},
    {"cameras[].orthographic.ymag", Kind::number, nullptr, 0, true},
    {"cameras[].orthographic.znear", Kind::number, nullptr, 0, true},
    {"cameras[].orthographic.zfar", Kind::number, nullptr, 0, true},
    {"extensions.KHR_lights_punctual.lights[].type", Kind::string, nullptr, 0, true},
    {"extensions.KHR_lights_punctual.lights[].color", Kind::numbers, nullptr, 3},
    {"extensions.KHR_lights_punctual.lights[].intensity", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].range", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.innerConeAngle", Kind::number},
    {"extensions.KHR_lights_punctual.lights[].spot.outerConeAngle", Kind::number},

    {"nodes[].children[]", Kind::index, "nodes"},
    {"nodes[].mesh", Kind::index, "meshes"},
    {"nodes[].camera", Kind::index, "cameras"},
    {"nodes[].skin", Kind::index, "skins"},
    {"nodes[].weights", Kind::numbers},
    {"nodes[].matrix", Kind::numbers, nullptr, 16},
    {"nodes[].translation", Kind::numbers, nullptr, 3},
    {"nodes[].rotation", Kind::numbers, nullptr, 4},
    {"nodes[].scale", Kind::numbers, nullptr, 3},
    {"nodes[].extensions.KHR_lights_punctual.light", Kind::index, kLights, 0, true},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes", Kind::object, nullptr, 0, true},
    {"nodes[].extensions.EXT_mesh_gpu_instancing.attributes{}", Kind::index, "accessors"},
    {"animations[].channels[].sampler", Kind::index, nullptr, 0, true},
    {"animations[].channels[].target", Kind::object, nullptr, 0, true},
    {"animations[].channels[].target.node", Kind::index, "nodes"},
    {"animations[].channels[].target.path", Kind::string, nullptr, 0, true},
    {"animations[].samplers[].input", Kind::index, "accessors", 0, true},
    {"animations[].samplers[].output", Kind::index, "accessors", 0, true},
    {"animations[].samplers[].interpolation", Kind::string},
    {"scenes[].nodes[]", Kind::index, "nodes"},
    {"scene", Kind::index, "scenes"},
};

#undef UMBRIX_TEXTURE_INFO

constexpr const char* kSupported[] = {
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_specular",  "KHR_materials_unlit", "KHR_mesh_quantization",           "KHR_texture_transform"};

// The number of elements of the array at a dotted path; 0 if there is none.
std::uint64_t array_size(const json& root, std::string_view path) {
  const json* value = &root;
  while (!path.empty()) {
    const auto dot = std::min(path.find('.'), path.size());
    const auto found = value->is_object() ? value->find(std::string(path.substr(0, dot))) : value->end();
    if (found == value->end()) return 0;
    value = &*found;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return value->is_array() ? value->size() : 0;
}

// Applies one rule to everything its path names, remembering the way for messages.
class RuleCheck {
 public:
  RuleCheck(const json& root, const Rule& rule)
      : rule_(rule), target_size_(rule.target ? array_size(root, rule.target) : std::uint64_t{1} << 31) {
    visit(root, rule.path);
  }

 private:
  struct Step {
    std::string_view member;
    std::size_t element;
  };
  static constexpr std::size_t kNone = ~std::size_t{0};

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    std::string where;
    for (const Step& step : trail_) {
      if (!step.member.empty()) where += (where.empty() ? "" : ".") + printable(step.member, 64);
      if (step.element != kNone) where += fmt::format("[{}]", step.element);
    }
    bad_input("{}: {}", where.empty() ? "the document" : where, fmt::format(format, std::forward<Args>(args)...));
  }

  void visit(const json& value, std::string_view rest) {
    if (rest.empty()) return check(value);
    if (rest.substr(0, 2) == "[]") return each_element(value, rest.substr(2));
    if (rest.substr(0, 2) == "{}") return each_member(value, rest.substr(2));
    if (rest.front() == '.') rest.remove_prefix(1);
    if (!value.is_object()) fail("is not an object");
    const auto end = std::min(rest.find_first_of(".[{"), rest.size());
    const std::string_view member = rest.substr(0, end);
    const auto found = value.find(std::string(member));
    if (found == value.end()) {
      if (rule_.required && end == rest.size()) fail("'{}' is missing", member);
      return;
    }
    trail_.push_back({member, kNone});
    visit(*found, rest.substr(end));
    trail_.pop_back();
  }

  void each_element(const json& array, std::string_view rest) {
    if (!array.is_array()) fail("is not an array");
    trail_.push_back({{}, 0});
    for (const json& element : array) {
      visit(element, rest);
      ++trail_.back().element;
    }
    trail_.pop_back();
  }

  void each_member(const json& object, std::string_view rest) {
    if (!object.is_object()) fail("is not an object");
    for (const auto& member : object.items()) {
      trail_.push_back({member.key(), kNone});
      visit(member.value(), rest);
      trail_.pop_back();
    }
  }

  void check(const json& value) const {
    switch (rule_.kind) {
      case Kind::object:
        if (!value.is_object()) fail("is not an object");
        break;
      case Kind::string:
        if (!value.is_string()) fail("is not a string");
        break;
      case Kind::boolean:
        if (!value.is_boolean()) fail("is neither true nor false");
        break;
      case Kind::number:
        if (!value.is_number()) fail("is not a number");
        break;
      case Kind::numbers:
        if (!value.is_array() || (rule_.length > 0 && value.size() != rule_.length)) {
          fail("must be {} numbers, has {}", rule_.length, value.is_array() ? value.size() : 1);
        }
        if (!std::all_of(value.begin(), value.end(), [](const json& n) { return n.is_number(); })) {
          fail("must be numbers");
        }
        break;
      case Kind::size:
        // Bounded, so that sums of two do not overflow.
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::uint64_t{1} << 53) {
          fail("is not a whole number from 0 to 2^53");
        }
        break;
      case Kind::index:
        if (!value.is_number_unsigned()) fail("is not a whole number from 0 up");
        if (value.get<std::uint64_t>() >= target_size_) {
          fail("is {}, but {}", value.get<std::uint64_t>(),
               rule_.target ? fmt::format("there are {} {}", target_size_, rule_.target) : "must be below 2^31");
        }
        break;
    }
  }

  const Rule& rule_;
  std::uint64_t target_size_;
  std::vector<Step> trail_;
};

void check_version(const json& asset) {
  const auto major_of = [](const std::string& version) { return version.substr(0, version.find('.')); };
  const std::string version = asset.at("version").get<std::string>();
  if (major_of(version) != "2") bad_input("glTF version {} is not supported, only 2", printable(version, 16));
  if (asset.contains("minVersion") && asset.at("minVersion").get<std::string>() != "2.0") {
    bad_input("needs glTF version {}, 2.0 is supported", printable(asset.at("minVersion").get<std::string>(), 16));
  }
}

void check_required_extensions(const json& root) {
  if (!root.contains("extensionsRequired")) return;
  for (const json& element : root.at("extensionsRequired")) {
    const auto name = element.get<std::string>();
    if (is_supported_extension(name)) continue;
    const char* advice = "";
    if (name == kDraco) advice = " by this build; gltf-transform can decompress the file";
    if (name == kMeshopt) advice = " by this build; gltfpack or gltf-transform can decompress the file";
    if (name == "KHR_texture_basisu") advice = "; gltf-transform can turn its KTX2 images into PNG";
    if (name == "EXT_texture_webp") advice = "; gltf-transform can turn its WebP images into PNG";
    bad_input("requires the extension {}, which is not supported{}", printable(name, 64), advice);
  }
}

void check_buffer_views(const json& root) {
  if (!root.contains("bufferViews")) return;
  std::size_t number = 0;
  for (const json& view : root.at("bufferViews")) {
    const auto length =
        root.at("buffers").at(view.at("buffer").get<std::size_t>()).at("byteLength").get<std::uint64_t>();
    const std::uint64_t begin = view.value("byteOffset", std::uint64_t{0});
    const std::uint64_t bytes = view.at("byteLength").get<std::uint64_t>();
    if (begin > length || bytes > length - begin) {
      bad_input("bufferViews[{}]: bytes {} to {} lie beyond its buffer of {} bytes", number, begin, begin + bytes,
                length);
    }
    ++number;
  }
}

// Before tinygltf makes objects of the elements, which take up to four kilobytes each where the text takes three bytes.
void check_list_lengths(const json& root, const LoadLimits& limits) {
  const auto check = [](const char* path, std::uint64_t size, std::uint64_t limit) {
    if (size > limit) over_limit("{} {}, the limit is {}", size, path, limit);
  };
  for (const auto& member : root.items()) {
    const std::string& name = member.key();
    if (name == "nodes" || !member.value().is_array()) continue;
    const bool small = name == "accessors" || name == "bufferViews" || name == "meshes";
    check(printable(name, 64).c_str(), member.value().size(), small ? limits.list_elements : limits.list_elements / 10);
  }
  check("nodes", array_size(root, "nodes"), limits.nodes);
  check("lights", array_size(root, kLights), limits.list_elements);
}

}  // namespace

bool is_supported_extension(std::string_view name) {
  if (name == kMeshopt) return kReadsMeshopt;
  if (name == kDraco) return kReadsDraco;
  return std::find(std::begin(kSupported), std::end(kSupported), name) != std::end(kSupported);
}

void check_gltf_json(const json& root, const LoadLimits& limits) {
  for (const Rule& rule : kHeadRules) RuleCheck(root, rule);
  check_version(root.at("asset"));
  check_required_extensions(root);
  check_list_lengths(root, limits);
  for (const Rule& rule : kBodyRules) RuleCheck(root, rule);
  check_buffer_views(root);
}

}  // namespace umbrix::io::detail
