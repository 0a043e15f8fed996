// SPDX-License-Identifier: Apache-2.0
#include "stress/regression_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace umbrix::bench {
namespace {

judge::Regression regression(const char* name, float x) {
  return {name, {{{{x, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}, {{0, 0, 0}, 0, {1, 1, 1}, 1}};
}

std::string fresh_path() {
  const std::string path = testing::TempDir() + "umbrix_regression_file.txt";
  std::filesystem::remove(path);
  return path;
}

TEST(RegressionFile, GrowsByWhatIsNew) {
  const std::string path = fresh_path();
  std::size_t added = 0;
  ASSERT_TRUE(append_regressions(path, {regression("a", 1), regression("b", 2)}, &added).ok());
  EXPECT_EQ(added, 2u);
  ASSERT_TRUE(append_regressions(path, {regression("b again", 2), regression("c", 3)}, &added).ok());
  EXPECT_EQ(added, 1u);
  std::vector<judge::Regression> found;
  ASSERT_TRUE(judge::read_regressions(path, found).ok());
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_EQ(found[2].triangles[0].v[0][0], 3);
}

TEST(RegressionFile, KeepsWhatAPersonWrote) {
  const std::string path = fresh_path();
  const std::string before = "# why this is hard\ncase old\nray 0 0 0 0 1 0 0 1";  // no line end
  std::ofstream(path) << before;
  std::size_t added = 0;
  ASSERT_TRUE(append_regressions(path, {regression("new", 1)}, &added).ok());
  std::string after;
  ASSERT_TRUE(judge::read_file(path, after).ok());
  EXPECT_EQ(after.substr(0, before.size() + 1), before + "\n");
  std::vector<judge::Regression> found;
  ASSERT_TRUE(judge::read_regressions(path, found).ok());
  EXPECT_EQ(found.size(), 2u);
}

TEST(RegressionFile, AFolderThatIsNotThereIsAnError) {
  std::size_t added = 0;
  const Status status = append_regressions("/no/such/folder/file.txt", {regression("a", 1)}, &added);
  EXPECT_EQ(status.code(), StatusCode::output_failed);
  EXPECT_NE(status.message().find("/no/such/folder/file.txt"), std::string::npos) << status.message();
}

}  // namespace
}  // namespace umbrix::bench
