// SPDX-License-Identifier: Apache-2.0
//
// Table 1 of Liang & Huang (2019) for any scene: what each kernel's rays cost, by what was true of them, in the last
// frame of a moving camera. Counts come from a run of their own; in each round every kernel is timed once, and medians
// are shown.
#include <fmt/core.h>

#include <memory>

#include "command.h"
#include "light_choice.h"
#include "report.h"
#include "table1/contestant.h"
#include "table1/moving_camera.h"
#include "table1/table1_report.h"
#include "workload/disputes.h"
#include "workload/geometry.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::vector<std::string> kernels = {"all"};
  std::string setup, json, csv;
  std::string light = "0";
  int size = 1024;
  int rounds = 3;
  CameraMotion motion;
};

Status measure_light(const Settings& settings, Scene& scene, const workload::Geometry& geometry,
                     const workload::Viewpoint& viewpoint, std::size_t light_index, std::vector<TableRow>& rows) {
  const io::Light& light = viewpoint.lights[light_index];
  const Frames frames = moving_camera_frames(scene, geometry, viewpoint.camera, light, settings.size, settings.motion);
  std::vector<std::unique_ptr<Contestant>> contestants;
  if (Status status = make_contestants(settings.kernels, contestants); !status) return status;
  float position[1][3];
  for (std::size_t k = 0; k < 3; ++k) position[0][k] = static_cast<float>(light.position[k]);
  Training lights;
  if (light.type != io::LightType::directional) {
    lights.lights = position;
    lights.light_count = 1;
  }

  std::vector<TableRow> table(contestants.size());
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    TableRow& row = table[i];
    row.scene = geometry.name;
    row.light = light_index;
    row.kernel = contestants[i]->name();
    row.build = scene.build_stats();
    if (Status status = contestants[i]->run(scene, frames, lights, true, row.result); !status) return status;
  }
  for (int round = 0; round < settings.rounds; ++round) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      FrameResult timed;
      if (Status status = contestants[i]->run(scene, frames, lights, false, timed); !status) return status;
      table[i].seconds.push_back(timed.seconds);
      table[i].precompute_seconds.push_back(timed.precompute_seconds);
    }
  }
  std::vector<const std::vector<std::uint8_t>*> answers;
  for (const TableRow& row : table) answers.push_back(&row.result.answers);
  const std::vector<std::uint64_t> wrong = workload::count_wrong(geometry, frames.back().rays, answers);
  for (std::size_t i = 0; i < table.size(); ++i) table[i].wrong = wrong[i];
  print_table(table);
  rows.insert(rows.end(), table.begin(), table.end());
  return {};
}

Status measure(const Settings& settings, const std::string& path, std::vector<TableRow>& rows) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  BuildOptions build;
  build.tree = TreeBuild::at_commit;  // its figures go into the table
  Scene scene;
  if (Status status = workload::build_scene(geometry.views(), build, scene); !status) return status;
  std::vector<std::size_t> lights;
  if (Status status = choose_lights(settings.light, viewpoint.lights.size(), path, lights); !status) return status;
  for (const std::size_t light : lights) {
    if (Status status = measure_light(settings, scene, geometry, viewpoint, light, rows); !status) return status;
  }
  return {};
}

ExitCode run(const Settings& settings) {
  fmt::print("Umbrix {} ({}), one thread, {} rounds, frame {} of a camera that moves by {} of the diagonal a frame\n",
             version_string(), simd_target_name(0), settings.rounds, settings.motion.frames, settings.motion.step);
  std::vector<TableRow> rows;
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, rows); !status) return fail(status);
  }
  if (const ExitCode code = write_json(settings.json, to_json(rows)); code != kDone) return code;
  if (const ExitCode code = write_table_csv(settings.csv, rows); code != kDone) return code;
  for (const TableRow& row : rows) {
    if (row.wrong > 0) return kFailed;
  }
  return kDone;
}

}  // namespace

std::function<ExitCode()> table1_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--size", settings->size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--frames", settings->motion.frames, "Frames; the last one is counted")->check(CLI::Range(1, 1000));
  app.add_option("--motion", settings->motion.step, "What the camera moves a frame, in scene diagonals")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--rounds", settings->rounds, "Timed runs of each kernel")->check(CLI::Range(1, 1000));
  app.add_option("--light", settings->light, "Which light, counted from 0, or all")->check(light_validator());
  app.add_option("--kernels", settings->kernels, "all, or some of them")->delimiter(',');
  app.add_option("--json", settings->json, "Write the rows to this file");
  app.add_option("--csv", settings->csv, "Write the rows to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
