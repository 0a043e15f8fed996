// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, binary form. A part is one interleaved vertex view and one index view. Quantized meshes store coordinates
// in grid steps; their nodes scale them back (KHR_mesh_quantization), exactly, since the step is a power of two.
#include "glb.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "numbers.h"

namespace umbrix::scenes {
namespace {

using Json = nlohmann::ordered_json;
using glm::dvec3;

// Component types and targets of glTF 2.0, section 5.1.3 and 5.11.5.
constexpr int kByte = 5120, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;

Json numbers(const dvec3& v) { return {v.x, v.y, v.z}; }

/// Numbers, little-endian whatever the machine is.
class Bytes {
 public:
  template <typename T>
  void put(T value) {
    static_assert(sizeof(T) <= 4);
    std::uint32_t bits = 0;
    if constexpr (std::is_floating_point_v<T>) {
      std::memcpy(&bits, &value, sizeof bits);
    } else {
      bits = static_cast<std::uint32_t>(value);
    }
    for (std::size_t i = 0; i < sizeof(T); ++i) text_.push_back(static_cast<char>(bits >> (8 * i)));
  }
  void put(const std::string& text) { text_ += text; }
  /// Fills up to a multiple of four bytes.
  void align(char with) { text_.append((4 - text_.size() % 4) % 4, with); }
  std::size_t size() const { return text_.size(); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

bool fits_quantized(const Mesh& mesh) {
  for (const Part& part : mesh.parts) {
    for (const dvec3& p : part.shape.positions) {
      const dvec3 steps = glm::abs(p) / kGrid;
      if (std::max({steps.x, steps.y, steps.z}) > 32767) return false;
    }
  }
  return true;
}

class Writer {
 public:
  explicit Writer(const Scene& scene) : scene_(scene) {
    for (const Mesh& mesh : scene.meshes) quantized_.push_back(scene.quantized && fits_quantized(mesh));
  }

  std::string write() {
    Json extensions{"KHR_lights_punctual"};
    const bool quantized = std::find(quantized_.begin(), quantized_.end(), true) != quantized_.end();
    if (quantized) extensions.push_back("KHR_mesh_quantization");
    json_ = {{"asset", {{"version", "2.0"}, {"generator", "umbrix_scenes"}}}, {"extensionsUsed", extensions}};
    if (quantized) json_["extensionsRequired"] = {"KHR_mesh_quantization"};
    add_materials();
    for (std::size_t i = 0; i < scene_.meshes.size(); ++i) add_mesh(scene_.meshes[i], quantized_[i]);
    add_nodes();
    json_["buffers"] = {{{"byteLength", buffer_.size()}}};
    return chunks();
  }

 private:
  void add_materials() {
    for (const Material& m : scene_.materials) {
      Json json{{"name", m.name},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {m.color.r, m.color.g, m.color.b, 1}},
                  {"metallicFactor", m.metallic},
                  {"roughnessFactor", m.roughness}}}};
      if (m.emission != dvec3(0)) json["emissiveFactor"] = numbers(m.emission);
      if (m.double_sided) json["doubleSided"] = true;
      json_["materials"].push_back(json);
    }
  }

  std::size_t add_view(std::size_t begin, int target, std::size_t stride) {
    Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", buffer_.size() - begin}};
    if (stride != 0) view["byteStride"] = stride;
    view["target"] = target;
    json_["bufferViews"].push_back(view);
    return json_["bufferViews"].size() - 1;
  }

  std::size_t add_accessor(const Json& accessor) {
    json_["accessors"].push_back(accessor);
    return json_["accessors"].size() - 1;
  }

  void put_position(const dvec3& p, bool quantized) {
    for (int axis = 0; axis < 3; ++axis) {
      if (quantized) {
        buffer_.put(static_cast<std::int16_t>(p[axis] / kGrid));
      } else {
        buffer_.put(static_cast<float>(p[axis]));
      }
    }
    buffer_.align(0);
  }

  void put_normal(const dvec3& n, bool quantized) {
    for (int axis = 0; axis < 3; ++axis) {
      if (quantized) {
        buffer_.put(static_cast<std::int8_t>(std::floor(n[axis] * 127 + 0.5)));
      } else {
        buffer_.put(static_cast<float>(snapped(n[axis], 1.0 / 1024)));
      }
    }
    buffer_.align(0);
  }

  Json add_vertices(const Shape& shape, bool quantized) {
    const std::size_t begin = buffer_.size();
    const std::vector<dvec3> shading = shape.smooth ? normals(shape) : std::vector<dvec3>{};
    dvec3 low(shape.positions.front()), high = low;
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
      low = glm::min(low, shape.positions[i]);
      high = glm::max(high, shape.positions[i]);
      put_position(shape.positions[i], quantized);
      if (shape.smooth) put_normal(shading[i], quantized);
    }
    const std::size_t position_bytes = quantized ? 8 : 12;
    const std::size_t view = add_view(begin, kArrayBuffer, (buffer_.size() - begin) / shape.positions.size());
    const double step = quantized ? kGrid : 1;
    Json attributes{{"POSITION", add_accessor({{"bufferView", view},
                                               {"componentType", quantized ? kShort : kFloat},
                                               {"count", shape.positions.size()},
                                               {"type", "VEC3"},
                                               {"min", numbers(low / step)},
                                               {"max", numbers(high / step)}})}};
    if (shape.smooth) {
      Json accessor{{"bufferView", view},
                    {"byteOffset", position_bytes},
                    {"componentType", quantized ? kByte : kFloat},
                    {"count", shape.positions.size()},
                    {"type", "VEC3"}};
      if (quantized) accessor["normalized"] = true;
      attributes["NORMAL"] = add_accessor(accessor);
    }
    return attributes;
  }

