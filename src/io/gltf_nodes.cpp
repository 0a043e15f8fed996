// SPDX-License-Identifier: Apache-2.0
// The node hierarchy (glTF 2.0, section 3.5), walked with a stack of our own: files may nest deeper than the machine's.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "io/gltf_convert.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// Placing costs memory per instance, and a small file can place much.
constexpr std::uint64_t kInstancesPerNodeLimit = 16;

std::string node_label(const tinygltf::Model& model, std::size_t node) {
  return label_of("nodes", node, model.nodes[node].name);
}

bool is_finite(const glm::dmat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!std::isfinite(m[c][r])) return false;
    }
  }
  return true;
}

glm::dmat4 from_matrix(const std::vector<double>& values, const std::string& label) {
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];  // both are column-major
  constexpr double kSlack = 1e-6;
  if (std::abs(m[0][3]) > kSlack || std::abs(m[1][3]) > kSlack || std::abs(m[2][3]) > kSlack ||
      std::abs(m[3][3] - 1) > kSlack) {
    bad_input("{}: the matrix is not affine; its last row must be 0 0 0 1", label);
  }
  m[0][3] = m[1][3] = m[2][3] = 0;
  m[3][3] = 1;
  return m;
}

glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& label) {
  if (node.matrix.size() == 16) return from_matrix(node.matrix, label);
  glm::dmat4 m(1);
  if (node.rotation.size() == 4) {
    const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(q);
    if (!(length > 0) || !std::isfinite(length)) bad_input("{}: the rotation is not a quaternion of length 1", label);
    m = glm::mat4_cast(q / length);
  }
  if (node.scale.size() == 3) {
    for (int c = 0; c < 3; ++c) m[c] *= node.scale[static_cast<std::size_t>(c)];
  }
  if (node.translation.size() == 3) {
    m[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  }
  return m;
}

Transform to_transform(const glm::dmat4& m) {
  Transform out;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 4; ++c) out[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = m[c][r];
  }
  return out;
}

glm::dvec3 direction(const glm::dvec3& v, const char* what, const std::string& label) {
  const double longest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(longest > 0)) bad_input("{}: the transform leaves the {} no direction", label, what);
  return glm::normalize(v / longest);  // scaled first: squares of very large or small scales do not fit
}

// A camera's frame without its scale and shear: the view axis stays, "up" is made normal to it.
Transform camera_frame(const glm::dmat4& m, const std::string& label) {
  const glm::dvec3 z = direction(m[2], "camera", label);
  const glm::dvec3 y = direction(m[1], "camera", label);
  const glm::dvec3 x = direction(glm::cross(y, z), "camera", label);
  return to_transform(glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0), m[3]));
}

class NodeWalk {
 public:
  explicit NodeWalk(Conversion& conversion) : c_(conversion), model_(conversion.model) {}

