// SPDX-License-Identifier: Apache-2.0
//
// What went wrong once, here or elsewhere, stays right: every kernel on every instruction set.
#include "judge/regressions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "judge/minimise.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

TEST(Regressions, EveryKernelIsRight) {
  std::vector<Regression> regressions;
  const Status status = read_regressions(UMBRIX_REGRESSIONS, regressions);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_GE(regressions.size(), 10u);
  for (const Regression& regression : regressions) {
    SCOPED_TRACE(regression.name);
    const cases::CaseData data = {regression.triangles, {regression.ray}};
    Options options;
    options.targets = Targets::all;
    options.rays_on_each_target = 1;
    options.truth.closest_rays = 1;
    Result result;
    const Status judged = judge(data, options, result);
    ASSERT_TRUE(judged.ok()) << judged.message();
    EXPECT_EQ(result.answers.total(), 2 * kernel_count() * simd_target_count());
    for (const Complaint& complaint : result.complaints) ADD_FAILURE() << minimise(data, complaint).text;
  }
}

TEST(Regressions, TextKeepsEveryBit) {
  const float nan = std::nanf(""), infinity = INFINITY;
  Regression before{"odd numbers", {{{{0x1.8p-149f, -0.0f, infinity}, {nan, 1, 2}, {3, 4, -infinity}}}}, {}};
  before.ray = {{0x1.fffffep127f, -0x1p-126f, 0}, -infinity, {1, 0x1.000002p0f, -1}, infinity};
  const std::string path = testing::TempDir() + "umbrix_regressions_text.txt";
  FILE* file = std::fopen(path.c_str(), "w");
  ASSERT_NE(file, nullptr);
  std::fputs(("# comment\n\n" + to_text(before)).c_str(), file);
  std::fclose(file);
  std::vector<Regression> after;
  const Status status = read_regressions(path, after);
  ASSERT_TRUE(status.ok()) << status.message();
  ASSERT_EQ(after.size(), 1u);
  EXPECT_EQ(after[0].name, before.name);
  ASSERT_EQ(after[0].triangles.size(), 1u);
  EXPECT_EQ(to_text(after[0]), to_text(before));
  EXPECT_EQ(std::memcmp(&after[0].ray, &before.ray, sizeof(Ray)), 0);
}

TEST(Regressions, BadTextNamesTheLine) {
  const std::string path = testing::TempDir() + "umbrix_regressions_bad.txt";
  for (const char* text : {"case a\ntriangle 1 2 3\n", "case a\nray 1 2 3 4 5 6 7 8 9\n", "case a\nsphere 1\n",
                           "# only\nray 0 0 0 0 1 1 1 1\n", "case a\nray 0 0 0 zero 1 1 1 1\n"}) {
    SCOPED_TRACE(text);
    FILE* file = std::fopen(path.c_str(), "w");
    ASSERT_NE(file, nullptr);
    std::fputs(text, file);
    std::fclose(file);
    std::vector<Regression> regressions;
    const Status status = read_regressions(path, regressions);
    EXPECT_EQ(status.code(), StatusCode::bad_input);
    EXPECT_NE(status.message().find(path + ":2: "), std::string::npos) << status.message();
  }
  std::vector<Regression> regressions;
  EXPECT_EQ(read_regressions("/no/such/file", regressions).code(), StatusCode::bad_input);
}

}  // namespace
}  // namespace umbrix::judge
