// SPDX-License-Identifier: Apache-2.0
// The public contract, call by call. That answers are right at scale is the business of tests/oracle.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Two unit squares facing z, at z = 1 and z = 2; each is mesh of its own, of two triangles.
struct Squares {
  std::vector<float> vertices[2];
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};

  MeshView view(int i) {
    const float z = static_cast<float>(i + 1);
    vertices[i] = {0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z};
    MeshView mesh;
    mesh.vertices = vertices[i].data();
    mesh.vertex_count = 4;
    mesh.indices = indices.data();
    mesh.triangle_count = 2;
    return mesh;
  }
};

Ray up(float x, float y, float tmin = 0, float tmax = kInfinity) { return {{x, y, 0}, tmin, {0, 0, 1}, tmax}; }

/// Makes what the kernel needs, learning from a ray or two.
void prepare(Scene& scene, KernelId kernel) {
  const Ray rays[2] = {up(0.75f, 0.25f), up(0.5f, 0.25f, 1, 2)};
  Training training;
  training.rays = {rays, 2};
  ASSERT_TRUE(scene.prepare(kernel, training).ok());
}

class EveryKernel : public testing::TestWithParam<std::size_t> {
 protected:
  QueryOptions options() const {
    QueryOptions o;
    o.kernel.index = static_cast<int>(GetParam());
    return o;
  }
  bool occluded(const Ray& ray) const { return scene.occluded(ray, options()); }

  void SetUp() override {
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(scene.add(squares.view(i)).ok());
    ASSERT_TRUE(scene.commit().ok());
    prepare(scene, options().kernel);
  }

  Squares squares;
  Scene scene;
};

TEST_P(EveryKernel, HitsClosedTrianglesWithinTheOpenInterval) {
  EXPECT_TRUE(occluded(up(0.5f, 0.25f)));
  EXPECT_TRUE(occluded(up(0.5f, 0.5f))) << "the shared edge";
  EXPECT_TRUE(occluded(up(0, 0))) << "a vertex";
  EXPECT_TRUE(occluded(up(1, 0.5f))) << "the outer edge";
  EXPECT_FALSE(occluded(up(std::nextafter(1.0f, 2.0f), 0.5f)));
  EXPECT_FALSE(occluded(up(0.5f, 0.5f, 0, 1))) << "a hit at tmax";
  EXPECT_TRUE(occluded(up(0.5f, 0.5f, 0, std::nextafter(1.0f, 2.0f))));
  EXPECT_FALSE(occluded(up(0.5f, 0.5f, 2, kInfinity))) << "a hit at tmin";
  EXPECT_TRUE(occluded(up(0.5f, 0.5f, std::nextafter(2.0f, 1.0f), kInfinity)));
  EXPECT_FALSE(occluded(up(0.5f, 0.5f, 1, 2))) << "between the squares";
  EXPECT_TRUE(occluded(up(0.5f, 0.5f, -kInfinity, kInfinity)));
}

TEST_P(EveryKernel, DoesNotHitFromWithinThePlane) {
  EXPECT_FALSE(occluded({{-1, 0.5f, 1}, 0, {1, 0, 0}, kInfinity}));
  EXPECT_FALSE(occluded({{0.5f, 0.5f, 1}, -1, {1, 1, 0}, 1}));
}

TEST_P(EveryKernel, TakesInvalidRaysForMisses) {
  const Ray good = up(0.5f, 0.25f);
  ASSERT_TRUE(occluded(good));
  for (const float bad : {kNaN, kInfinity, -kInfinity})
    for (int k = 0; k < 3; ++k) {
      Ray ray = good;
      ray.origin[k] = bad;
      EXPECT_FALSE(occluded(ray));
      ray = good;
      ray.direction[k] = bad;
      EXPECT_FALSE(occluded(ray));
    }
  EXPECT_FALSE(occluded({{0.5f, 0.25f, 0}, 0, {0, 0, 0}, kInfinity}));
  EXPECT_FALSE(occluded(up(0.5f, 0.25f, 3, 2)));
  EXPECT_FALSE(occluded(up(0.5f, 0.25f, 1.5f, 1.5f)));
  EXPECT_FALSE(occluded(up(0.5f, 0.25f, kNaN, 2)));
  EXPECT_FALSE(occluded(up(0.5f, 0.25f, 0, kNaN)));
}

