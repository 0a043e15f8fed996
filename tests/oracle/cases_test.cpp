// SPDX-License-Identifier: Apache-2.0
//
// Every kernel on every instruction set on every hard case: the answers are those of exact arithmetic, and cases that
// claim more (no leak, no acne, the same as before a change) are right to do so.
#include "cases/cases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "case_parameters.h"
#include "judge/judge.h"
#include "judge/minimise.h"
#include "test_rays.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

class HardCase : public testing::TestWithParam<const char*> {};

TEST_P(HardCase, EveryKernelIsRight) {
  const cases::Case& c = *cases::find_case(GetParam());
  const std::size_t rays = test_rays(500);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " rays " << rays);
    const cases::CaseData data = c.make(seed, rays);
    Options options;
    options.targets = Targets::all;
    options.rays_on_each_target = rays;
    options.truth.claim = c.claim;
    options.truth.closest_rays = static_cast<std::size_t>(static_cast<double>(rays) * c.closest_share) + 1;
    options.mode = c.mode;
    Result result;
    const Status status = judge(data, options, result);
    ASSERT_TRUE(status.ok()) << status.message();
    ASSERT_GE(result.answers.total(), rays * (kernel_count() - 1) * simd_target_count());
    EXPECT_EQ(result.truth.refuted, std::vector<std::size_t>()) << "rays that are not as the case claims";
    EXPECT_EQ(result.complaints.size(), 0u);
    for (std::size_t i = 0; i < std::min<std::size_t>(result.complaints.size(), 3); ++i) {
      ADD_FAILURE() << minimise(data, result.complaints[i]).text;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, HardCase, testing::ValuesIn(case_names()), case_test_name);

}  // namespace
}  // namespace umbrix::judge
