// SPDX-License-Identifier: Apache-2.0
#include "render_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "frame_list.h"
#include "heat_map_files.h"
#include "strict_number.h"

namespace umbrix::app {
namespace {

constexpr std::uint64_t kLargestSide = 65536;

[[noreturn]] void reject(const std::string& message) { throw CLI::ValidationError(message); }

int parse_side(const std::string& text, std::uint64_t low, const char* form, const std::string& whole) {
  std::uint64_t value = 0;
  if (!parse_number(text, value) || value < low || value > kLargestSide) {
    reject(fmt::format("'{}' is not of the form {} with numbers from {} to {}", whole, form, low, kLargestSide));
  }
  return static_cast<int>(value);
}

/// "WxH".
Size parse_size(const std::string& text, const char* form, const std::string& whole) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) reject(fmt::format("'{}' is not of the form {}", whole, form));
  return {parse_side(text.substr(0, x), 1, form, whole), parse_side(text.substr(x + 1), 1, form, whole)};
}

/// "WxH+X+Y".
render::Crop parse_crop(const std::string& text) {
  constexpr const char* form = "WxH+X+Y";
  const std::size_t first = text.find('+');
  const std::size_t second = first == std::string::npos ? first : text.find('+', first + 1);
  if (second == std::string::npos) reject(fmt::format("--crop: '{}' is not of the form {}", text, form));
  const Size size = parse_size(text.substr(0, first), form, text);
  return {parse_side(text.substr(first + 1, second - first - 1), 0, form, text),
          parse_side(text.substr(second + 1), 0, form, text), size.width, size.height};
}

/// Adds an option whose value is one of a few words.
template <typename T>
void add_choice(CLI::App& command, const std::string& flags, T& value, const std::map<std::string, T>& words,
                const std::string& help) {
  std::string names;
  for (const auto& [word, meaning] : words) names += (names.empty() ? "" : "|") + word;
  const auto choose = [&value, words, flags, names](const std::string& word) {
    const auto found = words.find(word);
    if (found == words.end()) reject(fmt::format("{}: '{}' is not one of {}", flags, word, names));
    value = found->second;
  };
  command.add_option_function<std::string>(flags, choose, help)->type_name(names);
}

void choose_kernel(RenderArguments& arguments, const std::string& name) {
  arguments.kernel_name = name;
  if (name == "auto") return;
  if (Status status = find_kernel(name.c_str(), arguments.kernel); !status) reject("--kernel: " + status.message());
}

void choose_aovs(RenderArguments& arguments, const std::vector<std::string>& names) {
  const std::vector<render::AovInfo> known = render::known_aovs();
  for (const std::string& name : names) {
    if (std::any_of(known.begin(), known.end(), [&](const auto& aov) { return aov.name == name; })) continue;
    std::string list;
    for (const render::AovInfo& aov : known) list += (list.empty() ? "" : ", ") + aov.name;
    reject(fmt::format("--aov: '{}' is not one of {}", name, list));
  }
  arguments.aovs = names;
}

void choose_frames(RenderArguments& arguments, const std::string& list) {
  if (Status status = parse_frames(list, arguments.frames); !status) reject("--frames: " + status.message());
}

void add_sequence_options(CLI::App& command, RenderArguments& a) {
  CLI::Option* frames = command
                            .add_option_function<std::string>(
                                "--frames", [&a](const std::string& list) { choose_frames(a, list); },
                                "Frames of a scene that moves, such as 1-3,5,7-20:2; -o then needs #### or %04d")
                            ->type_name("LIST");
  add_real(
      command, "--fps", 0.001, 100000, [&a](double x) { a.fps = x; },
      "Frames a second: frame F shows a glTF animation at F/X seconds [24]")
      ->needs(frames);
  command
      .add_option("--animation", a.animation,
                  "Play only this of the scene's animations, by name or number from 0 [all that fit together]")
      ->needs(frames)
      ->type_name("NAME|N");
}

