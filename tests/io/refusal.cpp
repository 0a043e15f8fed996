// SPDX-License-Identifier: Apache-2.0
#include "refusal.h"

#include <algorithm>

namespace umbrix::io::testing {

void expect_refused(const std::string& path, StatusCode code, const std::string& fault, const LoadLimits& limits) {
  SceneFile scene;
  const Status status = load_scene(path, scene, limits);
  const std::string& message = status.message();
  EXPECT_EQ(status.code(), code) << message;
  EXPECT_NE(message.find(path.substr(path.rfind('/') + 1)), std::string::npos) << message;
  EXPECT_NE(message.find(fault), std::string::npos) << message;
  EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](unsigned char c) { return c >= 0x20 && c != 0x7F; }))
      << message;
  EXPECT_LT(message.size(), 700u) << message;
  EXPECT_TRUE(scene.meshes.empty() && scene.instances.empty() && scene.path.empty());
}

void expect_refused(const Fault& fault) {
  SCOPED_TRACE(fault.name);
  const TempFolder folder;
  Gltf g = one_triangle();
  fault.make(g);
  expect_refused(folder.write("text.gltf", g.text()), fault.code, fault.message);
  expect_refused(folder.write("binary.glb", g.glb()), fault.code, fault.message);
}

}  // namespace umbrix::io::testing
