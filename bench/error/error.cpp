// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "error/ray_errors.h"
#include "error/ray_rows.h"
#include "light_choice.h"
#include "report.h"
#include "workload/geometry.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::string setup, json;
  std::string light = "all";
  RayErrorOptions rays;
};

void print_rows(const nlohmann::json& rows) {
  for (const nlohmann::json& row : rows) {
    fmt::print("  {:<12} {:<9} {:<32} {:>9} {:>8} {:>8} {:>10.2f} {:>9.3f}\n", row["kind"].get<std::string>(),
               row["aim"].get<std::string>(), row["peer"].get<std::string>(), row["rays"].get<std::uint64_t>(),
               row["leaks"].get<std::uint64_t>(), row["false_shadows"].get<std::uint64_t>(),
               row["wrong_per_million"]["value"].get<double>(), row["mrays_per_s"]["value"].get<double>());
  }
}

Status measure(const Settings& settings, const std::string& path, nlohmann::json& report) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  std::vector<std::size_t> lights;
  if (Status status = choose_lights(settings.light, viewpoint.lights.size(), path, lights); !status) return status;
  std::vector<RayErrors> sets;
  if (Status status = measure_rays(geometry, viewpoint, lights, settings.rays, sets); !status) return status;
  const nlohmann::json rows = ray_rows(geometry.name, sets);
  print_rows(rows);
  report["rows"].insert(report["rows"].end(), rows.begin(), rows.end());
  return {};
}

ExitCode run(const Settings& settings) {
  nlohmann::json report = {{"rows", nlohmann::json::array()}};
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, report); !status) return fail(status);
  }
  return write_json(settings.json, report);
}

}  // namespace

std::function<ExitCode()> error_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--light", settings->light, "Which light's rays, counted from 0, or all")->check(light_validator());
  app.add_option("--size", settings->rays.size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--adversarial", settings->rays.adversarial, "Adversarial rays of each kind; 0: none")
      ->check(CLI::Range(0, 1 << 24));
  app.add_option("--seed", settings->rays.seed, "Makes the adversarial rays");
  app.add_option("--rounds", settings->rays.rounds, "Timed runs of each peer")->check(CLI::Range(1, 1000));
  app.add_option("--kernels", settings->rays.kernels, "all, or some of them")->delimiter(',');
  app.add_option("--json", settings->json, "Write what was measured to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
