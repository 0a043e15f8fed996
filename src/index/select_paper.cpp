// SPDX-License-Identifier: Apache-2.0
// After Liang & Huang (2019), section 3: large triangles are tested at inner nodes where they are likely to end a ray
// early. Equation 2 leaves out the node's own step and the children's weights; taken with both and put into equation 3,
// C(T,t) = c + (1 - p) C(T) gives E = a^h (p - c / C(T)).
#include "index/select_paper.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/float_mode.h"
#include "index/cells.h"
#include "index/subtree_costs.h"
#include "tree/clip.h"
#include "tree/scale.h"
#include "tree/split.h"

namespace umbrix::detail {
namespace {

struct Candidate {
  std::uint32_t id;
  double box_area;
};

Box bounds_of(const Triangle& triangle) {
  Box box;
  for (const Vec3& v : triangle.v) box.extend(v);
  return box;
}

/// The triangles with the largest boxes, largest first.
std::vector<Candidate> find_candidates(const Triangle* triangles, int exponent, const std::uint32_t* kept,
                                       std::size_t count, const PaperOptions& options) {
  std::vector<Candidate> result(count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    result[i] = {kept[i], half_area(bounds_of(scaled(triangles[kept[i]], exponent)))};
    sum += result[i].box_area;
  }
  const double least = options.least_box * sum / static_cast<double>(count);
  result.erase(
      std::remove_if(result.begin(), result.end(), [least](const Candidate& c) { return !(c.box_area > least); }),
      result.end());
  std::sort(result.begin(), result.end(), [](const Candidate& a, const Candidate& b) {
    return a.box_area != b.box_area ? a.box_area > b.box_area : a.id < b.id;
  });
  const auto share = static_cast<std::size_t>(std::ceil(options.most_share * static_cast<double>(count)));
  result.resize(std::min({result.size(), share, options.most_candidates}));
  return result;
}

/// What stands at a node already.
struct List {
  std::uint32_t count = 0;
  double missed = 1;  ///< the chance that a line is blocked by none of it
};

/// A node for the triangle at hand.
struct Place {
  std::uint32_t node;
  double score;
  double p;
  double gain;  ///< node steps spared to a line through the root
};

/// Places one triangle after the other, the best nodes found by going up its part of the tree.
class Selection {
 public:
  Selection(const Tree& tree, const PaperOptions& options)
      : tree_(tree), options_(options), costs_(subtree_costs(tree)), root_area_(half_area(tree.root)) {
    const double depth = costs_.depth;
    first_depth_ = static_cast<std::uint32_t>(std::ceil(options.band_low * depth));
    last_depth_ = static_cast<std::uint32_t>(std::floor(options.band_high * depth));
  }

  void place(std::uint32_t id, const Triangle& triangle) {
    triangle_ = &triangle;
    places_.clear();
    best_below(0, tree_.root, 0);
    std::sort(places_.begin(), places_.end(),
              [](const Place& a, const Place& b) { return a.score != b.score ? a.score > b.score : a.node < b.node; });
    places_.resize(std::min<std::size_t>(places_.size(), options_.nodes_per_triangle));
    for (const Place& place : places_) {
      List& list = lists_[place.node];
      ++list.count;
      list.missed *= 1 - place.p;
      gain_ += place.gain;
      placements_.push_back({place.node, id});
    }
  }

  /// The placements, or none if they do not pay.
  std::vector<Placement> take() {
    if (!(gain_ > options_.least_gain * static_cast<double>(costs_.expected[0]))) placements_.clear();
    return std::move(placements_);
  }

 private:
  /// Appends the best places of the subtree, none above another, and returns the sum of their scores.
  double best_below(std::uint32_t index, const Box& cell, std::uint32_t depth) {
    if (depth > last_depth_ || costs_.inner_nodes[index] < options_.least_inner_nodes) return 0;
    const Box part = clipped_bounds(*triangle_, cell, 0);
    if (part.empty()) return 0;
    const std::size_t first = places_.size();
    const Node& node = tree_.nodes[index];
    double below = 0;
    for (const bool high : {false, true}) {
      const std::size_t middle = places_.size();
      const double sum = best_below(node.low_child() + (high ? 1 : 0), half_cell(cell, node, high), depth + 1);
      if (options_.nodes_per_triangle > 1)
        below += sum;
      else if (sum > below)
        below = sum;
      else
        places_.resize(middle);
    }
    if (depth < first_depth_) return below;
    const Place here = score(index, cell, part, depth);
    if (!(here.score > options_.threshold && here.score >= below)) return below;
    places_.resize(first);
    places_.push_back(here);
    return here.score;
  }

  Place score(std::uint32_t index, const Box& cell, const Box& part, std::uint32_t depth) const {
    const auto found = lists_.find(index);
    const List list = found == lists_.end() ? List() : found->second;
    if (list.count >= options_.per_node) return {index, 0, 0, 0};
    const CostModel model;
    const double area = half_area(cell), rest = static_cast<double>(costs_.expected[index]);
    const double measure = options_.reading == PaperReading::area ? clipped_area(*triangle_, cell) : half_area(part);
    const double p = std::min(1.0, measure / area);
    const double test = model.leaf(list.count + 1) - model.leaf(list.count);
    // Lists are one block: what stands there already has been paid for, and takes its share of the lines.
    const double saved = list.missed * p * rest - test;
    const double gain = saved * area / root_area_;
    if (options_.reading == PaperReading::area) return {index, gain, p, gain};
    const double relative = options_.reading == PaperReading::literal ? literal_benefit(index, area) : saved / rest;
    return {index, std::pow(options_.decay, depth) * relative, p, gain};
  }

  /// 1 - C(T,t) / C(T) by equations 1 and 2 as they stand. Pr is cut at 1: beyond, the cost would be negative.
  double literal_benefit(std::uint32_t index, double area) const {
    const double c = CostModel().leaf(1);
    const double p = std::min(1.0, half_area(bounds_of(*triangle_)) / area);
    const std::uint32_t low = tree_.nodes[index].low_child();
    const double children = static_cast<double>(costs_.local[low]) + static_cast<double>(costs_.local[low + 1]);
    return 1 - (p * c + (1 - p) * (c + children)) / static_cast<double>(costs_.local[index]);
  }

  const Tree& tree_;
  const PaperOptions& options_;
  SubtreeCosts costs_;
  double root_area_;
  std::uint32_t first_depth_ = 0, last_depth_ = 0;
  const Triangle* triangle_ = nullptr;  ///< in the tree's units
  std::vector<Place> places_;           ///< of that triangle
  std::unordered_map<std::uint32_t, List> lists_;
  std::vector<Placement> placements_;
  double gain_ = 0;
};

}  // namespace

std::vector<Placement> select_paper(const Tree& tree, const Triangle* triangles, const std::uint32_t* kept,
                                    std::size_t kept_count, const PaperOptions& options) {
  if (kept_count == 0) return {};
  const DefaultFloatMode mode;
  Selection selection(tree, options);
  for (const Candidate& candidate : find_candidates(triangles, tree.scale_exponent, kept, kept_count, options))
    selection.place(candidate.id, scaled(triangles[candidate.id], tree.scale_exponent));
  return selection.take();
}

}  // namespace umbrix::detail
