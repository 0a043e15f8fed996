// SPDX-License-Identifier: Apache-2.0
#include "io/node_tracks.h"

#include <algorithm>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// Keys are at floats. A frame's time, rounded as an exporter would have, is that of its key, so that a camera that
// jumps at a frame has jumped in that frame and not in the next.
double at_key(const std::vector<double>& times, double seconds) {
  const double rounded = static_cast<float>(seconds);
  return std::binary_search(times.begin(), times.end(), rounded) ? rounded : seconds;
}

template <class V>
void set(V& value, const std::optional<KeyTrack<V>>& track, double seconds) {
  if (track) value = track->at(at_key(*track->times, seconds));
}

template <class V>
void widen_by(const std::optional<KeyTrack<V>>& track, KeySpan& span) {
  if (track) span.add(track->times->front(), track->times->back());
}

void require_finite(const glm::dmat4& m, std::uint32_t number) {
  if (!is_finite(m)) bad_input("nodes[{}]: the transform is not finite", number);
}

}  // namespace

void KeySpan::add(double first, double last) { span_ = {std::min(span_[0], first), std::max(span_[1], last)}; }

glm::dmat4 NodeTracks::matrix_at(double seconds) const {
  Pose pose = rest;
  set(pose.translation, translation, seconds);
  set(pose.rotation, rotation, seconds);
  set(pose.scale, scale, seconds);
  return to_matrix(pose, label);
}

std::vector<double> NodeTracks::weights_at(double seconds) const {
  const double time = at_key(*weights->times, seconds);
  std::vector<double> out(weights->count);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = weights->at(time, i);
  return out;
}

void NodeTracks::widen(KeySpan& span) const {
  widen_by(translation, span);
  widen_by(rotation, span);
  widen_by(scale, span);
  widen_by(weights, span);
}

glm::dmat4 NodeTree::local(const Node& node, std::optional<double> seconds) const {
  return seconds && node.tracks && node.tracks->moves() ? node.tracks->matrix_at(*seconds) : node.rest;
}

glm::dmat4 NodeTree::to_world(std::size_t node, std::optional<double> seconds) const {
  std::vector<const Node*> path = {&nodes[node]};
  while (path.back()->parent >= 0) path.push_back(&nodes[static_cast<std::size_t>(path.back()->parent)]);
  glm::dmat4 m = base(*path.back());
  for (auto n = path.rbegin(); n != path.rend(); ++n) m = m * local(**n, seconds);
  require_finite(m, nodes[node].number);
  return m;
}

std::vector<glm::dmat4> NodeTree::all_to_world(std::optional<double> seconds) const {
  std::vector<glm::dmat4> out;
  out.reserve(nodes.size());
  for (const Node& node : nodes) {
    const glm::dmat4& parent = node.parent < 0 ? base(node) : out[static_cast<std::size_t>(node.parent)];
    out.push_back(parent * local(node, seconds));
    require_finite(out.back(), node.number);
  }
  return out;
}

}  // namespace umbrix::io::detail
