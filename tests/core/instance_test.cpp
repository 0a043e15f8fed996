// SPDX-License-Identifier: Apache-2.0
// The contract of prototypes and instances, call by call. That answers are right is the business of tests/oracle.

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A square of 2 * cells * cells triangles in the plane z = 0, from -1 to 1.
struct Sheet {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;

  explicit Sheet(std::uint32_t cells) {
    const std::uint32_t side = cells + 1;
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        vertices.push_back(2 * static_cast<float>(x) / static_cast<float>(cells) - 1);
        vertices.push_back(2 * static_cast<float>(y) / static_cast<float>(cells) - 1);
        vertices.push_back(0);
      }
    for (std::uint32_t y = 0; y < cells; ++y)
      for (std::uint32_t x = 0; x < cells; ++x) {
        const std::uint32_t i = y * side + x;
        indices.insert(indices.end(), {i, i + 1, i + side + 1, i, i + side + 1, i + side});
      }
  }

  MeshView view() const {
    MeshView mesh;
    mesh.vertices = vertices.data();
    mesh.vertex_count = vertices.size() / 3;
    mesh.indices = indices.data();
    mesh.triangle_count = indices.size() / 3;
    return mesh;
  }
};

Instance moved(std::uint32_t prototype, double x, double y, double z) {
  Instance instance;
  instance.prototype = prototype;
  instance.to_world[0][3] = x;
  instance.to_world[1][3] = y;
  instance.to_world[2][3] = z;
  return instance;
}

Ray down(float x, float y, float tmax = kInfinity) { return {{x, y, 10}, 0, {0, 0, -1}, tmax}; }

TEST(InstanceContract, RefusesWhatMakesNoSense) {
  const Sheet sheet(2);
  Scene scene;
  Status status = scene.add_instance({});
  EXPECT_EQ(status.code(), StatusCode::invalid_argument);
  EXPECT_EQ(status.message(), "scene: no prototype 0");
  MeshView bad = sheet.view();
  bad.vertex_count = 3;
  EXPECT_EQ(scene.add_prototype(bad).code(), StatusCode::invalid_argument);
  std::uint32_t prototype = 7;
  ASSERT_TRUE(scene.add_prototype(sheet.view(), &prototype).ok());
  EXPECT_EQ(prototype, 0u);
  EXPECT_EQ(scene.add_instance(moved(1, 0, 0, 0)).message(), "scene: no prototype 1");
  ASSERT_TRUE(scene.add_instance(moved(0, 0, 0, 0)).ok());
  ASSERT_TRUE(scene.commit().ok());
  EXPECT_EQ(scene.add_prototype(sheet.view()).code(), StatusCode::invalid_argument);
  EXPECT_EQ(scene.add_instance(moved(0, 1, 0, 0)).code(), StatusCode::invalid_argument);
  EXPECT_TRUE(scene.occluded(down(0.5f, 0.25f)));
}

TEST(InstanceContract, PrototypesAreSeenThroughInstancesAlone) {
  const Sheet sheet(2);
  Scene scene;
  ASSERT_TRUE(scene.add_prototype(sheet.view()).ok());
  ASSERT_TRUE(scene.commit().ok());
  EXPECT_FALSE(scene.occluded(down(0.5f, 0.25f)));
  float lower[3], upper[3];
  EXPECT_FALSE(scene.bounds(lower, upper));
  EXPECT_EQ(scene.build_stats().triangles, 0u);
}

