// SPDX-License-Identifier: Apache-2.0
//
// Calls of many rays that an executor's threads share: answers are those of one thread, whatever comes in one call.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <initializer_list>
#include <thread>
#include <utility>
#include <vector>

#include "bundles.h"
#include "two_meshes.h"

namespace umbrix::detail {
namespace {

const Vec3 kLight(0.1f, 0.2f, 0.3f);

/// Threads of its own, of which the last index is begun first; and how many indices there were.
struct Pool {
  static constexpr unsigned kThreads = 3;

  Executor executor{&run, this, kThreads};
  std::atomic<std::size_t> calls{0};

  static void run(void* context, std::size_t count, void (*body)(void*, std::size_t), void* data) {
    static_cast<Pool*>(context)->calls += count;
    std::atomic<std::size_t> left{count};
    const auto work = [&] {
      for (std::size_t i; (i = left.fetch_sub(1)) > 0 && i <= count;) body(data, i - 1);
    };
    std::vector<std::thread> workers;
    for (unsigned t = 1; t < kThreads; ++t) workers.emplace_back(work);
    work();
    for (std::thread& worker : workers) worker.join();
  }
};

/// As a host's whose threads are gone.
void fail(void*, std::size_t, void (*)(void*, std::size_t), void*) { throw 1; }

/// What a call may bring, with a name.
struct Call {
  const char* name;
  std::vector<Ray> rays;
};

std::vector<Call> calls() {
  std::vector<Ray> half = rays_from_walls(150000, kLight);
  const std::vector<Ray> others = rays_to_light(half.size(), kLight, 3);
  std::copy(others.begin() + 75000, others.end(), half.begin() + 75000);
  std::vector<Ray> lights = rays_from_walls(60000, kLight);
  const std::vector<Ray> to_other = rays_from_walls(60000, Vec3(-0.9f, 0.1f, 0.4f));
  std::copy(to_other.begin() + 30000, to_other.end(), lights.begin() + 30000);
  return {{"in order", rays_from_walls(150000, kLight)},
          {"in no order", rays_to_light(150000, kLight, 4)},
          {"in order, then in none", std::move(half)},
          {"to one light, then to another", std::move(lights)},
          {"to an area", bundles(2500, 16, 0.02f, 5)},
          {"few", rays_to_light(300, kLight, 6)},
          {"none", {}}};
}

std::vector<std::uint8_t> ask(const Scene& scene, const std::vector<Ray>& rays, const QueryOptions& options) {
  std::vector<std::uint8_t> out(rays.size(), 7);
  scene.occluded({rays.data(), rays.size()}, out.data(), options);
  return out;
}

std::vector<std::uint8_t> ask_frames(const Scene& scene, const std::vector<Ray>& rays, const Executor* executor) {
  FrameTracer tracer;
  EXPECT_TRUE(tracer.start(scene).ok());
  EXPECT_TRUE(tracer.begin_frame({}).ok());
  ShadowTile tile;
  tile.rays = {rays.data(), rays.size()};
  tile.executor = executor;
  std::vector<std::uint8_t> out(rays.size(), 7);
  tracer.occluded(tile, out.data());
  EXPECT_EQ(tracer.end_frame().rays, rays.size());
  return out;
}

TEST(SharedCalls, HaveTheAnswersOfOneThread) {
  const TwoMeshes two;
  Pool pool;
  const Executor tbb, failing{&fail, nullptr, 2};
  for (const Call& call : calls()) {
    SCOPED_TRACE(call.name);
    const std::vector<std::uint8_t> truth = ask(two.scene, call.rays, {});
    for (const Executor* const executor : std::initializer_list<const Executor*>{&tbb, &pool.executor, &failing}) {
      QueryOptions options;
      options.executor = executor;
      EXPECT_EQ(ask(two.scene, call.rays, options), truth);
      EXPECT_EQ(ask_frames(two.scene, call.rays, executor), truth);
    }
  }
}

TEST(SharedCalls, AreSharedIfTheyAreLarge) {
  const TwoMeshes two;
  for (const Call& call : calls()) {
    Pool pool;
    QueryOptions options;
    options.executor = &pool.executor;
    ask(two.scene, call.rays, options);
    if (call.rays.size() > 10000)
      EXPECT_GT(pool.calls, 1u) << call.name;
    else
      EXPECT_EQ(pool.calls, 0u) << call.name;
  }
  Pool pool;
  ask_frames(two.scene, rays_from_walls(40000, kLight), &pool.executor);
  EXPECT_GT(pool.calls, 1u) << "a frame's tile";
}

/// Each ray has a triangle that is not there for it: the one that it meets first.
TEST(SharedCalls, EachRayHasItsOwnSkip) {
  const TwoMeshes two;
  const Executor tbb;
  for (const std::vector<Ray>& rays : {rays_from_walls(40000, kLight), rays_to_light(40000, kLight, 8)}) {
    const std::vector<Primitive> skip = first_met(two.scene, rays);
    for (const char* const kernel : {"auto", "bvh"}) {
      QueryOptions options;
      ASSERT_TRUE(find_kernel(kernel, options.kernel).ok());
      options.skip = skip.data();
      options.mask = 2;
      const std::vector<std::uint8_t> truth = ask(two.scene, rays, options);
      options.executor = &tbb;
      EXPECT_EQ(ask(two.scene, rays, options), truth) << kernel;
    }
  }
}

TEST(SharedCalls, AreForEveryKernelAndForNearestHits) {
  const TwoMeshes two;
  Pool pool;
  const std::vector<Ray> rays = rays_to_light(9000, kLight, 9);
  for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
    SCOPED_TRACE(kernel_info(kernel).name);
    QueryOptions options;
    options.kernel.index = static_cast<int>(kernel);
    const std::vector<std::uint8_t> truth = ask(two.scene, rays, options);
    std::vector<Hit> nearest(rays.size()), hits(rays.size());
    two.scene.closest({rays.data(), rays.size()}, nearest.data(), options);
    options.executor = &pool.executor;
    EXPECT_EQ(ask(two.scene, rays, options), truth);
    two.scene.closest({rays.data(), rays.size()}, hits.data(), options);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ASSERT_EQ(hits[i].t, nearest[i].t) << "ray " << i;
      ASSERT_EQ(hits[i].primitive.mesh, nearest[i].primitive.mesh) << "ray " << i;
      ASSERT_EQ(hits[i].primitive.triangle, nearest[i].primitive.triangle) << "ray " << i;
    }
  }
}

