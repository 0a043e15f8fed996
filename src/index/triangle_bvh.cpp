// SPDX-License-Identifier: Apache-2.0
// Built from the top by binned surface areas (Wald 2007), where a leaf costs by its rows of sixteen: the upper part by
// one thread, the parts below side by side. The result does not depend on the threads.
#include "index/triangle_bvh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/parallel_for.h"
#include "tree/scale.h"

namespace umbrix::detail {
namespace {

constexpr std::size_t kBins = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Four floats that compilers keep in a register.
using Float4 = float __attribute__((vector_size(16)));

Float4 least(Float4 a, Float4 b) { return a < b ? a : b; }

/// Lower bounds, and upper bounds with the sign changed: a union is two minima.
struct Bounds {
  Float4 lower{kInfinity, kInfinity, kInfinity, kInfinity};
  Float4 minus_upper{kInfinity, kInfinity, kInfinity, kInfinity};

  void extend(const Bounds& b) {
    lower = least(lower, b.lower);
    minus_upper = least(minus_upper, b.minus_upper);
  }
  Float4 extent() const { return -minus_upper - lower; }
  float area() const {
    const Float4 e = extent();
    return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
  }
};

struct Reference {
  Bounds bounds;
  std::uint32_t id = 0;

  Float4 middle() const { return bounds.lower - bounds.minus_upper; }  // twice as far out as it is
};

/// References from first to last, their bounds, and those of their middles.
struct Range {
  std::size_t first = 0, last = 0;
  Bounds bounds, middles;

  std::size_t size() const { return last - first; }
  bool is_leaf() const { return size() <= kRowLanes; }
};

float rows_of(std::size_t count) {
  const std::size_t rows = (count + kRowLanes - 1) / kRowLanes;
  return static_cast<float>(rows);
}

/// Cuts ranges of references, which it orders so that each part is together.
class Cutter {
 public:
  explicit Cutter(std::vector<Reference>& references) : references_(references) {}

  Range range(std::size_t first, std::size_t last) const {
    Range result;
    result.first = first;
    result.last = last;
    for (std::size_t i = first; i < last; ++i) {
      const Float4 middle = references_[i].middle();
      result.bounds.extend(references_[i].bounds);
      result.middles.lower = least(result.middles.lower, middle);
      result.middles.minus_upper = least(result.middles.minus_upper, -middle);
    }
    return result;
  }

  /// Two parts that are not empty, of a range of two or more.
  void cut(const Range& whole, Range& low, Range& high) const {
    const Cut best = find(whole);
    const auto begin = references_.begin();
    std::size_t at = whole.first;
    if (best.bin != 0) {
      const Places places(whole);
      const auto middle = std::partition(
          begin + static_cast<std::ptrdiff_t>(whole.first), begin + static_cast<std::ptrdiff_t>(whole.last),
          [&](const Reference& r) { return Places::bin(places(r)[best.axis]) < best.bin; });
      at = static_cast<std::size_t>(middle - begin);
    }
    // Middles that are all the same, or nearly: any halves will do.
    if (at == whole.first || at == whole.last) at = whole.first + whole.size() / 2;
    low = range(whole.first, at);
    high = range(at, whole.last);
  }

 private:
  struct Cut {
    float cost = kInfinity;
    int axis = 0;
    std::size_t bin = 0;
  };

  /// Where middles are among the bins, on all axes.
  class Places {
   public:
    explicit Places(const Range& whole) : origin_(whole.middles.lower) {
      const Float4 extent = whole.middles.extent();
      for (int axis = 0; axis < 3; ++axis) {
        const float scale = static_cast<float>(kBins) * (1 - 0x1p-20f) / extent[axis];
        scale_[axis] = scale < kInfinity ? scale : 0;
      }
    }
    Float4 operator()(const Reference& r) const { return (r.middle() - origin_) * scale_; }
    static std::size_t bin(float place) { return std::min(static_cast<std::size_t>(place), kBins - 1); }

