// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "oracle/decide.h"

namespace umbrix::oracle {

/// The exact answers of BruteForce for scenes of millions of triangles: a hierarchy of boxes halved by number, walked
/// in double with bounds on every rounding. Shares no code with the tracer; tests and the bench hold it to BruteForce.
/// Const calls are thread-safe, and do not depend on the caller's floating-point mode.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Triangle> triangles);

  const std::vector<Triangle>& triangles() const { return triangles_; }

  bool occluded(const Ray& ray) const;

  /// The smallest t; among equals the lowest triangle.
  std::optional<Closest> closest(const Ray& ray) const;

 private:
  struct Box {
    float lower[3], upper[3];
  };
  // Leaves name a run of order_, inner nodes their second child; the first one follows its parent.
  struct Node {
    Box box;
    std::uint32_t first;
    std::uint32_t count;  // 0: inner
  };

  void add_node(std::vector<Box>& boxes, std::size_t begin, std::size_t end);
  bool may_meet(const Ray& ray, const Box& box) const;
  template <typename Body>
  void for_each_near(const Ray& ray, const Body& body) const;

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace umbrix::oracle