TEST(InstanceContract, InstancesAreNumberedAsMeshes) {
  const Sheet sheet(2);
  Scene scene;
  std::uint32_t numbers[3];
  ASSERT_TRUE(scene.add_prototype(sheet.view()).ok());
  ASSERT_TRUE(scene.add_instance(moved(0, 0, 0, 3), &numbers[0]).ok());
  ASSERT_TRUE(scene.add(sheet.view(), &numbers[1]).ok());
  ASSERT_TRUE(scene.add_instance(moved(0, 0, 0, 2), &numbers[2]).ok());
  ASSERT_TRUE(scene.commit().ok());
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(numbers[i], i);

  // From above: the first instance, the second, the mesh.
  const std::uint32_t order[] = {0, 2, 1};
  const float distances[] = {7, 8, 10};
  Hit hit;
  for (int i = 0; i < 3; ++i) {
    Ray ray = down(0.75f, -0.75f);
    if (i > 0) ray.tmin = distances[i - 1];
    ASSERT_TRUE(scene.closest(ray, hit));
    EXPECT_EQ(hit.primitive.mesh, order[i]);
    EXPECT_EQ(hit.t, distances[i]);
    QueryOptions options;
    options.skip = &hit.primitive;
    ray.tmax = distances[i] + 0.5f;
    EXPECT_TRUE(scene.occluded(ray));
    EXPECT_FALSE(scene.occluded(ray, options));
  }
  float lower[3], upper[3];
  ASSERT_TRUE(scene.bounds(lower, upper));
  EXPECT_EQ(lower[2], 0);
  EXPECT_EQ(upper[2], 3);
}

TEST(InstanceContract, VerticesAreRoundedOnceFromDouble) {
  const double m[3][4] = {{1.0 / 3, 1e-9, 0, 1}, {0, 1e30, -1e30, 0.5}, {0.1, 0.2, 0.3, -0.6}};
  const float local[3] = {3, 1, 1};
  float world[3];
  transform_point(m, local, world);
  EXPECT_EQ(world[0], static_cast<float>(2 + 1e-9));
  EXPECT_EQ(world[1], 0.5f);
  EXPECT_EQ(world[2], static_cast<float>(0.1 * 3 + 0.2 + 0.3 - 0.6));
}

TEST(InstanceContract, MoreTrianglesThanCouldBePlaced) {
  const Sheet sheet(200);
  Scene scene;
  ASSERT_TRUE(scene.add_prototype(sheet.view()).ok());
  constexpr std::uint64_t kInstances = 7000;
  for (std::uint64_t i = 0; i < kInstances; ++i)
    ASSERT_TRUE(scene.add_instance(moved(0, 3.0 * static_cast<double>(i), 0, 0)).ok());
  ASSERT_TRUE(scene.commit().ok());
  const BuildStats& stats = scene.build_stats();
  EXPECT_EQ(stats.triangles, kInstances * 80'000);
  EXPECT_GT(stats.triangles, std::uint64_t{1} << 29);
  EXPECT_EQ(stats.instances, kInstances);
  EXPECT_EQ(stats.instanced_triangles, stats.triangles);
  EXPECT_LT(stats.bytes, 16u << 20) << "a few megabytes, for half a billion triangles";
  Hit hit;
  ASSERT_TRUE(scene.closest(down(3.0f * 6999 + 0.5f, 0.25f), hit));
  EXPECT_EQ(hit.primitive.mesh, 6999u);
  EXPECT_FALSE(scene.occluded(down(3.0f * 6999 + 1.5f, 0.25f))) << "between two of them";
}

TEST(InstanceContract, TransformsWithoutAnInverseArePlaced) {
  const Sheet sheet(4);
  Scene scene;
  ASSERT_TRUE(scene.add_prototype(sheet.view()).ok());
  Instance flat = moved(0, 0, 0, 1);
  flat.to_world[2][2] = 0;  // a sheet it was, and is
  ASSERT_TRUE(scene.add_instance(flat).ok());
  Instance nothing = moved(0, 0, 0, 5);
  nothing.to_world[0][0] = 0;
  ASSERT_TRUE(scene.add_instance(nothing).ok());
  Instance nowhere = moved(0, 0, 0, std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(scene.add_instance(nowhere).ok());
  ASSERT_TRUE(scene.commit().ok());
  const BuildStats& stats = scene.build_stats();
  EXPECT_EQ(stats.instances, 0u);
  EXPECT_EQ(stats.triangles, 96u);
  EXPECT_EQ(stats.dropped_degenerate, 32u);
  EXPECT_EQ(stats.dropped_nonfinite, 32u);
  Hit hit;
  ASSERT_TRUE(scene.closest(down(0.5f, 0.25f), hit));
  EXPECT_EQ(hit.primitive.mesh, 0u);
  EXPECT_EQ(hit.t, 9);
}

}  // namespace
}  // namespace umbrix
