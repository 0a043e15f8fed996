// SPDX-License-Identifier: Apache-2.0
#include "stage.h"

#include <algorithm>

#include "io/picture_bytes.h"

namespace umbrix::features {
namespace {

using io::testing::bytes_of;

/// What fits a line stays in one.
std::string indented(const json& value, std::size_t depth) {
  constexpr std::size_t kLine = 110;
  const std::string flat = value.dump();
  if (!value.is_structured() || value.empty() || flat.size() + 2 * depth <= kLine) return flat;
  const std::string margin(2 * depth + 2, ' ');
  std::string out;
  for (const auto& item : value.items()) {
    out += (out.empty() ? "\n" : ",\n") + margin;
    if (value.is_object()) out += json(item.key()).dump() + ": ";
    out += indented(item.value(), depth + 1);
  }
  const std::string end = "\n" + std::string(2 * depth, ' ');
  return value.is_object() ? "{" + out + end + "}" : "[" + out + end + "]";
}

void add_once(json& list, const std::string& name) {
  if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

}  // namespace

json unlit(double r, double g, double b) {
  return {{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}}},
          {"extensions", {{"KHR_materials_unlit", json::object()}}}};
}

json lambert(double r, double g, double b) {
  return {{"pbrMetallicRoughness", {{"baseColorFactor", {r, g, b, 1}}, {"metallicFactor", 0}}},
          {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0}}}}}};
}

json glow(double r, double g, double b) {
  json out = lambert(0, 0, 0);
  out["emissiveFactor"] = {r, g, b};
  return out;
}

Stage::Stage(int width, int height) {
  json["cameras"] = {{{"type", "orthographic"},
                      {"orthographic", {{"xmag", width / 2.0}, {"ymag", height / 2.0}, {"znear", 0}, {"zfar", 100}}}}};
  json["scene"] = 0;
  root({{"camera", 0}, {"translation", {width / 2.0, height / 2.0, 10}}});
}

const char* Stage::type_of(int components) {
  static const char* const kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return kTypes[components - 1];
}

int Stage::floats(const std::vector<float>& values, int components) {
  const int number = integers(values, 5126, components);
  // glTF asks for bounds of positions and of the times of keys.
  if (components != 1 && components != 3) return number;
  std::vector<float> lower(values.begin(), values.begin() + components), upper = lower;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t c = i % lower.size();
    lower[c] = std::min(lower[c], values[i]);
    upper[c] = std::max(upper[c], values[i]);
  }
  bound(number, lower, upper);
  return number;
}

void Stage::bound(int accessor, const nlohmann::json& lower, const nlohmann::json& upper) {
  json["accessors"][static_cast<std::size_t>(accessor)].update({{"min", lower}, {"max", upper}});
}

void Stage::use(const std::string& extension, bool required) {
  add_once(json["extensionsUsed"], extension);
  if (required) add_once(json["extensionsRequired"], extension);
}

void Stage::note_extensions(const nlohmann::json& value) {
  if (!value.is_structured()) return;
  for (const auto& item : value.items()) {
    if (value.is_object() && item.key() == "extensions") {
      for (const auto& extension : item.value().items()) use(extension.key());
    }
    note_extensions(item.value());
  }
}

int Stage::material(const nlohmann::json& material) {
  note_extensions(material);
  json["materials"].push_back(material);
  return static_cast<int>(json["materials"].size()) - 1;
}

nlohmann::json Stage::square(int material, const nlohmann::json& attributes) {
  if (square_positions_ < 0) {
    square_positions_ = floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
    square_indices_ = integers(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, 5123, 1);
  }
  nlohmann::json out = {{"attributes", attributes}, {"indices", square_indices_}, {"material", material}};
  if (!attributes.contains("POSITION")) out["attributes"]["POSITION"] = square_positions_;
  return out;
}

int Stage::place(const nlohmann::json& primitive, double x, double y, double z) {
  nlohmann::json node = {{"mesh", mesh(primitive)}};
  if (x != 0 || y != 0 || z != 0) node["translation"] = {x, y, z};
  return root(node);
}

int Stage::show(const nlohmann::json& material_in, double x, double y, double z) {
  return place(square(material(material_in)), x, y, z);
}

int Stage::texcoords(float u, float v) { return floats({0, v, u, v, u, 0, 0, 0}, 2); }

int Stage::texture(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                   const std::vector<std::uint8_t>& pixels, const nlohmann::json& sampler) {
  const int bytes = view(io::testing::png_bytes(width, height, channels, pixels));
  json["images"].push_back({{"bufferView", bytes}, {"mimeType", "image/png"}});
  json["samplers"].push_back(sampler);
  json["textures"].push_back({{"source", json["images"].size() - 1}, {"sampler", json["samplers"].size() - 1}});
  return static_cast<int>(json["textures"].size()) - 1;
}

void Stage::animate(std::size_t animation, int node, const std::string& path, const std::vector<float>& times,
                    const std::vector<float>& values, const std::string& interpolation) {
  Gltf::animate(animation, node, path, times, values, interpolation);
  bound(json["animations"][animation]["samplers"].back()["input"], nlohmann::json::array({times.front()}),
        nlohmann::json::array({times.back()}));
}

int Stage::light(const nlohmann::json& light, const nlohmann::json& node) {
  use("KHR_lights_punctual");
  nlohmann::json& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back(light);
  nlohmann::json holder = node;
  holder["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  return root(holder);
}

void Stage::light_straight_on() { light({{"type", "directional"}, {"intensity", 3.14159265}}); }

void Stage::slanted_light() {
  light({{"type", "directional"}, {"intensity", 3.14159265}},
        {{"matrix", {0.8, 0, -0.6, 0, -0.36, 0.8, -0.48, 0, 0.48, 0.6, 0.64, 0, 0, 0, 5, 1}}});
}

std::string Stage::readable() const { return indented(nlohmann::json::parse(text()), 0) + "\n"; }

}  // namespace umbrix::features
