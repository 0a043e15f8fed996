// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "program.h"

namespace umbrix::app {
namespace {

class Info : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }
};

TEST_F(Info, JsonTellsWhatIsInTheFile) {
  const Outcome outcome = run({"info", path("scene.gltf"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto info = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(info["triangles"], 4);
  EXPECT_EQ(info["meshes"], 1);
  EXPECT_EQ(info["instances"], 1);
  EXPECT_EQ(info["bounds"]["lower"], nlohmann::json({-2, -2, 0}));
  EXPECT_EQ(info["bounds"]["upper"], nlohmann::json({2, 2, 0.5}));
  ASSERT_EQ(info["cameras"].size(), 1u);
  EXPECT_EQ(info["cameras"][0]["name"], "eye");
  EXPECT_EQ(info["cameras"][0]["position"], nlohmann::json({0, 0, 4}));
  ASSERT_EQ(info["lights"].size(), 1u);
  EXPECT_EQ(info["lights"][0]["type"], "point");
  EXPECT_EQ(info["lights"][0]["position"], nlohmann::json({-1, 0, 2}));
  EXPECT_EQ(info["extensions_used"], nlohmann::json({"KHR_lights_punctual"}));
  EXPECT_TRUE(info["ignored"].empty());
}

TEST_F(Info, EmissiveMeshesAreTold) {
  auto scene = nlohmann::json::parse(read("scene.gltf"));
  scene["materials"] = {{{"emissiveFactor", {1, 0.5, 0.25}}, {"doubleSided", true}}};
  scene["meshes"][0]["primitives"][0]["material"] = 0;
  write("lamp.gltf", scene.dump());
  const Outcome outcome = run({"info", path("lamp.gltf"), "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lamps = nlohmann::json::parse(outcome.out)["emissive_meshes"];
  ASSERT_EQ(lamps.size(), 1u);
  EXPECT_EQ(lamps[0]["triangles"], 4);
  EXPECT_EQ(lamps[0]["radiance"], nlohmann::json({1, 0.5, 0.25}));
  EXPECT_EQ(lamps[0]["double_sided"], true);
}

TEST_F(Info, TableTellsTheSameToPeople) {
  const Outcome outcome = run({"info", path("scene.gltf")});
  ASSERT_EQ(outcome.code, 0);
  for (const char* said : {"triangles", "eye", "KHR_lights_punctual", "bounds"}) {
    EXPECT_NE(outcome.out.find(said), std::string::npos) << outcome.out;
  }
  EXPECT_EQ(outcome.err, "");
}

}  // namespace
}  // namespace umbrix::app