TEST_P(EveryKernel, FindsTheClosestAndBreaksTiesByOrder) {
  Hit hit;
  ASSERT_TRUE(scene.closest(up(0.75f, 0.25f), hit, options()));
  EXPECT_EQ(hit.primitive.mesh, 0u);
  EXPECT_EQ(hit.primitive.triangle, 0u);
  EXPECT_EQ(hit.t, 1);
  EXPECT_EQ(hit.u, 0.5f);
  EXPECT_EQ(hit.v, 0.25f);
  ASSERT_TRUE(scene.closest(up(0.5f, 0.5f), hit, options()));
  EXPECT_EQ(hit.primitive.triangle, 0u) << "on the shared edge";
  ASSERT_TRUE(scene.closest(up(0.25f, 0.75f, 1), hit, options()));
  EXPECT_EQ(hit.primitive.mesh, 1u);
  EXPECT_EQ(hit.primitive.triangle, 1u);
  EXPECT_FALSE(scene.closest(up(2, 2), hit, options()));
  EXPECT_FALSE(hit.valid());
}

TEST_P(EveryKernel, LeavesOutTheSkippedTriangleOnly) {
  const Ray rays[3] = {up(0.75f, 0.25f), up(0.75f, 0.25f), up(0.75f, 0.25f, 0, 1.5f)};
  const Primitive skip[3] = {{}, {0, 0}, {0, 0}};
  QueryOptions o = options();
  o.skip = skip;
  Hit hits[3];
  scene.closest(RaySpan{rays, 3, sizeof(Ray)}, hits, o);
  EXPECT_EQ(hits[0].primitive.mesh, 0u);
  EXPECT_EQ(hits[1].primitive.mesh, 1u);
  EXPECT_FALSE(hits[2].valid());
  std::uint8_t blocked[3];
  scene.occluded(RaySpan{rays, 3, sizeof(Ray)}, blocked, o);
  EXPECT_EQ(blocked[0], 1);
  EXPECT_EQ(blocked[1], 1);
  EXPECT_EQ(blocked[2], 0);
}

TEST_P(EveryKernel, CountsWhatItDoes) {
  const Ray rays[3] = {up(0.5f, 0.25f), up(3, 3), up(kNaN, 0)};
  std::uint8_t out[3];
  OcclusionCounts counts;
  scene.occluded(RaySpan{rays, 3, sizeof(Ray)}, out, counts, options());
  EXPECT_EQ(counts.occluded.rays, 1u);
  EXPECT_EQ(counts.unoccluded.rays, 2u);
  EXPECT_EQ(counts.unoccluded.invalid_rays, 1u);
  EXPECT_GE(counts.occluded.primitive_tests, 1u);
}

std::vector<std::size_t> all_kernels() {
  std::vector<std::size_t> result(kernel_count());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = i;
  return result;
}

std::string name_of(const testing::TestParamInfo<std::size_t>& info) {
  std::string name = kernel_info(info.param).name;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel, testing::ValuesIn(all_kernels()), name_of);

TEST(Scene, AppliesMasksAndOpacity) {
  Squares squares;
  Scene scene;
  MeshView low = squares.view(0), high = squares.view(1);
  low.mask = 1;
  high.mask = 2;
  // The upper square is a sheet with a hole: see-through where v < 1/2 of its first triangle.
  high.opacity.opaque = [](const void*, std::uint32_t triangle, float, float v) { return triangle == 1 || v >= 0.5f; };
  ASSERT_TRUE(scene.add(low).ok());
  ASSERT_TRUE(scene.add(high).ok());
  ASSERT_TRUE(scene.commit().ok());
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    SCOPED_TRACE(kernel_info(k).name);
    QueryOptions options;
    options.kernel.index = static_cast<int>(k);
    prepare(scene, options.kernel);
    EXPECT_TRUE(scene.occluded(up(0.75f, 0.25f), options));
    options.mask = 2;
    EXPECT_FALSE(scene.occluded(up(0.75f, 0.25f), options)) << "through the hole";
    EXPECT_TRUE(scene.occluded(up(0.75f, 0.625f), options));
    EXPECT_TRUE(scene.occluded(up(0.25f, 0.75f), options));
    options.mask = 4;
    EXPECT_FALSE(scene.occluded(up(0.25f, 0.75f), options));
  }
}

TEST(Scene, DropsAndCountsWhatCannotBeHit) {
  std::vector<float> v = {0, 0, 1, 1,         0, 1, 0, 1, 1,  // fine
                          0, 0, 2, 1,         0, 2, 2, 0, 2,  // no area
                          0, 0, 3, kNaN,      0, 3, 0, 1, 3,  // not finite
                          0, 0, 4, kInfinity, 0, 4, 0, 1, 4};
  MeshView mesh;
  mesh.vertices = v.data();
  mesh.vertex_count = 12;
  mesh.triangle_count = 4;
  Scene scene;
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit().ok());
  EXPECT_EQ(scene.build_stats().triangles, 4u);
  EXPECT_EQ(scene.build_stats().dropped_degenerate, 1u);
  EXPECT_EQ(scene.build_stats().dropped_nonfinite, 2u);
  float lower[3], upper[3];
  ASSERT_TRUE(scene.bounds(lower, upper));
  EXPECT_EQ(upper[2], 1);
}

