// SPDX-License-Identifier: Apache-2.0
#include "job_hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

#include "heat_map_files.h"
#include "output_pattern.h"
#include "umbrix/io/content_hash.h"
#include "umbrix/version.h"

namespace umbrix::app {
namespace {

/// Options that change no pixel, or are hashed by what they mean: files by their content, the size that comes of them,
/// the AOVs that are rendered.
constexpr std::array kNotHashed = {
    "scene",     "output",        "setup",    "frames",     "size",       "crop",       "tile",         "pixel",
    "aov",       "heat-map",      "heat-max", "kernel",     "simd",       "threads",    "memory-limit", "build-quality",
    "overwrite", "skip-existing", "resume",   "checkpoint", "time-limit", "create-dir", "dry-run",      "progress",
    "log-file",  "stats",         "quiet",    "verbose",    "config",     "help",       "preview",      "instances"};

/// Options that change what one kind of file holds of the same pixels.
constexpr std::array kOfExr = {"half", "float"};
constexpr std::array kOfPng = {"exposure", "tonemap"};

template <std::size_t N>
bool is_one_of(const std::array<const char*, N>& names, std::string_view name) {
  return std::any_of(names.begin(), names.end(), [&](const char* known) { return name == known; });
}

std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : option.get_lnames().front();
}

/// Those of the lines "name=..." whose name passes.
template <class Passes>
std::string lines_that(const std::string& lines, Passes passes) {
  std::string out;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin) + 1;
    const std::string_view line(lines.data() + begin, end - begin);
    if (passes(line.substr(0, line.find('=')))) out += line;
    begin = end;
  }
  return out;
}

/// What all pixels depend on.
std::string common_lines(const RenderJob& job) {
  const std::string options = lines_that(
      job.arguments.picture_options, [](auto name) { return !is_one_of(kOfExr, name) && !is_one_of(kOfPng, name); });
  return fmt::format("version={}\ninputs={}\nsize={}x{}\n{}", version_string(), job.inputs_hash, job.size.width,
                     job.size.height, options);
}

/// Channels, and what they depend on beside: those that show the tracer at work, on how it works.
std::string aov_lines(const RenderJob& job, const std::vector<std::string>& aovs) {
  std::string lines;
  bool work = false;
  for (const std::string& name : aovs) {
    lines += "aov=" + name + "\n";
    for (const render::AovInfo& aov : render::known_aovs()) work = work || (aov.name == name && aov.of_tracer);
  }
  const RenderArguments& a = job.arguments;
  if (work) {
    lines +=
        fmt::format("kernel={}\nsimd={}\ninstances={}\n", a.kernel_name, a.simd_target, static_cast<int>(a.instancing));
  }
  return lines;
}

std::string option_lines(const RenderJob& job, bool png) {
  return lines_that(job.arguments.picture_options,
                    [&](auto name) { return png ? is_one_of(kOfPng, name) : is_one_of(kOfExr, name); });
}

}  // namespace

std::string picture_options(const CLI::App& command) {
  std::string lines;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = name_of(*option);
    if (option->empty() || is_one_of(kNotHashed, name)) continue;
    lines += name + "=";
    for (const std::string& value : option->results()) lines += value + "\x1f";
    std::replace(lines.begin() + static_cast<std::ptrdiff_t>(lines.rfind(name)), lines.end(), '\n', ' ');
    lines += '\n';
  }
  return lines;
}

Status hash_inputs(const RenderJob& job, std::string& out) {
  // Which file is which does not matter: the files themselves say what each other is called.
  std::multiset<std::string> hashes;
  for (const std::vector<std::string>* files : {&job.scene.files, &job.origin.setup_files}) {
    for (const std::string& path : *files) {
      std::string hash;
      std::error_code error;
      // A scene does without a picture that is not there.
      if (std::filesystem::is_regular_file(path, error)) {
        if (Status status = io::hash_file(path, hash); !status) return status;
      }
      hashes.insert(hash);
    }
  }
  std::string all;
  for (const std::string& hash : hashes) all += hash + "\n";
  out = io::content_hash(all);
  return {};
}

std::string job_hash(const RenderJob& job, const std::string& path) {
  const bool png = has_extension(path, ".png");
  const std::string aovs = png ? "" : aov_lines(job, rendered_aovs(job.arguments));
  return io::content_hash(common_lines(job) + aovs + option_lines(job, png));
}

std::string job_hash(const RenderJob& job, const render::HeatMapContent& heat_map) {
  return io::content_hash(common_lines(job) + aov_lines(job, {heat_map.aov}) + fmt::format("end={}\n", heat_map.end));
}

std::string pixel_hash(const RenderJob& job) {
  return io::content_hash(common_lines(job) + aov_lines(job, rendered_aovs(job.arguments)));
}

}  // namespace umbrix::app
