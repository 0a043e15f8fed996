// SPDX-License-Identifier: Apache-2.0
// Animated cameras (glTF 2.0, section 3.11 and appendix C). Only what moves a camera is read and checked.

#include "io/gltf_animations.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "io/camera_motion.h"
#include "io/key_track.h"
#include "io/load_error.h"
#include "io/node_transform.h"

namespace umbrix::io::detail {

/// A node that one animation moves.
struct MovingNode {
  std::string label;
  Pose rest;
  std::optional<KeyTrack<glm::dvec3>> translation, scale;
  std::optional<KeyTrack<glm::dquat>> rotation;
};

namespace {

// All keys of a file that are read: days of a camera with a key for each frame, and no more than a small file costs.
constexpr std::uint64_t kMostKeyBytes = 1u << 25;
// Cameras below each other share nodes that move, but each lists its way; a small file could list much.
constexpr std::size_t kMostPathNodes = 1u << 20;

bool moves_nodes(const std::string& path) { return path == "translation" || path == "rotation" || path == "scale"; }

// Keys are at floats. A frame's time, rounded as an exporter would have, is that of its key, so that a camera that
// jumps at a frame has jumped in that frame and not in the next.
double at_key(const std::vector<double>& times, double seconds) {
  const double rounded = static_cast<float>(seconds);
  return std::binary_search(times.begin(), times.end(), rounded) ? rounded : seconds;
}

template <class V>
void set(V& value, const std::optional<KeyTrack<V>>& track, double seconds) {
  if (track) value = track->at(at_key(track->times, seconds));
}

glm::dmat4 matrix_at(const MovingNode& node, double seconds) {
  Pose pose = node.rest;
  set(pose.translation, node.translation, seconds);
  set(pose.rotation, node.rotation, seconds);
  set(pose.scale, node.scale, seconds);
  return to_matrix(pose, node.label);
}

template <class V>
void widen(std::array<double, 2>& span, const std::optional<KeyTrack<V>>& track) {
  if (!track) return;
  span = {std::min(span[0], track->times.front()), std::max(span[1], track->times.back())};
}

// A node on the way to a camera.
struct PathNode {
  glm::dmat4 rest = glm::dmat4(1);
  std::shared_ptr<const MovingNode> moving;  // null: stays at rest
};

class NodeMotion final : public CameraMotion {
 public:
  NodeMotion(std::vector<PathNode> path, std::string label) : path_(std::move(path)), label_(std::move(label)) {}

  // Multiplied in the order of the walk at rest, so that a node that is moved to its place at rest changes no bit.
  void move(const Moment& moment, Camera& camera) const override {
    glm::dmat4 to_world(1);
    for (const PathNode& node : path_) {
      to_world = to_world * (node.moving ? matrix_at(*node.moving, moment.seconds) : node.rest);
    }
    if (!is_finite(to_world)) bad_input("{}: the transform is not finite", label_);
    camera.to_world = camera_frame(to_world, label_);
  }

  std::array<double, 2> span() const override {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::array<double, 2> span = {kInfinity, -kInfinity};
    for (const PathNode& node : path_) {
      if (!node.moving) continue;
      widen(span, node.moving->translation);
      widen(span, node.moving->rotation);
      widen(span, node.moving->scale);
    }
    return span;
  }

