// SPDX-License-Identifier: Apache-2.0
//
// Every kernel on every instruction set on every hard case: the answers are those of exact arithmetic, and cases that
// claim more (no leak, no acne, the same as before a change) are right to do so.
#include "cases/cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  const std::size_t rays = std::max<std::size_t>(1, test_rays(500) / (c.is_slow ? 8 : 1));
  const std::uint64_t seeds = c.is_variant ? 1 : 3;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << " rays " << rays);
    const cases::CaseData data = c.make(seed, rays);
    Options options;
    options.targets = Targets::all;
    options.rays_on_each_target = rays;
    options.truth.claim = c.claim;
    options.truth.closest_rays = rays / 4;
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

/// Are most rays within 1/64 of the scene's extent of the one before? Only then are a few hundred answered as the light
/// sees them (src/kernels/near_rays.h).
bool start_near_each_other(const cases::CaseData& data) {
  float low[3], high[3], extent = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = high[k] = data.triangles[0].v[0][k];
    for (const oracle::Triangle& t : data.triangles)
      for (const auto& vertex : t.v) {
        low[k] = std::min(low[k], vertex[k]);
        high[k] = std::max(high[k], vertex[k]);
      }
    extent = std::max(extent, high[k] - low[k]);
  }
  std::size_t near = 0;
  for (std::size_t i = 1; i < data.rays.size(); ++i) {
    const float(&a)[3] = data.rays[i - 1].origin, (&b)[3] = data.rays[i].origin;
    near += std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) < extent / 64 ? 1 : 0;
  }
  return near > data.rays.size() * 3 / 4;
}

TEST(OneLight, ManyScenesAreForTheLightsView) {
  for (const char* name : {"one_light", "one_light_in_plane", "one_light_at_vertex", "one_light_near"}) {
    std::size_t count = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
      count += start_near_each_other(cases::find_case(name)->make(seed, 400)) ? 1 : 0;
    EXPECT_GE(count, 10u) << name;
  }
}

}  // namespace
}  // namespace umbrix::judge
