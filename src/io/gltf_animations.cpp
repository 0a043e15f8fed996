// SPDX-License-Identifier: Apache-2.0
// Animations (glTF 2.0, section 3.11 and appendix C). Only what moves something that is shown is read and checked.

#include "io/gltf_animations.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// All keys of a file that are read: hours of a character with a key for each frame, and no more than a large mesh.
constexpr std::uint64_t kMostKeyBytes = 1u << 28;

bool moves_nodes(const std::string& path) { return path == "translation" || path == "rotation" || path == "scale"; }

bool is_read(const tinygltf::AnimationChannel& channel) {
  return channel.target_node >= 0 && (moves_nodes(channel.target_path) || channel.target_path == "weights");
}

std::string label_of_animation(const tinygltf::Model& model, std::size_t number) {
  return label_of("animations", number, model.animations[number].name);
}

Interpolation interpolation_of(const tinygltf::AnimationSampler& sampler, const std::string& label) {
  if (sampler.interpolation == "LINEAR") return Interpolation::linear;
  if (sampler.interpolation == "STEP") return Interpolation::step;
  if (sampler.interpolation == "CUBICSPLINE") return Interpolation::cubic_spline;
  bad_input("{}: interpolation '{}' is none of LINEAR, STEP, CUBICSPLINE", label, printable(sampler.interpolation, 32));
}

double converted(const std::array<float, 1>& v) { return v[0]; }
glm::dvec3 converted(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }
glm::dquat converted(const std::array<float, 4>& q) { return glm::dquat(q[3], q[0], q[1], q[2]); }

// Between two keys an arc needs unit length; a spline is made so afterwards (glTF 2.0, appendix C.4).
void normalize_rotations(KeyTrack<glm::dquat>& track, const std::string& label) {
  const bool cubic = track.interpolation == Interpolation::cubic_spline;
  for (std::size_t i = cubic ? 1 : 0; i < track.values.size(); i += cubic ? 3 : 1) {
    const double length = glm::length(track.values[i]);
    if (!(length > 0)) bad_input("{}: output value {} is not a rotation", label, i);
    if (!cubic) track.values[i] /= length;
  }
}

// The number of the animation that a user names.
std::size_t find_animation(const tinygltf::Model& model, const std::string& wanted) {
  std::string names;
  for (std::size_t i = 0; i < model.animations.size(); ++i) {
    if (model.animations[i].name == wanted) return i;
    if (i < 16) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", printable(model.animations[i].name, 64));
  }
  std::size_t number = 0;
  const char* end = wanted.data() + wanted.size();
  const auto [stop, error] = std::from_chars(wanted.data(), end, number);
  if (error == std::errc() && stop == end && number < model.animations.size()) return number;
  throw LoadError{StatusCode::invalid_argument,
                  fmt::format("there is no animation '{}'; {}", printable(wanted, 64),
                              names.empty() ? "the file has none" : "the file has " + names)};
}

std::uint64_t key_byte_limit(const LoadLimits& limits) {
  return limits.decoded_bytes > 0 ? std::min(limits.decoded_bytes, kMostKeyBytes) : kMostKeyBytes;
}

}  // namespace

Animations::Animations(Conversion& conversion, const std::string& wanted)
    : c_(conversion),
      reader_(conversion.model, key_byte_limit(conversion.limits)),
      played_(conversion.model.animations.size(), 0) {
  choose(wanted);
}

void Animations::choose(const std::string& wanted) {
  if (!wanted.empty()) {
    played_[find_animation(c_.model, wanted)] = 1;
    return;
  }
  std::set<std::pair<int, std::string>> moved;
  for (std::size_t a = 0; a < played_.size(); ++a) {
    const std::vector<Channel>& channels = c_.model.animations[a].channels;
    const auto target = [](const Channel& channel) { return std::pair(channel.target_node, channel.target_path); };
    played_[a] = std::none_of(channels.begin(), channels.end(), [&](const Channel& channel) {
      return is_read(channel) && moved.count(target(channel)) > 0;
    });
    if (!played_[a]) continue;
    for (const Channel& channel : channels) {
      if (is_read(channel)) moved.insert(target(channel));
    }
  }
}