TEST(SharedCalls, MeetInstances) {
  const std::vector<Triangle> triangles = random_soup(200, 0.3f, 10);
  const std::vector<Triangle> few = random_soup(20, 0.1f, 11);
  Scene scene;
  ASSERT_TRUE(scene.add(view_of(few)).ok());
  Instance instance;
  ASSERT_TRUE(scene.add_prototype(view_of(triangles), &instance.prototype).ok());
  ASSERT_TRUE(scene.add_instance(instance).ok());
  ASSERT_TRUE(scene.commit().ok());
  Pool pool;
  const std::vector<Ray> rays = rays_from_walls(40000, kLight);
  QueryOptions options;
  const std::vector<std::uint8_t> truth = ask(scene, rays, options);
  EXPECT_GT(std::count(truth.begin(), truth.end(), 1), 1000);
  options.executor = &pool.executor;
  EXPECT_EQ(ask(scene, rays, options), truth);
}

TEST(SharedCalls, CountTheSameWork) {
  const TwoMeshes two;
  const Executor tbb;
  const std::vector<Ray> rays = rays_from_walls(40000, kLight);
  std::vector<std::uint8_t> out(rays.size());
  OcclusionCounts alone, shared;
  QueryOptions options;
  two.scene.occluded({rays.data(), rays.size()}, out.data(), alone, options);
  options.executor = &tbb;
  two.scene.occluded({rays.data(), rays.size()}, out.data(), shared, options);
  EXPECT_EQ(shared.unoccluded.node_tests, alone.unoccluded.node_tests);
  EXPECT_EQ(shared.unoccluded.primitive_tests, alone.unoccluded.primitive_tests);
  EXPECT_EQ(shared.occluded.primitive_tests, alone.occluded.primitive_tests);
}

}  // namespace
}  // namespace umbrix::detail