   private:
    Float4 origin_, scale_{};
  };

  struct Bins {
    Bounds bounds[kBins];
    std::size_t counts[kBins] = {};
  };

  Cut find(const Range& whole) const {
    Bins bins[3];
    const Places places(whole);
    for (std::size_t i = whole.first; i < whole.last; ++i) {
      const Float4 place = places(references_[i]);
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t bin = Places::bin(place[axis]);
        bins[axis].bounds[bin].extend(references_[i].bounds);
        ++bins[axis].counts[bin];
      }
    }
    Cut best;
    for (int axis = 0; axis < 3; ++axis) compare(bins[axis], axis, best);
    return best;
  }

  static void compare(const Bins& bins, int axis, Cut& best) {
    float high_cost[kBins];
    Bounds bounds;
    std::size_t count = 0;
    for (std::size_t bin = kBins - 1; bin > 0; --bin) {
      bounds.extend(bins.bounds[bin]);
      count += bins.counts[bin];
      high_cost[bin] = count == 0 ? kInfinity : bounds.area() * rows_of(count);
    }
    bounds = Bounds();
    count = 0;
    for (std::size_t bin = 1; bin < kBins; ++bin) {
      bounds.extend(bins.bounds[bin - 1]);
      count += bins.counts[bin - 1];
      if (count == 0) continue;
      const float cost = bounds.area() * rows_of(count) + high_cost[bin];
      if (cost < best.cost) best = {cost, axis, bin};
    }
  }

  std::vector<Reference>& references_;
};

/// Some of the hierarchy, with places of its own.
struct Part {
  std::vector<BvhNode> nodes;
  std::vector<TriangleRows> rows;
};

/// A child that another part will hold.
struct Pending {
  std::uint32_t node, lane;
  Range range;
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
  Builder(const Triangle* triangles, int exponent, std::vector<Reference>& references)
      : triangles_(triangles), exponent_(exponent), references_(references), cutter_(references) {}

  Range whole() const { return cutter_.range(0, references_.size()); }

  /// All below a range; what is not larger than `most` is left to others.
  void build(const Range& range, std::size_t most, Part& out, std::vector<Pending>& left) const {
    std::vector<Pending> todo{{add_node(out), 0, range}};
    while (!todo.empty()) {
      const Pending at = todo.back();
      todo.pop_back();
      Range parts[kBvhWidth] = {at.range};
      const std::uint32_t count = cut(parts);
      for (std::uint32_t lane = 0; lane < count; ++lane) {
        set_box(parts[lane].bounds, lane, out.nodes[at.node]);
        if (parts[lane].is_leaf()) {
          out.nodes[at.node].child[lane] = add_rows(parts[lane], out) | BvhNode::kLeaf;
        } else if (parts[lane].size() <= most) {
          left.push_back({at.node, lane, parts[lane]});
        } else {
          const std::uint32_t child = add_node(out);
          out.nodes[at.node].child[lane] = child;
          todo.push_back({child, 0, parts[lane]});
        }
      }
    }
  }

 private:
  static std::uint32_t add_node(Part& part) {
    BvhNode node;
    for (std::uint32_t lane = 0; lane < kBvhWidth; ++lane) {
      set_box(Bounds(), lane, node);
      node.child[lane] = BvhNode::kLeaf;
    }
    part.nodes.push_back(node);
    return static_cast<std::uint32_t>(part.nodes.size() - 1);
  }

