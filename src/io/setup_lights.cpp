// SPDX-License-Identifier: Apache-2.0
// The lights of a setup file (docs/setup.md). Each type has the members that its traits tell.

#include "io/setup_lights.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "io/environment_file.h"
#include "io/input_file.h"
#include "io/load_error.h"
#include "io/setup_json.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

constexpr std::size_t kMostLights = 4096;
constexpr double kSmallest = 1e-30;

Double3 numbers(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

LightType light_type(const json& object, const std::string& label) {
  const json& value = setup_member(object, "type", label);
  const std::string name = value.is_string() ? value.get<std::string>() : value.dump();
  LightType type;
  if (!find_light_type(name, type)) bad_input("{}: there is no type '{}'", label, printable(name, 32));
  if (light_type_info(type).has(kFromMaterial)) {
    bad_input("{}: meshes shine by their materials, in the scene file", label);
  }
  return type;
}

void refuse_unknown_of_type(const json& object, const LightTypeInfo& type, const std::string& label) {
  if (type.has(kSurrounds))
    return refuse_unknown(object, {"type", "name", "color", "radiance", "file", "rotation_degrees", "visible"}, label);
  if (type.has(kHasEdges)) {
    return refuse_unknown(
        object,
        {"type", "name", "position", "direction", "up", "width", "height", "color", "intensity", "radiance", "power"},
        label);
  }
  if (type.has(kHasRadius)) {
    return refuse_unknown(object, {"type", "name", "position", "radius", "color", "intensity", "radiance", "power"},
                          label);
  }
  refuse_unknown(object,
                 {"type", "name", "position", "direction", "color", "intensity", "range", "inner_cone_degrees",
                  "outer_cone_degrees"},
                 label);
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

double positive(const json& object, const char* name, const std::string& label) {
  return setup_number(setup_member(object, name, label), kSmallest, kLargestFloat, label + "." + name);
}

glm::dvec3 optional_vector(const json& object, const char* name, double low, const glm::dvec3& otherwise,
                           const std::string& label) {
  return object.contains(name) ? setup_vector(object.at(name), low, label + "." + name) : otherwise;
}

// The width runs across `up`, as for a picture that hangs on a wall and faces the room.
void read_edges(const json& object, const std::string& label, Light& light) {
  const glm::dvec3 facing(light.direction[0], light.direction[1], light.direction[2]);
  const glm::dvec3 usual = std::abs(facing.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 up = optional_vector(object, "up", -kLargestFloat, usual, label);
  const glm::dvec3 across = setup_direction(glm::cross(up, facing), label, "'up' is zero or points along 'direction'");
  const glm::dvec3 along = glm::cross(facing, across);
  light.half_edges = {numbers(0.5 * positive(object, "width", label) * across),
                      numbers(0.5 * positive(object, "height", label) * along)};
}

void read_color(const json& object, const std::string& label, Light& light) {
  const glm::vec3 color(optional_vector(object, "color", 0, glm::dvec3(1), label));
  light.color = {color.r, color.g, color.b};
}

float finite_float(double value, const std::string& label) {
  if (!(value <= kLargestFloat)) bad_input("{}: shines too brightly for a float", label);
  return static_cast<float>(value);
}

// A number, or one for each of red, green and blue.
void read_radiance(const json& object, const std::string& label, Light& light) {
  const json& value = object.at("radiance");
  if (!value.is_array()) {
    light.intensity = static_cast<float>(setup_number(value, 0, kLargestFloat, label + ".radiance"));
    return;
  }
  const glm::dvec3 radiance = setup_vector(value, 0, label + ".radiance");
  for (int c = 0; c < 3; ++c) {
    float& color = light.color[static_cast<std::size_t>(c)];
    color = finite_float(double{color} * radiance[c], label);
  }
}

// Radiance of a light with a place: as it is, from the power that it gives off, or from the intensity of a point light
// that does the same far away, straight ahead.
void read_area_strength(const json& object, const std::string& label, const SceneFile& scene, Light& light) {
  // `area` as seen from straight ahead; what shines in all directions gives off 4 pi times its intensity, a flat light
  // pi times.
  const auto length = [](const Double3& v) { return glm::length(glm::dvec3(v[0], v[1], v[2])); };
  const bool flat = light_type_info(light.type).has(kHasEdges);
  const double area = flat ? 4 * length(light.half_edges[0]) * length(light.half_edges[1])
                           : kPi * double{light.radius} * double{light.radius};
  const auto given = [&](const char* name) { return object.contains(name); };
  if (given("radiance") + given("power") + given("intensity") > 1) {
    bad_input("{}: only one of 'radiance', 'power' and 'intensity' may be given", label);
  }
  const auto value = [&](const char* name) {
    return setup_number(object.at(name), 0, kLargestFloat, label + "." + name);
  };
  if (given("radiance")) {
    read_radiance(object, label, light);
  } else if (given("power")) {
    light.intensity = finite_float(value("power") / (area * kPi * (flat ? 1 : 4)), label);
  } else {
    const double intensity = given("intensity") ? value("intensity") : default_intensity(scene, light.position);
    light.intensity = finite_float(intensity / area, label);
  }
}

void read_environment_light(const json& object, const std::string& label, const SetupContext& context, Light& light) {
  if (object.contains("radiance")) read_radiance(object, label, light);
  if (object.contains("rotation_degrees")) {
    light.rotation = radians(setup_number(object.at("rotation_degrees"), -1e6, 1e6, label + ".rotation_degrees"));
  }
  if (object.contains("visible")) {
    if (!object.at("visible").is_boolean()) bad_input("{}.visible: is neither true nor false", label);
    light.visible = object.at("visible").get<bool>();
  }
  if (!object.contains("file")) return;
  if (!object.at("file").is_string()) bad_input("{}.file: is not a string", label);
  const auto name = object.at("file").get<std::string>();
  const std::string path =
      path_beside(context.path, name, !context.limits.allow_paths_outside, label + ".file", "setup file");
  if (Status status = check_readable(path); !status) bad_input("{}.file: {}", label, status.message());
  try {
    light.environment = std::make_shared<EnvironmentMap>(read_environment(path, context.limits.environment_pixels));
  } catch (const LoadError& e) {
    throw LoadError{e.code, fmt::format("{}.file: {}: {}", label, printable(path), e.what)};
  }
}

void read_strength(const json& object, const std::string& label, const SceneFile& scene, Light& light) {
  const LightTypeInfo& type = light_type_info(light.type);
  if (type.has(kHasArea)) return read_area_strength(object, label, scene, light);
  if (object.contains("intensity")) {
    light.intensity = static_cast<float>(setup_number(object.at("intensity"), 0, kLargestFloat, label + ".intensity"));
  } else {
    light.intensity = type.has(kHasPosition) ? default_intensity(scene, light.position) : static_cast<float>(kPi);
  }
  if (object.contains("range")) {
    light.range = static_cast<float>(setup_number(object.at("range"), kSmallest, kLargestFloat, label + ".range"));
  }
}

Light read_light_object(const json& object, const std::string& label, const SetupContext& context) {
  Light light;
  light.type = light_type(object, label);
  const LightTypeInfo& type = light_type_info(light.type);
  refuse_unknown_of_type(object, type, label);
  if (object.contains("name") && object.at("name").is_string()) light.name = object.at("name").get<std::string>();
  if (type.has(kHasPosition)) {
    light.position =
        numbers(setup_vector(setup_member(object, "position", label), -kLargestFloat, label + ".position"));
  }
  if (type.has(kHasDirection)) {
    const glm::dvec3 v = setup_vector(setup_member(object, "direction", label), -kLargestFloat, label + ".direction");
    light.direction = numbers(setup_direction(v, label, "the direction is zero"));
  }
  if (type.has(kHasEdges)) read_edges(object, label, light);
  if (type.has(kHasRadius)) light.radius = static_cast<float>(positive(object, "radius", label));
  if (type.has(kHasCone)) read_cone(object, label, light);
  read_color(object, label, light);
  if (type.has(kSurrounds)) {
    read_environment_light(object, label, context, light);
  } else {
    read_strength(object, label, context.scene, light);
  }
  return light;
}

}  // namespace

std::vector<Light> read_setup_lights(const json& array, const SetupContext& context) {
  if (!array.is_array()) bad_input("lights: is not an array");
  if (array.size() > kMostLights) over_limit("lights: {} lights, the limit is {}", array.size(), kMostLights);
  std::vector<Light> lights;
  for (const json& value : array) {
    const std::string label = fmt::format("lights[{}]", lights.size());
    if (value.is_object()) {
      lights.push_back(read_light_object(value, label, context));
      continue;
    }
    Light light;
    light.position = numbers(setup_vector(value, -kLargestFloat, label));
    light.intensity = default_intensity(context.scene, light.position);
    lights.push_back(std::move(light));
  }
  return lights;
}

}  // namespace umbrix::io::detail
