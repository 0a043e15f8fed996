// SPDX-License-Identifier: Apache-2.0
//
// How often a frame tracer guesses right, over the size of what is guessed for: regions of the screen, as in Liang &
// Huang (2019), and cells of space.
#include <fmt/core.h>

#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "plot/line_chart.h"
#include "report.h"
#include "table1/contestant.h"
#include "table1/moving_camera.h"
#include "umbrix/umbrix.h"
#include "workload/disputes.h"
#include "workload/geometry.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::string setup, json, svg;
  std::size_t light = 0;
  int size = 512;
  int rounds = 3;
  CameraMotion motion;
};

constexpr std::uint32_t kRegions[] = {2, 4, 8, 16, 32, 64};
constexpr int kCells[] = {32, 64, 128, 256, 512, 1024};  ///< in the scene's largest extent

/// So many that hardly any places share one: what is measured are sizes, not the table.
constexpr std::uint32_t kSlots = 1u << 20;

const char* rule_name(PredictorRule rule) {
  return rule == PredictorRule::sample ? "sample" : rule == PredictorRule::majority ? "majority" : "counter";
}

// One way to predict, and what came of it.
struct Setup {
  FrameOptions options;
  FrameResult result = {};  // of the counted run
  std::vector<double> seconds = {};
  std::uint64_t wrong = 0;

  bool by_screen() const { return options.key == PredictorKey::screen; }
  std::string size() const {
    return by_screen() ? fmt::format("{} px", options.region) : fmt::format("1/{:.0f}", 1 / options.cell);
  }
  double tests_per_ray() const {
    const OcclusionCounts& c = result.counts;
    const std::uint64_t tests =
        c.occluded.node_tests + c.occluded.primitive_tests + c.unoccluded.node_tests + c.unoccluded.primitive_tests;
    return result.frame.rays == 0 ? 0 : static_cast<double>(tests) / static_cast<double>(result.frame.rays);
  }
};

std::vector<Setup> make_setups() {
  std::vector<Setup> setups;
  FrameOptions options;
  options.method = FrameMethod::cached;
  options.slots = kSlots;
  options.key = PredictorKey::screen;
  for (const PredictorRule rule : {PredictorRule::sample, PredictorRule::majority, PredictorRule::counter}) {
    options.rule = rule;
    for (const std::uint32_t region : kRegions) {
      options.region = region;
      setups.push_back({options});
    }
  }
  options.region = FrameOptions().region;
  options.key = PredictorKey::object;
  for (const PredictorRule rule : {PredictorRule::majority, PredictorRule::counter}) {
    options.rule = rule;
    for (const int cells : kCells) {
      options.cell = 1.0f / static_cast<float>(cells);
      setups.push_back({options});
    }
  }
  return setups;
}

Status trace_all(const Settings& settings, Scene& scene, const Frames& frames, std::vector<Setup>& setups) {
  for (int round = 0; round <= settings.rounds; ++round) {
    for (Setup& setup : setups) {
      FrameResult timed;
      const bool counts = round == 0;
      const auto tracer = frame_contestant("", setup.options);
      if (Status status = tracer->run(scene, frames, {}, counts, counts ? setup.result : timed); !status) return status;
      if (!counts) setup.seconds.push_back(timed.seconds);
    }
  }
  return {};
}

void judge(const workload::Geometry& geometry, const Scene& scene, const std::vector<Ray>& rays,
           std::vector<Setup>& setups) {
  std::vector<std::uint8_t> plain(rays.size());
  scene.occluded({rays.data(), rays.size()}, plain.data());
  std::vector<const std::vector<std::uint8_t>*> answers{&plain};
  for (const Setup& setup : setups) answers.push_back(&setup.result.answers);
  const std::vector<std::uint64_t> wrong = workload::count_wrong(geometry, rays, answers);
  for (std::size_t i = 0; i < setups.size(); ++i) setups[i].wrong = wrong[i + 1];
}

double percent(std::uint64_t part, std::uint64_t of) {
  return of == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(of);
}

void print(const workload::Geometry& geometry, const std::vector<Setup>& setups) {
  const FrameStats& any = setups.front().result.frame;
  fmt::print("{}: {} rays, {:.1f} % occluded\n", geometry.name, any.rays, percent(any.occluded, any.rays));
  fmt::print("  {:<7} {:<9} {:>7} {:>7} {:>21} {:>21} {:>9} {:>7} {:>8} {:>8} {:>9} {:>6}\n", "key", "rule", "size",
             "right %", "occluded wrong/right", "unocc. wrong/right", "unknown %", "hits %", "regret", "tests", "ms",
             "wrong");
  for (const Setup& s : setups) {
    const FrameStats& frame = s.result.frame;
    const Confusion& c = frame.confusion;
    fmt::print("  {:<7} {:<9} {:>7} {:>7.2f} {:>21} {:>21} {:>9.2f} {:>7.1f} {:>8.2f} {:>8.2f} {:>9.2f} {:>6}\n",
               s.by_screen() ? "screen" : "object", rule_name(s.options.rule), s.size(), 100 * c.accuracy(),
               fmt::format("{}/{}", c.predicted_occluded[0], c.predicted_occluded[1]),
               fmt::format("{}/{}", c.predicted_unoccluded[1], c.predicted_unoccluded[0]),
               percent(c.not_predicted[0] + c.not_predicted[1], frame.rays),
               percent(frame.cache_hits, frame.cache_tries), frame.regret(), s.tests_per_ray(), 1e3 * median(s.seconds),
               s.wrong);
  }
  std::fflush(stdout);
}

