// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "oracle/exact_hit.h"
#include "umbrix/ray.h"

namespace umbrix::oracle {

/// The answers of BruteForce for millions of rays: boxes over the triangles, halved at the middle, that only spare
/// tests of triangles which a ray certainly misses. Const calls are thread-safe, and do not depend on the caller's
/// floating-point mode.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Triangle> triangles);

  bool occluded(const Ray& ray) const;

  /// occluded() for each ray, over all cores.
  std::vector<std::uint8_t> occluded(const std::vector<Ray>& rays) const;

 private:
  /// Children follow each other; a leaf's triangles do.
  struct Node {
    float lower[3], upper[3];
    std::uint32_t first = 0;  ///< child, or triangle of a leaf
    std::uint32_t count = 0;  ///< triangles of a leaf; 0: an inner node
  };

  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  bool may_meet(const Ray& ray, const Node& node) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace umbrix::oracle
