// SPDX-License-Identifier: Apache-2.0
// Every node that a ray enters before it is blocked is a place from which its blocker could have ended it. The most
// gainful placement is taken first; since it shortens its rays, gains of others only change downwards but for saved
// tests, and are counted anew when they come up ("lazy greedy", Minoux 1978, "Accelerated greedy algorithms").
#include "index/select_learned.h"

#include <algorithm>
#include <queue>
#include <unordered_map>

#include "core/float_mode.h"
#include "index/cells.h"
#include "index/ray_path.h"
#include "tree/split.h"

namespace umbrix::detail {
namespace {

/// The nodes that a blocked ray enters, and where it ends as things stand.
struct Path {
  std::uint32_t first_step, step_count;
  float end;
};

/// A blocked ray enters a node.
struct Entry {
  std::uint32_t node, triangle, path;
  float before;
};

/// The entries of one node by rays with one blocker: a placement to choose or not.
struct Candidate {
  std::uint32_t first_entry, entry_count;
};

/// What placing a candidate is worth, in node steps. A single ray may well be chance: `proven` is the gain without one
/// of the rays, as if it had been left out of the choice.
struct Offer {
  double gain, proven;
  std::uint32_t candidate;

  bool operator<(const Offer& o) const { return gain != o.gain ? gain < o.gain : candidate > o.candidate; }
};

class Selection {
 public:
  Selection(const Tree& tree, const LearnedOptions& options)
      : tree_(tree), options_(options), entering_(tree.nodes.size()), lists_(tree.nodes.size()) {}

  void follow(const BlockedRays& traced) {
    for (std::size_t i = 0; i < traced.rays.count; ++i) {
      const std::size_t first = steps_.size();
      const float end = follow_ray(tree_, traced.rays[i], traced.blockers[i], steps_);
      work_ += static_cast<double>(end);
      for (std::size_t s = first; s < steps_.size(); ++s) ++entering_[steps_[s].node];
      if (traced.blockers[i] == Primitive::kNone) {
        steps_.resize(first);
        continue;
      }
      blockers_.push_back(traced.blockers[i]);
      paths_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(steps_.size() - first), end});
    }
  }

  /// The placements, or none if they do not pay.
  std::vector<Placement> choose() {
    collect_entries();
    collect_candidates();
    while (!offers_.empty()) {
      const Offer offer = offer_of(offers_.top().candidate);
      offers_.pop();
      if (!(offer.gain > 0)) continue;
      if (!offers_.empty() && offer < offers_.top())
        offers_.push(offer);
      else if (is_alone_on_its_path(entry(offer.candidate)))
        place(offer);
    }
    if (!(proven_gain_ > options_.least_gain * work_)) placements_.clear();
    return std::move(placements_);
  }

 private:
  const Entry& entry(std::uint32_t candidate) const { return entries_[candidates_[candidate].first_entry]; }

  void collect_entries() {
    for (std::uint32_t p = 0; p < paths_.size(); ++p)
      for (std::uint32_t s = 0; s < paths_[p].step_count; ++s) {
        const PathStep& step = steps_[paths_[p].first_step + s];
        entries_.push_back({step.node, blockers_[p], p, step.before});
      }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
      if (a.node != b.node) return a.node < b.node;
      return a.triangle != b.triangle ? a.triangle < b.triangle : a.path < b.path;
    });
  }

  void collect_candidates() {
    for (std::uint32_t first = 0, end = 0; first < entries_.size(); first = end) {
      const Entry& e = entries_[first];
      for (end = first; end < entries_.size() && entries_[end].node == e.node && entries_[end].triangle == e.triangle;)
        ++end;
      candidates_.push_back({first, end - first});
      const Offer offer = offer_of(static_cast<std::uint32_t>(candidates_.size() - 1));
      if (offer.gain > 0)
        offers_.push(offer);
      else
        candidates_.pop_back();
    }
  }

  /// As things stand: what the rays that still come to the node and are blocked there would be spared, less the tests
  /// of all that come. Worth 0 if it may not be placed.
  Offer offer_of(std::uint32_t number) const {
    const Offer none{0, 0, number};
    const Candidate& candidate = candidates_[number];
    const std::uint32_t node = entries_[candidate.first_entry].node;
    if (lists_[node] >= options_.per_node) return none;
    double spared = 0;
    std::uint32_t hits = 0;
    for (std::uint32_t i = 0; i < candidate.entry_count; ++i) {
      const Entry& e = entries_[candidate.first_entry + i];
      const float rest = paths_[e.path].end - e.before;
      if (!(rest > 0)) continue;
      spared += static_cast<double>(rest);
      ++hits;
    }
    const double entering = entering_[node];
    if (hits == 0 || hits < options_.least_share * entering) return none;
    const CostModel model;
    const double gain = spared - entering * (model.leaf(lists_[node] + 1u) - model.leaf(lists_[node]));
    return {gain, gain - spared / hits, number};
  }

  bool is_alone_on_its_path(const Entry& e) const {
    const auto found = nodes_of_.find(e.triangle);
    if (found == nodes_of_.end()) return true;
    return std::none_of(found->second.begin(), found->second.end(), [&](std::uint32_t other) {
      return is_within_subtree(tree_, other, e.node) || is_within_subtree(tree_, e.node, other);
    });
  }

  void place(const Offer& offer) {
    const Candidate& candidate = candidates_[offer.candidate];
    for (std::uint32_t i = 0; i < candidate.entry_count; ++i) {
      const Entry& e = entries_[candidate.first_entry + i];
      if (e.before < paths_[e.path].end) shorten(paths_[e.path], e.before);
    }
    const Entry& e = entry(offer.candidate);
    nodes_of_[e.triangle].push_back(e.node);
    ++lists_[e.node];
    proven_gain_ += offer.proven;
    placements_.push_back({e.node, e.triangle});
  }

  /// The ray ends on entering the node that it comes to at `end`.
  void shorten(Path& path, float end) {
    for (std::uint32_t s = path.step_count; s-- > 0;) {
      const PathStep& step = steps_[path.first_step + s];
      if (!(step.before > end)) break;
      if (step.before < path.end) --entering_[step.node];
    }
    path.end = end;
  }

  const Tree& tree_;
  const LearnedOptions& options_;
  std::vector<std::uint32_t> entering_;  ///< rays, by node
  std::vector<std::uint8_t> lists_;      ///< triangles placed, by node
  std::vector<PathStep> steps_;
  std::vector<Path> paths_;
  std::vector<std::uint32_t> blockers_;  ///< by path
  std::vector<Entry> entries_;           ///< by node, then triangle
  std::vector<Candidate> candidates_;
  std::priority_queue<Offer> offers_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> nodes_of_;  ///< with the triangle in their lists
  std::vector<Placement> placements_;
  double work_ = 0, proven_gain_ = 0;
};

}  // namespace

std::vector<Placement> select_learned(const Tree& tree, const BlockedRays& traced, const LearnedOptions& options) {
  const DefaultFloatMode mode;
  Selection selection(tree, options);
  selection.follow(traced);
  return selection.choose();
}

}  // namespace umbrix::detail
