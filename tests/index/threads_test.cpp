// SPDX-License-Identifier: Apache-2.0
// Side tables that grow while rays are traced (links, the wide tree), and all others, are shared by threads from the
// first ray on. The thread sanitizer watches here; threads of our own, as it does not know oneTBB's.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "small_scene.h"
#include "umbrix/umbrix.h"

namespace umbrix::detail {
namespace {

constexpr unsigned kThreads = 4;
constexpr std::size_t kBatch = 50;

template <class Body>
void on_threads(const Body& body) {
  std::vector<std::thread> workers;
  for (unsigned t = 1; t < kThreads; ++t) workers.emplace_back(body);
  body();
  for (std::thread& worker : workers) worker.join();
}

/// Runs all indices on new threads.
void parallel_for(void*, std::size_t count, void (*body)(void*, std::size_t), void* data) {
  std::atomic<std::size_t> next{0};
  on_threads([&] {
    for (std::size_t i; (i = next.fetch_add(1)) < count;) body(data, i);
  });
}

TEST(Threads, ShareAFreshSceneWithEveryKernel) {
  constexpr std::uint32_t kSeed = 50;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  Executor executor;
  executor.parallel_for = parallel_for;
  const std::vector<Triangle> triangles = random_soup(600, 0.2f, kSeed);
  MeshView mesh;
  mesh.vertices = &triangles[0].v[0].x;
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  BuildOptions build;
  build.executor = &executor;
  Scene scene;
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit(build).ok());

  const std::vector<Ray> rays = rays_to_light(2000, Vec3(0.7f, 0.4f, 1.5f), kSeed + 1);
  QueryOptions options;
  ASSERT_TRUE(find_kernel("brute", options.kernel).ok());
  std::vector<std::uint8_t> truth(rays.size());
  scene.occluded({rays.data(), rays.size()}, truth.data(), options);

  for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
    SCOPED_TRACE(kernel_info(kernel).name);
    options.kernel.index = static_cast<int>(kernel);
    Training training;
    training.rays = {rays.data(), 300};
    training.executor = &executor;
    ASSERT_TRUE(scene.prepare(options.kernel, training).ok());
    std::vector<std::uint8_t> out(rays.size());
    std::vector<Hit> hits(rays.size());
    std::atomic<std::size_t> next{0};
    on_threads([&] {
      for (std::size_t begin; (begin = kBatch * next.fetch_add(1)) < rays.size();) {
        const RaySpan batch = {rays.data() + begin, kBatch};
        scene.occluded(batch, out.data() + begin, options);
        scene.closest(batch, hits.data() + begin, options);
      }
    });
    EXPECT_EQ(out, truth);
    for (std::size_t i = 0; i < rays.size(); ++i) ASSERT_EQ(hits[i].valid(), truth[i] != 0) << "ray " << i;
  }
}

/// As from a tile to the sun: those that the default kernel wants the tree for.
std::vector<Ray> side_by_side(std::size_t count) {
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 0.03f * static_cast<float>(i % 60) - 0.9f, y = 0.05f * static_cast<float>(i / 60 % 34) - 0.9f;
    rays.push_back({{x, y, -2}, 0, {0.1f, 0.2f, 4}, 0.4f});
  }
  return rays;
}

TEST(Threads, BuildTheTreeWhenItIsNeeded) {
  constexpr std::uint32_t kSeed = 60;
  SCOPED_TRACE("seed " + std::to_string(kSeed));
  const std::vector<Triangle> triangles = random_soup(600, 0.2f, kSeed);
  MeshView mesh;
  mesh.vertices = &triangles[0].v[0].x;
  mesh.vertex_count = 3 * triangles.size();
  mesh.triangle_count = triangles.size();
  const std::vector<Ray> rays = side_by_side(2000);
  const RaySpan all = {rays.data(), rays.size()};
  // By turns kernels that need it at once, the default one, for whose few rays it comes to pay, and who asks for it.
  for (const char* const name : {"standard", "auto", "wide"}) {
    SCOPED_TRACE(name);
    QueryOptions options;
    ASSERT_TRUE(find_kernel("brute", options.kernel).ok());
    Scene scene;
    ASSERT_TRUE(scene.add(mesh).ok());
    ASSERT_TRUE(scene.commit().ok());
    std::vector<std::uint8_t> truth(rays.size());
    scene.occluded(all, truth.data(), options);
    EXPECT_EQ(scene.build_stats().nodes, 0u);
    ASSERT_TRUE(find_kernel(name, options.kernel).ok());
    std::atomic<int> wrong{0};
    std::atomic<std::uint64_t> nodes{0};
    on_threads([&] {
      std::uint8_t out[kBatch];
      Hit hits[kBatch];
      for (int repeat = 0; repeat < 10; ++repeat) {
        for (std::size_t begin = 0; begin < rays.size(); begin += kBatch) {
          const RaySpan batch = {rays.data() + begin, kBatch};
          scene.occluded(batch, out, options);
          scene.closest(batch, hits, options);
          for (std::size_t i = 0; i < kBatch; ++i) wrong += out[i] != truth[begin + i] || hits[i].valid() != out[i];
          nodes += scene.build_stats().nodes;
        }
      }
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(nodes, 0u);
    EXPECT_GT(scene.build_stats().nodes, 0u) << "built by the rays";
  }
}

}  // namespace
}  // namespace umbrix::detail
