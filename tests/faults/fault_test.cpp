// SPDX-License-Identifier: Apache-2.0
#include "fault_test.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace umbrix::app {

int fault_runs(int few, int many) {
  const char* const text = std::getenv("UMBRIX_FAULT_RUNS");
  const int asked = text ? std::atoi(text) : 0;
  return asked > 0 ? std::max(1, static_cast<int>(std::lround(many * (asked / 200.0)))) : few;
}

double FaultRow::percentile(double share) const {
  if (latencies_.empty()) return 0;
  std::vector<double> sorted = latencies_;
  std::sort(sorted.begin(), sorted.end());
  return sorted[std::min(sorted.size() - 1, static_cast<std::size_t>(share * static_cast<double>(sorted.size())))];
}

FaultRow::~FaultRow() {
  std::string latency = "|  |  ";
  if (!latencies_.empty()) {
    char text[64];
    std::snprintf(text, sizeof text, "| %.1f | %.1f ", 1e3 * percentile(0.5), 1e3 * percentile(0.99));
    latency = text;
  }
  std::printf("fault-row | %s | %d | %d %s| %s |\n", kind_.c_str(), runs_, failures_, latency.c_str(), remark_.c_str());
}

void FaultTest::SetUp() {
  ProgramTest::SetUp();
  write_scene();
  const char* const text = std::getenv("UMBRIX_FAULT_SEED");
  const unsigned seed = text ? static_cast<unsigned>(std::atol(text)) : std::random_device()();
  std::printf("UMBRIX_FAULT_SEED=%u\n", seed);
  random_.seed(seed);
}

std::vector<std::string> FaultTest::render_arguments() const {
  return {"render",  path("scene.gltf"), "-q", "-o", path("out.exr"), "-o", path("out.png"), "--overwrite", "--size",
          "400x200", "--float",          "-j", "2"};
}

void FaultTest::make_expected() {
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run(render_arguments()).code, 0);
  seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  exr_ = read("out.exr");
  png_ = read("out.png");
  ASSERT_FALSE(exr_.empty() || png_.empty());
  for (const char* name : {"out.exr", "out.png"}) write(name, "precious");
}

bool FaultTest::is_new(const std::string& name) const { return read(name) == (name == "out.exr" ? exr_ : png_); }

bool FaultTest::is_whole(const std::string& name) const { return read(name) == "precious" || is_new(name); }

std::vector<std::string> FaultTest::temporaries() const {
  std::vector<std::string> names = files();
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string& name) { return name.find(".umbrix-") == std::string::npos; }),
              names.end());
  return names;
}

void FaultTest::age_temporaries() const {
  for (const std::string& name : temporaries()) {
    const timespec times[2] = {{1, 0}, {1, 0}};
    EXPECT_EQ(utimensat(AT_FDCWD, path(name).c_str(), times, 0), 0);
  }
}

void FaultTest::sleep_for_some(double most_seconds) {
  std::this_thread::sleep_for(
      std::chrono::duration<double>(std::uniform_real_distribution(0.0, most_seconds)(random_)));
}

std::string shared_scene(const std::string& name) {
  const char* const variable = std::getenv("UMBRIX_SCENES_DIR");
  const std::filesystem::path folder = variable ? variable : UMBRIX_SCENES_DIR_DEFAULT;
  const std::filesystem::path file = folder / (name + ".glb");
  return std::filesystem::exists(file) ? file.string() : "";
}

std::vector<std::string> with_environment(const std::vector<std::string>& variables,
                                          const std::vector<std::string>& command) {
  std::vector<std::string> words = {"/usr/bin/env"};
  words.insert(words.end(), variables.begin(), variables.end());
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

}  // namespace umbrix::app
