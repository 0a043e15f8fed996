// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "oracle/box_tree.h"
#include "oracle/brute_force.h"

namespace umbrix::oracle {

/// The faster of the two: brute force for few triangles, else a BoxTree. Const calls are thread-safe.
class Oracle {
 public:
  explicit Oracle(const std::vector<Triangle>& triangles) {
    constexpr std::size_t kBruteTriangles = 128;
    if (triangles.size() <= kBruteTriangles) {
      brute_ = std::make_unique<BruteForce>(triangles);
    } else {
      tree_ = std::make_unique<BoxTree>(triangles);
    }
  }

  bool is_tree() const { return tree_ != nullptr; }
  bool occluded(const Ray& ray) const { return tree_ ? tree_->occluded(ray) : brute_->occluded(ray); }
  std::optional<Closest> closest(const Ray& ray) const { return tree_ ? tree_->closest(ray) : brute_->closest(ray); }

 private:
  std::unique_ptr<BruteForce> brute_;
  std::unique_ptr<BoxTree> tree_;
};

}  // namespace umbrix::oracle
