// SPDX-License-Identifier: Apache-2.0
// Feltman, Lee & Fatahalian 2012, "SRDH: specializing BVH construction and traversal order using representative shadow
// ray sets". Built from the top; rays follow to the children whose boxes they meet, with those of their blockers that
// are there, and not to a child that they are stopped before.
#include "index/srdh.h"

#include <algorithm>
#include <iterator>

#include "core/parallel_for.h"
#include "index/srdh_split.h"
#include "tree/block.h"
#include "tree/clip.h"

namespace umbrix::detail {
namespace {

/// One block. Leaves of four would halve the tests of triangles, for more node tests and twice the memory.
constexpr std::uint32_t kLeafTriangles = 8;
/// Deeper, runs of triangles are halved: bins may take off one triangle at a time, and the builder is recursive.
constexpr std::uint32_t kMostSplits = 64;
constexpr std::ptrdiff_t kParallelTriangles = 8192;

struct LeafRun {
  const std::uint32_t* begin;
  std::uint32_t count;
};

/// A subtree, with its leaves in the order of its nodes.
struct Subtree {
  std::vector<SrdhNode> nodes;
  std::vector<LeafRun> leaves;
};

class Builder {
 public:
  Builder(const std::vector<Box>& boxes, float eps, const TrainingRays& training, const Executor* executor)
      : boxes_(boxes), eps_(eps), training_(training), executor_(executor) {}

  Subtree build(std::uint32_t* begin, std::uint32_t* end, const NodeRays& rays, std::uint32_t depth) const {
    Subtree result;
    if (end - begin <= kLeafTriangles) {
      result.nodes.push_back(node(begin, end, 1, 0));
      result.leaves.push_back({begin, static_cast<std::uint32_t>(end - begin)});
      return result;
    }
    SrdhSplit split;
    if (depth < kMostSplits) split = find_srdh_split(boxes_, begin, end, training_, rays);
    std::uint32_t* const middle =
        split.found
            ? std::partition(begin, end, [&](std::uint32_t id) { return split.bins.of(boxes_[id]) <= split.last_low; })
            : begin + (end - begin) / 2;
    NodeRays child_rays[2];
    if (split.found) hand_down(rays, split, box_of(begin, middle), box_of(middle, end), child_rays);
    Subtree children[2];
    const auto build_child = [&](std::size_t i) {
      children[i] =
          i == 0 ? build(begin, middle, child_rays[0], depth + 1) : build(middle, end, child_rays[1], depth + 1);
    };
    if (end - begin > kParallelTriangles) {
      parallel_for(executor_, 2, build_child);
    } else {
      build_child(0);
      build_child(1);
    }
    return joined(begin, end, children[split.high_first ? 1 : 0], children[split.high_first ? 0 : 1]);
  }

 private:
  Box box_of(const std::uint32_t* begin, const std::uint32_t* end) const {
    Box box;
    for (const std::uint32_t* id = begin; id != end; ++id) box.extend(boxes_[*id]);
    return box;
  }

  SrdhNode node(const std::uint32_t* begin, const std::uint32_t* end, std::size_t skip, std::uint32_t block) const {
    const Box box = grown(box_of(begin, end), eps_);
    SrdhNode result{};
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      result.faces[face_of(axis, false)] = box.lower[static_cast<int>(axis)];
      result.faces[face_of(axis, true)] = box.upper[static_cast<int>(axis)];
    }
    result.skip = static_cast<std::uint32_t>(skip);
    result.block = block;
    return result;
  }

  Subtree joined(const std::uint32_t* begin, const std::uint32_t* end, const Subtree& first,
                 const Subtree& second) const {
    Subtree result;
    const std::size_t size = 1 + first.nodes.size() + second.nodes.size();
    result.nodes.reserve(size);
    result.nodes.push_back(node(begin, end, size, SrdhNode::kInner));
    for (const Subtree* const child : {&first, &second}) {
      result.nodes.insert(result.nodes.end(), child->nodes.begin(), child->nodes.end());
      result.leaves.insert(result.leaves.end(), child->leaves.begin(), child->leaves.end());
    }
    return result;
  }

  /// Gives the low and the high child their rays.
  void hand_down(const NodeRays& rays, const SrdhSplit& split, const Box& low, const Box& high,
                 NodeRays (&children)[2]) const {
    const Box* const boxes[2] = {&low, &high};
    for (const std::uint32_t ray : rays.open)
      for (const std::size_t side : {std::size_t{0}, std::size_t{1}})
        if (training_.rays[ray].meets(*boxes[side])) children[side].open.push_back(ray);
    for (const NodeRays::Blocked& blocked : rays.blocked) {
      const std::size_t first = split.high_first ? 1 : 0;
      for (const std::size_t side : {first, 1 - first}) {
        NodeRays& child = children[side];
        const auto begin = static_cast<std::uint32_t>(child.blockers.size());
        std::copy_if(&rays.blockers[blocked.first], &rays.blockers[blocked.first] + blocked.count,
                     std::back_inserter(child.blockers),
                     [&](std::uint32_t id) { return (split.bins.of(boxes_[id]) <= split.last_low) == (side == 0); });
        const std::uint32_t count = static_cast<std::uint32_t>(child.blockers.size()) - begin;
        if (count > 0) {
          child.blocked.push_back({blocked.ray, begin, count});
          break;
        }
        if (training_.rays[blocked.ray].meets(*boxes[side])) child.open.push_back(blocked.ray);
      }
    }
  }

  const std::vector<Box>& boxes_;
  float eps_;
  const TrainingRays& training_;
  const Executor* executor_;
};

NodeRays all_rays(const TrainingRays& training) {
  NodeRays result;
  result.blockers = training.blockers;
  for (std::uint32_t i = 0; i < training.rays.size(); ++i) {
    const TrainingRay& ray = training.rays[i];
    if (ray.blocker_count == 0) {
      result.open.push_back(i);
    } else {
      result.blocked.push_back({i, ray.first_blocker, ray.blocker_count});
    }
  }
  return result;
}

}  // namespace

Srdh::Srdh(const std::vector<Triangle>& scaled, std::vector<std::uint32_t> kept, float eps,
           const TrainingRays& training, const Executor* executor) {
  std::vector<Box> boxes(scaled.size());
  for (const std::uint32_t id : kept)
    for (const Vec3& v : scaled[id].v) boxes[id].extend(v);
  const Builder builder(boxes, eps, training, executor);
  Subtree all = builder.build(kept.data(), kept.data() + kept.size(), all_rays(training), 0);
  nodes_ = std::move(all.nodes);
  blocks_.resize(all.leaves.size());
  const auto triangle_of = [&scaled](std::uint32_t id) -> const Triangle& { return scaled[id]; };
  std::uint32_t leaf = 0;
  for (SrdhNode& node : nodes_) {
    if (!node.is_leaf()) continue;
    const DVec3 extent(node.faces[3] - node.faces[0], node.faces[4] - node.faces[1], node.faces[5] - node.faces[2]);
    const double diagonal = glm::length(extent) + 8 * static_cast<double>(eps);
    pack_block(all.leaves[leaf].begin, all.leaves[leaf].count, triangle_of, static_cast<float>(diagonal),
               blocks_[leaf]);
    node.block = leaf++;
  }
}

}  // namespace umbrix::detail
