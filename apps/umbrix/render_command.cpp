// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "exit_code.h"
#include "frame_loop.h"
#include "frame_plan.h"
#include "heat_map_files.h"
#include "job_hash.h"
#include "log_file.h"
#include "memory_guard.h"
#include "memory_plan.h"
#include "message.h"
#include "moving_scene.h"
#include "output_files.h"
#include "render/threads.h"
#include "render_job.h"
#include "render_report.h"
#include "standard_streams.h"
#include "stopwatch.h"
#include "thread_count.h"
#include "view_choice.h"

namespace umbrix::app {
namespace {

Size frame_size(const RenderArguments& a, const io::Camera& camera) {
  if (a.size) return *a.size;
  constexpr int kRows = 720;
  return {static_cast<int>(std::clamp(std::round(kRows * natural_aspect(camera)), 1.0, 65536.0)), kRows};
}

void warn(const RenderJob& job) {
  if (job.arguments.quiet) return;
  for (const std::string& text : job.scene.warnings) say_warning(text);
  for (const std::string& text : job.world.notes) say_warning(text);
  const bool moves = job.view.camera.motion || job.scene.motion;
  if (job.frames.size() > 1 && !moves) say_warning("nothing moves: all frames are alike");
  if (!job.arguments.verbose) return;
  for (const std::string& text : job.scene.ignored) say(fmt::format("umbrix: ignored: {}", text));
}

Status describe_plan(const RenderJob& job) {
  std::string text = fmt::format("{}: {} triangles, {} lights, {}x{} pixels, {} samples, about {} MB of memory\n",
                                 printable(job.scene.path), job.scene.instanced_triangles(), job.view.lights.size(),
                                 job.size.width, job.size.height, job.arguments.samples, plan_memory(job).peak() >> 20);
  const RenderArguments& a = job.arguments;
  const std::string frames = a.frames.empty() ? "" : fmt::format(", {} frames", job.frames.size());
  for (const std::vector<std::string>& list : {a.outputs, heat_map_files(a.heat_maps)}) {
    for (const std::string& path : list) {
      text += fmt::format("would write {}{}\n", printable(a.tile ? path_of_tile(path, *a.tile) : path), frames);
    }
  }
  return print_result(text);
}

/// A file that does not fit into memory is told by its size.
io::LoadLimits load_limits(const RenderArguments& a) {
  io::LoadLimits limits;
  if (a.memory_limit > 0) limits.file_bytes = std::min(limits.file_bytes, a.memory_limit);
  limits.image_bytes = a.memory_limit;
  return limits;
}

/// The part of the frame that is rendered: all, a crop or pixel, or a tile.
Status choose_window(RenderJob& job) {
  const RenderArguments& a = job.arguments;
  job.window = a.crop;
  if (a.tile) {
    job.window.emplace();
    if (Status status = tile_window(job.size, *a.tile, *job.window); !status) return status;
  }
  const Status status = render::check_options(render_options(job));
  if (status.ok()) return {};
  // Other numbers are within their ranges by now.
  const char* const flag = a.tile ? "--tile" : a.print_pixel ? "--pixel" : a.crop ? "--crop" : "--size";
  return {status.code(), fmt::format("{}: {}", flag, status.message())};
}

/// Leaves out what need not be rendered, which for --resume depends on what would be.
Status choose_frames(RenderJob& job) {
  const RenderArguments& a = job.arguments;
  if (Status status = hash_inputs(job, job.inputs_hash); !status) return status;
  job.pixels_hash = pixel_hash(job);
  if (a.print_pixel) return {};
  if (a.skip_existing) skip_existing(job);
  if (a.resume) skip_done(job);
  return {};
}

/// Reads the inputs and checks all that can be checked before work begins.
Status load(RenderJob& job) {
  const Stopwatch watch;
  set_phase("reading the scene");
  const RenderArguments& a = job.arguments;
  if (Status status = plan_frames(a, job.frames); !status) return status;
  if (!a.create_folders) {
    if (Status status = check_outputs(a, job.frames); !status) return status;
  }
  if (Status status = io::load_scene(a.scene, job.scene, load_limits(a), a.animation); !status) return status;
  const ViewChoice choice = {a.setup, a.camera, a.mesh_lights};
  if (Status status = choose_view(job.scene, choice, job.view, job.origin); !status) {
    return status;
  }
  if (Status status = place_cameras(job); !status) return status;
  job.size = frame_size(a, job.view.camera);
  if (Status status = choose_window(job); !status) return status;
  if (Status status = check_memory(job); !status) return status;
  if (a.create_folders && !a.dry_run) {
    if (Status status = create_output_folders(a); !status) return status;
    if (Status status = check_outputs(a, job.frames); !status) return status;
  }
  if (!a.dry_run) {
    if (Status status = choose_frames(job); !status) return status;
  }
  job.stats.lights.resize(job.view.lights.size());
  job.seconds.load = watch.seconds();
  return {};
}

/// What textures decode to is known only now.
Status read_textures(RenderJob& job) {
  const Stopwatch watch;
  set_phase("reading textures");
  if (Status status = io::read_textures(job.scene, load_limits(job.arguments)); !status) return status;
  job.seconds.load += watch.seconds();
  return check_memory(job);
}

Status write_report(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  if (!a.quiet) {
    for (const std::string& line : summary(job)) say(line);
  }
  if (a.stats.empty()) return {};
  // A run that is repeated and finds all done keeps the report of the one that did it.
  std::error_code error;
  if (job.frames.empty() && std::filesystem::exists(a.stats, error)) return {};
  return io::write_text(a.stats, stats_text(job), may_exist(a));
}

Status run(const RenderArguments& a) {
  if (Status status = open_log(a.log_file); !status) return status;
  RenderJob job(a);
  Checkpoints checkpoints(a.checkpoints, a.quiet);
  limit_memory(a.memory_limit);
  if (Status status = load(job); !status) return status;
  if (a.dry_run) return describe_plan(job);
  job.threads = a.threads > 0 ? a.threads : allowed_threads();
  Status status;
  const auto work = [&] {
    status = read_textures(job);
    if (status.ok()) status = build_world(job);
    if (!status) return;
    warn(job);
    status = render_frames(job, checkpoints);
  };
  if (!job.frames.empty()) render::with_threads(job.threads, work);
  if (status.ok()) status = write_report(job);
  return status;
}

}  // namespace

Command add_render_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("render", "Render a scene to image files");
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(*parser, *arguments);
  return {parser, [arguments] { return report_status(run(*arguments)); }};
}

}  // namespace umbrix::app
