// SPDX-License-Identifier: Apache-2.0
#include "render_arguments.h"

#include <fmt/format.h>

#include <algorithm>

#include "choice_option.h"
#include "config_file.h"
#include "duration.h"
#include "frame_list.h"
#include "heat_map_files.h"
#include "job_hash.h"
#include "log_file.h"
#include "output_pattern.h"
#include "progress_option.h"
#include "strict_number.h"

namespace umbrix::app {
namespace {

constexpr std::uint64_t kLargestSide = 65536;

[[noreturn]] void reject(const std::string& message) { throw CLI::ValidationError(message); }

/// Takes whole numbers with the separators between them, such as "x++", apart; false if the text is of another form.
bool split_numbers(const std::string& text, const std::string& separators, std::vector<std::uint64_t>& out) {
  out.clear();
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= separators.size(); ++i) {
    const std::size_t end = i < separators.size() ? text.find(separators[i], begin) : text.size();
    std::uint64_t number = 0;
    if (end == std::string::npos || !parse_number(text.substr(begin, end - begin), number) || number > kLargestSide) {
      return false;
    }
    out.push_back(number);
    begin = end + 1;
  }
  return true;
}

/// "WxH".
Size parse_size(const std::string& text) {
  std::vector<std::uint64_t> n;
  if (!split_numbers(text, "x", n) || n[0] < 1 || n[1] < 1) {
    reject(fmt::format("--size: '{}' is not of the form WxH with numbers from 1 to {}", text, kLargestSide));
  }
  return {static_cast<int>(n[0]), static_cast<int>(n[1])};
}

render::Crop crop_of(std::uint64_t x, std::uint64_t y, std::uint64_t width, std::uint64_t height) {
  return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(width), static_cast<int>(height)};
}

/// "WxH+X+Y", or "X0,Y0,X1,Y1" of which the last two are the first pixels beyond.
render::Crop parse_crop(const std::string& text) {
  std::vector<std::uint64_t> n;
  if (split_numbers(text, "x++", n) && n[0] > 0 && n[1] > 0) return crop_of(n[2], n[3], n[0], n[1]);
  if (split_numbers(text, ",,,", n) && n[2] > n[0] && n[3] > n[1]) return crop_of(n[0], n[1], n[2] - n[0], n[3] - n[1]);
  reject(fmt::format("--crop: '{}' is neither of the form WxH+X+Y nor X0,Y0,X1,Y1 with numbers from 0 to {}", text,
                     kLargestSide));
}

void choose_pixel(RenderArguments& arguments, const std::string& text) {
  std::vector<std::uint64_t> n;
  if (!split_numbers(text, ",", n)) reject(fmt::format("--pixel: '{}' is not of the form X,Y", text));
  arguments.crop = crop_of(n[0], n[1], 1, 1);
  arguments.print_pixel = true;
}