TEST(Scene, BuildsTheTreeOnDemand) {
  Squares squares;
  std::vector<Ray> rays;
  for (int i = 0; i < 4096; ++i) {
    const float x = static_cast<float>(i % 64) / 32 - 0.5f, y = static_cast<float>(i / 64) / 32 - 0.5f;
    rays.push_back({{x, y, 0}, 0, {0.5f - x, 0.5f - y, 3}, 1});
  }
  for (const TreeBuild when : {TreeBuild::on_demand, TreeBuild::at_commit}) {
    BuildOptions options;
    options.tree = when;
    Scene scene;
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(scene.add(squares.view(i)).ok());
    ASSERT_TRUE(scene.commit(options).ok());
    const bool at_once = when == TreeBuild::at_commit;
    EXPECT_EQ(scene.build_stats().nodes > 0, at_once);
    EXPECT_GT(scene.build_stats().box_bytes, 0u);
    std::vector<std::uint8_t> out(rays.size()), by_tree(rays.size());
    scene.occluded({rays.data(), rays.size()}, out.data());
    EXPECT_EQ(scene.build_stats().nodes > 0, at_once) << "a frame of rays to one light does without";
    const std::uint64_t before = scene.build_stats().bytes;
    QueryOptions standard;
    ASSERT_TRUE(find_kernel("standard", standard.kernel).ok());
    scene.occluded({rays.data(), rays.size()}, by_tree.data(), standard);
    EXPECT_EQ(out, by_tree);
    const BuildStats& stats = scene.build_stats();
    EXPECT_GT(stats.nodes, 0u);
    EXPECT_EQ(stats.bytes - before, at_once ? 0 : stats.node_bytes + stats.leaf_bytes);
  }
}

TEST(Scene, RefusesBadMeshesAndStaysUsable) {
  Squares squares;
  Scene scene;
  MeshView bad = squares.view(0);
  bad.vertex_count = 3;
  EXPECT_EQ(scene.add(bad).code(), StatusCode::invalid_argument);
  bad = squares.view(0);
  bad.vertices = nullptr;
  EXPECT_EQ(scene.add(bad).code(), StatusCode::invalid_argument);
  bad = squares.view(0);
  bad.vertex_stride = 10;
  EXPECT_EQ(scene.add(bad).code(), StatusCode::invalid_argument);
  std::uint32_t id = 9;
  ASSERT_TRUE(scene.add(squares.view(0), &id).ok());
  EXPECT_EQ(id, 0u);
  EXPECT_FALSE(scene.occluded(up(0.5f, 0.25f))) << "not committed yet";
  ASSERT_TRUE(scene.commit().ok());
  EXPECT_TRUE(scene.occluded(up(0.5f, 0.25f)));
  EXPECT_EQ(scene.add(squares.view(1)).code(), StatusCode::invalid_argument) << "after commit";
  EXPECT_EQ(scene.commit().code(), StatusCode::invalid_argument);
}

TEST(Scene, WorksEmpty) {
  Scene scene;
  EXPECT_FALSE(scene.occluded(up(0, 0)));
  ASSERT_TRUE(scene.commit().ok());
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    QueryOptions options;
    options.kernel.index = static_cast<int>(k);
    prepare(scene, options.kernel);
    Hit hit;
    EXPECT_FALSE(scene.occluded(up(0, 0), options));
    EXPECT_FALSE(scene.closest(up(0, 0), hit, options));
  }
}

TEST(Scene, ReadsStridedVerticesAndRays) {
  struct Vertex {
    float x, y, z, nx, ny, nz;
  };
  const Vertex vertices[3] = {{0, 0, 1, 9, 9, 9}, {1, 0, 1, 9, 9, 9}, {0, 1, 1, 9, 9, 9}};
  MeshView mesh;
  mesh.vertices = &vertices[0].x;
  mesh.vertex_count = 3;
  mesh.vertex_stride = sizeof(Vertex);
  mesh.triangle_count = 1;
  Scene scene;
  ASSERT_TRUE(scene.add(mesh).ok());
  ASSERT_TRUE(scene.commit().ok());
  struct Padded {
    Ray ray;
    double other;
  };
  const Padded rays[2] = {{up(0.25f, 0.25f), 1}, {up(0.75f, 0.75f), 2}};
  std::uint8_t out[2];
  scene.occluded(RaySpan{&rays[0].ray, 2, sizeof(Padded)}, out);
  EXPECT_EQ(out[0], 1);
  EXPECT_EQ(out[1], 0);
}

TEST(Kernels, AreFoundByName) {
  KernelId id;
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    ASSERT_TRUE(find_kernel(kernel_info(k).name, id).ok());
    EXPECT_EQ(id.index, static_cast<int>(k));
  }
  const Status status = find_kernel("no-such-kernel", id);
  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_NE(status.message().find("standard"), std::string::npos);
}

}  // namespace
}  // namespace umbrix
