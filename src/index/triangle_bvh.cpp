// SPDX-License-Identifier: Apache-2.0
// Built from the top by binned surface areas: the upper part by all threads together, the parts below side by side.
// The result does not depend on the threads.
#include "index/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/float_mode.h"
#include "core/parallel_for.h"
#include "index/bvh_cutter.h"
#include "tree/clip.h"
#include "tree/scale.h"

namespace umbrix::detail {
namespace {

/// Deeper ranges are halved: so there is a deepest leaf, however the triangles lie.
constexpr std::uint32_t kMostCutDepth = 36;
static_assert(kMaxBvhDepth > kMostCutDepth + 27, "2^29 triangles");

/// Threads that wait for each other at every cut lose more than threads that have nothing left to do.
constexpr std::size_t kSmallestPart = 2 * BvhCutter::kChunk;

bool is_leaf(const BvhRange& range) { return range.size() <= kRowLanes; }

/// A child that is to be made.
struct Pending {
  std::uint32_t node, lane, depth;
  BvhRange range;
};

/// Some of the hierarchy, with places of its own. Leaves are named by their places in `leaves`.
struct Part {
  struct Leaf {
    std::uint32_t first, count;  ///< references
    float reach;
  };
  std::vector<BvhNode> nodes;
  std::vector<Leaf> leaves;
};

/// In double, where the normal of a triangle that is not much thinner than 2^-20 has an error of 2^-30: so the float
/// has no other than that of its own rounding.
Vec3 unit_normal(const Triangle& t) {
  const DVec3 a = t.v[0], b = DVec3(t.v[1]) - a, c = DVec3(t.v[2]) - a;
  const DVec3 n = glm::cross(b, c);
  const double length = glm::length(n);
  if (!(length > 0x1p-20 * glm::length(b) * glm::length(c)) || !(length > 0x1p-200)) return Vec3(0);
  return Vec3(n / length);
}

float longest_edge(const Triangle& t) {
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    const DVec3 edge = DVec3(t.v[(i + 1) % 3]) - DVec3(t.v[i]);
    square = std::max(square, glm::dot(edge, edge));
  }
  return static_cast<float>(std::sqrt(square)) * (1 + 0x1p-20f);
}

class Builder {
 public:
  Builder(BvhReference* references, std::size_t count, float eps, const Executor* executor)
      : cutter_(references),
        scratch_(count > BvhCutter::kChunk ? count : 0, Fill::nothing),
        eps_(eps),
        executor_(executor) {}

  /// All below a range; what is not larger than `most` is left to others.
  void build(const Pending& root, std::size_t most, Part& out, std::vector<Pending>& left) {
    std::vector<Pending> todo{root};
    todo.back().node = add_node(out);
    while (!todo.empty()) {
      const Pending at = todo.back();
      todo.pop_back();
      BvhRange parts[kBvhWidth] = {at.range};
      const std::uint32_t count = cut(parts, at.depth, most);
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        const Box box = box_of(parts[lane].bounds);
        set_box(box, lane, out.nodes[at.node]);
        if (is_leaf(parts[lane])) {
          out.nodes[at.node].child[lane] = static_cast<std::uint32_t>(out.leaves.size()) | BvhNode::kLeaf;
          out.leaves.push_back({static_cast<std::uint32_t>(parts[lane].first),
                                static_cast<std::uint32_t>(parts[lane].size()), diagonal(box)});
        } else if (parts[lane].size() <= most) {
          left.push_back({at.node, lane, at.depth + 1, parts[lane]});
        } else {
          const std::uint32_t child = add_node(out);
          out.nodes[at.node].child[lane] = child;
          todo.push_back({child, 0, at.depth + 1, parts[lane]});
        }
      }
    }
  }

 private:
  static std::uint32_t add_node(Part& part) {
    BvhNode& node = part.nodes.emplace_back();
    for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
      set_box(Box(), lane, node);
      node.child[lane] = BvhNode::kLeaf;
    }
    return static_cast<std::uint32_t>(part.nodes.size() - 1);
  }

  Box box_of(const BvhBounds& bounds) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = bounds.lower[axis];
      box.upper[axis] = -bounds.minus_upper[axis];
    }
    return eps_ > 0 ? grown(box, eps_) : box;
  }

  static void set_box(const Box& box, std::uint32_t lane, BvhNode& node) {
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][lane] = box.lower[axis];
      node.upper[axis][lane] = box.upper[axis];
    }
  }

  /// With room for walks, which place a ray in the box by float times.
  float diagonal(const Box& box) const {
    const DVec3 extent = DVec3(box.upper) - DVec3(box.lower);
    return static_cast<float>((glm::length(extent) + 4 * static_cast<double>(eps_)) * (1 + 0x1p-18));
  }

  /// Cuts the largest part again until there are as many as a node has children.
  std::uint32_t cut(BvhRange (&parts)[kBvhWidth], std::uint32_t depth, std::size_t most) {
    std::uint32_t count = 1;
    for (; count < kBvhWidth; ++count) {
      std::uint32_t widest = count;
      for (std::uint32_t i = 0; i < count; ++i)
        if (!is_leaf(parts[i]) && (widest == count || parts[i].bounds.area() > parts[widest].bounds.area())) widest = i;
      if (widest == count) break;
      const BvhRange whole = parts[widest];
      if (depth >= kMostCutDepth)
        cutter_.halve(whole, parts[widest], parts[count]);
      else if (most > 0 && whole.size() > most)
        cutter_.cut(whole, parts[widest], parts[count], &scratch_[0], executor_);
      else
        cutter_.cut(whole, parts[widest], parts[count]);
    }
    return count;
  }

  BvhCutter cutter_;
  LazyArray<BvhReference> scratch_;
  float eps_;
  const Executor* executor_;
};

