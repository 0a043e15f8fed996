// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "program.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::json;

class Stats : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  Outcome render(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o", path("out.exr"), "--size", "64x32", "-j",
                                          "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(Stats, FileAddsUp) {
  ASSERT_EQ(render({"--stats", path("stats.json"), "--spp", "2"}).code, 0);
  const Json stats = Json::parse(read("stats.json"));
  EXPECT_EQ(stats["scene"], path("scene.gltf"));
  EXPECT_EQ(stats["triangles"], 4);
  EXPECT_EQ(stats["threads"], 3);
  EXPECT_EQ(stats["kernel"], "auto");
  EXPECT_EQ(stats["samples_per_pixel"], 2);
  EXPECT_EQ(stats["build"]["triangles"], 4);
  EXPECT_EQ(stats["build"]["leaves"], 0) << "so few rays are worth no tree";
  EXPECT_EQ(stats["camera"]["rays"], 64 * 32 * 2);

  ASSERT_EQ(stats["lights"].size(), 1u);
  const Json& lamp = stats["lights"][0];
  EXPECT_EQ(lamp["type"], "point");
  EXPECT_GT(lamp["occluded"]["rays"], 0);
  EXPECT_GT(lamp["unoccluded"]["rays"], 0);
  const auto rays = lamp["occluded"]["rays"].get<int>() + lamp["unoccluded"]["rays"].get<int>();
  EXPECT_EQ(lamp["rays"], rays);
  EXPECT_EQ(stats["shadow"]["rays"], rays);
  EXPECT_GE(lamp["occluded"]["primitive_tests_per_ray"], 1);
  EXPECT_GE(lamp["unoccluded"]["node_tests_per_ray"], 1);
  int answered = 0;
  for (const Json& route : lamp["routes"]) answered += route.get<int>();
  EXPECT_EQ(answered, rays);
  EXPECT_TRUE(lamp["routes"].contains("cached"));
  EXPECT_EQ(stats["shadow"]["routes"], lamp["routes"]);
  int skipped = 0;
  for (const Json& reason : lamp["skipped"]) skipped += reason.get<int>();
  EXPECT_EQ(rays + skipped, stats["camera"]["hits"]);
  for (const char* phase : {"load", "build", "render", "write"}) EXPECT_GE(stats["seconds"][phase], 0) << phase;
  EXPECT_GT(stats["mrays_per_second"], 0);
}

TEST_F(Stats, HoldTheTreeOfAKernelThatNeedsOne) {
  ASSERT_EQ(render({"--stats", path("stats.json"), "--kernel", "standard"}).code, 0);
  EXPECT_GE(Json::parse(read("stats.json"))["build"]["leaves"], 1);
}

TEST_F(Stats, HeatMapsAreAmongTheOutputs) {
  ASSERT_EQ(render({"--stats", path("stats.json"), "--heat-map", "kernel=" + path("heat.png")}).code, 0);
  EXPECT_EQ(Json::parse(read("stats.json"))["outputs"], Json({path("out.exr"), path("heat.png")}));
}

TEST_F(Stats, DashIsStdout) {
  const Outcome outcome = render({"--stats", "-", "-q"});
  ASSERT_EQ(outcome.code, 0);
  EXPECT_EQ(Json::parse(outcome.out)["width"], 64);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Stats, ExistingFileIsKept) {
  write("stats.json", "precious");
  EXPECT_EQ(render({"--stats", path("stats.json")}).code, 4);
  EXPECT_EQ(read("stats.json"), "precious");
  EXPECT_FALSE(exists("out.exr"));
}

TEST_F(Stats, CountingDoesNotChangeTheImage) {
  ASSERT_EQ(render({"--stats", path("stats.json")}).code, 0);
  const std::string counted = read("out.exr");
  ASSERT_EQ(render({"--overwrite"}).code, 0);
  EXPECT_TRUE(counted == read("out.exr"));
}

}  // namespace
}  // namespace umbrix::app
