// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "judge/judge.h"

namespace umbrix::bench {

/// Wrong answers to occlusion queries, by what they would do to a picture. A ray counts once for each.
struct WrongRays {
  std::uint64_t leaks = 0;          ///< occluded, and answered otherwise
  std::uint64_t false_shadows = 0;  ///< not occluded, and answered otherwise

  std::uint64_t total() const { return leaks + false_shadows; }
  void add(const WrongRays& other);
};

/// What was asked in a row or a case of it, and what was wrong.
struct Counts {
  std::uint64_t rays = 0;
  std::uint64_t occluded = 0;  ///< in truth
  std::uint64_t by_oracle = 0;
  judge::AnswerCounts answers;
  WrongRays ours;
  std::uint64_t closest_wrong = 0;
  std::uint64_t refuted = 0;    ///< rays for which a claim (no acne, no leak, the same as its twin) does not hold
  std::uint64_t different = 0;  ///< checks that compare ways to ask, not with the truth
  std::uint64_t embree_rays = 0;
  WrongRays embree_robust, embree_fast;
  std::uint64_t embree_robust_at_ends = 0;  ///< wrong, but right for ends a little elsewhere
  std::uint64_t embree_fast_at_ends = 0;
  double seconds = 0;
  double slowest_build = 0;         ///< seconds
  std::uint64_t largest_scene = 0;  ///< bytes
  std::vector<std::string> notes;

  std::uint64_t failures() const { return ours.total() + closest_wrong + refuted + different; }
  void add(const Counts& other);
  nlohmann::json to_json() const;
};

}  // namespace umbrix::bench