 private:
  std::vector<PathNode> path_;
  std::string label_;
};

Interpolation interpolation_of(const tinygltf::AnimationSampler& sampler, const std::string& label) {
  if (sampler.interpolation == "LINEAR") return Interpolation::linear;
  if (sampler.interpolation == "STEP") return Interpolation::step;
  if (sampler.interpolation == "CUBICSPLINE") return Interpolation::cubic_spline;
  bad_input("{}: interpolation '{}' is none of LINEAR, STEP, CUBICSPLINE", label, printable(sampler.interpolation, 32));
}

std::vector<double> checked_times(const std::vector<float>& seconds, const std::string& label) {
  if (seconds.empty()) bad_input("{}: has no keys", label);
  std::vector<double> times;
  for (const float time : seconds) {
    if (!std::isfinite(time)) bad_input("{}: the time of key {} is not finite", label, times.size());
    if (!times.empty() && !(time > times.back())) {
      bad_input("{}: the time of key {} is {}, must be above the one before, {}", label, times.size(), time,
                times.back());
    }
    times.push_back(time);
  }
  return times;
}

glm::dvec3 converted(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
glm::dquat converted(const std::array<float, 4>& q) { return glm::dquat(q[3], q[0], q[1], q[2]); }

template <class V, std::size_t N>
KeyTrack<V> make_track(Interpolation interpolation, std::vector<double> times,
                       const std::vector<std::array<float, N>>& values, const std::string& label) {
  const std::size_t wanted = times.size() * (interpolation == Interpolation::cubic_spline ? 3 : 1);
  if (values.size() != wanted) {
    bad_input("{}: {} keys need {} output values, there are {}", label, times.size(), wanted, values.size());
  }
  KeyTrack<V> track{interpolation, std::move(times), {}};
  for (const std::array<float, N>& value : values) {
    for (const float number : value) {
      if (!std::isfinite(number)) bad_input("{}: output value {} is not finite", label, track.values.size());
    }
    track.values.push_back(converted(value));
  }
  return track;
}

// Between two keys an arc needs unit length; a spline is made so afterwards (glTF 2.0, appendix C.4).
void normalize_rotations(KeyTrack<glm::dquat>& track, const std::string& label) {
  const bool cubic = track.interpolation == Interpolation::cubic_spline;
  for (std::size_t i = cubic ? 1 : 0; i < track.values.size(); i += cubic ? 3 : 1) {
    const double length = glm::length(track.values[i]);
    if (!(length > 0)) bad_input("{}: output value {} is not a rotation", label, i);
    if (!cubic) track.values[i] /= length;
  }
}

}  // namespace

CameraAnimations::CameraAnimations(Conversion& conversion, const std::vector<int>& parent)
    : c_(conversion),
      parent_(parent),
      reader_(conversion.model, kMostKeyBytes),
      cargo_(conversion.model.nodes.size(), 0) {
  std::size_t number = 0;
  for (const tinygltf::Animation& animation : c_.model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.target_node < 0 || !moves_nodes(channel.target_path)) continue;
      std::vector<std::size_t>& list = animations_of_[static_cast<std::size_t>(channel.target_node)];
      if (list.empty() || list.back() != number) list.push_back(number);
    }
    ++number;
  }
}

void CameraAnimations::carry(std::size_t node, Cargo cargo) {
  for (auto n = static_cast<int>(node); n >= 0; n = parent_[static_cast<std::size_t>(n)]) {
    unsigned char& all = cargo_[static_cast<std::size_t>(n)];
    if (all & cargo) return;
    all = static_cast<unsigned char>(all | cargo);
  }
}

