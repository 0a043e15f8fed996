// SPDX-License-Identifier: Apache-2.0
#include "program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>

extern char** environ;

namespace umbrix::app {
namespace {

// The buffer: 8 positions, then 12 indices of 16 bits. The upper square is [0, 0.5]^2 at z = 0.5, the lower one [-2,
// 2]^2.
const char* const kScene = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"name": "lamp", "type": "point", "intensity": 20}]}},
  "scene": 0,
  "scenes": [{"nodes": [0, 1, 2]}],
  "nodes": [
    {"mesh": 0, "name": "squares"},
    {"camera": 0, "name": "eye", "translation": [0, 0, 4]},
    {"name": "lamp", "translation": [-1, 0, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}}
  ],
  "cameras": [{"name": "eye", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "aspectRatio": 2.0}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-2, -2, 0], "max": [2, 2, 0.5]},
    {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}
  ],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 96},
    {"buffer": 0, "byteOffset": 96, "byteLength": 24}
  ],
  "buffers": [{"byteLength": 120, "uri": "scene.bin"}]
})";

std::string scene_buffer() {
  const float positions[] = {-2, -2, 0,    2,    -2, 0,    2,    2,    0,    -2, 2,    0,
                             0,  0,  0.5f, 0.5f, 0,  0.5f, 0.5f, 0.5f, 0.5f, 0,  0.5f, 0.5f};
  const unsigned short indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  return std::string(reinterpret_cast<const char*>(positions), sizeof positions) +
         std::string(reinterpret_cast<const char*>(indices), sizeof indices);
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

void ProgramTest::SetUp() {
  std::string pattern = (std::filesystem::temp_directory_path() / "umbrix-cli-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
}

void ProgramTest::TearDown() { std::filesystem::remove_all(folder_); }

std::vector<std::string> ProgramTest::program(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {UMBRIX_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

pid_t ProgramTest::start(const std::vector<std::string>& arguments) { return start_command(program(arguments)); }

pid_t ProgramTest::start_command(std::vector<std::string> words, int standard_output) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  // A shell may have left signals ignored for what it runs in the background.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t all;
  sigfillset(&all);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

  // What it says goes beside the folder, so that the folder holds its outputs alone.
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const std::string out = folder_.string() + ".out", err = folder_.string() + ".err";
  if (standard_output >= 0)
    posix_spawn_file_actions_adddup2(&actions, standard_output, STDOUT_FILENO);
  else
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  pid_t process = -1;
  EXPECT_EQ(posix_spawn(&process, argv[0], &actions, &attributes, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return process;
}

Outcome ProgramTest::wait(pid_t process) {
  int status = 0;
  rusage usage{};
  EXPECT_EQ(wait4(process, &status, 0, &usage), process);
  Outcome outcome;
  outcome.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  for (const auto& [suffix, text] : {std::pair(".out", &outcome.out), std::pair(".err", &outcome.err)}) {
    *text = read_file(folder_.string() + suffix);
    std::filesystem::remove(folder_.string() + suffix);
  }
  return outcome;
}

Outcome ProgramTest::run(const std::vector<std::string>& arguments) { return wait(start(arguments)); }

void ProgramTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string ProgramTest::read(const std::string& name) const { return read_file(folder_ / name); }

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void ProgramTest::write_scene() const {
  write("scene.gltf", kScene);
  write("scene.bin", scene_buffer());
}

}  // namespace umbrix::app
