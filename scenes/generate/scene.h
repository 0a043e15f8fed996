// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/ext/quaternion_double.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shape.h"

/// What a generated file holds, and the scenes we have.
namespace umbrix::scenes {

/// glTF's metallic-roughness material; colours are linear Rec.709.
struct Material {
  std::string name;
  glm::dvec3 color{0.8, 0.8, 0.8};
  double roughness = 0.9;
  double metallic = 0;
  glm::dvec3 emission{0, 0, 0};
  bool double_sided = false;
};

/// Triangles of one material, all smooth or all flat.
struct Part {
  std::uint32_t material;
  Shape shape;
};

struct Mesh {
  std::string name;
  std::vector<Part> parts;

  /// Adds a shape, its vertices moved to the grid. Throws std::logic_error if a triangle has no area there.
  void add(std::uint32_t material, const Shape& shape);
};

/// A mesh placed in the world.
struct Node {
  std::uint32_t mesh;
  glm::dvec3 position{0, 0, 0};
  glm::dquat rotation{1, 0, 0, 0};
  glm::dvec3 scale{1, 1, 1};
};

enum class LightType { point, spot, directional };

struct Light {
  std::string name;
  LightType type;
  glm::dvec3 color;
  double intensity;  ///< candela, or lux if directional
  glm::dvec3 position;
  glm::dvec3 target{0, 0, 0};  ///< for spots and directional lights
  double inner_cone_angle = 0.3;
  double outer_cone_angle = 0.6;  ///< radians, for spots
};

struct Camera {
  glm::dvec3 eye;
  glm::dvec3 target;
  double yfov;  ///< radians
};

struct Scene {
  std::string name;
  bool quantized = false;  ///< store positions as 16-bit integers (KHR_mesh_quantization) where they fit
  Camera camera;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Node> nodes;
  std::vector<Light> lights;

  std::uint32_t add(Material material);
  std::uint32_t add(Mesh mesh);
  /// Adds the mesh and one instance of it.
  void place(Mesh mesh, const glm::dvec3& position = {0, 0, 0}, double turns_around_y = 0);
  /// Adds an instance.
  void place(std::uint32_t mesh, const glm::dvec3& position, double turns_around_y = 0,
             const glm::dvec3& scale = {1, 1, 1});
};

/// Rotation around an axis of unit length.
glm::dquat rotation(const glm::dvec3& axis, double turns);

/// A backdrop of emissive bands, bright at the horizon: the part of a cylinder around the y axis between two angles
/// (in turns, counterclockwise from +x seen from above), seen from inside.
Mesh sky(Scene& scene, double radius, double height, double first_turn, double last_turn);

Scene atrium();
Scene bedroom();
Scene conference();
Scene cornell();
Scene forest();

}  // namespace umbrix::scenes