nlohmann::json row_json(const workload::Geometry& geometry, const Setup& s) {
  const FrameStats& frame = s.result.frame;
  nlohmann::json row = {{"scene", geometry.name},
                        {"key", s.by_screen() ? "screen" : "object"},
                        {"rule", rule_name(s.options.rule)},
                        {"rays", frame.rays},
                        {"occluded", frame.occluded},
                        {"accuracy", frame.confusion.accuracy()},
                        {"predicted_occluded", frame.confusion.predicted_occluded},
                        {"predicted_unoccluded", frame.confusion.predicted_unoccluded},
                        {"not_predicted", frame.confusion.not_predicted},
                        {"cache_tries", frame.cache_tries},
                        {"cache_hits", frame.cache_hits},
                        {"regret", frame.regret()},
                        {"tests_per_ray", s.tests_per_ray()},
                        {"seconds", median(s.seconds)},
                        {"wrong", s.wrong}};
  if (s.by_screen())
    row["region"] = s.options.region;
  else
    row["cell"] = s.options.cell;
  return row;
}

plot::LineChart chart_of(const workload::Geometry& geometry, const std::vector<Setup>& setups) {
  plot::LineChart chart;
  chart.title = geometry.name + ": right guesses";
  chart.x.title = "pixels along a region's side";
  chart.x.logarithmic = true;
  chart.y.title = "of the rays predicted, %";
  for (const Setup& s : setups) {
    if (!s.by_screen()) continue;
    const std::string name = rule_name(s.options.rule);
    if (chart.series.empty() || chart.series.back().name != name) chart.series.push_back({name, {}});
    chart.series.back().points.push_back(
        {static_cast<double>(s.options.region), 100 * s.result.frame.confusion.accuracy()});
  }
  return chart;
}

Status measure(const Settings& settings, const std::string& path, nlohmann::json& rows, bool& any_wrong) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  if (settings.light >= viewpoint.lights.size()) {
    return {StatusCode::invalid_argument,
            fmt::format("{}: no light {}; there are {}", path, settings.light, viewpoint.lights.size())};
  }
  Scene scene;
  if (Status status = workload::build_scene(geometry.views(), {}, scene); !status) return status;
  const Frames frames = moving_camera_frames(scene, geometry, viewpoint.camera, viewpoint.lights[settings.light],
                                             settings.size, settings.motion);
  std::vector<Setup> setups = make_setups();
  if (Status status = trace_all(settings, scene, frames, setups); !status) return status;
  judge(geometry, scene, frames.back().rays, setups);
  print(geometry, setups);
  for (const Setup& setup : setups) {
    rows.push_back(row_json(geometry, setup));
    any_wrong |= setup.wrong > 0;
  }
  if (settings.svg.empty()) return {};
  return plot::write_svg(chart_path(settings.svg, geometry.name, settings.scenes.size()), chart_of(geometry, setups),
                         true);
}

ExitCode run(const Settings& settings) {
  nlohmann::json rows = nlohmann::json::array();
  bool any_wrong = false;
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, rows, any_wrong); !status) return fail(status);
  }
  const nlohmann::json report = {
      {"simd_target", simd_target_name(0)}, {"size", settings.size},   {"frames", settings.motion.frames},
      {"motion", settings.motion.step},     {"light", settings.light}, {"rows", rows}};
  if (const ExitCode code = write_json(settings.json, report); code != kDone) return code;
  return any_wrong ? kFailed : kDone;
}

}  // namespace

std::function<ExitCode()> predictor_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--size", settings->size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--frames", settings->motion.frames, "Frames; the last one is reported")->check(CLI::Range(1, 1000));
  app.add_option("--motion", settings->motion.step, "What the camera moves a frame, in scene diagonals")
      ->check(CLI::Range(0.0, 10.0));
  app.add_option("--rounds", settings->rounds, "Timed runs of each setting")->check(CLI::Range(1, 1000));
  app.add_option("--light", settings->light, "Which light, counted from 0");
  app.add_option("--json", settings->json, "Write the rows to this file");
  app.add_option("--svg", settings->svg, "Draw accuracy over region size into this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
