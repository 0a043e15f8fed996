// SPDX-License-Identifier: Apache-2.0
//
// Build time and memory. Builders take turns, so that a disturbance of the machine meets all of them.
#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "command.h"
#include "embree/embree_scene.h"
#include "report.h"
#include "umbrix/umbrix.h"
#include "workload/geometry.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::string json;
  int threads = 0;
  int rounds = 3;
};

struct Builder {
  std::string name;
  std::function<Status(Builder&)> build;
  std::vector<double> seconds = {};
  std::size_t bytes = 0;
  BuildStats stats = {};  // Umbrix only
};

Status build_umbrix(const std::vector<MeshView>& views, const BuildOptions& options, Builder& builder) {
  Scene scene;
  const double start = wall_seconds();
  if (Status status = workload::build_scene(views, options, scene); !status) return status;
  builder.seconds.push_back(wall_seconds() - start);
  builder.stats = scene.build_stats();
  builder.bytes = builder.stats.bytes;
  return {};
}

Status build_embree(const std::vector<MeshView>& views, const embree::Options& options, Builder& builder) {
  embree::EmbreeScene scene;
  const double start = wall_seconds();
  if (Status status = scene.build(views, options); !status) return status;
  builder.seconds.push_back(wall_seconds() - start);
  builder.bytes = scene.bytes();
  return {};
}

std::vector<Builder> builders(const std::vector<MeshView>& views, int threads) {
  std::vector<Builder> result;
  const auto add = [&](const char* name, BuildQuality quality, TreeBuild tree) {
    BuildOptions options;
    options.quality = quality;
    options.tree = tree;
    result.push_back({name, [&views, options](Builder& b) { return build_umbrix(views, options, b); }});
  };
  add("umbrix:boxes", BuildQuality::high, TreeBuild::on_demand);
  add("umbrix:high", BuildQuality::high, TreeBuild::at_commit);
  add("umbrix:fast", BuildQuality::fast, TreeBuild::at_commit);
  for (const auto& [name, quality] :
       {std::pair{"high", embree::Quality::high}, std::pair{"medium", embree::Quality::medium}}) {
    for (const bool robust : {true, false}) {
      const embree::Options options{quality, robust, threads};
      result.push_back({fmt::format("embree:{}:{}", name, robust ? "robust" : "fast"),
                        [&views, options](Builder& b) { return build_embree(views, options, b); }});
    }
  }
  return result;
}

nlohmann::json to_json(const BuildStats& s) {
  return {{"nodes", s.nodes},
          {"leaves", s.leaves},
          {"empty_leaves", s.empty_leaves},
          {"references", s.references},
          {"largest_leaf", s.largest_leaf},
          {"depth", s.depth},
          {"sah_cost", s.sah_cost},
          {"node_bytes", s.node_bytes},
          {"leaf_bytes", s.leaf_bytes},
          {"triangle_bytes", s.triangle_bytes},
          {"box_bytes", s.box_bytes},
          {"seconds_prepare", s.seconds_prepare},
          {"seconds_tree", s.seconds_tree},
          {"seconds_leaves", s.seconds_leaves}};
}

void report(const workload::Geometry& geometry, const std::vector<Builder>& all, nlohmann::json& rows) {
  const auto triangles = static_cast<double>(geometry.triangle_count());
  fmt::print("{}: {} triangles\n", geometry.name, geometry.triangle_count());
  fmt::print("  {:<22} {:>9} {:>9} {:>9} {:>12} {:>9} {:>6} {:>9}\n", "builder", "seconds", "MB", "B/tri", "nodes",
             "refs/tri", "depth", "SAH cost");
  for (const Builder& builder : all) {
    const BuildStats& s = builder.stats;
    const double seconds = median(builder.seconds);
    const auto bytes = static_cast<double>(builder.bytes);
    fmt::print("  {:<22} {:>9.3f} {:>9.1f} {:>9.0f}", builder.name, seconds, bytes * 1e-6, bytes / triangles);
    nlohmann::json row = {{"scene", geometry.name},
                          {"builder", builder.name},
                          {"triangles", geometry.triangle_count()},
                          {"seconds", seconds},
                          {"bytes", builder.bytes}};
    if (s.nodes > 0) {
      fmt::print(" {:>12} {:>9.2f} {:>6} {:>9.1f}", s.nodes, static_cast<double>(s.references) / triangles, s.depth,
                 s.sah_cost);
      row["stats"] = to_json(s);
    }
    fmt::print("\n");
    rows.push_back(std::move(row));
  }
  std::fflush(stdout);
}

Status measure(const Settings& settings, const std::string& path, int threads, nlohmann::json& rows) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  const std::vector<MeshView> views = geometry.views();
  std::vector<Builder> all = builders(views, threads);
  tbb::task_arena arena(threads);
  for (int round = 0; round < settings.rounds; ++round) {
    for (Builder& builder : all) {
      Status status;
      arena.execute([&] { status = builder.build(builder); });
      if (!status) return status;
    }
  }
  report(geometry, all, rows);
  return {};
}

ExitCode run(const Settings& settings) {
  const int threads =
      settings.threads > 0 ? settings.threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  fmt::print("Umbrix {}, Embree {}, {} thread(s), {} rounds; medians of wall time\n", version_string(),
             embree::version(), threads, settings.rounds);
  nlohmann::json rows = nlohmann::json::array();
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, threads, rows); !status) return fail(status);
  }
  return write_json(settings.json,
                    {{"embree", embree::version()}, {"threads", threads}, {"rounds", settings.rounds}, {"rows", rows}});
}

}  // namespace

std::function<ExitCode()> build_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--threads", settings->threads, "Threads; 0: all")->check(CLI::Range(0, 1024));
  app.add_option("--rounds", settings->rounds, "Builds of each kind")->check(CLI::Range(1, 1000));
  app.add_option("--json", settings->json, "Write the rows to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
