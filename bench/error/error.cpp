// SPDX-License-Identifier: Apache-2.0
//
// Run time against error: what is wrong among answers, and how far images are from the truth, over what they cost.
#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "error/image_curves.h"
#include "error/machine.h"
#include "error/ray_errors.h"
#include "error/ray_rows.h"
#include "error/report_files.h"
#include "light_choice.h"
#include "render/render.h"
#include "report.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::string setup, from;
  std::string light = "all";
  RayErrorOptions rays;
  ImageCurveOptions images;
  ReportFiles files;
};

void print_rows(const nlohmann::json& rows) {
  fmt::print("  {:<11} {:<31} {:>9} {:>9} {:>9} {:>9} {:>12}\n", "rays", "tracer", "rays", "Mrays/s", "leaks", "false",
             "wrong/million");
  for (const nlohmann::json& row : rows) {
    fmt::print("  {:<11} {:<31} {:>9} {:>9.3f} {:>9} {:>9} {:>12.2f}\n", row.at("kind").get<std::string>(),
               row.at("peer").get<std::string>(), row.at("rays").get<std::uint64_t>(),
               row.at("mrays_per_s").at("value").get<double>(), row.at("leaks").get<std::uint64_t>(),
               row.at("false_shadows").get<std::uint64_t>(), row.at("wrong_per_million").at("value").get<double>());
  }
}

void print_images(const nlohmann::json& images) {
  fmt::print("  images: noise of the reference is {:.3f} of the smallest RMSE\n",
             images.at("reference").at("noise_share").get<double>());
  for (const nlohmann::json& point : images.at("points")) {
    fmt::print("  {:>5} rays a pixel: RMSE {:.4g}, relMSE {:.4g}, bias {:+.2g};", point.at("samples").get<int>(),
               point.at("rmse").at("value").get<double>(), point.at("relmse").at("value").get<double>(),
               point.at("bias").at("value").get<double>());
    for (const nlohmann::json& time : point.at("times"))
      fmt::print(" {} {:.3f} s", time.at("kernel").get<std::string>(), time.at("seconds").at("value").get<double>());
    fmt::print("\n");
  }
}

Status measure(const Settings& settings, const std::string& path, nlohmann::json& report) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  std::vector<std::size_t> lights;
  if (Status status = choose_lights(settings.light, viewpoint.lights.size(), path, lights); !status) return status;
  fmt::print("{}: {} triangles\n", geometry.name, geometry.triangle_count());
  std::vector<RayErrors> sets;
  if (Status status = measure_rays(geometry, viewpoint, lights, settings.rays, sets); !status) return status;
  const nlohmann::json rows = ray_rows(geometry.name, sets);
  print_rows(rows);
  report["rows"].insert(report["rows"].end(), rows.begin(), rows.end());
  if (settings.images.samples.empty()) return {};
  const auto light =
      std::find_if(lights.begin(), lights.end(), [&](std::size_t i) { return can_have_area(viewpoint.lights[i]); });
  if (light == lights.end()) {
    fmt::print("  no images: no light that is chosen could have an area\n");
    return {};
  }
  if (Status status =
          measure_images(geometry, viewpoint.camera, viewpoint.lights[*light], settings.images, report["images"]);
      !status)
    return status;
  print_images(report["images"].back());
  std::fflush(stdout);
  return {};
}

/// Whether a tracer of ours answered a ray wrongly.
bool is_any_wrong(const nlohmann::json& report) {
  for (const nlohmann::json& row : report.at("rows")) {
    const bool ours = row.at("family").get<std::string>().rfind("embree", 0) != 0;
    if (ours && row.at("wrong_per_million").at("value") != 0.0) return true;
  }
  return false;
}

ExitCode run(const Settings& settings) {
  nlohmann::json report;
  if (!settings.from.empty()) {
    if (const Status status = read_report(settings.from, report); !status) return fail(status);
  } else {
    report = {{"machine", machine_json()},
              {"load_before", load_json()},
              {"settings",
               {{"size", settings.rays.size},
                {"light", settings.light},
                {"adversarial", settings.rays.adversarial},
                {"seed", settings.rays.seed},
                {"rounds", settings.rays.rounds}}},
              {"rows", nlohmann::json::array()},
              {"images", nlohmann::json::array()}};
    for (const std::string& path : settings.scenes) {
      if (const Status status = measure(settings, path, report); !status) return fail(status);
    }
    if (settings.scenes.size() > 1) {
      const nlohmann::json pooled = pooled_rows(report["rows"]);
      report["rows"].insert(report["rows"].begin(), pooled.begin(), pooled.end());
    }
    report["load_after"] = load_json();
  }
  if (const Status status = write_report(report, settings.files); !status) return fail(status);
  return is_any_wrong(report) ? kFailed : kDone;
}

}  // namespace

std::function<ExitCode()> error_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  RayErrorOptions& rays = settings->rays;
  ImageCurveOptions& images = settings->images;
  CLI::Option* scenes = app.add_option("scene", settings->scenes, "glTF files");
  CLI::Option* from = app.add_option("--from", settings->from, "Measure nothing: take what --json wrote");
  scenes->excludes(from);
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--light", settings->light,
                 "Which light's rays, counted from 0, or all; images have the first that may have an area")
      ->check(light_validator());
  app.add_option("--size", rays.size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--adversarial", rays.adversarial, "Adversarial rays of each kind; 0: none")
      ->check(CLI::Range(0, 1 << 24));
  app.add_option("--seed", rays.seed, "Makes the adversarial rays");
  app.add_option("--rounds", rays.rounds, "Timed runs of each tracer")->check(CLI::Range(1, 1000));
  app.add_option("--kernels", rays.kernels, "all, or some of them")->delimiter(',');
  app.add_option("--samples", images.samples, "Images of so many shadow rays a pixel; 0: no images")
      ->delimiter(',')
      ->check(CLI::Range(0u, render::kMostLightSamples));
  app.add_option("--seeds", images.seeds, "Images for each number of rays")->check(CLI::Range(1, 1000));
  app.add_option("--reference", images.reference, "Shadow rays a pixel of each half of the reference")
      ->check(CLI::Range(1u, 1u << 24));
  app.add_option("--image-size", images.size, "Pixels of images in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--image-kernels", images.kernels, "Kernels, or frames:best, that render the images")->delimiter(',');
  app.add_option("--radius", images.radius, "Of a spherical light in place of a point, in scene diagonals")
      ->check(CLI::Range(1e-6, 10.0));
  app.add_option("--keep-images", images.keep, "Write the images as PNG into this folder")
      ->check(CLI::ExistingDirectory);
  app.add_option("--json", settings->files.json, "Write what was measured to this file");
  app.add_option("--html", settings->files.html, "Write the report as one page to this file");
  app.add_option("--out", settings->files.folder, "Write the page and its charts into this folder");
  return [settings, &app]() -> ExitCode {
    if (settings->scenes.empty() && settings->from.empty()) {
      fmt::print(stderr, "umbrix-bench: scenes to measure, or --from FILE, are needed\n{}", app.help());
      return kUsage;
    }
    auto& samples = settings->images.samples;
    samples.erase(std::remove(samples.begin(), samples.end(), 0u), samples.end());
    return run(*settings);
  };
}

}  // namespace umbrix::bench