  void run() {
    if (model_.nodes.size() > c_.limits.nodes) {
      over_limit("{} nodes, the limit is {}", model_.nodes.size(), c_.limits.nodes);
    }
    find_parents();
    refuse_cycles();
    const std::vector<int> roots = scene_roots();
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
      stack_.push_back({static_cast<std::size_t>(*root), glm::dmat4(1), 0});
    }
    while (!stack_.empty()) {
      const Pending next = stack_.back();
      stack_.pop_back();
      visit(next);
    }
  }

 private:
  struct Pending {
    std::size_t node;
    glm::dmat4 parent_to_world;
    std::uint32_t depth;
  };

  void find_parents() {
    parent_.assign(model_.nodes.size(), -1);
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      for (const int child : model_.nodes[n].children) {
        int& parent = parent_[static_cast<std::size_t>(child)];
        if (parent >= 0) {
          bad_input("{}: is the child of two nodes, {} and {}", node_label(model_, static_cast<std::size_t>(child)),
                    parent, n);
        }
        parent = static_cast<int>(n);
      }
    }
  }

  // With one parent each, a node is on or below a cycle exactly if going up never ends.
  void refuse_cycles() const {
    enum : char { kUnknown, kOnPath, kGood };
    std::vector<char> state(model_.nodes.size(), kUnknown);
    std::vector<std::size_t> path;
    for (std::size_t start = 0; start < model_.nodes.size(); ++start) {
      path.clear();
      for (int n = static_cast<int>(start); n >= 0; n = parent_[static_cast<std::size_t>(n)]) {
        char& s = state[static_cast<std::size_t>(n)];
        if (s == kOnPath) bad_input("{}: is its own ancestor", node_label(model_, static_cast<std::size_t>(n)));
        if (s == kGood) break;
        s = kOnPath;
        path.push_back(static_cast<std::size_t>(n));
      }
      for (const std::size_t n : path) state[n] = kGood;
    }
  }

  std::vector<int> scene_roots() const {
    std::vector<int> roots;
    if (model_.scenes.empty()) {
      for (std::size_t n = 0; n < parent_.size(); ++n) {
        if (parent_[n] < 0) roots.push_back(static_cast<int>(n));
      }
      return roots;
    }
    const int number = model_.defaultScene >= 0 ? model_.defaultScene : 0;
    roots = model_.scenes[static_cast<std::size_t>(number)].nodes;
    std::vector<char> listed(model_.nodes.size(), 0);
    for (const int root : roots) {
      const auto n = static_cast<std::size_t>(root);
      if (parent_[n] >= 0)
        bad_input("{}: is a root of scenes[{}] and a child of node {}", node_label(model_, n), number, parent_[n]);
      if (listed[n]) bad_input("{}: is listed twice in scenes[{}]", node_label(model_, n), number);
      listed[n] = 1;
    }
    return roots;
  }

  void visit(const Pending& next) {
    const tinygltf::Node& node = model_.nodes[next.node];
    const std::string label = node_label(model_, next.node);
    if (next.depth > c_.limits.node_depth) over_limit("{}: nested deeper than {} nodes", label, c_.limits.node_depth);
    const glm::dmat4 to_world = next.parent_to_world * local_transform(node, label);
    if (!is_finite(to_world)) bad_input("{}: the transform is not finite", label);
    if (node.mesh >= 0) place_mesh(node, to_world, label);
    if (node.camera >= 0) place_camera(node, to_world, label);
    place_light(node, to_world, label);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      stack_.push_back({static_cast<std::size_t>(*child), to_world, next.depth + 1});
    }
  }

  void place_mesh(const tinygltf::Node& node, const glm::dmat4& to_world, const std::string& label) {
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const std::uint64_t most = c_.limits.nodes * kInstancesPerNodeLimit;
    for (std::uint32_t m = c_.first_mesh[mesh]; m < c_.first_mesh[mesh + 1]; ++m) {
      triangles_ += c_.scene.meshes[m].triangles.size();
      if (triangles_ > c_.limits.triangles) {
        over_limit("{}: more than {} triangles over all instances, which is the limit", label, c_.limits.triangles);
      }
      if (c_.scene.instances.size() >= most) over_limit("{}: more than {} instances", label, most);
      c_.scene.instances.push_back({node.name, m, to_transform(to_world)});
    }
  }

  void place_camera(const tinygltf::Node& node, const glm::dmat4& to_world, const std::string& label) {
    const auto number = static_cast<std::size_t>(node.camera);
    const tinygltf::Camera& in = model_.cameras[number];
    Camera camera = convert_camera(in, label_of("cameras", number, in.name));
    if (camera.name.empty()) camera.name = node.name;
    camera.to_world = camera_frame(to_world, label);
    c_.scene.cameras.push_back(std::move(camera));
  }

  void place_light(const tinygltf::Node& node, const glm::dmat4& to_world, const std::string& label) {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.Has("light")) return;
    const int reference = extension->second.Get("light").GetNumberAsInt();
    if (reference < 0 || static_cast<std::size_t>(reference) >= model_.lights.size()) {
      bad_input("{}: light {} does not exist", label, reference);
    }
    const auto number = static_cast<std::size_t>(reference);
    const tinygltf::Light& in = model_.lights[number];
    Light light = convert_light(in, label_of("lights", number, in.name));
    if (light.name.empty()) light.name = node.name;
    light.position = {to_world[3].x, to_world[3].y, to_world[3].z};
    if (light_type_info(light.type).has_direction) {
      const glm::dvec3 d = direction(-glm::dvec3(to_world[2]), "light", label);
      light.direction = {d.x, d.y, d.z};
    }
    c_.scene.lights.push_back(std::move(light));
  }

  Conversion& c_;
  const tinygltf::Model& model_;
  std::vector<int> parent_;
  std::vector<Pending> stack_;
  std::uint64_t triangles_ = 0;
};

}  // namespace

void convert_nodes(Conversion& conversion) { NodeWalk(conversion).run(); }

}  // namespace umbrix::io::detail
