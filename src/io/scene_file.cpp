// SPDX-License-Identifier: Apache-2.0
#include "umbrix/io/scene_file.h"

#include <exception>
#include <new>
#include <stdexcept>

#include "io/gltf_compression.h"
#include "io/gltf_convert.h"
#include "io/gltf_document.h"
#include "io/gltf_parse.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "io/memory_share.h"

namespace umbrix::io {
namespace detail {

void Remarks::add(const std::string& kind, const std::string& where, std::uint64_t count) {
  Entry& entry = entries_[kind];
  if (entry.count == 0) entry.first = where;
  entry.count += count;
}

std::vector<std::string> Remarks::lines() const {
  std::vector<std::string> out;
  for (const auto& [kind, entry] : entries_) {
    std::string line = kind;
    if (entry.count > 1) line += fmt::format(": {}", entry.count);
    if (!entry.first.empty()) line += fmt::format("{} in {}", entry.count > 1 ? ", first" : ":", entry.first);
    out.push_back(std::move(line));
  }
  return out;
}

std::string label_of(const char* array, std::size_t index, const std::string& name) {
  return name.empty() ? fmt::format("{}[{}]", array, index)
                      : fmt::format("{}[{}] '{}'", array, index, printable(name, 64));
}

namespace {

void note_unread(Conversion& c) {
  const auto note = [&](const char* kind, std::size_t count) {
    if (count > 0) c.ignored.add(kind, "", count);
  };
  note("scenes other than the default one", c.model.scenes.empty() ? 0 : c.model.scenes.size() - 1);
  for (const std::string& name : c.model.extensionsUsed) {
    if (!is_supported_extension(name)) c.ignored.add("extension " + printable(name, 64), "");
  }
}

// What a small file can ask for by naming one accessor in many primitives has to end before the machine's memory does.
std::uint64_t decoded_byte_limit(const LoadLimits& limits) {
  if (limits.decoded_bytes > 0) return limits.decoded_bytes;
  return memory_share(3, 4);
}

void load(const std::string& path, SceneFile& scene, LoadLimits limits, const std::string& animation) {
  limits.decoded_bytes = decoded_byte_limit(limits);
  const OpenedFiles record(scene.files);
  const tinygltf::Model model = [&] {
    GltfDocument document = read_gltf_document(path, limits);
    const nlohmann::json root = parse_json(document.json, limits);
    check_gltf_json(root, limits);
    tinygltf::Model parsed = parse_gltf(path, as_if_plain(std::move(document), root), root, limits);
    if constexpr (kReadsMeshopt) decode_meshopt(root, parsed, limits.decoded_bytes);
    if constexpr (kReadsDraco) decode_draco(root, parsed, limits.decoded_bytes);
    return parsed;
  }();
  scene.path = path;
  scene.generator = model.asset.generator;
  scene.extensions_used = model.extensionsUsed;
  for (const tinygltf::Animation& animation_in : model.animations) scene.animations.push_back(animation_in.name);

  Conversion conversion{model, limits, scene, {}, {}, {}, {}};
  convert_textures(conversion);
  convert_images(conversion);
  convert_materials(conversion);
  convert_meshes(conversion);
  convert_nodes(conversion, animation);
  note_unread(conversion);
  if (scene.instances.empty()) conversion.warnings.add("the scene shows no triangles", "");
  scene.ignored = conversion.ignored.lines();
  scene.warnings = conversion.warnings.lines();
}

}  // namespace
}  // namespace detail

std::uint64_t SceneFile::instanced_triangles() const noexcept {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].triangles.size();
  return count;
}

Status load_scene(const std::string& path, SceneFile& out, const LoadLimits& limits, const std::string& animation) {
  out = {};
  const auto failed = [&](StatusCode code, const std::string& what) {
    out = {};
    return Status(code, detail::printable(path) + ": " + what);
  };
  try {
    detail::load(path, out, limits, animation);
    return {};
  } catch (const detail::LoadError& e) {
    return failed(e.code, e.what);
  } catch (const std::bad_alloc&) {
    out = {};
    return detail::out_of_memory(path);
  } catch (const std::length_error&) {
    return failed(StatusCode::resource_limit, "not enough memory");
  } catch (const std::exception& e) {
    return failed(StatusCode::bad_input, detail::one_line(e.what()));
  }
}

}  // namespace umbrix::io
