// SPDX-License-Identifier: Apache-2.0
// What must be true of the counts of each way to walk the same tree. That answers are right is tested elsewhere.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

class Peers : public testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> u(-1, 1);
    std::vector<float> vertices;
    for (int i = 0; i < 3000; ++i) {
      const float center[3] = {u(random), u(random), u(random)};
      for (int k = 0; k < 9; ++k) vertices.push_back(center[k % 3] + 0.06f * u(random));
    }
    MeshView mesh;
    mesh.vertices = vertices.data();
    mesh.vertex_count = 9000;
    mesh.triangle_count = 3000;
    ASSERT_TRUE(scene_.add(mesh).ok());
    ASSERT_TRUE(scene_.commit().ok());
    for (int i = 0; i < 4000; ++i)
      rays_.push_back({{u(random), u(random), u(random)}, 0, {u(random), u(random), u(random)}, 1});
  }

  OcclusionCounts count(const std::string& kernel, const Executor* executor = nullptr) {
    QueryOptions options;
    EXPECT_TRUE(find_kernel(kernel.c_str(), options.kernel).ok());
    Training training;
    training.rays = {rays_.data(), rays_.size()};
    training.executor = executor;
    EXPECT_TRUE(scene_.prepare(options.kernel, training).ok());
    std::vector<std::uint8_t> out(rays_.size());
    OcclusionCounts counts;
    scene_.occluded({rays_.data(), rays_.size()}, out.data(), counts, options);
    return counts;
  }

  Scene scene_;
  std::vector<Ray> rays_;
};

TEST_F(Peers, OrderDoesNotMatterToUnoccludedRays) {
  const OcclusionCounts standard = count("standard");
  ASSERT_GT(standard.occluded.rays, 500u);
  ASSERT_GT(standard.unoccluded.rays, 500u);
  for (const char* name : {"far-first", "sato-box", "sato-area", "sato-count", "sato-cell", "rtsah", "srdh-order"}) {
    SCOPED_TRACE(name);
    const OcclusionCounts counts = count(name);
    EXPECT_EQ(counts.unoccluded.node_tests, standard.unoccluded.node_tests);
    EXPECT_EQ(counts.unoccluded.primitive_tests, standard.unoccluded.primitive_tests);
    EXPECT_NE(counts.occluded.node_tests, standard.occluded.node_tests);
    EXPECT_EQ(counts.occluded.restarts + counts.unoccluded.restarts, 0u);
  }
}

TEST_F(Peers, OrderLearnedFromTheRaysIsBetterForThem) {
  EXPECT_LT(count("srdh-order").occluded.primitive_tests, count("standard").occluded.primitive_tests);
}

TEST_F(Peers, SideTablesDoNotDependOnTheExecutor) {
  // Backwards and on one thread; oneTBB is another schedule.
  const Executor backwards{[](void*, std::size_t count, void (*body)(void*, std::size_t), void* data) {
                             while (count-- > 0) body(data, count);
                           },
                           nullptr};
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    if (!kernel_info(k).needs_preparation) continue;
    SCOPED_TRACE(kernel_info(k).name);
    const OcclusionCounts a = count(kernel_info(k).name), b = count(kernel_info(k).name, &backwards);
    EXPECT_EQ(a.occluded.node_tests, b.occluded.node_tests);
    EXPECT_EQ(a.occluded.primitive_tests, b.occluded.primitive_tests);
    EXPECT_EQ(a.unoccluded.node_tests, b.unoccluded.node_tests);
  }
}

TEST_F(Peers, RestartsReplaceTheStackAndChangeNoLeaf) {
  const RayCounts standard = count("standard").unoccluded;
  EXPECT_EQ(standard.restarts, 0u);
  for (const char* name : {"kd-restart", "restart-trail", "push-down", "kd-backtrack", "short-stack"}) {
    SCOPED_TRACE(name);
    const RayCounts counts = count(name).unoccluded;
    EXPECT_EQ(counts.leaf_visits, standard.leaf_visits);
    EXPECT_EQ(counts.primitive_tests, standard.primitive_tests);
    EXPECT_GT(counts.restarts, 0u);
    EXPECT_GT(counts.node_tests, standard.node_tests);
  }
}

TEST_F(Peers, RestartsCostLessTheMoreAKernelRemembers) {
  const RayCounts restart = count("kd-restart").unoccluded;
  const RayCounts trail = count("restart-trail").unoccluded;
  const RayCounts push_down = count("push-down").unoccluded;
  const RayCounts short_stack = count("short-stack").unoccluded;
  EXPECT_EQ(restart.restarts, restart.leaf_visits - restart.rays) << "one for each leaf but the first";
  EXPECT_EQ(trail.node_tests, restart.node_tests);
  EXPECT_LT(push_down.node_tests, restart.node_tests);
  EXPECT_EQ(push_down.restarts, restart.restarts);
  EXPECT_LT(10 * short_stack.restarts, push_down.restarts);
}

}  // namespace
}  // namespace umbrix