  static void set_box(const Bounds& bounds, std::uint32_t lane, BvhNode& node) {
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis][lane] = bounds.lower[axis];
      node.upper[axis][lane] = -bounds.minus_upper[axis];
    }
  }

  /// Cuts the largest part again until there are as many as a node has children.
  std::uint32_t cut(Range (&parts)[kBvhWidth]) const {
    std::uint32_t count = 1;
    for (; count < kBvhWidth; ++count) {
      std::uint32_t widest = count;
      for (std::uint32_t i = 0; i < count; ++i)
        if (!parts[i].is_leaf() && (widest == count || parts[i].bounds.area() > parts[widest].bounds.area()))
          widest = i;
      if (widest == count) break;
      const Range whole = parts[widest];
      cutter_.cut(whole, parts[widest], parts[count]);
    }
    return count;
  }

  std::uint32_t add_rows(const Range& range, Part& out) const {
    TriangleRows& rows = out.rows.emplace_back();
    rows.count = static_cast<std::uint32_t>(range.size());
    for (std::uint32_t lane = 0; lane < kRowLanes; ++lane) {
      const std::uint32_t id = references_[range.first + (lane < rows.count ? lane : 0)].id;
      const Triangle t = scaled(triangles_[id], exponent_);
      rows.id[lane] = id;
      for (int vertex = 0; vertex < 3; ++vertex)
        for (int axis = 0; axis < 3; ++axis) rows.v[vertex][axis][lane] = t.v[vertex][axis];
      rows.longest[lane] = longest_edge(t);
      const Vec3 normal = unit_normal(t);
      for (int axis = 0; axis < 3; ++axis) rows.normal[axis][lane] = normal[axis];
    }
    return static_cast<std::uint32_t>(out.rows.size() - 1);
  }

  const Triangle* triangles_;
  int exponent_;
  std::vector<Reference>& references_;
  Cutter cutter_;
};

Reference reference(const Triangle& t, std::uint32_t id) {
  const Vec3 lower = glm::min(t.v[0], glm::min(t.v[1], t.v[2])), upper = glm::max(t.v[0], glm::max(t.v[1], t.v[2]));
  Reference result;
  result.bounds.lower = Float4{lower.x, lower.y, lower.z, 0};
  result.bounds.minus_upper = Float4{-upper.x, -upper.y, -upper.z, 0};
  result.id = id;
  return result;
}

}  // namespace

TriangleBvh::TriangleBvh(const Triangle* triangles, const std::uint32_t* kept, std::size_t kept_count, int exponent,
                         const Executor* executor) {
  if (kept_count == 0) return;
  constexpr std::size_t kChunk = 1u << 14;
  std::vector<Reference> references(kept_count);
  parallel_for(executor, (kept_count + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(kept_count, (chunk + 1) * kChunk); ++i)
      references[i] = reference(scaled(triangles[kept[i]], exponent), kept[i]);
  });

  const Builder builder(triangles, exponent, references);
  Part top;
  std::vector<Pending> below;
  builder.build(builder.whole(), std::max<std::size_t>(1u << 12, kept_count / 32), top, below);
  std::vector<Part> parts(below.size());
  parallel_for(executor, below.size(), [&](std::size_t i) {
    std::vector<Pending> none;
    builder.build(below[i].range, 0, parts[i], none);
  });

  nodes_ = std::move(top.nodes);
  rows_ = std::move(top.rows);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto first_node = static_cast<std::uint32_t>(nodes_.size()),
               first_row = static_cast<std::uint32_t>(rows_.size());
    nodes_[below[i].node].child[below[i].lane] = first_node;
    for (BvhNode node : parts[i].nodes) {
      for (std::uint32_t& child : node.child) child += (child & BvhNode::kLeaf) != 0 ? first_row : first_node;
      nodes_.push_back(node);
    }
    rows_.insert(rows_.end(), parts[i].rows.begin(), parts[i].rows.end());
    parts[i] = Part();
  }
  nodes_.shrink_to_fit();
  rows_.shrink_to_fit();
}

std::uint64_t TriangleBvh::bytes() const noexcept {
  return nodes_.capacity() * sizeof(BvhNode) + rows_.capacity() * sizeof(TriangleRows);
}

}  // namespace umbrix::detail
