// SPDX-License-Identifier: Apache-2.0
// The node hierarchy (glTF 2.0, section 3.5), walked with a stack of our own: files may nest deeper than the machine's.

#include <limits>

#include "io/gltf_animations.h"
#include "io/gltf_convert.h"
#include "io/load_error.h"
#include "io/node_transform.h"

namespace umbrix::io::detail {
namespace {

// Placing costs memory per instance, and a small file can place much.
constexpr std::uint64_t kInstancesPerNodeLimit = 16;

std::string node_label(const tinygltf::Model& model, std::size_t node) {
  return label_of("nodes", node, model.nodes[node].name);
}

class NodeWalk {
 public:
  explicit NodeWalk(Conversion& conversion)
      : c_(conversion), model_(conversion.model), animations_(conversion, parent_) {}

  void run() {
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
    animations_.note_ignored();
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
    if (node.mesh >= 0) place_mesh(next.node, to_world, label);
    if (node.camera >= 0) place_camera(next.node, to_world, label);
    place_light(next.node, to_world, label);
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
      stack_.push_back({static_cast<std::size_t>(*child), to_world, next.depth + 1});
    }
  }

  void place_mesh(std::size_t number, const glm::dmat4& to_world, const std::string& label) {
    const tinygltf::Node& node = model_.nodes[number];
    animations_.mesh_at(number);
    const auto mesh = static_cast<std::size_t>(node.mesh);
    constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t nodes = c_.limits.nodes;
    const std::uint64_t most = nodes > kLargest / kInstancesPerNodeLimit ? kLargest : nodes * kInstancesPerNodeLimit;
    for (std::uint32_t m = c_.first_mesh[mesh]; m < c_.first_mesh[mesh + 1]; ++m) {
      triangles_ += c_.scene.meshes[m].triangles.size();
      if (triangles_ > c_.limits.triangles) {
        over_limit("{}: more than {} triangles over all instances, which is the limit", label, c_.limits.triangles);
      }
      if (c_.scene.instances.size() >= most) over_limit("{}: more than {} instances", label, most);
      c_.scene.instances.push_back({node.name, m, to_transform(to_world)});
    }
  }

  void place_camera(std::size_t number, const glm::dmat4& to_world, const std::string& label) {
    const tinygltf::Node& node = model_.nodes[number];
    const auto reference = static_cast<std::size_t>(node.camera);
    const tinygltf::Camera& in = model_.cameras[reference];
    Camera camera = convert_camera(in, label_of("cameras", reference, in.name));
    if (camera.name.empty()) camera.name = node.name;
    camera.to_world = camera_frame(to_world, label);
    camera.motion = animations_.motion(number);
    c_.scene.cameras.push_back(std::move(camera));
  }

  void place_light(std::size_t node_number, const glm::dmat4& to_world, const std::string& label) {
    const tinygltf::Node& node = model_.nodes[node_number];
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.Has("light")) return;
    const int reference = extension->second.Get("light").GetNumberAsInt();
    if (reference < 0 || static_cast<std::size_t>(reference) >= model_.lights.size()) {
      bad_input("{}: light {} does not exist", label, reference);
    }
    animations_.light_at(node_number);
    const auto number = static_cast<std::size_t>(reference);
    const tinygltf::Light& in = model_.lights[number];
    Light light = convert_light(in, label_of("lights", number, in.name));
    if (light.name.empty()) light.name = node.name;
    light.position = {to_world[3].x, to_world[3].y, to_world[3].z};
    if (light_type_info(light.type).has(kHasDirection)) {
      const glm::dvec3 d = direction(-glm::dvec3(to_world[2]), "light", label);
      light.direction = {d.x, d.y, d.z};
    }
    c_.scene.lights.push_back(std::move(light));
  }

  Conversion& c_;
  const tinygltf::Model& model_;
  std::vector<int> parent_;
  CameraAnimations animations_;
  std::vector<Pending> stack_;
  std::uint64_t triangles_ = 0;
};

}  // namespace

void convert_nodes(Conversion& conversion) { NodeWalk(conversion).run(); }

}  // namespace umbrix::io::detail