/// Triangles in the tree's units: as scaled() makes them, in float where a product is rounded once as well.
class Scaler {
 public:
  explicit Scaler(int exponent)
      : exponent_(exponent),
        is_float_(exponent >= -126 && exponent <= 127),
        factor_(is_float_ ? std::ldexp(1.0f, exponent) : 0) {}

  Triangle operator()(const Triangle& t) const {
    if (!is_float_) return scaled(t, exponent_);
    return {{t.v[0] * factor_, t.v[1] * factor_, t.v[2] * factor_}};
  }

 private:
  int exponent_;
  bool is_float_;
  float factor_;
};

void fill_rows(const Triangle* triangles, const Scaler& scale, const BvhReference* references, const Part::Leaf& leaf,
               TriangleRows& rows) {
  rows.count = leaf.count;
  // Of lanes that are left over, the first again.
  for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
    const std::uint32_t id = references[leaf.first + (lane < leaf.count ? lane : 0)].id();
    const Triangle t = scale(triangles[id]);
    rows.id[lane] = id;
    for (int vertex = 0; vertex < 3; ++vertex)
      for (int axis = 0; axis < 3; ++axis) rows.v[vertex][axis][lane] = t.v[vertex][axis];
    rows.longest[lane] = longest_edge(t);
    const Vec3 normal = unit_normal(t);
    for (int axis = 0; axis < 3; ++axis) rows.normal[axis][lane] = normal[axis];
  }
  // What denormals lose in rounding is made up for.
  rows.edge_bound = *std::max_element(rows.longest, rows.longest + kRowLanes) + 0x1p-60f;
  rows.reach = leaf.reach;
}

LazyArray<BvhReference> make_references(const Triangle* triangles, const std::uint32_t* kept, const Scaler& scale,
                                        const Executor* executor, BvhRange& whole) {
  constexpr std::size_t kChunk = BvhCutter::kChunk;
  LazyArray<BvhReference> references(whole.size(), Fill::nothing);
  std::vector<BvhRange> chunks((whole.size() + kChunk - 1) / kChunk);
  parallel_for(executor, chunks.size(), [&](std::size_t chunk) {
    const DefaultFloatMode mode;
    BvhRange all;
    for (std::size_t i = chunk * kChunk; i < std::min(whole.size(), (chunk + 1) * kChunk); ++i) {
      references[i] = BvhReference(scale(triangles[kept[i]]), kept[i]);
      all.bounds.extend(references[i].bounds);
      all.add_middle(references[i].middle());
    }
    chunks[chunk] = all;
  });
  for (const BvhRange& chunk : chunks) whole.extend(chunk);
  return references;
}

}  // namespace

TriangleBvh::TriangleBvh(const Triangle* triangles, const std::uint32_t* kept, std::size_t kept_count, int exponent,
                         float eps, const Executor* executor) {
  if (kept_count == 0) return;
  const DefaultFloatMode mode;
  const Scaler scale(exponent);
  BvhRange whole;
  whole.last = kept_count;
  const LazyArray<BvhReference> references = make_references(triangles, kept, scale, executor, whole);

  std::vector<Part> parts(1);
  std::vector<Pending> below;
  {
    Builder builder(&references[0], kept_count, eps, executor);
    builder.build({0, 0, 0, whole}, std::max(kSmallestPart, kept_count / 32), parts[0], below);
    parts.resize(1 + below.size());
    parallel_for(executor, below.size(), [&](std::size_t i) {
      const DefaultFloatMode body_mode;
      std::vector<Pending> none;
      builder.build(below[i], 0, parts[1 + i], none);
    });
  }

  struct Places {
    std::uint32_t node = 0, row = 0;
  };
  std::vector<Places> first(parts.size() + 1);
  for (std::size_t i = 0; i < parts.size(); ++i)
    first[i + 1] = {first[i].node + static_cast<std::uint32_t>(parts[i].nodes.size()),
                    first[i].row + static_cast<std::uint32_t>(parts[i].leaves.size())};
  for (std::size_t i = 0; i < below.size(); ++i) parts[0].nodes[below[i].node].child[below[i].lane] = first[1 + i].node;
  nodes_ = LazyArray<BvhNode>(first.back().node, Fill::nothing);
  rows_ = LazyArray<TriangleRows>(first.back().row, Fill::nothing);
  parallel_for(executor, parts.size(), [&](std::size_t i) {
    const DefaultFloatMode body_mode;
    const Part& part = parts[i];
    std::copy(part.nodes.begin(), part.nodes.end(), &nodes_[first[i].node]);
    for (std::size_t n = 0; n < part.nodes.size() && i > 0; ++n)
      for (std::uint32_t& child : nodes_[first[i].node + n].child)
        child += (child & BvhNode::kLeaf) != 0 ? first[i].row : first[i].node;
    for (std::size_t leaf = 0; leaf < part.leaves.size(); ++leaf)
      fill_rows(triangles, scale, &references[0], part.leaves[leaf], rows_[first[i].row + leaf]);
    parts[i] = Part();
  });
}

std::uint64_t TriangleBvh::bytes() const noexcept {
  return nodes_.size() * sizeof(BvhNode) + rows_.size() * sizeof(TriangleRows);
}

}  // namespace umbrix::detail
