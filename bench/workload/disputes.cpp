// SPDX-License-Identifier: Apache-2.0
#include "workload/disputes.h"

#include <algorithm>

#include "oracle/brute_force.h"

namespace umbrix::workload {

std::vector<std::uint64_t> count_wrong(const Geometry& geometry, const std::vector<Ray>& rays,
                                       const std::vector<const std::vector<std::uint8_t>*>& answers) {
  std::vector<std::size_t> disputed;
  std::vector<Ray> disputed_rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto agrees = [&](const std::vector<std::uint8_t>* peer) { return (*peer)[i] == (*answers[0])[i]; };
    if (std::all_of(answers.begin(), answers.end(), agrees)) continue;
    disputed.push_back(i);
    disputed_rays.push_back(rays[i]);
  }
  std::vector<std::uint64_t> wrong(answers.size(), 0);
  if (disputed.empty()) return wrong;
  const oracle::BruteForce truth(geometry.triangle_list());
  const std::vector<std::uint8_t> right = truth.occluded(disputed_rays);
  for (std::size_t peer = 0; peer < answers.size(); ++peer) {
    for (std::size_t i = 0; i < disputed.size(); ++i) wrong[peer] += (*answers[peer])[disputed[i]] != right[i] ? 1 : 0;
  }
  return wrong;
}

}  // namespace umbrix::workload
