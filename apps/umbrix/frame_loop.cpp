// SPDX-License-Identifier: Apache-2.0
#include "frame_loop.h"

#include <fmt/format.h>

#include "heat_map_files.h"
#include "memory_guard.h"
#include "moving_scene.h"
#include "progress.h"
#include "stopwatch.h"
#include "umbrix/version.h"

namespace umbrix::app {
namespace {

/// Says in the file how it was made, without anything that differs between runs, machines or kernels, or with the other
/// frames of the run.
void add_metadata(const RenderJob& job, const Frame& frame, io::Image& image) {
  const RenderArguments& a = job.arguments;
  image.metadata = {{"Software", fmt::format("umbrix {}", version_string())},
                    {"umbrix:seed", std::to_string(a.seed)},
                    {"umbrix:spp", std::to_string(a.samples)}};
  if (a.light_samples > 1) image.metadata.emplace_back("umbrix:light_samples", std::to_string(a.light_samples));
  if (a.bounces > 0) image.metadata.emplace_back("umbrix:bounces", std::to_string(a.bounces));
  if (frame.number) image.metadata.emplace_back("umbrix:frame", std::to_string(*frame.number));
  if (a.crop) {
    const render::Crop& c = *a.crop;
    image.metadata.emplace_back("umbrix:crop", fmt::format("{}x{}+{}+{}", c.width, c.height, c.x, c.y));
    image.metadata.emplace_back("umbrix:frame_size", fmt::format("{}x{}", job.size.width, job.size.height));
  }
}

Status write_preview(const RenderArguments& a, const io::Image& image) {
  io::WriteOptions options = a.write;
  options.overwrite = true;
  return io::write_image(a.preview, image, options);
}

Status trace(RenderJob& job, const Frame& frame, Progress& progress, io::Image& image, FrameReport& report) {
  set_phase("rendering");
  const Stopwatch watch;
  render::RenderOptions options = render_options(job);
  if (job.arguments.kernel_name == "auto") options.tracer = &job.tracer;
  options.frame = frame.number.value_or(0);
  options.progress = [&progress](std::size_t done, std::size_t total) { progress.update(done, total); };
  Status preview_status;
  if (!job.arguments.preview.empty()) {
    options.preview = [&](const io::Image& so_far, std::uint32_t) {
      if (preview_status.ok()) preview_status = write_preview(job.arguments, so_far);
    };
  }
  const render::View view = {frame.camera, job.view.lights};
  Status status = render::render(job.world, view, options, image, report.stats);
  report.seconds.render = watch.seconds();
  return status.ok() ? preview_status : status;
}

Status write_images(const RenderJob& job, const Frame& frame, io::Image& image, FrameReport& report) {
  set_phase("writing images");
  const Stopwatch watch;
  add_metadata(job, frame, image);
  for (const std::string& path : frame.outputs) {
    if (Status status = io::write_image(path, image, job.arguments.write); !status) return status;
  }
  if (Status status = write_heat_maps(job.arguments, frame, image, report.stats); !status) return status;
  report.seconds.write = watch.seconds();
  return {};
}

void count(RenderJob& job, FrameReport& report) {
  job.stats += report.stats;
  job.seconds.build += report.seconds.build;
  job.seconds.render += report.seconds.render;
  job.seconds.write += report.seconds.write;
  if (!job.arguments.stats.empty()) job.reports.push_back(std::move(report));
}

Status render_all(RenderJob& job, Progress& progress) {
  io::Image image;
  for (std::size_t i = 0; i < job.frames.size(); ++i) {
    FrameReport report;
    report.frame = i;
    Status status = move_world(job, job.frames[i], report);
    if (status.ok()) status = trace(job, job.frames[i], progress, image, report);
    if (status.ok()) status = write_images(job, job.frames[i], image, report);
    if (!status) return status;
    count(job, report);
    progress.frame_done(job.frames[i].number);
  }
  return {};
}

}  // namespace

render::RenderOptions render_options(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  render::RenderOptions options;
  options.width = job.size.width;
  options.height = job.size.height;
  options.crop = a.crop;
  options.samples = a.samples;
  options.light_samples = a.light_samples;
  options.bounces = a.bounces;
  options.filter = a.filter;
  options.ao_distance = a.ao_distance;
  options.seed = a.seed;
  options.aovs = rendered_aovs(a);
  options.kernel = a.kernel;
  options.count_work = !a.stats.empty();
  return options;
}

Status render_frames(RenderJob& job) {
  Progress progress(job.arguments.quiet ? ProgressStyle::none : job.arguments.progress, job.frames.size());
  Status status = render_all(job, progress);
  progress.finish();
  return status;
}

}  // namespace umbrix::app
