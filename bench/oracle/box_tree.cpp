// SPDX-License-Identifier: Apache-2.0
//
// A median-split hierarchy of boxes (Kay & Kajiya 1986). Box bounds are vertex coordinates, so they are exact; a ray's
// times at their planes are doubles with a few roundings, which a relative slack far above them covers.
#include "oracle/box_tree.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "oracle/triangle_filter.h"

namespace umbrix::oracle {
namespace {

constexpr std::uint32_t kLeafSize = 4;
constexpr std::size_t kMostDepth = 40;  // halving 2^32 triangles down to leaves takes 30 levels

bool is_finite(const Triangle& triangle) {
  for (const auto& corner : triangle.v) {
    for (const float x : corner) {
      if (!std::isfinite(x)) return false;
    }
  }
  return true;
}

double center(const Triangle& t, std::size_t axis) {
  return double{t.v[0][axis]} + double{t.v[1][axis]} + double{t.v[2][axis]};
}

}  // namespace

BoxTree::BoxTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  // Nothing ever hits the others, and they have no box.
  triangles_.erase(
      std::remove_if(triangles_.begin(), triangles_.end(), [](const Triangle& t) { return !is_finite(t); }),
      triangles_.end());
  if (triangles_.empty()) return;
  nodes_.emplace_back();
  split(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void BoxTree::split(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
  const auto first = triangles_.begin() + begin, last = triangles_.begin() + end;
  std::size_t longest = 0;
  Node box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.lower[k] = box.upper[k] = first->v[0][k];
    for (auto t = first; t != last; ++t) {
      for (const auto& corner : t->v) {
        box.lower[k] = std::min(box.lower[k], corner[k]);
        box.upper[k] = std::max(box.upper[k], corner[k]);
      }
    }
    if (double{box.upper[k]} - box.lower[k] > double{box.upper[longest]} - box.lower[longest]) longest = k;
  }
  if (end - begin <= kLeafSize) {
    box.first = begin;
    box.count = end - begin;
    nodes_[node] = box;
    return;
  }
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(first, triangles_.begin() + middle, last,
                   [longest](const Triangle& a, const Triangle& b) { return center(a, longest) < center(b, longest); });
  box.first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node] = box;
  nodes_.resize(nodes_.size() + 2);
  split(box.first, begin, middle);
  split(box.first + 1, middle, end);
}

bool BoxTree::may_meet(const Ray& ray, const Node& node) const {
  double near = ray.tmin, far = ray.tmax;
  for (std::size_t k = 0; k < 3; ++k) {
    const double origin = ray.origin[k], direction = ray.direction[k];
    if (direction == 0) {
      if (origin < node.lower[k] || origin > node.upper[k]) return false;
      continue;
    }
    double enter = (node.lower[k] - origin) / direction, leave = (node.upper[k] - origin) / direction;
    if (direction < 0) std::swap(enter, leave);
    constexpr double kSlack = 1e-14;  // two roundings are 2.3e-16
    near = std::max(near, enter - kSlack * std::abs(enter));
    far = std::min(far, leave + kSlack * std::abs(leave));
  }
  return near <= far;
}

bool BoxTree::occluded(const Ray& ray) const {
  const DefaultFloatMode mode;
  if (nodes_.empty() || !is_valid(ray)) return false;
  std::array<std::uint32_t, kMostDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!may_meet(ray, node)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Verdict verdict = filter(ray, triangles_[i]).verdict;
      if (verdict == Verdict::hit) return true;
      if (verdict == Verdict::open && exact_hit(ray, triangles_[i].v)) return true;
    }
  }
  return false;
}

std::vector<std::uint8_t> BoxTree::occluded(const std::vector<Ray>& rays) const {
  std::vector<std::uint8_t> out(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { out[i] = occluded(rays[i]) ? 1 : 0; });
  return out;
}

}  // namespace umbrix::oracle