void add_image_options(CLI::App& command, RenderArguments& a) {
  command
      .add_option_function<std::string>(
          "--size", [&a](const std::string& text) { a.size = parse_size(text, "WxH", text); },
          "Image size; without it 720 rows in the camera's aspect")
      ->type_name("WxH");
  command
      .add_option_function<std::string>(
          "--crop", [&a](const std::string& text) { a.crop = parse_crop(text); }, "Render only this part of the image")
      ->type_name("WxH+X+Y");
  add_integer(
      command, "--spp", 1, render::kMostSamples, [&a](auto n) { a.samples = static_cast<std::uint32_t>(n); },
      "Samples a pixel, stratified [1]");
  add_integer(
      command, "--light-samples", 1, render::kMostLightSamples,
      [&a](auto n) { a.light_samples = static_cast<std::uint32_t>(n); },
      "Shadow rays of a sample to each light with an area; with more than 8 such lights, to 8 of them by power [1]");
  add_integer(
      command, "--bounces", 0, render::kMostBounces, [&a](auto n) { a.bounces = static_cast<std::uint32_t>(n); },
      "Times that light goes on from surface to surface before the camera sees it; noisy below some --spp 64 [0]");
  command.add_flag_callback(
      "--no-mesh-lights", [&a] { a.mesh_lights = false; }, "Emissive surfaces are seen, but light nothing");
  add_choice<render::PixelFilter>(command, "--filter", a.filter,
                                  {{"box", render::PixelFilter::box},
                                   {"triangle", render::PixelFilter::triangle},
                                   {"gaussian", render::PixelFilter::gaussian},
                                   {"blackman-harris", render::PixelFilter::blackman_harris}},
                                  "How a pixel's samples are spread around its centre [box]");
  add_integer(
      command, "--seed", 0, UINT64_MAX, [&a](auto n) { a.seed = n; }, "Another seed, other sample places [0]");
  add_real(
      command, "--exposure", -64, 64, [&a](double x) { a.write.exposure = static_cast<float>(x); },
      "Stops by which a PNG is brightened [0]");
  add_choice<io::ToneMap>(command, "--tonemap", a.write.tone_map,
                          {{"none", io::ToneMap::none},
                           {"srgb", io::ToneMap::srgb},
                           {"aces", io::ToneMap::aces},
                           {"agx", io::ToneMap::agx}},
                          "What a PNG's colours go through [srgb]");
  command
      .add_option_function<std::vector<std::string>>(
          "--aov", [&a](const std::vector<std::string>& names) { choose_aovs(a, names); },
          "More channels for EXR: normal,depth,albedo,indirect,ao,shadow,node_tests,primitive_tests,kernel")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("LIST");
  add_real(
      command, "--ao-distance", 1e-30, 1e30, [&a](double x) { a.ao_distance = static_cast<float>(x); },
      "How far the ambient occlusion of --aov ao looks, in scene units [to infinity]");
  const auto type_flag = [&](const char* flag, io::PixelType type, const char* help) {
    return command.add_flag_callback(
        flag, [&a, type] { a.write.pixel_type = type; }, help);
  };
  CLI::Option* half = type_flag("--half", io::PixelType::half, "16-bit EXR (the default)");
  type_flag("--float", io::PixelType::single, "32-bit EXR")->excludes(half);
}

void add_tracing_options(CLI::App& command, RenderArguments& a) {
  command
      .add_option_function<std::string>(
          "--kernel", [&a](const std::string& name) { choose_kernel(a, name); },
          "How the tree is walked (see 'umbrix kernels'); changes time, never the picture [auto]")
      ->type_name("NAME");
  add_choice<BuildQuality>(command, "--build-quality", a.build_quality,
                           {{"fast", BuildQuality::fast}, {"high", BuildQuality::high}},
                           "How much time the tree may take [high]");
  add_choice<render::Instancing>(command, "--instances", a.instancing,
                                 {{"auto", render::Instancing::automatic},
                                  {"flatten", render::Instancing::flatten},
                                  {"share", render::Instancing::share}},
                                 "Whether instances share their mesh: takes little memory and more time, and never "
                                 "changes the picture; auto: in large scenes [auto]");
  command
      .add_option_function<std::string>(
          "--simd",
          [&a](const std::string& name) {
            a.simd_target = name;
            if (Status status = use_simd_target(name.c_str()); !status) reject("--simd: " + status.message());
          },
          "Instruction set (see 'umbrix kernels') [the best there is]")
      ->type_name("TARGET");
  add_integer(
      command, "-j,--threads", 0, 1024, [&a](auto n) { a.threads = static_cast<int>(n); },
      "Threads; 0: all that the machine, the affinity mask and the container allow [0]");
  add_memory_limit_option(command, a.memory_limit);
}

void add_talking_options(CLI::App& command, RenderArguments& a) {
  add_choice<ProgressStyle>(command, "--progress", a.progress,
                            {{"auto", ProgressStyle::automatic},
                             {"bar", ProgressStyle::bar},
                             {"lines", ProgressStyle::lines},
                             {"none", ProgressStyle::none}},
                            "On stderr; auto: a bar on a terminal, else lines [auto]");
  command
      .add_option("--stats", a.stats, "Write what was done as JSON; '-': to stdout. Counts work, so tracing is slower")
      ->type_name("FILE");
  command
      .add_option("--preview", a.preview,
                  "Image that shows the samples so far and is replaced after 1, 2, 4, 8, ... of --spp")
      ->type_name("FILE");
  CLI::Option* quiet = command.add_flag("-q,--quiet", a.quiet, "Only errors");
  command.add_flag("-v,--verbose", a.verbose, "Also what in the scene is ignored")->excludes(quiet);
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& a) {
  command.add_option("scene", a.scene, "A glTF 2.0 file, .gltf or .glb")->required()->type_name("SCENE");
  command.add_option("-o,--output", a.outputs, "Image to write, .exr (linear) or .png (sRGB); may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  command.add_option("--setup", a.setup, "Camera and lights from a JSON file")->type_name("FILE");
  command.add_option("--camera", a.camera, "The scene's camera, by name or number from 0 [0]")->type_name("NAME|N");
  add_sequence_options(command, a);
  add_image_options(command, a);
  add_heat_map_options(command, a);
  add_tracing_options(command, a);
  CLI::Option* overwrite = command.add_flag("--overwrite", a.write.overwrite, "Replace files that exist");
  command.add_flag("--skip-existing", a.skip_existing, "Leave images that exist, render those that are missing")
      ->excludes(overwrite);
  command.add_flag("--create-dir", a.create_folders, "Make missing folders of the outputs");
  command.add_flag("-n,--dry-run", a.dry_run, "Check everything and say what would be rendered");
  add_talking_options(command, a);
  command.callback([&a] {
    if (a.outputs.empty() && a.heat_maps.empty()) throw CLI::RequiredError("--output or --heat-map");
  });
}

}  // namespace umbrix::app
