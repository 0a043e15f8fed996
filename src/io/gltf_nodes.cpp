// SPDX-License-Identifier: Apache-2.0
// What nodes place: meshes, cameras, lights (glTF 2.0, section 3.5); and which of it moves.

#include <algorithm>
#include <limits>

#include "io/gltf_animations.h"
#include "io/gltf_convert.h"
#include "io/gltf_instancing.h"
#include "io/gltf_skins.h"
#include "io/load_error.h"
#include "io/node_hierarchy.h"
#include "io/node_motion.h"
#include "io/node_transform.h"
#include "io/scene_motion.h"

namespace umbrix::io::detail {
namespace {

// Placing costs memory per instance, and a small file can place much.
constexpr std::uint64_t kInstancesPerNodeLimit = 16;

class NodePlacer {
 public:
  NodePlacer(Conversion& conversion, const std::string& animation)
      : c_(conversion),
        model_(conversion.model),
        reader_(conversion.model, conversion.limits.decoded_bytes),
        hierarchy_(conversion),
        animations_(conversion, animation),
        shown_as_stored_(conversion.shapes.size(), 0),
        bytes_left_(conversion.limits.decoded_bytes) {}

  void run() {
    read_animations();
    place_all();
    bind_skins();
    own_meshes();
    // The shapes at rest, also of what does not move.
    SceneChanges changes;
    motion_.pose(c_.scene, std::nullopt, changes);
    keep_motion();
  }

 private:
  // A node that is placed, by its number, its place on the walk, where it is, and its name for messages.
  struct Placing {
    std::size_t node;
    std::size_t step;
    const glm::dmat4& to_world;
    std::string label;
  };

  const tinygltf::Skin* skin_of(std::size_t node) const {
    const int skin = model_.nodes[node].mesh >= 0 ? model_.nodes[node].skin : -1;
    return skin < 0 ? nullptr : &model_.skins[static_cast<std::size_t>(skin)];
  }

  bool shows_light(const tinygltf::Node& node) const {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    return extension != node.extensions.end() && extension->second.Has("light");
  }

  void read_animations() {
    std::vector<char> matters(model_.nodes.size(), 0);
    for (std::size_t s = 0; s < hierarchy_.walk().size(); ++s) {
      const NodeHierarchy::Step step = hierarchy_.walk()[s];
      if (!step.shown) continue;
      const tinygltf::Node& node = model_.nodes[step.node];
      if (node.mesh >= 0 || node.camera >= 0 || shows_light(node)) hierarchy_.mark_path(step.node, matters);
      if (const tinygltf::Skin* skin = skin_of(step.node)) {
        hierarchy_.include(skin->joints);
        for (const int joint : skin->joints) hierarchy_.mark_path(static_cast<std::size_t>(joint), matters);
      }
    }
    animations_.read(matters);
  }

  void place_all() {
    const std::vector<NodeHierarchy::Step>& walk = hierarchy_.walk();
    to_world_.reserve(walk.size());
    in_tree_.assign(walk.size(), -1);
    for (std::size_t s = 0; s < walk.size(); ++s) {
      const NodeHierarchy::Step& step = walk[s];
      const std::string label = label_of("nodes", step.node, model_.nodes[step.node].name);
      const glm::dmat4 local = local_transform(model_.nodes[step.node], label);
      to_world_.push_back(step.parent < 0 ? local : to_world_[static_cast<std::size_t>(step.parent)] * local);
      if (!is_finite(to_world_.back())) bad_input("{}: the transform is not finite", label);
      grow_tree(s, local);
      if (step.shown) place({step.node, s, to_world_.back(), label});
    }
  }

  // Adds a node that moves, by itself or with its parent.
  void grow_tree(std::size_t s, const glm::dmat4& local) {
    const NodeHierarchy::Step& step = hierarchy_.walk()[s];
    const std::shared_ptr<const NodeTracks> tracks = animations_.tracks(step.node);
    const std::int32_t parent = step.parent < 0 ? -1 : in_tree_[static_cast<std::size_t>(step.parent)];
    if (parent < 0 && !(tracks && tracks->moves())) return;
    add_to_tree(s, parent, local, tracks);
  }

