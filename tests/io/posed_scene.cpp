// SPDX-License-Identifier: Apache-2.0
#include "posed_scene.h"

#include <gtest/gtest.h>

namespace umbrix::io::testing {

SceneFile load(const Gltf& g) {
  const TempFolder folder;
  SceneFile scene;
  const Status status = load_scene(folder.write("scene.glb", g.glb()), scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

SceneChanges pose(SceneFile& scene, double seconds) {
  SceneChanges changes;
  Moment moment;
  moment.seconds = seconds;
  const Status status = pose_scene(scene, moment, changes);
  EXPECT_TRUE(status.ok()) << status.message();
  return changes;
}

Double3 corner(const SceneFile& scene, std::size_t instance, std::size_t vertex) {
  const Transform& m = scene.instances.at(instance).to_world;
  const Float3& p = scene.meshes.at(scene.instances[instance].mesh).positions.at(vertex);
  Double3 out;
  for (std::size_t r = 0; r < 3; ++r) out[r] = m[r][0] * p[0] + m[r][1] * p[1] + m[r][2] * p[2] + m[r][3];
  return out;
}

void expect_near(const Double3& is, const Double3& wanted) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-6) << "axis " << i;
}

void animate_weights(Gltf& g, int node, const std::vector<float>& times, const std::vector<float>& values,
                     const char* interpolation) {
  const int input = g.accessor(bytes_of(times), 5126, times.size(), "SCALAR");
  const int output = g.accessor(bytes_of(values), 5126, values.size(), "SCALAR");
  g.json["animations"].push_back(
      {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}}}});
}

}  // namespace umbrix::io::testing
