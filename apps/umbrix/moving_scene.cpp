// SPDX-License-Identifier: Apache-2.0
#include "moving_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "memory_guard.h"
#include "stopwatch.h"

namespace umbrix::app {
namespace {

BuildOptions build_options(const RenderJob& job) {
  BuildOptions options;
  options.quality = job.arguments.build_quality;
  return options;
}

/// The tracer knows the scene it was started for, a kernel what was prepared in it.
Status get_ready(RenderJob& job) {
  ++job.trees_built;
  if (job.arguments.kernel_name == "auto") return job.tracer.start(job.world.scene);
  return job.world.scene.prepare(job.arguments.kernel);
}

}  // namespace

Status pose_scene(RenderJob& job, const Frame& frame, io::SceneChanges& changes) {
  changes = {};
  if (!frame.number || !job.scene.motion) return {};
  io::Moment moment;
  moment.frame = *frame.number;
  moment.seconds = frame.seconds;
  if (Status status = io::pose_scene(job.scene, moment, changes); !status) {
    return {status.code(), fmt::format("{}: frame {}: {}", job.scene.path, *frame.number, status.message())};
  }
  if (job.origin.scene_lights) std::copy(job.scene.lights.begin(), job.scene.lights.end(), job.view.lights.begin());
  return {};
}

Status build_world(RenderJob& job) {
  const Stopwatch watch;
  set_phase("building the tree");
  Status status;
  // Where the first frame wants it, so that it is not built twice.
  io::SceneChanges changes;
  if (!job.frames.empty()) status = pose_scene(job, job.frames.front(), changes);
  if (status.ok()) {
    status =
        render::build_world(job.scene, build_options(job), job.world, job.arguments.instancing, job.frames.size() > 1);
  }
  if (status.ok()) status = get_ready(job);
  job.seconds.build = watch.seconds();
  return status;
}

Status move_world(RenderJob& job, const Frame& frame, FrameReport& report) {
  const Stopwatch watch;
  set_phase("moving the scene");
  io::SceneChanges changes;
  Status status = pose_scene(job, frame, changes);
  report.moved_instances = changes.instances.size();
  report.moved_lights = changes.lights;
  if (status.ok() && !changes.instances.empty()) {
    set_phase("building the tree");
    status = render::move_world(changes, build_options(job), job.world, report.tree_built);
    if (status.ok() && report.tree_built) status = get_ready(job);
  }
  report.seconds.build = watch.seconds();
  return status;
}

}  // namespace umbrix::app
