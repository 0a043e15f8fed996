// SPDX-License-Identifier: Apache-2.0
// Camera and lights from a JSON file of ours; docs/setup.md describes it.

#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <new>

#include "io/gltf_document.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "umbrix/io/scene_file.h"

namespace umbrix::io {
namespace detail {
namespace {

using nlohmann::json;

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kMostBytes = 64u << 20;
constexpr std::size_t kMostLights = 4096;

double number(const json& value, double low, double high, const std::string& label) {
  if (!value.is_number()) bad_input("{}: is not a number", label);
  const auto n = value.get<double>();
  if (!(n >= low && n <= high)) bad_input("{}: {} is not from {} to {}", label, n, low, high);
  return n;
}

constexpr double kLargest = std::numeric_limits<float>::max();

Double3 triple(const json& value, double low, const std::string& label) {
  if (!value.is_array() || value.size() != 3) bad_input("{}: must be three numbers", label);
  Double3 out{};
  for (std::size_t i = 0; i < 3; ++i) out[i] = number(value[i], low, kLargest, label);
  return out;
}

const json& member(const json& object, const char* name, const std::string& label) {
  const auto found = object.find(name);
  if (found == object.end()) bad_input("{}: '{}' is missing", label, name);
  return *found;
}

glm::dvec3 unit(const glm::dvec3& v, const std::string& label, const char* fault) {
  const double length = glm::length(v);
  if (!(length > 0) || !std::isfinite(length)) bad_input("{}: {}", label, fault);
  return v / length;
}

// Unknown names are refused: a misspelt "intensty" would else be a dark picture.
void refuse_unknown(const json& object, std::initializer_list<const char*> known, const std::string& label) {
  if (!object.is_object()) bad_input("{}: is not an object", label);
  for (const auto& entry : object.items()) {
    bool found = false;
    for (const char* name : known) found = found || entry.key() == name;
    if (!found) bad_input("{}: unknown member '{}'", label, printable(entry.key(), 64));
  }
}

Camera read_camera(const json& object) {
  const std::string label = "camera";
  refuse_unknown(object, {"eye", "target", "up", "fov_y_degrees"}, label);
  const auto vector = [&](const char* name) {
    const Double3 v = triple(member(object, name, label), -kLargest, label + "." + name);
    return glm::dvec3(v[0], v[1], v[2]);
  };
  const glm::dvec3 eye = vector("eye");
  const glm::dvec3 up = object.contains("up") ? vector("up") : glm::dvec3(0, 1, 0);
  const glm::dvec3 z = unit(eye - vector("target"), label, "eye and target are the same point");
  const glm::dvec3 x = unit(glm::cross(up, z), label, "'up' is zero or points along the view");
  const glm::dvec3 y = glm::cross(z, x);
  Camera camera;
  camera.name = "setup";
  if (object.contains("fov_y_degrees")) {
    camera.yfov = number(object.at("fov_y_degrees"), 0.001, 179.999, "camera.fov_y_degrees") * kPi / 180;
  }
  for (int r = 0; r < 3; ++r) camera.to_world[static_cast<std::size_t>(r)] = {x[r], y[r], z[r], eye[r]};
  return camera;
}

LightType light_type(const json& object, const std::string& label) {
  const json& value = member(object, "type", label);
  const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  LightType type;
  if (!find_light_type(name, type)) bad_input("{}: there is no type '{}'", label, printable(name, 32));
  return type;
}

void read_cone(const json& object, const std::string& label, Light& light) {
  const auto radians = [&](const char* name, double degrees) {
    if (object.contains(name)) degrees = number(object.at(name), 0, 90, label + "." + name);
    return degrees * kPi / 180;
  };
  light.outer_cone_angle = static_cast<float>(radians("outer_cone_degrees", 45));
  light.inner_cone_angle = static_cast<float>(radians("inner_cone_degrees", 0));
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
    light.position = triple(member(object, "position", label), -kLargest, label + ".position");
  }
  if (type.has_direction) {
    const Double3 d = triple(member(object, "direction", label), -kLargest, label + ".direction");
    const glm::dvec3 v = unit({d[0], d[1], d[2]}, label, "the direction is zero");
    light.direction = {v.x, v.y, v.z};
  }
  if (object.contains("color")) {
    const Double3 color = triple(object.at("color"), 0, label + ".color");
    for (std::size_t c = 0; c < 3; ++c) light.color[c] = static_cast<float>(color[c]);
  }
  if (object.contains("intensity")) {
    light.intensity = static_cast<float>(number(object.at("intensity"), 0, kLargest, label + ".intensity"));
  } else {
    light.intensity = type.has_position ? default_intensity(scene, light.position) : static_cast<float>(kPi);
  }
  if (object.contains("range")) {
    light.range = static_cast<float>(number(object.at("range"), 1e-30, kLargest, label + ".range"));
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
    light.position = triple(value, -kLargest, label);
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
  if (entry.contains("camera")) out.camera = read_camera(entry.at("camera"));
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
    return failed(StatusCode::resource_limit, "not enough memory");
  } catch (const std::exception& e) {
    return failed(StatusCode::bad_input, detail::one_line(e.what()));
  }
}

}  // namespace umbrix::io
