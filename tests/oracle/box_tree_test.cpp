// SPDX-License-Identifier: Apache-2.0
//
// The judge of many rays against brute force: its boxes must never lose a hit.
#include "oracle/box_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "case_parameters.h"
#include "cases/cases.h"
#include "oracle/brute_force.h"
#include "test_rays.h"

namespace umbrix::oracle {
namespace {

class BoxTreeCase : public testing::TestWithParam<const char*> {};

TEST_P(BoxTreeCase, AgreesWithBruteForce) {
  for (std::uint64_t seed = 20; seed < 22; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const cases::CaseData data = cases::find_case(GetParam())->make(seed, test_rays(1000));
    EXPECT_EQ(BoxTree(data.triangles).occluded(data.rays), BruteForce(data.triangles).occluded(data.rays));
  }
}

INSTANTIATE_TEST_SUITE_P(AllCases, BoxTreeCase, testing::ValuesIn(case_names()), case_test_name);

TEST(BoxTree, OfNothing) {
  const Ray ray = {{0, 0, 0}, 0, {0, 0, 1}, 10};
  EXPECT_FALSE(BoxTree(std::vector<Triangle>()).occluded(ray));
  const std::vector<Triangle> no_number = {{{{-1, -1, NAN}, {2, -1, 1}, {-1, 2, 1}}}};
  EXPECT_FALSE(BoxTree(no_number).occluded(ray));
}

}  // namespace
}  // namespace umbrix::oracle