  void add_to_tree(std::size_t s, std::int32_t parent, const glm::dmat4& rest,
                   std::shared_ptr<const NodeTracks> tracks) {
    const NodeHierarchy::Step& step = hierarchy_.walk()[s];
    NodeTree::Node node{parent, step.node, rest, std::move(tracks)};
    if (parent < 0) {
      node.parent = -1 - static_cast<std::int32_t>(tree_->bases.size());
      tree_->bases.push_back(step.parent < 0 || !node.tracks ? glm::dmat4(1)
                                                             : to_world_[static_cast<std::size_t>(step.parent)]);
    }
    in_tree_[s] = static_cast<std::int32_t>(tree_->nodes.size());
    tree_->nodes.push_back(std::move(node));
  }

  void place(const Placing& p) {
    const tinygltf::Node& node = model_.nodes[p.node];
    if (node.mesh >= 0) place_mesh(p);
    if (node.camera >= 0) place_camera(p);
    if (shows_light(node)) add_light(p);
  }

  void place_mesh(const Placing& p) {
    const tinygltf::Node& node = model_.nodes[p.node];
    const auto mesh = static_cast<std::size_t>(node.mesh);
    bool many = has_gpu_instances(node);
    if (many && skin_of(p.node)) {
      c_.ignored.add("EXT_mesh_gpu_instancing of skinned meshes", p.label);
      many = false;
    }
    std::vector<glm::dmat4> places;
    if (many) {
      const std::uint64_t count = gpu_instance_count(node, reader_, p.label);
      for (std::uint32_t m = c_.first_mesh[mesh]; m < c_.first_mesh[mesh + 1]; ++m) check_room(m, count, p.label);
      places = read_gpu_instances(node, reader_, p.label);
    }
    for (std::uint32_t m = c_.first_mesh[mesh]; m < c_.first_mesh[mesh + 1]; ++m) {
      place_primitive(p, m, many ? &places : nullptr);
    }
  }

  // Refuses what would be too much, before memory is asked for.
  void check_room(std::uint32_t mesh, std::uint64_t count, const std::string& label) const {
    const std::uint64_t triangles = c_.scene.meshes[mesh].triangles.size();
    if (count > (c_.limits.triangles - triangles_) / triangles) {
      over_limit("{}: more than {} triangles over all instances, which is the limit", label, c_.limits.triangles);
    }
    constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
    const std::uint64_t nodes = c_.limits.nodes;
    const std::uint64_t most = nodes > kLargest / kInstancesPerNodeLimit ? kLargest : nodes * kInstancesPerNodeLimit;
    if (count > most - c_.scene.instances.size()) over_limit("{}: more than {} instances", label, most);
  }

  // Once, or at places within the node.
  void place_primitive(const Placing& p, std::uint32_t mesh, const std::vector<glm::dmat4>* places) {
    const std::size_t count = places ? places->size() : 1;
    check_room(mesh, count, p.label);
    triangles_ += count * c_.scene.meshes[mesh].triangles.size();
    const bool has_shape = has_own_shape(p, mesh);
    const bool follows_joints = has_shape && skin_of(p.node) && c_.shapes[mesh]->influences > 0;
    if (skin_of(p.node) && !follows_joints) c_.ignored.add("skins of meshes without joints", p.label);
    const auto first = static_cast<std::uint32_t>(c_.scene.instances.size());
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dmat4 m = places ? p.to_world * (*places)[i] : p.to_world;
      if (!is_finite(m)) bad_input("{}: the transform of an instance is not finite", p.label);
      const auto number = static_cast<std::uint32_t>(c_.scene.instances.size());
      c_.scene.instances.push_back({model_.nodes[p.node].name, mesh, follows_joints ? kIdentity : to_transform(m)});
      if (in_tree_[p.step] < 0 || follows_joints) continue;
      motion_.instances.push_back({number, static_cast<std::uint32_t>(in_tree_[p.step]),
                                   places ? std::make_shared<glm::dmat4>((*places)[i]) : nullptr});
    }
    if (!has_shape) {
      shown_as_stored_[mesh] = 1;
    } else if (count > 0) {
      add_shape(p, mesh, first, follows_joints);
    }
  }

