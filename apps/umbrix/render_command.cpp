// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "commands.h"
#include "exit_code.h"
#include "heat_map_files.h"
#include "message.h"
#include "output_files.h"
#include "render/threads.h"
#include "render_job.h"
#include "render_report.h"
#include "signals.h"
#include "thread_count.h"
#include "umbrix/version.h"
#include "view_choice.h"

namespace umbrix::app {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

Size frame_size(const RenderArguments& a, const io::Camera& camera) {
  if (a.size) return *a.size;
  constexpr int kRows = 720;
  return {static_cast<int>(std::clamp(std::round(kRows * natural_aspect(camera)), 1.0, 65536.0)), kRows};
}

render::RenderOptions render_options(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  render::RenderOptions options;
  options.width = job.size.width;
  options.height = job.size.height;
  options.crop = a.crop;
  options.samples = a.samples;
  options.seed = a.seed;
  options.aovs = rendered_aovs(a);
  options.kernel = a.kernel;
  options.count_work = !a.stats.empty();
  options.cancel = &interrupted();
  return options;
}

/// Says in the file how it was made, without anything that differs between runs, machines or kernels.
void add_metadata(RenderJob& job) {
  const RenderArguments& a = job.arguments;
  io::Image& image = job.image;
  image.metadata = {{"Software", fmt::format("umbrix {}", version_string())},
                    {"umbrix:seed", std::to_string(a.seed)},
                    {"umbrix:spp", std::to_string(a.samples)}};
  if (a.crop) {
    const render::Crop& c = *a.crop;
    image.metadata.emplace_back("umbrix:crop", fmt::format("{}x{}+{}+{}", c.width, c.height, c.x, c.y));
    image.metadata.emplace_back("umbrix:frame_size", fmt::format("{}x{}", job.size.width, job.size.height));
  }
}

void warn(const RenderJob& job) {
  if (job.arguments.quiet) return;
  for (const std::string& text : job.scene.warnings) say_warning(text);
  for (const std::string& text : job.world.notes) say_warning(text);
  if (!job.arguments.verbose) return;
  for (const std::string& text : job.scene.ignored) say(fmt::format("umbrix: ignored: {}", text));
}

void describe_plan(const RenderJob& job) {
  fmt::print("{}: {} triangles, {} lights, {}x{} pixels, {} samples\n", printable(job.scene.path),
             job.scene.instanced_triangles(), job.view.lights.size(), job.size.width, job.size.height,
             job.arguments.samples);
  for (const std::vector<std::string>& list : {job.arguments.outputs, heat_map_files(job.arguments)}) {
    for (const std::string& path : list) fmt::print("would write {}\n", printable(path));
  }
}

/// Reads the inputs and checks all that can be checked before work begins.
Status load(RenderJob& job) {
  const Stopwatch watch;
  const RenderArguments& a = job.arguments;
  if (!a.create_folders) {
    if (Status status = check_outputs(a); !status) return status;
  }
  if (Status status = io::load_scene(a.scene, job.scene); !status) return status;
  if (Status status = choose_view(job.scene, a.setup, a.camera, job.view); !status) return status;
  job.size = frame_size(a, job.view.camera);
  if (Status status = render::check_options(render_options(job)); !status) return status;
  if (a.create_folders && !a.dry_run) {
    if (Status status = create_output_folders(a); !status) return status;
    if (Status status = check_outputs(a); !status) return status;
  }
  job.seconds.load = watch.seconds();
  return {};
}

Status build(RenderJob& job) {
  const Stopwatch watch;
  BuildOptions options;
  options.quality = job.arguments.build_quality;
  Status status = render::build_world(job.scene, options, job.world);
  job.seconds.build = watch.seconds();
  return status;
}

Status trace(RenderJob& job) {
  const SignalScope stop(OnSignal::stop);
  const Stopwatch watch;
  Progress progress(job.arguments.quiet ? ProgressStyle::none : job.arguments.progress);
  render::RenderOptions options = render_options(job);
  options.progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); };
  Status status = render::render(job.world, job.view, options, job.image, job.stats);
  progress.finish();
  job.seconds.render = watch.seconds();
  return status;
}

Status write_images(RenderJob& job) {
  const SignalScope hold(OnSignal::hold);
  const Stopwatch watch;
  add_metadata(job);
  for (const std::string& path : job.arguments.outputs) {
    if (interrupted()) return {StatusCode::cancelled, "interrupted"};
    if (Status status = io::write_image(path, job.image, job.arguments.write); !status) return status;
  }
  if (Status status = write_heat_maps(job); !status) return status;
  job.seconds.write = watch.seconds();
  return {};
}

Status write_report(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  if (!a.quiet) {
    for (const std::string& line : summary(job)) say(line);
  }
  if (a.stats.empty()) return {};
  const SignalScope hold(OnSignal::hold);
  return io::write_text(a.stats, stats_text(job), a.write.overwrite);
}

Status run(const RenderArguments& a) {
  RenderJob job(a);
  if (Status status = load(job); !status) return status;
  if (a.dry_run) {
    describe_plan(job);
    return {};
  }
  job.threads = a.threads > 0 ? a.threads : allowed_threads();
  Status status;
  render::with_threads(job.threads, [&] {
    status = build(job);
    if (!status) return;
    warn(job);
    status = trace(job);
  });
  if (status.ok()) status = write_images(job);
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
