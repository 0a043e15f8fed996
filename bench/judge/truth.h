// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "cases/cases.h"

namespace umbrix::judge {

/// The right answers to a case's rays.
struct Truth {
  std::vector<std::uint8_t> occluded;
  std::vector<std::uint32_t> closest;  ///< the triangle, or Primitive::kNone; of the first rays
  std::uint64_t by_oracle = 0;         ///< rays that exact arithmetic decided, not only a proof
  std::vector<std::size_t> refuted;    ///< rays for which exact arithmetic says other than the case's claim or its twin
};

/// How much is left to proofs, and how much is asked twice.
struct TruthOptions {
  cases::Claim claim = cases::Claim::none;
  bool trust_claim = false;  ///< the oracle decides a sample only
  std::size_t closest_rays = 0;
};

/// By brute force for scenes of few triangles, else by a BoxTree that brute force confirms on a sample. Answers of a
/// case that has a twin are those of the twin, and the oracle must say the same of the case itself on a sample.
Truth find_truth(const cases::CaseData& data, const TruthOptions& options);

}  // namespace umbrix::judge
