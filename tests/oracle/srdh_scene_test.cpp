// SPDX-License-Identifier: Apache-2.0
//
// What SRDH learns on a scene of our own: rays like those it was built for cost fewer node tests.
#include <gtest/gtest.h>

#include <vector>

#include "umbrix/umbrix.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix {
namespace {

OcclusionCounts count(const Scene& scene, const std::vector<Ray>& rays, const QueryOptions& options) {
  std::vector<std::uint8_t> out(rays.size());
  OcclusionCounts counts;
  scene.occluded({rays.data(), rays.size()}, out.data(), counts, options);
  return counts;
}

TEST(SrdhScene, TrainedHierarchyIsBetterThanOneBuiltFromAreas) {
  workload::Geometry geometry;
  workload::Viewpoint viewpoint;
  Scene scene;
  Status status = workload::load_geometry(UMBRIX_SOURCE_DIR "/scenes/atrium.glb", geometry);
  ASSERT_TRUE(status.ok()) << status.message();
  status = workload::find_viewpoint(geometry, "", viewpoint);
  ASSERT_TRUE(status.ok()) << status.message();
  status = workload::build_scene(geometry.views(), {}, scene);
  ASSERT_TRUE(status.ok()) << status.message();
  const std::vector<Ray> rays = workload::shadow_rays(scene, geometry, viewpoint.camera, viewpoint.lights.at(0), 128);
  std::vector<Ray> learned;  // a quarter of them
  for (std::size_t i = 0; i < rays.size(); i += 4) learned.push_back(rays[i]);

  QueryOptions options;
  ASSERT_TRUE(find_kernel("srdh", options.kernel).ok());
  PrepareStats cost;
  ASSERT_TRUE(scene.prepare(options.kernel, {}, &cost).ok());
  EXPECT_GT(cost.bytes, 0u);
  const OcclusionCounts by_area = count(scene, rays, options);
  Training training;
  training.rays = {learned.data(), learned.size()};
  ASSERT_TRUE(scene.prepare(options.kernel, training).ok());
  const OcclusionCounts trained = count(scene, rays, options);
  ASSERT_GT(trained.occluded.rays, 500u);
  EXPECT_LT(trained.occluded.node_tests, by_area.occluded.node_tests * 9 / 10);
  EXPECT_LT(trained.occluded.primitive_tests, by_area.occluded.primitive_tests);
}

}  // namespace
}  // namespace umbrix
