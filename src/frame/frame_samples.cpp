// SPDX-License-Identifier: Apache-2.0
#include "frame/frame_samples.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "index/select_learned.h"
#include "kernels/indexed.h"
#include "kernels/walk-inl.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kEvery = 16;

using HWY_NAMESPACE::Interval;
using HWY_NAMESPACE::WalkRay;

/// Marks the leaves that the ray crosses within the interval, the empty ones too.
void mark_leaves(const Tree& tree, std::uint32_t node_index, const WalkRay& ray, Interval at,
                 std::vector<bool>& marks) {
  const Node& node = tree.nodes[node_index];
  if (node.is_leaf()) {
    marks[node_index] = true;
    return;
  }
  const float t = HWY_NAMESPACE::plane_time(ray, node.plane(), node.axis_bits());
  const std::uint32_t near = node.low_child() + ray.far_low[node.axis_bits()];
  if (t > at.t0) mark_leaves(tree, near, ray, {at.t0, std::min(at.t1, t)}, marks);
  if (t < at.t1) mark_leaves(tree, near ^ 1u, ray, {std::max(at.t0, t), at.t1}, marks);
}

/// A value's bits, for an order that knows no equal but the same.
template <class T>
std::array<std::uint32_t, sizeof(T) / 4> words_of(const T& value) {
  static_assert(sizeof(T) % 4 == 0);
  std::array<std::uint32_t, sizeof(T) / 4> words;
  std::memcpy(words.data(), &value, sizeof value);
  return words;
}

}  // namespace

void FrameSamples::add(const ShadowTile& tile) noexcept try {
  for (std::size_t i = 0; i < tile.rays.count; i += kEvery)
    samples_.push_back({tile.rays[i], tile.skip ? tile.skip[i] : Primitive()});
} catch (const std::bad_alloc&) {
  // Fewer samples cost time only.
}

std::vector<bool> FrameSamples::touched_leaves(const Tree& tree) const {
  std::vector<bool> marks(tree.nodes.size());
  for (const Sample& sample : samples_) {
    const Ray& ray = sample.ray;
    WalkRay walk_ray;
    if (!is_valid(ray) || HWY_NAMESPACE::prepare(ray, tree, walk_ray) == HWY_NAMESPACE::Reach::far) continue;
    const Interval at = HWY_NAMESPACE::clip_to_root(walk_ray, tree);
    if (at.t0 <= at.t1) mark_leaves(tree, 0, walk_ray, at, marks);
  }
  return marks;
}

std::unique_ptr<PrimitiveIndex> FrameSamples::learned_index(const SceneView& scene, const Executor* executor) const {
  // Tiles came in any order: put the rays in one of their own.
  std::vector<Sample> sorted = samples_;
  std::sort(sorted.begin(), sorted.end(), [](const Sample& a, const Sample& b) { return words_of(a) < words_of(b); });
  std::vector<Primitive> skip;
  skip.reserve(sorted.size());
  for (const Sample& sample : sorted) skip.push_back(sample.skip);
  const RaySpan rays{&sorted.data()->ray, sorted.size(), sizeof(Sample)};
  std::vector<std::uint32_t> blockers;
  blockers.reserve(sorted.size());
  for (const Ending& ending : find_endings(scene, rays, skip.data(), executor)) blockers.push_back(ending.blocker);
  return std::make_unique<PrimitiveIndex>(*scene.tree, scene.triangles,
                                          select_learned(*scene.tree, {rays, blockers.data()}));
}

}  // namespace umbrix::detail