  std::size_t add_indices(const Shape& shape) {
    // 65535 itself is reserved (primitive restart).
    const bool narrow = shape.positions.size() <= 65535;
    const std::size_t begin = buffer_.size();
    for (const glm::uvec3& t : shape.triangles) {
      for (int corner = 0; corner < 3; ++corner) {
        if (narrow) {
          buffer_.put(static_cast<std::uint16_t>(t[corner]));
        } else {
          buffer_.put(t[corner]);
        }
      }
    }
    const std::size_t view = add_view(begin, kElementArrayBuffer, 0);
    buffer_.align(0);
    return add_accessor({{"bufferView", view},
                         {"componentType", narrow ? kUnsignedShort : kUnsignedInt},
                         {"count", 3 * shape.triangles.size()},
                         {"type", "SCALAR"}});
  }

  void add_mesh(const Mesh& mesh, bool quantized) {
    Json primitives = Json::array();
    for (const Part& part : mesh.parts) {
      const Json attributes = add_vertices(part.shape, quantized);
      primitives.push_back(
          {{"attributes", attributes}, {"indices", add_indices(part.shape)}, {"material", part.material}});
    }
    json_["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
  }

  static Json decimals(const dvec3& v, double units) {
    return {rounded(v.x, units), rounded(v.y, units), rounded(v.z, units)};
  }

  static void put_rotation(Json& node, const glm::dquat& q) {
    if (q.w == 1) return;
    node["rotation"] = decimals({q.x, q.y, q.z}, 1e5);
    node["rotation"].push_back(rounded(q.w, 1e5));
  }

  /// A node at `position` whose -z axis points to `target`.
  static Json looking(const std::string& name, const dvec3& position, const dvec3& target) {
    Json node{{"name", name}, {"translation", decimals(position, 1e4)}};
    const dvec3 along = glm::normalize(target - position);
    const bool steep = along.y * along.y > 0.99;
    put_rotation(node, glm::quatLookAt(along, steep ? dvec3(0, 0, 1) : dvec3(0, 1, 0)));
    return node;
  }

  void add_nodes() {
    Json nodes = Json::array(), lights = Json::array(), roots = Json::array();
    for (const Node& n : scene_.nodes) {
      Json node{{"mesh", n.mesh}};
      if (n.position != dvec3(0)) node["translation"] = decimals(n.position, 1e4);
      put_rotation(node, n.rotation);
      const dvec3 scale = quantized_[n.mesh] ? n.scale * kGrid : n.scale;
      const bool exact = glm::fract(n.scale) == dvec3(0);
      if (scale != dvec3(1)) node["scale"] = exact ? numbers(scale) : decimals(scale, 1e8);
      nodes.push_back(node);
    }
    for (const Light& l : scene_.lights) {
      Json light{{"name", l.name}, {"type", ""}, {"color", numbers(l.color)}, {"intensity", l.intensity}};
      light["type"] = l.type == LightType::point ? "point" : l.type == LightType::spot ? "spot" : "directional";
      if (l.type == LightType::spot) {
        light["spot"] = {{"innerConeAngle", l.inner_cone_angle}, {"outerConeAngle", l.outer_cone_angle}};
      }
      Json node = l.type == LightType::point ? Json{{"name", l.name}, {"translation", decimals(l.position, 1e4)}}
                                             : looking(l.name, l.position, l.target);
      node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      lights.push_back(light);
      nodes.push_back(node);
    }
    nodes.push_back(looking("camera", scene_.camera.eye, scene_.camera.target));
    nodes.back()["camera"] = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) roots.push_back(i);
    json_["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", scene_.camera.yfov}, {"znear", 0.05}}}}};
    json_["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    json_["nodes"] = nodes;
    json_["scenes"] = {{{"name", scene_.name}, {"nodes", roots}}};
    json_["scene"] = 0;
  }

  std::string chunks() {
    Bytes json;
    json.put(json_.dump());
    json.align(' ');
    buffer_.align(0);
    Bytes file;
    file.put(std::string("glTF"));
    file.put(std::uint32_t{2});
    file.put(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer_.size()));
    file.put(static_cast<std::uint32_t>(json.size()));
    file.put(std::string("JSON"));
    file.put(json.text());
    file.put(static_cast<std::uint32_t>(buffer_.size()));
    file.put(std::string("BIN\0", 4));
    file.put(buffer_.text());
    return file.text();
  }

  const Scene& scene_;
  std::vector<bool> quantized_;  ///< one a mesh
  Json json_;
  Bytes buffer_;
};

}  // namespace

TriangleCounts count_triangles(const Scene& scene) {
  std::vector<std::uint64_t> by_mesh;
  TriangleCounts counts;
  for (const Mesh& mesh : scene.meshes) {
    std::uint64_t triangles = 0;
    for (const Part& part : mesh.parts) triangles += part.shape.triangles.size();
    by_mesh.push_back(triangles);
    counts.stored += triangles;
  }
  for (const Node& node : scene.nodes) counts.flattened += by_mesh[node.mesh];
  return counts;
}

std::string glb(const Scene& scene) { return Writer(scene).write(); }

}  // namespace umbrix::scenes
