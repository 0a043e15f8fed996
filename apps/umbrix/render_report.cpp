// SPDX-License-Identifier: Apache-2.0
#include "render_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "umbrix/version.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::ordered_json;

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

double mega(std::uint64_t n) { return static_cast<double>(n) * 1e-6; }

const char* simd_target(const RenderArguments& a) {
  return a.simd_target.empty() ? simd_target_name(0) : a.simd_target.c_str();
}

Json work(const RayCounts& counts) {
  const auto rays = static_cast<double>(counts.rays);
  return {{"rays", counts.rays},
          {"node_tests_per_ray", ratio(static_cast<double>(counts.node_tests), rays)},
          {"primitive_tests_per_ray", ratio(static_cast<double>(counts.primitive_tests), rays)},
          {"leaf_visits_per_ray", ratio(static_cast<double>(counts.leaf_visits), rays)},
          {"double_tests", counts.double_tests},
          {"exact_tests", counts.exact_tests},
          {"far_rays", counts.far_rays}};
}

Json routes(const render::RouteCounts<std::uint64_t>& rays) {
  Json counts;
  for (std::size_t i = 0; i < render::kRayRoutes; ++i) counts[render::kRouteNames[i]] = rays[i];
  return counts;
}

Json confusion(const Confusion& c) {
  const auto row = [](const std::uint64_t(&counts)[2]) {
    return Json{{"unoccluded", counts[0]}, {"occluded", counts[1]}};
  };
  return {{"predicted_occluded", row(c.predicted_occluded)},
          {"predicted_unoccluded", row(c.predicted_unoccluded)},
          {"not_predicted", row(c.not_predicted)},
          {"accuracy", c.accuracy()}};
}

/// What the frame tracer foresaw, and what it was worth.
Json prediction(const FrameStats& frame) {
  return {{"first", frame.first},
          {"cut", frame.cut},
          {"rays", frame.rays},
          {"confusion", confusion(frame.confusion)},
          {"cache_tries", frame.cache_tries},
          {"cache_hits", frame.cache_hits},
          {"precompute_seconds", frame.precompute_seconds},
          {"bytes", frame.bytes}};
}

/// The images, then the heat maps.
Json output_files(std::vector<std::string> images, const std::vector<HeatMapFile>& maps) {
  for (const HeatMapFile& map : maps) images.push_back(map.path);
  return images;
}

Json shadow_rays(const render::LightStats& light) {
  return {{"rays", light.rays()},
          {"occluded", work(light.counts.occluded)},
          {"unoccluded", work(light.counts.unoccluded)},
          {"skipped",
           {{"surface_faces_away", light.skipped_behind},
            {"beyond_range", light.skipped_range},
            {"outside_cone", light.skipped_cone},
            {"emitter_faces_away", light.skipped_emitter},
            {"no_power", light.skipped_no_power}}},
          {"routes", routes(light.routes)},
          {"thread_seconds", light.seconds},
          {"mrays_per_second_per_thread", ratio(mega(light.rays()), light.seconds)}};
}

Json build(const BuildStats& b) {
  return {{"triangles", b.triangles},
          {"dropped_nonfinite", b.dropped_nonfinite},
          {"dropped_degenerate", b.dropped_degenerate},
          {"instances", b.instances},
          {"instanced_triangles", b.instanced_triangles},
          {"nodes", b.nodes},
          {"leaves", b.leaves},
          {"empty_leaves", b.empty_leaves},
          {"references", b.references},
          {"largest_leaf", b.largest_leaf},
          {"depth", b.depth},
          {"sah_cost", b.sah_cost},
          {"node_bytes", b.node_bytes},
          {"leaf_bytes", b.leaf_bytes},
          {"triangle_bytes", b.triangle_bytes},
          {"box_bytes", b.box_bytes},
          {"instance_bytes", b.instance_bytes},
          {"bytes", b.bytes},
          {"seconds_prepare", b.seconds_prepare},
          {"seconds_tree", b.seconds_tree},
          {"seconds_leaves", b.seconds_leaves},
          {"seconds", b.seconds}};
}

/// Of rays to the nearest surface.
Json closest_rays(std::uint64_t rays, std::uint64_t hits, double seconds) {
  return {{"rays", rays},
          {"hits", hits},
          {"thread_seconds", seconds},
          {"mrays_per_second_per_thread", ratio(mega(rays), seconds)}};
}

