// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/gltf_text.h"

namespace umbrix::features {

using nlohmann::json;

/// Bytes by file name.
using Files = std::map<std::string, std::string>;

/// What base colour and emission look like in any light.
json unlit(double r, double g, double b);
json glow(double r, double g, double b);
/// White that spreads light and mirrors none, so that a facing surface is as bright as its irradiance over pi.
json lambert(double r = 1, double g = 1, double b = 1);

/// A scene under construction. It is seen straight on from +z, by a camera that shows [0, width] x [0, height]; what it
/// shows are unit squares at z = 0.
struct Stage : io::testing::Gltf {
  Stage(int width, int height);

  int material(const nlohmann::json& material);
  /// A primitive that is the unit square, facing +z, with `more` members and attributes.
  nlohmann::json square(int material, const nlohmann::json& attributes = nlohmann::json::object());
  /// Places a mesh of this one primitive.
  int place(const nlohmann::json& primitive, double x, double y = 0, double z = 0);
  /// The unit square, placed.
  int show(const nlohmann::json& material, double x, double y = 0, double z = 0);

  /// An attribute of floats, `components` each.
  int floats(const std::vector<float>& values, int components);
  /// Says what the values of an accessor lie between.
  void bound(int accessor, const nlohmann::json& lower, const nlohmann::json& upper);
  /// An attribute of normalized integers.
  template <class T>
  int normalized(const std::vector<T>& values, int component_type, int components) {
    const int number = integers(values, component_type, components);
    json["accessors"][static_cast<std::size_t>(number)]["normalized"] = true;
    return number;
  }
  template <class T>
  int integers(const std::vector<T>& values, int component_type, int components) {
    const auto each = static_cast<std::size_t>(components);
    return accessor(io::testing::bytes_of(values), component_type, values.size() / each, type_of(components));
  }

  /// Texture coordinates of the unit square from (0, 0) in its upper left corner to (u, v) in its lower right one.
  int texcoords(float u = 1, float v = 1);
  /// A texture of pixels in a PNG, in a buffer view, that is read without blending.
  int texture(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
              const std::vector<std::uint8_t>& pixels, const nlohmann::json& sampler = {{"magFilter", 9728}});

  /// As Gltf's, with bounds.
  void animate(std::size_t animation, int node, const std::string& path, const std::vector<float>& times,
               const std::vector<float>& values, const std::string& interpolation = "LINEAR");

  int light(const nlohmann::json& light, const nlohmann::json& node = nlohmann::json::object());
  /// A directional light along -z that makes white as bright as 1.
  void light_straight_on();
  /// The same from the direction (0.48, 0.6, 0.64).
  void slanted_light();

  void use(const std::string& extension, bool required = false);

  /// The file's text, indented, short values in a line.
  std::string readable() const;

 private:
  static const char* type_of(int components);
  void note_extensions(const nlohmann::json& value);

  int square_positions_ = -1, square_indices_ = -1;
};

void add_geometry(Files& files);
void add_placement(Files& files);
void add_materials(Files& files);
void add_textures(Files& files);
void add_alpha(Files& files);
void add_views(Files& files);
void add_animations(Files& files);
void add_shapes(Files& files);
void add_compressed(Files& files);

}  // namespace umbrix::features