void choose_tile(RenderArguments& arguments, const std::string& text) {
  Tile tile;
  if (!parse_tile(text, tile)) {
    reject(fmt::format("--tile: '{}' is not of the form I/N with I from 0 to N-1 and N up to {}", text, kMostTiles));
  }
  arguments.tile = tile;
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
          "--size", [&a](const std::string& text) { a.size = parse_size(text); },
          "Image size; without it 720 rows in the camera's aspect")
      ->type_name("WxH");
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
  add_choice<render::PixelFilter>(
      command, "--filter", [&a](render::PixelFilter filter) { a.filter = filter; },
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
  add_choice<io::ToneMap>(
      command, "--tonemap", [&a](io::ToneMap map) { a.write.tone_map = map; },
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

void add_part_options(CLI::App& command, RenderArguments& a) {
  CLI::Option* crop = command
                          .add_option_function<std::string>(
                              "--crop", [&a](const std::string& text) { a.crop = parse_crop(text); },
                              "Render only this part of the image; also X0,Y0,X1,Y1 (X1 and Y1 are beyond it)")
                          ->type_name("WxH+X+Y");
  CLI::Option* tile =
      command
          .add_option_function<std::string>(
              "--tile", [&a](const std::string& text) { choose_tile(a, text); },
              "Render only tile I, from 0, of N equal ones, to name.tileIofN.exr; 'umbrix merge' puts them together")
          ->type_name("I/N")
          ->excludes(crop);
  command
      .add_option_function<std::string>(
          "--pixel", [&a](const std::string& text) { choose_pixel(a, text); },
          "Render only this pixel and print its channels")
      ->type_name("X,Y")
      ->excludes(crop)
      ->excludes(tile);
}

void add_again_options(CLI::App& command, RenderArguments& a) {
  CLI::Option* overwrite = command.add_flag("--overwrite", a.write.overwrite, "Replace files that exist");
  CLI::Option* skip =
      command.add_flag("--skip-existing", a.skip_existing, "Leave images that exist, render those that are missing")
          ->excludes(overwrite);
  command
      .add_flag("--resume", a.resume,
                "Leave images that are whole and of this very job, render the others, going on from checkpoints")
      ->excludes(overwrite)
      ->excludes(skip);
  add_duration(
      command, "--checkpoint", [&a](double seconds) { a.checkpoints.interval = seconds; },
      "Keep what is done of a frame in FILE.part: this often, on SIGUSR1, and when interrupted");
  add_duration(
      command, "--time-limit", [&a](double seconds) { a.checkpoints.time_limit = seconds; },
      "End with code 5 after this time, with a checkpoint");
  command.add_flag("--create-dir", a.create_folders, "Make missing folders of the outputs");
  command.add_flag("-n,--dry-run", a.dry_run, "Check everything and say what would be rendered");
}

void add_tracing_options(CLI::App& command, RenderArguments& a) {
  command
      .add_option_function<std::string>(
          "--kernel", [&a](const std::string& name) { choose_kernel(a, name); },
          "How the tree is walked (see 'umbrix kernels'); changes time, never the picture [auto]")
      ->type_name("NAME");
  add_choice<BuildQuality>(
      command, "--build-quality", [&a](BuildQuality quality) { a.build_quality = quality; },
      {{"fast", BuildQuality::fast}, {"high", BuildQuality::high}}, "How much time the tree may take [high]");
  add_choice<render::Instancing>(
      command, "--instances", [&a](render::Instancing instancing) { a.instancing = instancing; },
      {{"auto", render::Instancing::automatic},
       {"flatten", render::Instancing::flatten},
       {"share", render::Instancing::share}},
      "Whether instances share their mesh: takes little memory and more time, and never changes the picture; auto: in "
      "large scenes [auto]");
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
  add_progress_option(command, a.progress);
  command
      .add_option("--stats", a.stats, "Write what was done as JSON; '-': to stdout. Counts work, so tracing is slower")
      ->type_name("FILE");
  command
      .add_option("--preview", a.preview,
                  "Image that shows the samples so far and is replaced after 1, 2, 4, 8, ... of --spp")
      ->type_name("FILE");
  CLI::Option* quiet = command.add_flag("-q,--quiet", a.quiet, "Only errors");
  add_log_file_option(command, a.log_file);
  command.add_flag("-v,--verbose", a.verbose, "Also what in the scene is ignored")->excludes(quiet);
}

/// What is wrong with options that are right for themselves.
void check_together(const RenderArguments& a) {
  if (a.outputs.empty() && a.heat_maps.empty() && !a.print_pixel) {
    throw CLI::RequiredError("--output or --heat-map or --pixel");
  }
  if (!a.tile) return;
  if (!a.heat_maps.empty()) reject("--tile: a --heat-map shows a whole frame");
  for (const std::string& path : a.outputs) {
    if (!has_extension(path, ".exr")) {
      reject(fmt::format("--tile: {}: only .exr keeps where in the frame a tile is", path));
    }
  }
}

}  // namespace

void add_render_options(CLI::App& command, RenderArguments& a) {
  add_config_option(command);
  command.add_option("scene", a.scene, "A glTF 2.0 file, .gltf or .glb")->required()->type_name("SCENE");
  command.add_option("-o,--output", a.outputs, "Image to write, .exr (linear) or .png (sRGB); may be repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  command.add_option("--setup", a.setup, "Camera and lights from a JSON file")->type_name("FILE");
  command.add_option("--camera", a.camera, "The scene's camera, by name or number from 0 [0]")->type_name("NAME|N");
  add_sequence_options(command, a);
  add_image_options(command, a);
  add_part_options(command, a);
  add_heat_map_options(command, a);
  add_tracing_options(command, a);
  add_again_options(command, a);
  add_talking_options(command, a);
  command.callback([&command, &a] {
    check_together(a);
    if (a.resume) a.write.overwrite = a.checkpoints.resume = true;
    a.picture_options = picture_options(command);
  });
}

}  // namespace umbrix::app
