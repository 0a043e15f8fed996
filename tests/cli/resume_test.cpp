// SPDX-License-Identifier: Apache-2.0
// What was done is not done again, what is damaged or of another job is, and what an interruption leaves is gone on
// from.
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {
namespace {

class Resume : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_scene();
  }

  std::vector<std::string> words(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o", path(output), "--progress", "none"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  Outcome render(const std::string& output, const std::vector<std::string>& more = {}) {
    return run(words(output, more));
  }

  std::string job_of(const std::string& name) const {
    io::Image image;
    EXPECT_TRUE(io::read_image(path(name), image).ok());
    for (const auto& [key, value] : image.metadata) {
      if (key == "umbrix:job") return value;
    }
    return "";
  }
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(Resume, LeavesWhatIsDone) {
  const std::vector<std::string> more = {
      "--size", "24x16", "--resume", "-o", path("b.png"), "--heat-map", "depth=" + path("c.png")};
  ASSERT_EQ(render("a.exr", more).code, 0);
  const auto before = std::filesystem::last_write_time(path("a.exr"));
  const Outcome again = render("a.exr", more);
  EXPECT_EQ(again.code, 0);
  for (const char* name : {"a.exr", "b.png", "c.png"}) {
    EXPECT_TRUE(contains(again.err, std::string("skip ") + path(name))) << again.err;
  }
  EXPECT_EQ(std::filesystem::last_write_time(path("a.exr")), before);
}

TEST_F(Resume, RendersAgainWhatIsNotWholeOrOfAnotherJob) {
  const std::vector<std::string> more = {"--size", "24x16", "--float", "--resume"};
  ASSERT_EQ(render("good.exr", more).code, 0);
  const std::string good = read("good.exr");
  std::string flipped = good, header = good;
  flipped[good.size() - 3] = static_cast<char>(flipped[good.size() - 3] ^ 1);
  const std::size_t matrix = good.find("worldToNDC") + 30;
  header[matrix] = static_cast<char>(header[matrix] ^ 1);
  ASSERT_EQ(render("other.exr", {"--size", "24x16", "--float", "--seed", "3"}).code, 0);
  ASSERT_EQ(render("part.exr", {"--size", "24x16", "--float", "--crop", "24x15+0+0"}).code, 0);
  ASSERT_EQ(render("frame.exr", {"--size", "24x16", "--float", "--frames", "4"}).code, 0);
  for (const std::string& bad : {good.substr(0, good.size() / 2), flipped, header, std::string(), std::string("text"),
                                 read("other.exr"), read("part.exr"), read("frame.exr")}) {
    write("a.exr", bad);
    const Outcome outcome = render("a.exr", more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(read("a.exr") == good);
  }
}

TEST_F(Resume, JobIsTheContentAndWhatChangesPixels) {
  const std::vector<std::string> base = {"--size", "24x16", "--overwrite"};
  ASSERT_EQ(render("a.exr", {"--size", "24x16"}).code, 0);
  const std::string job = job_of("a.exr");
  EXPECT_EQ(job.size(), 32u);
  const auto job_with = [&](std::vector<std::string> more) {
    more.insert(more.end(), base.begin(), base.end());
    const Outcome outcome = render("b.exr", more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return job_of("b.exr");
  };
  EXPECT_EQ(job_with({"-j",           "1",       "--kernel",     "brute",          "--build-quality",
                      "fast",         "--stats", path("s.json"), "--checkpoint",   "1h",
                      "--exposure",   "2",       "--half",       "--memory-limit", "4G",
                      "--instances",  "share",   "--preview",    path("p.png"),    "--log-file",
                      path("run.log")}),
            job_with({"--half"}))
      << "these change no pixel of an EXR";
  for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{"--seed", "1"},
                                                                                    {"--spp", "2"},
                                                                                    {"--light-samples", "2"},
                                                                                    {"--no-mesh-lights"},
                                                                                    {"--bounces", "1"},
                                                                                    {"--float"},
                                                                                    {"--aov", "depth"},
                                                                                    {"--camera", "eye"}}) {
    EXPECT_NE(job_with(more), job) << more[0];
  }
  const std::string work = job_with({"--aov", "node_tests"});
  EXPECT_NE(job_with({"--aov", "node_tests", "--kernel", "brute"}), work) << "these show the kernel at work";

  // A copy is the same scene; one changed byte of what it refers to is another.
  std::filesystem::create_directory(path("copy"));
  for (const char* name : {"scene.gltf", "scene.bin"}) std::filesystem::copy(path(name), path("copy") + "/" + name);
  ASSERT_EQ(run({"render", path("copy/scene.gltf"), "-q", "-o", path("c.exr"), "--size", "24x16"}).code, 0);
  EXPECT_EQ(job_of("c.exr"), job);
  std::string bytes = read("copy/scene.bin");
  bytes[2] = static_cast<char>(bytes[2] ^ 1);
  write("copy/scene.bin", bytes);
  ASSERT_EQ(run({"render", path("copy/scene.gltf"), "-q", "-o", path("d.exr"), "--size", "24x16"}).code, 0);
  EXPECT_NE(job_of("d.exr"), job);
  write("setup.json", R"({"lights": [[0, 0, 3]]})");
  const std::string lit = job_with({"--setup", path("setup.json")});
  write("setup.json", R"({"lights": [[0, 0, 4]]})");
  EXPECT_NE(job_with({"--setup", path("setup.json")}), lit);
}

TEST_F(Resume, JobDependsOnTextures) {
  io::Image texture;
  texture.width = texture.height = 1;
  texture.channels = {"R", "G", "B"};
  texture.pixels = {1, 0.5f, 0.25f};
  ASSERT_TRUE(io::write_image(path("t.png"), texture, {}).ok());
  auto scene = nlohmann::json::parse(read("scene.gltf"));
  scene["images"] = {{{"uri", "t.png"}}};
  scene["textures"] = {{{"source", 0}}};
  scene["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  scene["meshes"][0]["primitives"][0]["material"] = 0;
  write("scene.gltf", scene.dump());
  const std::vector<std::string> more = {"--size", "24x16", "--resume"};
  ASSERT_EQ(render("a.exr", more).code, 0);
  const std::string job = job_of("a.exr");
  texture.pixels[0] = 0;
  io::WriteOptions replace;
  replace.overwrite = true;
  ASSERT_TRUE(io::write_image(path("t.png"), texture, replace).ok());
  ASSERT_EQ(render("a.exr", more).code, 0);
  EXPECT_NE(job_of("a.exr"), job);
  // Without the picture the material does without, and that is another job again.
  std::filesystem::remove(path("t.png"));
  ASSERT_EQ(render("b.exr", more).code, 0);
  EXPECT_NE(job_of("b.exr"), job_of("a.exr"));
}

/// A render of many tiles that takes a while on any machine.
const std::vector<std::string> kLong = {"--size", "256x256", "--spp", UMBRIX_LONG_SPP, "-j", "1"};

class Checkpoint : public Resume {
 protected:
  Outcome render_long(const std::vector<std::string>& more) {
    std::vector<std::string> all = kLong;
    all.insert(all.end(), more.begin(), more.end());
    return render("a.exr", all);
  }

  pid_t start_long(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", path("scene.gltf"), "-o", path("a.exr"), "--progress", "lines"};
    arguments.insert(arguments.end(), kLong.begin(), kLong.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments);
  }

  /// Waits until it says that a tenth of the tiles is done.
  void wait_for_a_tenth() const {
    for (;;) {
      std::ifstream file(folder_.string() + ".err");
      const std::string said((std::istreambuf_iterator<char>(file)), {});
      if (contains(said, "10%")) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void expect_as_in_one_go() {
    std::vector<std::string> all = kLong;
    ASSERT_EQ(render("whole.exr", all).code, 0);
    EXPECT_TRUE(read("a.exr") == read("whole.exr"));
    EXPECT_FALSE(exists("a.exr.part"));
  }
};

TEST_F(Checkpoint, SignalsKeepWhatIsDoneAndResumeGoesOn) {
  for (const auto& [signal, code] : {std::pair(SIGTERM, 143), std::pair(SIGINT, 130)}) {
    const pid_t process = start_long({"--checkpoint", "1h", "--resume"});
    wait_for_a_tenth();
    kill(process, signal);
    kill(process, signal);  // schedulers send it to the process and to its group
    const Outcome outcome = wait(process);
    EXPECT_EQ(outcome.code, code);
    EXPECT_TRUE(contains(outcome.err, "a.exr.part has ")) << outcome.err;
    EXPECT_FALSE(exists("a.exr"));
  }
  const Outcome rest = render_long({"--resume"});
  EXPECT_EQ(rest.code, 0);
  EXPECT_TRUE(contains(rest.err, "going on from ")) << rest.err;
  expect_as_in_one_go();
}

TEST_F(Checkpoint, TimeLimitIsFiveAndResumeGoesOn) {
  const Outcome endless = run({"render", path("scene.gltf"), "-o", path("b.exr"), "--size", "2000x20", "--spp", "60000",
                               "--time-limit", "1", "--progress", "openjd"});
  EXPECT_EQ(endless.code, 5);
  EXPECT_TRUE(contains(endless.err, "--time-limit")) << endless.err;
  EXPECT_TRUE(contains(endless.out, "openjd_fail: ")) << endless.out;
  EXPECT_FALSE(exists("b.exr"));
  const Outcome limited = render_long({"--time-limit", "1"});
  EXPECT_TRUE(limited.code == 5 || (limited.code == 0 && exists("a.exr"))) << limited.err;
  EXPECT_EQ(render_long({"--resume", "--time-limit", "1h"}).code, 0);
  expect_as_in_one_go();
}

TEST_F(Checkpoint, ADamagedOrForeignOneIsNotUsed) {
  const pid_t process = start_long({"--checkpoint", "1h"});
  wait_for_a_tenth();
  kill(process, SIGTERM);
  ASSERT_EQ(wait(process).code, 143);
  const std::string good = read("a.exr.part");
  std::string flipped = good;
  flipped[good.size() / 2] = static_cast<char>(flipped[good.size() / 2] ^ 4);
  for (const std::string& bad : {flipped, good.substr(0, good.size() - 4), std::string("umbrix part 1\n")}) {
    write("a.exr.part", bad);
    const Outcome outcome = render("a.exr", {"--size", "256x256", "--spp", "1", "--resume"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(contains(outcome.err, "going on")) << outcome.err;
    std::filesystem::remove(path("a.exr"));
  }
  write("a.exr.part", good);
  const Outcome other = render("a.exr", {"--size", "256x256", "--spp", "1", "--resume"});
  EXPECT_FALSE(contains(other.err, "going on")) << "of another number of samples";
}

TEST_F(Checkpoint, SnapshotSignalWritesOne) {
  const pid_t process = start_long({"--checkpoint", "1h"});
  wait_for_a_tenth();
  kill(process, SIGUSR1);
  while (!exists("a.exr.part")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  kill(process, SIGKILL);
  EXPECT_EQ(wait(process).code, 137);
  EXPECT_TRUE(contains(render_long({"--resume"}).err, "going on from "));
  expect_as_in_one_go();
}

TEST_F(Checkpoint, WrongTimesAreTwo) {
  for (const char* flag : {"--checkpoint", "--time-limit"}) {
    for (const char* time : {"0", "5d", "", "-1", "nan", "1e99h"}) {
      const Outcome outcome = render("a.exr", {flag, time});
      EXPECT_EQ(outcome.code, 2) << flag << time;
      EXPECT_TRUE(contains(outcome.err, flag)) << outcome.err;
    }
  }
  EXPECT_EQ(render("a.exr", {"--resume", "--overwrite"}).code, 2);
  EXPECT_EQ(render("a.exr", {"--resume", "--skip-existing"}).code, 2);
}

}  // namespace
}  // namespace umbrix::app
