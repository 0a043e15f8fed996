// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <memory>

#include "commands.h"
#include "exit_code.h"
#include "message.h"
#include "output_files.h"
#include "render/threads.h"
#include "render_arguments.h"
#include "render_report.h"
#include "signals.h"
#include "thread_count.h"
#include "umbrix/version.h"
#include "view_choice.h"

namespace umbrix::app {
namespace {

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Status check_interrupt() { return interrupted() ? Status(StatusCode::cancelled, "interrupted") : Status(); }

Size frame_size(const RenderArguments& a, const io::Camera& camera) {
  if (a.size) return *a.size;
  constexpr int kRows = 720;
  return {std::max(1, static_cast<int>(std::lround(kRows * natural_aspect(camera)))), kRows};
}

render::RenderOptions render_options(const RenderArguments& a, const Size& size) {
  render::RenderOptions options;
  options.width = size.width;
  options.height = size.height;
  options.crop = a.crop;
  options.samples = a.samples;
  options.seed = a.seed;
  options.aovs = a.aovs;
  options.kernel = a.kernel;
  options.count_work = !a.stats.empty();
  options.cancel = &interrupted();
  return options;
}

/// Says in the file how it was made, without anything that differs between runs, machines or kernels.
void add_metadata(const RenderArguments& a, const Size& size, io::Image& image) {
  image.metadata = {{"Software", fmt::format("umbrix {}", version_string())},
                    {"umbrix:seed", std::to_string(a.seed)},
                    {"umbrix:spp", std::to_string(a.samples)}};
  if (a.crop) {
    const render::Crop& c = *a.crop;
    image.metadata.emplace_back("umbrix:crop", fmt::format("{}x{}+{}+{}", c.width, c.height, c.x, c.y));
    image.metadata.emplace_back("umbrix:frame_size", fmt::format("{}x{}", size.width, size.height));
  }
}

Status write_outputs(const RenderArguments& a, const io::Image& image) {
  const SignalScope hold(OnSignal::hold);
  for (const std::string& path : a.outputs) {
    if (Status status = check_interrupt(); !status) return status;
    if (Status status = io::write_image(path, image, a.write); !status) return status;
  }
  return {};
}

void warn(const RenderArguments& a, const io::SceneFile& scene, const std::vector<std::string>& notes) {
  if (a.quiet) return;
  for (const std::string& text : scene.warnings) say_warning(text);
  for (const std::string& text : notes) say_warning(text);
  if (!a.verbose) return;
  for (const std::string& text : scene.ignored) say(fmt::format("umbrix: ignored: {}", text));
}

void describe_plan(const RenderArguments& a, const io::SceneFile& scene, const render::View& view, const Size& size) {
  fmt::print("{}: {} triangles, {} lights, {}x{} pixels, {} samples\n", printable(scene.path),
             scene.instanced_triangles(), view.lights.size(), size.width, size.height, a.samples);
  for (const std::string& path : a.outputs) fmt::print("would write {}\n", printable(path));
}

Status trace(const RenderArguments& a, const io::SceneFile& scene, const render::View& view, const Size& size,
             RenderReport& report, render::World& world, render::RenderStats& stats, io::Image& image) {
  Stopwatch watch;
  BuildOptions build;
  build.quality = a.build_quality;
  if (Status status = render::build_world(scene, build, world); !status) return status;
  report.seconds_build = watch.lap();
  warn(a, scene, world.notes);

  const SignalScope stop(OnSignal::stop);
  Progress progress(a.quiet ? ProgressStyle::none : a.progress);
  render::RenderOptions options = render_options(a, size);
  options.progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); };
  const Status status = render::render(world, view, options, image, stats);
  progress.finish();
  report.seconds_render = watch.lap();
  return status;
}

Status run(const RenderArguments& a) {
  Stopwatch watch;
  if (!a.create_folders) {
    if (Status status = check_outputs(a); !status) return status;
  }
  io::SceneFile scene;
  if (Status status = io::load_scene(a.scene, scene); !status) return status;
  render::View view;
  if (Status status = choose_view(scene, a.setup, a.camera, view); !status) return status;
  const Size size = frame_size(a, view.camera);
  if (Status status = render::check_options(render_options(a, size)); !status) return status;
  const double seconds_load = watch.lap();
  if (a.dry_run) {
    describe_plan(a, scene, view, size);
    return {};
  }
  if (a.create_folders) {
    if (Status status = create_output_folders(a); !status) return status;
    if (Status status = check_outputs(a); !status) return status;
  }

  render::World world;
  render::RenderStats stats;
  io::Image image;
  RenderReport report = {a, scene, world, view, stats, size.width, size.height};
  report.threads = a.threads > 0 ? a.threads : allowed_threads();
  report.seconds_load = seconds_load;
  Status status;
  render::with_threads(report.threads, [&] { status = trace(a, scene, view, size, report, world, stats, image); });
  if (!status) return status;

  watch.lap();
  add_metadata(a, size, image);
  if (status = write_outputs(a, image); !status) return status;
  report.seconds_write = watch.lap();
  if (!a.stats.empty()) {
    if (status = io::write_text(a.stats, stats_text(report), a.write.overwrite); !status) return status;
  }
  if (a.quiet) return {};
  for (const std::string& line : summary(report)) say(line);
  return {};
}

}  // namespace

Command add_render_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("render", "Render a scene to image files");
  const auto arguments = std::make_shared<RenderArguments>();
  add_render_options(*parser, *arguments);
  return {parser, [arguments] { return report_status(run(*arguments)); }};
}

}  // namespace umbrix::app
