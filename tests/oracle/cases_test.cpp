// SPDX-License-Identifier: Apache-2.0
//
// Every kernel on every hard case: the answers are those of exact arithmetic. Instruction sets differ in the test of a
// leaf, which tree walks share, so two of those stand for the others on all but the best one.
#include "cases/cases.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "case_parameters.h"
#include "judge/judge.h"
#include "judge/minimise.h"
#include "test_rays.h"

namespace umbrix::judge {
namespace {

class HardCase : public testing::TestWithParam<const char*> {};

TEST_P(HardCase, EveryKernelIsRight) {
  const cases::Case& c = *cases::find_case(GetParam());
  const auto rays = static_cast<std::size_t>(static_cast<double>(test_rays(1500)) * c.share) + 1;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " rays " << rays);
    const cases::CaseData data = c.make(seed, rays);
    Options options;
    options.all_targets = true;
    options.on_all_targets = {"auto", "standard", "linked"};
    options.closest_rays = rays / 2;
    Result result;
    const Status status = judge(data, options, result);
    ASSERT_TRUE(status.ok()) << status.message();
    ASSERT_GE(result.answers, rays);
    EXPECT_EQ(result.complaints.size(), 0u);
    for (std::size_t i = 0; i < std::min<std::size_t>(result.complaints.size(), 3); ++i) {
      ADD_FAILURE() << describe(data, result.complaints[i]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, HardCase, testing::ValuesIn(case_names()), case_test_name);

}  // namespace
}  // namespace umbrix::judge
