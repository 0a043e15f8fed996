// SPDX-License-Identifier: Apache-2.0
#include "frame_loop.h"

#include <fmt/format.h>

#include "heat_map_files.h"
#include "image_metadata.h"
#include "memory_guard.h"
#include "moving_scene.h"
#include "progress.h"
#include "standard_streams.h"
#include "stopwatch.h"
#include "umbrix/io/content_hash.h"

namespace umbrix::app {
namespace {

/// What lasts from frame to frame.
struct RunState {
  Progress& progress;
  Checkpoints& checkpoints;
};

/// What of a frame tells its floats from those of other frames, parts and jobs.
std::string checkpoint_key(const RenderJob& job, const Frame& frame) {
  const render::Crop part = job.window.value_or(render::Crop{0, 0, job.size.width, job.size.height});
  return io::content_hash(fmt::format("{} {} {} {} {} {} {}", job.pixels_hash, frame.number.has_value(),
                                      frame.number.value_or(0), part.x, part.y, part.width, part.height));
}

Status write_preview(const RenderArguments& a, const io::Image& image) {
  io::WriteOptions options = a.write;
  options.overwrite = true;
  return io::write_image(a.preview, image, options);
}

Status trace(RenderJob& job, const Frame& frame, RunState& state, io::Image& image, FrameReport& report) {
  set_phase("rendering");
  const Stopwatch watch;
  render::RenderOptions options = render_options(job);
  if (job.arguments.kernel_name == "auto") options.tracer = &job.tracer;
  options.frame = frame.number.value_or(0);
  options.progress = [&state](std::size_t done, std::size_t total) { state.progress.update(done, total); };
  if (!frame.checkpoint.empty() && state.checkpoints.in_use()) {
    state.checkpoints.begin_frame(frame.checkpoint, checkpoint_key(job, frame));
    options.store = &state.checkpoints;
  }
  options.cancel = &state.checkpoints.leaving();
  Status preview_status;
  if (!job.arguments.preview.empty()) {
    options.preview = [&](const io::Image& so_far, std::uint32_t) {
      if (preview_status.ok()) preview_status = write_preview(job.arguments, so_far);
    };
  }
  const render::View view = {frame.camera, job.view.lights};
  Status status = render::render(job.world, view, options, image, report.stats);
  state.checkpoints.wait_if_leaving();
  report.seconds.render = watch.seconds();
  return status.ok() ? preview_status : status;
}

Status write_images(const RenderJob& job, const Frame& frame, io::Image& image, FrameReport& report) {
  set_phase("writing images");
  const Stopwatch watch;
  for (const std::string& path : frame.outputs) {
    image.metadata = image_metadata(job, frame, path);
    if (Status status = io::write_image(path, image, job.arguments.write); !status) return status;
  }
  if (Status status = write_heat_maps(job, frame, image, report.stats); !status) return status;
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

/// A line with the pixel's channels, for --pixel.
Status print_pixel(const RenderJob& job, const Frame& frame, const io::Image& image) {
  std::string line = frame.number ? fmt::format("frame {}, ", *frame.number) : "";
  line += fmt::format("pixel {},{}:", job.window->x, job.window->y);
  for (std::size_t c = 0; c < image.channels.size(); ++c)
    line += fmt::format(" {} {}", image.channels[c], image.pixels[c]);
  return print_result(line + "\n");
}

Status render_all(RenderJob& job, RunState& state, io::Image& image) {
  for (std::size_t i = 0; i < job.frames.size(); ++i) {
    FrameReport report;
    report.frame = i;
    Status status = move_world(job, job.frames[i], report);
    if (status.ok()) status = trace(job, job.frames[i], state, image, report);
    if (status.ok()) status = write_images(job, job.frames[i], image, report);
    if (status.ok() && job.arguments.print_pixel) status = print_pixel(job, job.frames[i], image);
    if (!status) return status;
    state.checkpoints.end_frame();
    count(job, report);
    state.progress.frame_done(job.frames[i].number);
  }
  return {};
}

}  // namespace

render::RenderOptions render_options(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  render::RenderOptions options;
  options.width = job.size.width;
  options.height = job.size.height;
  options.crop = job.window;
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

Status render_frames(RenderJob& job, Checkpoints& checkpoints) {
  Progress progress(job.arguments.quiet ? ProgressStyle::none : job.arguments.progress, job.frames.size());
  RunState state = {progress, checkpoints};
  io::Image image;
  Status status = render_all(job, state, image);
  if (!status) checkpoints.keep_frame();
  progress.finish();
  return status;
}

}  // namespace umbrix::app
