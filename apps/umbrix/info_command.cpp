// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "memory_guard.h"
#include "memory_limit.h"
#include "message.h"
#include "render/render.h"
#include "render/world.h"
#include "standard_streams.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::ordered_json;

/// The box of all placed vertices; JSON null if there are none.
Json bounds(const std::vector<render::WorldMesh>& meshes) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  io::Float3 lower = {kInfinity, kInfinity, kInfinity}, upper = {-kInfinity, -kInfinity, -kInfinity};
  for (const render::WorldMesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.mesh->positions.size(); ++i) {
      const io::Float3 position = mesh.position(i);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], position[axis]);
        upper[axis] = std::max(upper[axis], position[axis]);
      }
    }
  }
  if (!(lower[0] <= upper[0])) return nullptr;
  return {{"lower", lower}, {"upper", upper}};
}

Json lights(const io::SceneFile& scene) {
  Json list = Json::array();
  for (const io::Light& light : scene.lights) {
    Json entry = {{"name", light.name},
                  {"type", io::light_type_info(light.type).name},
                  {"color", light.color},
                  {"intensity", light.intensity}};
    if (io::light_type_info(light.type).has(io::kHasPosition)) entry["position"] = light.position;
    if (io::light_type_info(light.type).has(io::kHasDirection)) entry["direction"] = light.direction;
    list.push_back(entry);
  }
  return list;
}

/// Meshes that are lights, by the light that each instance makes.
Json emissive_meshes(const io::SceneFile& scene) {
  Json list = Json::array();
  for (const io::Light& light : io::emissive_lights(scene)) {
    const io::Mesh& mesh = scene.meshes[scene.instances[light.instance].mesh];
    list.push_back({{"name", light.name},
                    {"triangles", mesh.triangles.size()},
                    {"radiance", light.color},
                    {"double_sided", scene.materials[mesh.material].double_sided}});
  }
  return list;
}

Json cameras(const io::SceneFile& scene) {
  Json list = Json::array();
  for (const io::Camera& camera : scene.cameras) {
    const bool perspective = camera.type == io::CameraType::perspective;
    const io::Transform& m = camera.to_world;
    Json entry = {{"name", camera.name},
                  {"type", perspective ? "perspective" : "orthographic"},
                  {"position", {m[0][3], m[1][3], m[2][3]}}};
    if (camera.motion) entry["moves_seconds"] = io::motion_span(camera);
    list.push_back(entry);
  }
  return list;
}

/// What materials take from an image.
Json uses_of(const io::SceneFile& scene, std::int32_t image) {
  constexpr const char* kNames[] = {"base color", "metallic-roughness", "normal",
                                    "emission",   "specular",           "specular color"};
  static_assert(std::size(kNames) == std::size(io::kMaterialTextures));
  Json uses = Json::array();
  for (std::size_t kind = 0; kind < std::size(kNames); ++kind) {
    const bool used = std::any_of(scene.materials.begin(), scene.materials.end(), [&](const io::Material& material) {
      const std::int32_t texture = (material.*io::kMaterialTextures[kind]).texture;
      return texture >= 0 && scene.textures[static_cast<std::size_t>(texture)].image == image;
    });
    if (used) uses.push_back(kNames[kind]);
  }
  return uses;
}

/// Pictures as their headers have them, by what they are used for; nothing is decoded.
Json images(const io::SceneFile& scene) {
  Json list = Json::array();
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const io::TextureImage& image = scene.images[i];
    Json entry = {{"name", image.file.empty() ? image.name : std::filesystem::path(image.file).filename().string()}};
    io::ImageInfo header;
    if (const Status status = io::describe_image(scene, image, header); !status) {
      entry["fault"] = status.message();
    } else {
      entry.update({{"format", header.format}, {"size", {header.width, header.height}}, {"channels", header.channels}});
    }
    entry["used_for"] = uses_of(scene, static_cast<std::int32_t>(i));
    list.push_back(entry);
  }
  return list;
}

/// All that is told, in the order in which it is told.
Json describe(const io::SceneFile& scene, const std::vector<render::WorldMesh>& meshes,
              const std::vector<std::string>& notes) {
  std::uint64_t stored = 0;
  for (const io::Mesh& mesh : scene.meshes) stored += mesh.triangles.size();
  std::vector<std::string> warnings = scene.warnings;
  warnings.insert(warnings.end(), notes.begin(), notes.end());
  return {{"file", scene.path},
          {"generator", scene.generator},
          {"meshes", scene.meshes.size()},
          {"instances", scene.instances.size()},
          {"triangles", scene.instanced_triangles()},
          {"stored_triangles", stored},
          {"materials", scene.materials.size()},
          {"textures", scene.textures.size()},
          {"images", images(scene)},
          {"animations", scene.animations},
          {"moves_seconds", scene.motion ? Json(io::motion_span(scene)) : Json(nullptr)},
          {"bounds", bounds(meshes)},
          {"cameras", cameras(scene)},
          {"lights", lights(scene)},
          {"emissive_meshes", emissive_meshes(scene)},
          {"extensions_used", scene.extensions_used},
          {"ignored", scene.ignored},
          {"warnings", warnings}};
}

/// One line for a plain value, one for each element of a list.
std::string table(const Json& description) {
  std::string lines;
  for (const auto& [key, value] : description.items()) {
    const auto text = [](const Json& v) {
      return printable(v.is_string() ? v.get<std::string>() : v.dump(-1, ' ', false, Json::error_handler_t::replace));
    };
    if (!value.is_array()) {
      lines += fmt::format("{:18}{}\n", key, text(value));
      continue;
    }
    lines += fmt::format("{:18}{}\n", key, value.empty() ? "none" : std::to_string(value.size()));
    for (const Json& element : value) lines += fmt::format("{:18}  {}\n", "", text(element));
  }
  return lines;
}

Status run(const std::string& path, bool json) {
  io::SceneFile scene;
  if (Status status = io::load_scene(path, scene); !status) return status;
  std::vector<render::WorldMesh> meshes;
  std::vector<std::string> notes;
  if (Status status = render::flatten(scene, meshes, notes, render::Instancing::share); !status) return status;
  const Json description = describe(scene, meshes, notes);
  // File names and glTF strings may not be UTF-8: replace what is not, rather than fail.
  return print_result(json ? description.dump(2, ' ', false, Json::error_handler_t::replace) + '\n'
                           : table(description));
}

}  // namespace

Command add_info_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("info", "Tell what is in a scene, and what of it is ignored");
  const auto path = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  parser->add_option("scene", *path, "A glTF 2.0 file, .gltf or .glb")->required()->type_name("SCENE");
  parser->add_flag("--json", *json, "For programs");
  const auto memory_limit = std::make_shared<std::uint64_t>(default_memory_limit());
  add_memory_limit_option(*parser, *memory_limit);
  return {parser, [path, json, memory_limit] {
            limit_memory(*memory_limit);
            set_phase("reading the scene");
            return report_status(run(*path, *json));
          }};
}

}  // namespace umbrix::app