void Animations::read(const std::vector<char>& matters) {
  for (std::size_t a = 0; a < played_.size(); ++a) {
    const auto note = [&](const char* kind) { c_.ignored.add(kind, label_of_animation(c_.model, a)); };
    if (!played_[a]) {
      note("animations that are not played (an earlier one moves the same nodes, or another was chosen)");
      continue;
    }
    for (const Channel& channel : c_.model.animations[a].channels) {
      if (!is_read(channel)) {
        note("animated properties of other kinds");
      } else if (!matters[static_cast<std::size_t>(channel.target_node)]) {
        note("animations of nodes that show nothing");
      } else if (channel.target_path == "weights" &&
                 morph_targets(static_cast<std::size_t>(channel.target_node)) == 0) {
        note("animated weights of meshes without morph targets");
      } else {
        read_channel(a, channel);
      }
    }
  }
}

std::shared_ptr<const NodeTracks> Animations::tracks(std::size_t node) const {
  const auto found = tracks_.find(node);
  return found == tracks_.end() ? nullptr : found->second;
}

std::size_t Animations::morph_targets(std::size_t node) const {
  const int mesh = c_.model.nodes[node].mesh;
  if (mesh < 0) return 0;
  const auto& primitives = c_.model.meshes[static_cast<std::size_t>(mesh)].primitives;
  return primitives.empty() ? 0 : primitives.front().targets.size();
}

KeyTimes Animations::times(int accessor, const std::string& label) {
  KeyTimes& known = times_[accessor];
  if (known) return known;
  std::vector<double> out;
  for (const auto& [time] : reader_.values<1>(accessor, AccessorUse::key)) {
    if (!std::isfinite(time)) bad_input("{}: the time of key {} is not finite", label, out.size());
    if (!out.empty() && !(time > out.back())) {
      bad_input("{}: the time of key {} is {}, must be above the one before, {}", label, out.size(), time, out.back());
    }
    out.push_back(time);
  }
  if (out.empty()) bad_input("{}: has no keys", label);
  return known = std::make_shared<std::vector<double>>(std::move(out));
}

template <class V, std::size_t N>
KeyTrack<V> Animations::track(std::size_t number, const Channel& channel, std::size_t count, AccessorUse use) {
  const tinygltf::Animation& animation = c_.model.animations[number];
  const std::string label = label_of_animation(c_.model, number);
  if (channel.sampler < 0 || static_cast<std::size_t>(channel.sampler) >= animation.samplers.size()) {
    bad_input("{}: sampler {} does not exist", label, channel.sampler);
  }
  const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
  const std::string where = fmt::format("{}.samplers[{}]", label, channel.sampler);
  KeyTrack<V> track{interpolation_of(sampler, where), times(sampler.input, where), {}, count};
  const std::vector<std::array<float, N>> values = reader_.values<N>(sampler.output, use);
  const std::size_t rows = track.times->size() * (track.interpolation == Interpolation::cubic_spline ? 3 : 1);
  if (values.size() / count != rows || values.size() % count != 0) {
    bad_input("{}: {} keys need {} output values, there are {}", where, track.times->size(), rows * count,
              values.size());
  }
  track.values.reserve(values.size());
  for (const std::array<float, N>& value : values) {
    for (const float component : value) {
      if (!std::isfinite(component)) bad_input("{}: output value {} is not finite", where, track.values.size());
    }
    track.values.push_back(converted(value));
  }
  if constexpr (N == 4) normalize_rotations(track, where);
  return track;
}

void Animations::read_channel(std::size_t number, const Channel& channel) {
  const auto target = static_cast<std::size_t>(channel.target_node);
  const tinygltf::Node& in = c_.model.nodes[target];
  std::shared_ptr<NodeTracks>& known = tracks_[target];
  if (!known) {
    known = std::make_shared<NodeTracks>();
    known->label = label_of("nodes", target, in.name);
    known->rest = pose_of(in);
  }
  NodeTracks& node = *known;
  const auto set = [&](auto& track, auto read) {
    if (track) {
      bad_input("{}: the {} of {} is animated twice", label_of_animation(c_.model, number), channel.target_path,
                node.label);
    }
    track = read();
  };
  if (channel.target_path == "weights") {
    const std::size_t count = morph_targets(target);
    return set(node.weights, [&] { return track<double, 1>(number, channel, count, AccessorUse::morph_weight); });
  }
  if (!in.matrix.empty()) bad_input("{}: is animated, but has a matrix", node.label);
  if (channel.target_path == "rotation") {
    return set(node.rotation, [&] { return track<glm::dquat, 4>(number, channel, 1, AccessorUse::rotation); });
  }
  set(channel.target_path == "scale" ? node.scale : node.translation,
      [&] { return track<glm::dvec3, 3>(number, channel, 1, AccessorUse::key); });
}

}  // namespace umbrix::io::detail