  const std::vector<double>& weights_at_rest(std::size_t number) const {
    const tinygltf::Node& node = model_.nodes[number];
    return node.weights.empty() ? model_.meshes[static_cast<std::size_t>(node.mesh)].weights : node.weights;
  }

  // Whether a mesh looks other at this node than it is stored.
  bool has_own_shape(const Placing& p, std::uint32_t mesh) const {
    const std::shared_ptr<const Shape>& shape = c_.shapes[mesh];
    const std::size_t targets = shape ? shape->targets.size() : 0;
    const std::vector<double>& weights = weights_at_rest(p.node);
    if (!weights.empty() && weights.size() != targets) {
      bad_input("{}: {} morph weights, a primitive of the mesh has {} targets", p.label, weights.size(), targets);
    }
    const std::shared_ptr<const NodeTracks> tracks = animations_.tracks(p.node);
    const bool animated = tracks && tracks->weights;
    if (animated && tracks->weights->count != targets) {
      bad_input("{}: the primitives of its mesh have different numbers of morph targets", p.label);
    }
    const bool carried = shape && skin_of(p.node) && shape->influences > 0;
    return carried || animated || std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0; });
  }

  void add_shape(const Placing& p, std::uint32_t mesh, std::uint32_t first_instance, bool follows_joints) {
    SceneMotion::MovedMesh moved;
    moved.mesh = mesh;
    moved.shape = c_.shapes[mesh];
    moved.weights = weights_at_rest(p.node);
    moved.weights.resize(moved.shape->targets.size(), 0);
    spend(moved.weights.size() * sizeof(double), mesh);
    for (auto i = first_instance; i < c_.scene.instances.size(); ++i) moved.instances.push_back(i);
    const std::shared_ptr<const NodeTracks> tracks = animations_.tracks(p.node);
    if (tracks && tracks->weights) moved.tracks = tracks;
    motion_.meshes.push_back(std::move(moved));
    bound_to_.push_back(follows_joints ? model_.nodes[p.node].skin : -1);
  }

  void spend(std::uint64_t bytes, std::uint32_t mesh) {
    if (bytes > bytes_left_) {
      over_limit("mesh '{}': its shapes need more memory than the limit", printable(c_.scene.meshes[mesh].name, 64));
    }
    bytes_left_ -= bytes;
  }

  void place_camera(const Placing& p) {
    const auto reference = static_cast<std::size_t>(model_.nodes[p.node].camera);
    const tinygltf::Camera& in = model_.cameras[reference];
    Camera camera = convert_camera(in, label_of("cameras", reference, in.name));
    if (camera.name.empty()) camera.name = model_.nodes[p.node].name;
    camera.to_world = camera_frame(p.to_world, p.label);
    if (in_tree_[p.step] >= 0) {
      camera.motion = std::make_shared<NodeMotion>(tree_, static_cast<std::size_t>(in_tree_[p.step]), p.label);
    }
    c_.scene.cameras.push_back(std::move(camera));
  }

  void add_light(const Placing& p) {
    const int reference = model_.nodes[p.node].extensions.at("KHR_lights_punctual").Get("light").GetNumberAsInt();
    if (reference < 0 || static_cast<std::size_t>(reference) >= model_.lights.size()) {
      bad_input("{}: light {} does not exist", p.label, reference);
    }
    const auto number = static_cast<std::size_t>(reference);
    const tinygltf::Light& in = model_.lights[number];
    Light light = convert_light(in, label_of("lights", number, in.name));
    if (light.name.empty()) light.name = model_.nodes[p.node].name;
    place_light(p.to_world, p.label, light);
    if (in_tree_[p.step] >= 0) {
      motion_.lights.push_back(
          {static_cast<std::uint32_t>(c_.scene.lights.size()), static_cast<std::uint32_t>(in_tree_[p.step]), p.label});
    }
    c_.scene.lights.push_back(std::move(light));
  }

  // Gives each mesh that follows joints its skin; meshes of one skin share it.
  void bind_skins() {
    std::vector<std::shared_ptr<const SceneMotion::Skin>> skins(model_.skins.size());
    for (std::size_t i = 0; i < motion_.meshes.size(); ++i) {
      if (bound_to_[i] < 0) continue;
      const auto number = static_cast<std::size_t>(bound_to_[i]);
      if (!skins[number]) skins[number] = make_skin(number);
      const Shape& shape = *motion_.meshes[i].shape;
      const std::size_t last = *std::max_element(shape.joints.begin(), shape.joints.end());
      if (last >= skins[number]->joints.size()) {
        bad_input("{}: has {} joints, a vertex of mesh '{}' asks for joint {}", skin_label(number),
                  skins[number]->joints.size(), printable(c_.scene.meshes[motion_.meshes[i].mesh].name, 64), last);
      }
      motion_.meshes[i].skin = skins[number];
    }
  }

  std::string skin_label(std::size_t number) const { return label_of("skins", number, model_.skins[number].name); }

  std::shared_ptr<const SceneMotion::Skin> make_skin(std::size_t number) {
    const auto skin = std::make_shared<SceneMotion::Skin>();
    skin->inverse_bind = read_inverse_bind(model_.skins[number], reader_, skin_label(number));
    for (const int joint : model_.skins[number].joints) {
      const auto step = static_cast<std::size_t>(hierarchy_.place(static_cast<std::size_t>(joint)));
      // A joint that stays: a tree of its own.
      if (in_tree_[step] < 0) add_to_tree(step, -1, to_world_[step], nullptr);
      skin->joints.push_back(static_cast<std::uint32_t>(in_tree_[step]));
    }
    return skin;
  }

  // A mesh that is shown in several shapes becomes several; the first may keep the place of the stored one.
  void own_meshes() {
    for (SceneMotion::MovedMesh& moved : motion_.meshes) {
      if (!shown_as_stored_[moved.mesh]) {
        shown_as_stored_[moved.mesh] = 1;
        continue;
      }
      const Mesh& stored = c_.scene.meshes[moved.mesh];
      spend(2 * stored.positions.size() * sizeof(Float3) + stored.tangents.size() * sizeof(Float4) +
                stored.triangles.size() * sizeof stored.triangles[0],
            moved.mesh);
      Mesh copy = stored;
      moved.mesh = static_cast<std::uint32_t>(c_.scene.meshes.size());
      for (const std::uint32_t instance : moved.instances) c_.scene.instances[instance].mesh = moved.mesh;
      c_.scene.meshes.push_back(std::move(copy));
    }
  }

  // Of all that was placed, what an animation moves.
  void keep_motion() {
    const auto stays = [&](const SceneMotion::MovedMesh& mesh) {
      const auto moves = [&](std::uint32_t joint) {
        const NodeTree::Node& node = tree_->nodes[joint];
        return node.tracks || node.parent >= 0;
      };
      return !mesh.tracks && !(mesh.skin && std::any_of(mesh.skin->joints.begin(), mesh.skin->joints.end(), moves));
    };
    motion_.meshes.erase(std::remove_if(motion_.meshes.begin(), motion_.meshes.end(), stays), motion_.meshes.end());
    if (motion_.instances.empty() && motion_.lights.empty() && motion_.meshes.empty()) return;
    c_.scene.motion = std::make_shared<SceneMotion>(std::move(motion_));
  }

  Conversion& c_;
  const tinygltf::Model& model_;
  AccessorReader reader_;
  NodeHierarchy hierarchy_;
  Animations animations_;
  std::shared_ptr<NodeTree> tree_ = std::make_shared<NodeTree>();
  std::vector<glm::dmat4> to_world_;   // by place on the walk
  std::vector<std::int32_t> in_tree_;  // the same; -1: not there
  SceneMotion motion_{tree_, {}, {}, {}};
  std::vector<int> bound_to_;          // the skin of each of motion_.meshes, or -1
  std::vector<char> shown_as_stored_;  // of the stored meshes
  std::uint64_t bytes_left_;           // of what shapes may need beside the stored meshes
  std::uint64_t triangles_ = 0;
};

}  // namespace

void convert_nodes(Conversion& conversion, const std::string& animation) { NodePlacer(conversion, animation).run(); }

}  // namespace umbrix::io::detail
