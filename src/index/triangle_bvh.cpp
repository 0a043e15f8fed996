// SPDX-License-Identifier: Apache-2.0
// Built from the top by binned surface areas (Wald 2007), where a leaf costs by its rows of sixteen.
#include "index/triangle_bvh.h"

#include <algorithm>
#include <limits>

#include "tree/scale.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kBins = 16;

struct Reference {
  Vec3 lower;
  std::uint32_t id;
  Vec3 upper;

  Vec3 middle() const { return lower + upper; }  // twice as far out as it is
};

struct Range {
  std::size_t first, last;
  Box box;
  std::size_t size() const { return last - first; }
};

float area(const Box& box) {
  const Vec3 e = box.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

float rows_of(std::size_t count) { return static_cast<float>((count + kRowLanes - 1) / kRowLanes); }

/// Cuts ranges of references, which it orders so that each part is together.
class Cutter {
 public:
  explicit Cutter(std::vector<Reference>& references) : references_(references) {}

  Range whole() const { return with_box({0, references_.size(), {}}); }

  /// Two parts that are not empty, of a range that is longer than one row.
  void cut(const Range& range, Range& low, Range& high) {
    Box middles;
    for (std::size_t i = range.first; i < range.last; ++i) middles.extend(references_[i].middle());
    const Vec3 extent = middles.extent();
    Cut best;
    for (int axis = 0; axis < 3; ++axis)
      if (extent[axis] > 0) try_axis(range, middles, axis, best);
    std::size_t at = range.first;
    if (best.bin != 0) {
      const float origin = middles.lower[best.axis], scale = bin_scale(extent[best.axis]);
      const auto part = std::partition(
          references_.begin() + static_cast<std::ptrdiff_t>(range.first),
          references_.begin() + static_cast<std::ptrdiff_t>(range.last),
          [&](const Reference& r) { return bin_of(r.middle()[best.axis], origin, scale) < best.bin; });
      at = static_cast<std::size_t>(part - references_.begin());
    }
    // Middles that are all the same, or nearly: any halves will do.
    if (at == range.first || at == range.last) at = range.first + range.size() / 2;
    low = with_box({range.first, at, {}});
    high = with_box({at, range.last, {}});
  }

 private:
  struct Cut {
    float cost = std::numeric_limits<float>::infinity();
    int axis = 0;
    std::size_t bin = 0;
  };

  Range with_box(Range range) const {
    for (std::size_t i = range.first; i < range.last; ++i) {
      range.box.lower = glm::min(range.box.lower, references_[i].lower);
      range.box.upper = glm::max(range.box.upper, references_[i].upper);
    }
    return range;
  }

  static float bin_scale(float extent) { return static_cast<float>(kBins) * (1 - 0x1p-20f) / extent; }
  static std::size_t bin_of(float x, float origin, float scale) {
    return std::min(static_cast<std::size_t>((x - origin) * scale), kBins - 1);
  }

  void try_axis(const Range& range, const Box& middles, int axis, Cut& best) const {
    Box boxes[kBins];
    std::size_t counts[kBins] = {};
    const float origin = middles.lower[axis], scale = bin_scale(middles.extent()[axis]);
    if (!(scale < std::numeric_limits<float>::infinity())) return;
    for (std::size_t i = range.first; i < range.last; ++i) {
      const Reference& r = references_[i];
      const std::size_t bin = bin_of(r.middle()[axis], origin, scale);
      ++counts[bin];
      boxes[bin].lower = glm::min(boxes[bin].lower, r.lower);
      boxes[bin].upper = glm::max(boxes[bin].upper, r.upper);
    }
    float high_cost[kBins];
    Box box;
    std::size_t count = 0;
    for (std::size_t bin = kBins - 1; bin > 0; --bin) {
      box.extend(boxes[bin]);
      count += counts[bin];
      high_cost[bin] = count == 0 ? std::numeric_limits<float>::infinity() : area(box) * rows_of(count);
    }
    box = Box();
    count = 0;
    for (std::size_t bin = 1; bin < kBins; ++bin) {
      box.extend(boxes[bin - 1]);
      count += counts[bin - 1];
      if (count == 0) continue;
      const float cost = area(box) * rows_of(count) + high_cost[bin];
      if (cost < best.cost) best = {cost, axis, bin};
    }
  }

  std::vector<Reference>& references_;
};

}  // namespace

TriangleBvh::TriangleBvh(const Triangle* triangles, const std::uint32_t* kept, std::size_t kept_count, int exponent) {
  if (kept_count == 0) return;
  std::vector<Reference> references(kept_count);
  for (std::size_t i = 0; i < kept_count; ++i) {
    const Triangle t = scaled(triangles[kept[i]], exponent);
    references[i] = {glm::min(t.v[0], glm::min(t.v[1], t.v[2])), kept[i],
                     glm::max(t.v[0], glm::max(t.v[1], t.v[2]))};
  }
  Cutter cutter(references);
  const auto add_rows = [&](const Range& range) {
    const auto index = static_cast<std::uint32_t>(rows_.size());
    TriangleRows& rows = rows_.emplace_back();
    rows.count = static_cast<std::uint32_t>(range.size());
    for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
      const std::uint32_t id = references[range.first + (lane < rows.count ? lane : 0)].id;
      const Triangle t = scaled(triangles[id], exponent);
      rows.id[lane] = id;
      for (int vertex = 0; vertex < 3; ++vertex)
        for (int axis = 0; axis < 3; ++axis) rows.v[vertex][axis][lane] = t.v[vertex][axis];
    }
    return index | BvhNode::kLeaf;
  };

  struct Todo {
    Range range;
    std::uint32_t node;
  };
  std::vector<Todo> todo{{cutter.whole(), 0}};
  nodes_.emplace_back();
  while (!todo.empty()) {
    const Todo at = todo.back();
    todo.pop_back();
    Range parts[kBvhWidth] = {at.range};
    std::uint32_t count = 1;
    while (count < kBvhWidth) {
      std::uint32_t widest = count;
      for (std::uint32_t i = 0; i < count; ++i)
        if (parts[i].size() > kRowLanes && (widest == count || area(parts[i].box) > area(parts[widest].box)))
          widest = i;
      if (widest == count) break;
      const Range range = parts[widest];
      cutter.cut(range, parts[widest], parts[count++]);
    }
    for (std::uint32_t i = 0; i < kBvhWidth; ++i) {
      const bool used = i < count;
      for (int axis = 0; axis < 3; ++axis) {
        nodes_[at.node].lower[axis][i] = used ? parts[i].box.lower[axis] : std::numeric_limits<float>::infinity();
        nodes_[at.node].upper[axis][i] = used ? parts[i].box.upper[axis] : -std::numeric_limits<float>::infinity();
      }
      if (!used) {
        nodes_[at.node].child[i] = BvhNode::kLeaf;
      } else if (parts[i].size() <= kRowLanes) {
        nodes_[at.node].child[i] = add_rows(parts[i]);
      } else {
        nodes_[at.node].child[i] = static_cast<std::uint32_t>(nodes_.size());
        todo.push_back({parts[i], nodes_[at.node].child[i]});
        nodes_.emplace_back();
      }
    }
  }
}

std::uint64_t TriangleBvh::bytes() const noexcept {
  return nodes_.capacity() * sizeof(BvhNode) + rows_.capacity() * sizeof(TriangleRows);
}

}  // namespace umbrix::detail