/// "camera", "shadow", "lights" and "mrays_per_second", of a frame or of all.
void add_rays(const RenderJob& job, const render::RenderStats& stats, double seconds, Json& out) {
  const render::LightStats shadow = stats.shadow();
  Json lights = Json::array();
  for (std::size_t i = 0; i < job.view.lights.size(); ++i) {
    Json light = {{"name", job.view.lights[i].name}, {"type", io::light_type_info(job.view.lights[i].type).name}};
    light.update(shadow_rays(stats.lights[i]));
    lights.push_back(light);
  }
  out["camera"] = closest_rays(stats.camera_rays, stats.camera_hits, stats.camera_seconds);
  out["bounces"] = closest_rays(stats.bounce_rays, stats.bounce_hits, stats.bounce_seconds);
  out["shadow"] = shadow_rays(shadow);
  out["lights"] = lights;
  if (stats.frame.rays > 0) out["prediction"] = prediction(stats.frame);
  out["mrays_per_second"] = ratio(mega(stats.camera_rays + stats.bounce_rays + shadow.rays()), seconds);
}

Json frames(const RenderJob& job) {
  Json list = Json::array();
  for (const FrameReport& report : job.reports) {
    const Frame& frame = job.frames[report.frame];
    Json entry = {
        {"frame", frame.number.value_or(0)},
        {"time", frame.seconds},
        {"outputs", output_files(frame.outputs, frame.heat_maps)},
        {"tree_built", report.tree_built},
        {"moved_instances", report.moved_instances},
        {"moved_lights", report.moved_lights},
        {"seconds",
         {{"build", report.seconds.build}, {"render", report.seconds.render}, {"write", report.seconds.write}}}};
    add_rays(job, report.stats, report.seconds.render, entry);
    list.push_back(entry);
  }
  return list;
}

std::string frames_line(const RenderJob& job) {
  const std::size_t count = job.frames.size();
  return fmt::format("frames  {} rendered, {} skipped, {:.2f} s each", count, job.skipped,
                     ratio(job.seconds.render + job.seconds.write, static_cast<double>(count)));
}

}  // namespace

std::vector<std::string> summary(const RenderJob& job) {
  if (job.frames.empty()) return {"umbrix: nothing to render, all images exist"};
  const BuildStats& b = job.world.scene.build_stats();
  const render::LightStats shadow = job.stats.shadow();
  const double share_occluded = 100 * ratio(static_cast<double>(shadow.occluded), static_cast<double>(shadow.rays()));
  std::vector<std::string> lines = {
      fmt::format("scene   {} triangles in {} meshes, {} lights", b.triangles, job.world.meshes.size(),
                  job.view.lights.size()),
      fmt::format("tree    {} nodes, depth {}, {:.1f} MB", b.nodes, b.depth, mega(b.bytes)),
      fmt::format("camera  {:.2f} M rays, {:.2f} M rays/s a thread", mega(job.stats.camera_rays),
                  ratio(mega(job.stats.camera_rays), job.stats.camera_seconds)),
      fmt::format("shadow  {:.2f} M rays, {:.0f} % occluded, {:.2f} M rays/s a thread, {:.2f} M skipped",
                  mega(shadow.rays()), share_occluded, ratio(mega(shadow.rays()), shadow.seconds),
                  mega(shadow.skipped())),
      fmt::format("time    load {:.2f} s, build {:.2f} s, render {:.2f} s on {} threads, write {:.2f} s",
                  job.seconds.load, job.seconds.build, job.seconds.render, job.threads, job.seconds.write)};
  if (job.stats.bounce_rays > 0) {
    lines.insert(lines.begin() + 3,
                 fmt::format("bounces {:.2f} M rays, {:.2f} M rays/s a thread", mega(job.stats.bounce_rays),
                             ratio(mega(job.stats.bounce_rays), job.stats.bounce_seconds)));
  }
  if (!job.arguments.frames.empty()) lines.push_back(frames_line(job));
  return lines;
}

std::string stats_text(const RenderJob& job) {
  const RenderArguments& a = job.arguments;
  Json stats = {{"umbrix", version_string()},
                {"scene", job.scene.path},
                {"outputs", output_files(a.outputs, a.heat_maps)},
                {"width", job.size.width},
                {"height", job.size.height},
                {"samples_per_pixel", a.samples},
                {"light_samples", a.light_samples},
                {"bounces", a.bounces},
                {"seed", a.seed},
                {"triangles", job.world.scene.build_stats().triangles},
                {"kernel", a.kernel_name},
                {"simd_target", simd_target(a)},
                {"threads", job.threads},
                {"seconds",
                 {{"load", job.seconds.load},
                  {"build", job.seconds.build},
                  {"render", job.seconds.render},
                  {"write", job.seconds.write}}},
                {"build", build(job.world.scene.build_stats())}};
  add_rays(job, job.stats, job.seconds.render, stats);
  stats["notes"] = job.world.notes;
  if (!a.frames.empty()) {
    stats["fps"] = a.fps;
    stats["skipped_frames"] = job.skipped;
    stats["trees_built"] = job.trees_built;
    stats["frames"] = frames(job);
  }
  // File names and glTF strings may not be UTF-8: replace what is not, rather than fail.
  return stats.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace umbrix::app
