// SPDX-License-Identifier: Apache-2.0
#include "judge/truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <memory>

#include "judge/blocks.h"
#include "oracle/oracle.h"

namespace umbrix::judge {
namespace {

constexpr std::size_t kSample = 64;  // rays of a chunk that are looked at twice

// Rays spread evenly over all of them.
std::vector<std::size_t> sample_of(std::size_t count) {
  std::vector<std::size_t> sample;
  const std::size_t step = std::max<std::size_t>(1, count / kSample);
  for (std::size_t i = 0; i < count; i += step) sample.push_back(i);
  return sample;
}

// Adds the rays of a sample for which `holds` says no.
template <typename Holds>
void check_sample(const std::vector<Ray>& rays, const Holds& holds, Truth& truth) {
  const std::vector<std::size_t> sample = sample_of(rays.size());
  std::vector<std::uint8_t> is_right(sample.size());
  tbb::parallel_for(std::size_t{0}, sample.size(), [&](std::size_t i) { is_right[i] = holds(sample[i]) ? 1 : 0; });
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (is_right[i] == 0) truth.refuted.push_back(sample[i]);
  }
  truth.by_oracle += sample.size();
}

}  // namespace

Truth find_truth(const cases::CaseData& data, const TruthOptions& options) {
  Truth truth;
  truth.occluded.assign(data.rays.size(), options.claim == cases::Claim::all_occluded ? 1 : 0);
  truth.closest.assign(options.closest_rays, Primitive::kNone);
  const oracle::Oracle own(data.triangles);
  tbb::parallel_for(std::size_t{0}, truth.closest.size(), [&](std::size_t i) {
    if (const auto hit = own.closest(data.rays[i])) truth.closest[i] = hit->triangle;
  });
  const auto agrees = [&](std::size_t i) { return own.occluded(data.rays[i]) == (truth.occluded[i] != 0); };
  if (options.claim != cases::Claim::none && options.trust_claim) {
    check_sample(data.rays, agrees, truth);
    return truth;
  }

  const cases::CaseData& asked = data.same_as ? *data.same_as : data;
  const std::unique_ptr<oracle::Oracle> twin =
      data.same_as ? std::make_unique<oracle::Oracle>(asked.triangles) : nullptr;
  const oracle::Oracle& judge = twin ? *twin : own;
  for_each_block(asked.rays.size(), [&](std::size_t begin, std::size_t count) {
    for (std::size_t i = begin; i < begin + count; ++i) truth.occluded[i] = judge.occluded(asked.rays[i]) ? 1 : 0;
  });
  truth.by_oracle += asked.rays.size();
  for (std::size_t i = 0; i < truth.occluded.size() && options.claim != cases::Claim::none; ++i) {
    if ((truth.occluded[i] != 0) != (options.claim == cases::Claim::all_occluded)) truth.refuted.push_back(i);
  }
  if (twin) check_sample(data.rays, agrees, truth);
  if (own.is_tree() && data.triangles.size() <= 2'000'000) {
    const oracle::BruteForce brute(data.triangles);
    check_sample(
        data.rays, [&](std::size_t i) { return brute.occluded(data.rays[i]) == own.occluded(data.rays[i]); }, truth);
  }
  return truth;
}

}  // namespace umbrix::judge