std::vector<std::size_t> CameraAnimations::path_to(std::size_t node) const {
  std::vector<std::size_t> path;
  for (auto n = static_cast<int>(node); n >= 0; n = parent_[static_cast<std::size_t>(n)]) {
    path.push_back(static_cast<std::size_t>(n));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

int CameraAnimations::first_animation(const std::vector<std::size_t>& path) const {
  int first = -1;
  for (const std::size_t node : path) {
    const auto found = animations_of_.find(node);
    if (found == animations_of_.end()) continue;
    const auto number = static_cast<int>(found->second.front());
    if (first < 0 || number < first) first = number;
  }
  return first;
}

std::shared_ptr<const CameraMotion> CameraAnimations::motion(std::size_t node) {
  carry(node, kCamera);
  if (animations_of_.empty()) return nullptr;
  const std::vector<std::size_t> path = path_to(node);
  const int animation = first_animation(path);
  if (animation < 0) return nullptr;
  path_nodes_ += path.size();
  if (path_nodes_ > kMostPathNodes) over_limit("more than {} nodes lead to animated cameras", kMostPathNodes);
  const auto label_at = [&](std::size_t n) { return label_of("nodes", n, c_.model.nodes[n].name); };
  std::vector<PathNode> nodes;
  for (const std::size_t n : path) {
    PathNode next;
    next.moving = moving(static_cast<std::size_t>(animation), n);
    if (!next.moving) next.rest = local_transform(c_.model.nodes[n], label_at(n));
    nodes.push_back(std::move(next));
  }
  return std::make_shared<NodeMotion>(std::move(nodes), label_at(node));
}

// Null if the animation leaves the node at rest. Cameras that share nodes share what was read of them.
std::shared_ptr<const MovingNode> CameraAnimations::moving(std::size_t number, std::size_t node) {
  const auto animated = animations_of_.find(node);
  if (animated == animations_of_.end()) return nullptr;
  const std::vector<std::size_t>& list = animated->second;
  if (!std::binary_search(list.begin(), list.end(), number)) return nullptr;
  std::shared_ptr<const MovingNode>& known = moving_[{number, node}];
  if (known) return known;
  const tinygltf::Node& in = c_.model.nodes[node];
  const auto made = std::make_shared<MovingNode>();
  made->label = label_of("nodes", node, in.name);
  if (!in.matrix.empty()) bad_input("{}: is animated, but has a matrix", made->label);
  made->rest = pose_of(in);
  const tinygltf::Animation& animation = c_.model.animations[number];
  const std::string label = label_of("animations", number, animation.name);
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    if (channel.target_node == static_cast<int>(node)) read_channel(animation, channel, label, *made);
  }
  known = made;
  return known;
}

void CameraAnimations::read_channel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                                    const std::string& label, MovingNode& node) {
  if (!moves_nodes(channel.target_path)) return;
  if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
    bad_input("{}: sampler {} does not exist", label, channel.sampler);
  }
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  const std::string where = fmt::format("{}.samplers[{}]", label, channel.sampler);
  const Interpolation interpolation = interpolation_of(sampler, where);
  std::vector<double> times = checked_times(reader_.times(sampler.input), where);
  if (channel.target_path == "rotation") {
    if (node.rotation) bad_input("{}: the rotation of {} is animated twice", label, node.label);
    node.rotation = make_track<glm::dquat>(interpolation, std::move(times), reader_.rotations(sampler.output), where);
    normalize_rotations(*node.rotation, where);
    return;
  }
  auto& track = channel.target_path == "scale" ? node.scale : node.translation;
  if (track) bad_input("{}: the {} of {} is animated twice", label, channel.target_path, node.label);
  track =
      make_track<glm::dvec3>(interpolation, std::move(times), reader_.vectors(sampler.output, AccessorUse::key), where);
}

void CameraAnimations::note_ignored() {
  std::size_t number = 0;
  for (const tinygltf::Animation& animation : c_.model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) note_channel(number, channel);
    ++number;
  }
}

void CameraAnimations::note_channel(std::size_t number, const tinygltf::AnimationChannel& channel) {
  const auto note = [&](const char* kind) {
    c_.ignored.add(kind, label_of("animations", number, c_.model.animations[number].name));
  };
  if (channel.target_path == "weights") return note("animated morph targets (the meshes' own shape is used)");
  if (channel.target_node < 0 || !moves_nodes(channel.target_path)) return note("animated properties of other kinds");
  const auto node = static_cast<std::size_t>(channel.target_node);
  const unsigned char cargo = cargo_[node];
  if (cargo & kMesh) note("animations of meshes (they stay at rest)");
  if (cargo & kLight) note("animations of lights (they stay at rest)");
  if (cargo & kCamera && moving_.count({number, node}) == 0) note("animations of a camera after its first");
  if (cargo == 0) note("animations of nodes that show nothing");
}

}  // namespace umbrix::io::detail
