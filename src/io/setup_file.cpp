// SPDX-License-Identifier: Apache-2.0
// Camera and lights from a JSON file of ours; docs/setup.md describes it.

#include <filesystem>
#include <glm/glm.hpp>
#include <new>

#include "io/gltf_document.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "io/setup_camera.h"
#include "io/setup_json.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::io {
namespace detail {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMostBytes = 64u << 20;
constexpr std::size_t kMostLights = 4096;

Double3 numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

LightType light_type(const json& object, const std::string& label) {
  const json& value = setup_member(object, "type", label);
  const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  LightType type;
  if (!find_light_type(name, type)) bad_input("{}: there is no type '{}'", label, printable(name, 32));
  return type;
}

void read_cone(const json& object, const std::string& label, Light& light) {
  const auto angle = [&](const char* name, double degrees) {
    if (object.contains(name)) degrees = setup_number(object.at(name), 0, 90, label + "." + name);
    return static_cast<float>(radians(degrees));
  };
  light.outer_cone_angle = angle("outer_cone_degrees", 45);
  light.inner_cone_angle = angle("inner_cone_degrees", 0);
  if (!(light.outer_cone_angle > 0) || light.inner_cone_angle > light.outer_cone_angle) {
    bad_input("{}: the inner cone must not be wider than the outer one, nor that 0", label);
  }
}

Light read_light_object(const json& object, const std::string& label, const SceneFile& scene) {
  refuse_unknown(object,
                 {"type", "name", "position", "direction", "color", "intensity", "range", "inner_cone_degrees",
                  "outer_cone_degrees"},
                 label);
  Light light;
  light.type = light_type(object, label);
  if (object.contains("name") && object.at("name").is_string()) light.name = object.at("name").get<std::string>();
  const LightTypeInfo& type = light_type_info(light.type);
  if (type.has_position) {
    light.position =
        numbers(setup_vector(setup_member(object, "position", label), -kLargestFloat, label + ".position"));
  }
  if (type.has_direction) {
    const glm::dvec3 v = setup_vector(setup_member(object, "direction", label), -kLargestFloat, label + ".direction");
    light.direction = numbers(setup_direction(v, label, "the direction is zero"));
  }
  if (object.contains("color")) {
    const glm::vec3 color(setup_vector(object.at("color"), 0, label + ".color"));
    light.color = {color.r, color.g, color.b};
  }
  if (object.contains("intensity")) {
    light.intensity = static_cast<float>(setup_number(object.at("intensity"), 0, kLargestFloat, label + ".intensity"));
  } else {
    light.intensity = type.has_position ? default_intensity(scene, light.position) : static_cast<float>(kPi);
  }
  if (object.contains("range")) {
    light.range = static_cast<float>(setup_number(object.at("range"), 1e-30, kLargestFloat, label + ".range"));
  }
  if (type.has_cone) read_cone(object, label, light);
  return light;
}

std::vector<Light> read_lights(const json& array, const SceneFile& scene) {
  if (!array.is_array()) bad_input("lights: is not an array");
  if (array.size() > kMostLights) over_limit("lights: {} lights, the limit is {}", array.size(), kMostLights);
  std::vector<Light> lights;
  for (const json& value : array) {
    const std::string label = fmt::format("lights[{}]", lights.size());
    if (value.is_object()) {
      lights.push_back(read_light_object(value, label, scene));
      continue;
    }
    Light light;
    light.position = numbers(setup_vector(value, -kLargestFloat, label));
    light.intensity = default_intensity(scene, light.position);
    lights.push_back(std::move(light));
  }
  return lights;
}

// Of several entries, the one for this scene; a single object is for every scene.
const json& find_entry(const json& root, const std::string& scene_path) {
  if (root.is_object()) return root;
  if (!root.is_array()) bad_input("is neither an object nor an array of objects");
  const std::filesystem::path path(scene_path);
  const auto says = [](const json& entry, const char* name, const std::string& value) {
    const auto found = entry.find(name);
    return found != entry.end() && found->is_string() && found->get_ref<const std::string&>() == value;
  };
  for (const json& entry : root) {
    if (!entry.is_object()) bad_input("is an array, but not of objects");
    if (says(entry, "file", path.filename().string()) || says(entry, "name", path.stem().string())) return entry;
  }
  bad_input("has no entry whose \"file\" is {} or whose \"name\" is {}", printable(path.filename().string(), 128),
            printable(path.stem().string(), 128));
}

}  // namespace

void read_setup(const std::string& path, const SceneFile& scene, Setup& out) {
  const std::vector<unsigned char> bytes = read_file(path, kMostBytes);
  const json root = parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const json& entry = find_entry(root, scene.path);
  if (!entry.contains("camera") && !entry.contains("lights")) bad_input("has neither a camera nor lights");
  if (entry.contains("camera")) out.camera = read_setup_camera(entry.at("camera"));
  if (entry.contains("lights")) out.lights = read_lights(entry.at("lights"), scene);
}

}  // namespace detail

Status load_setup(const std::string& path, const SceneFile& scene, Setup& out) {
  out = {};
  const auto failed = [&](StatusCode code, const std::string& what) {
    out = {};
    return Status(code, detail::printable(path) + ": " + what);
  };
  try {
    detail::read_setup(path, scene, out);
    return {};
  } catch (const detail::LoadError& e) {
    return failed(e.code, e.what);
  } catch (const std::bad_alloc&) {
    out = {};
    return detail::out_of_memory(path);
  } catch (const std::exception& e) {
    return failed(StatusCode::bad_input, detail::one_line(e.what()));
  }
}

}  // namespace umbrix::io
