// SPDX-License-Identifier: Apache-2.0
#include "oracle/box_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <unordered_set>

namespace umbrix::oracle {
namespace {

constexpr std::size_t kLeafSize = 4;

bool is_finite(const Triangle& triangle) {
  for (const auto& corner : triangle.v) {
    for (const float x : corner) {
      if (!std::isfinite(x)) return false;
    }
  }
  return true;
}

// A triangle's bits, to find copies.
struct SameBits {
  const std::vector<Triangle>& triangles;

  std::size_t operator()(std::uint32_t i) const {  // FNV-1a
    unsigned char bytes[sizeof(Triangle)];
    std::memcpy(bytes, &triangles[i], sizeof bytes);
    std::uint64_t hash = 0xCBF29CE484222325ull;
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001B3ull;
    return static_cast<std::size_t>(hash);
  }
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    return std::memcmp(&triangles[a], &triangles[b], sizeof(Triangle)) == 0;
  }
};

}  // namespace

// A copy hits where the first one does, which wins any tie: the tree holds the first one only.
BoxTree::BoxTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  const DefaultFloatMode mode;
  const SameBits same{triangles_};
  std::unordered_set<std::uint32_t, SameBits, SameBits> seen(triangles_.size(), same, same);
  std::vector<Box> boxes(triangles_.size());
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    if (!is_finite(triangles_[i]) || !seen.insert(i).second) continue;
    const auto& v = triangles_[i].v;
    for (int k = 0; k < 3; ++k) {
      boxes[i].lower[k] = std::min({v[0][k], v[1][k], v[2][k]});
      boxes[i].upper[k] = std::max({v[0][k], v[1][k], v[2][k]});
    }
    order_.push_back(i);
  }
  if (!order_.empty()) add_node(boxes, 0, order_.size());
}

void BoxTree::add_node(std::vector<Box>& boxes, std::size_t begin, std::size_t end) {
  Box box = boxes[order_[begin]];
  for (std::size_t i = begin + 1; i < end; ++i) {
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], boxes[order_[i]].lower[k]);
      box.upper[k] = std::max(box.upper[k], boxes[order_[i]].upper[k]);
    }
  }
  const std::size_t place = nodes_.size();
  nodes_.push_back({box, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)});
  if (end - begin <= kLeafSize) return;
  int axis = 0;
  const auto extent = [&](int k) { return double{box.upper[k]} - double{box.lower[k]}; };
  for (int k = 1; k < 3; ++k) axis = extent(k) > extent(axis) ? k : axis;
  const auto center = [&](std::uint32_t i) { return double{boxes[i].lower[axis]} + double{boxes[i].upper[axis]}; };
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [&](std::uint32_t a, std::uint32_t b) { return center(a) < center(b); });
  add_node(boxes, begin, middle);
  nodes_[place].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[place].count = 0;
  add_node(boxes, middle, end);
}

// Slabs (Kay & Kajiya 1986). Each plane time has three roundings and no cancellation, so a relative error below 2^-51;
// 1e-14 is 22 times that. Floats keep all of it within a double's range.
bool BoxTree::may_meet(const Ray& ray, const Box& box) const {
  double enter = ray.tmin, exit = ray.tmax;
  for (int k = 0; k < 3; ++k) {
    const double lower = double{box.lower[k]} - double{ray.origin[k]};
    const double upper = double{box.upper[k]} - double{ray.origin[k]};
    if (ray.direction[k] == 0) {
      if (lower > 0 || upper < 0) return false;
      continue;
    }
    const double inverse = 1 / double{ray.direction[k]};
    const double low = lower * inverse, high = upper * inverse;
    enter = std::max(enter, std::min(low, high));
    exit = std::min(exit, std::max(low, high));
  }
  const auto margin = [](double t) { return std::isinf(t) ? 0 : std::abs(t) * 1e-14; };
  return enter - margin(enter) <= exit + margin(exit);
}

// Calls body(triangle) for each in a leaf whose box the ray may meet, until it returns false.
template <typename Body>
void BoxTree::for_each_near(const Ray& ray, const Body& body) const {
  if (nodes_.empty()) return;
  std::array<std::uint32_t, 64> stack;  // halves of 2^32 triangles at most are 32 deep
  std::size_t pending = 0;
  stack[pending++] = 0;
  while (pending > 0) {
    const std::uint32_t index = stack[--pending];
    const Node& node = nodes_[index];
    if (!may_meet(ray, node.box)) continue;
    if (node.count == 0) {
      stack[pending++] = node.first;
      stack[pending++] = index + 1;
      continue;
    }
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (!body(order_[node.first + i])) return;
    }
  }
}

bool BoxTree::occluded(const Ray& ray) const {
  return decide_occluded(ray, triangles_, {}, [&](const auto& body) { for_each_near(ray, body); });
}

std::optional<Closest> BoxTree::closest(const Ray& ray) const {
  return decide_closest(ray, triangles_, {}, [&](const auto& body) { for_each_near(ray, body); });
}

}  // namespace umbrix::oracle
