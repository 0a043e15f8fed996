// SPDX-License-Identifier: Apache-2.0
//
// How deep in the tree rays end that an index ended, and what they cost (figure 3 of Liang & Huang 2019). Learned lists
// come from one frame's rays and are judged by those of the next, for which the camera has moved a little.
#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "index/primitive_index.h"
#include "kernels/indexed.h"
#include "kernels/kernel.h"
#include "plot/line_chart.h"
#include "report.h"
#include "umbrix/umbrix.h"
#include "workload/geometry.h"
#include "workload/inner_scene.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::vector<std::string> scenes;
  std::string setup;
  std::string json;
  std::string svg;
  int size = 512;
  std::size_t light = 0;
};

// Occluded rays that ended at one depth in one way.
struct Ended {
  std::uint64_t rays = 0;
  std::uint64_t node_tests = 0;
  std::uint64_t primitive_tests = 0;

  void add(const detail::Ending& ending) {
    ++rays;
    node_tests += ending.node_tests;
    primitive_tests += ending.primitive_tests;
  }
  double mean_cost() const {
    return rays == 0 ? NAN : static_cast<double>(node_tests + primitive_tests) / static_cast<double>(rays);
  }
};

// By depth, for one way to choose lists.
struct Selection {
  std::string kernel;
  std::size_t lists = 0;
  std::uint64_t rays = 0, occluded = 0;
  std::vector<Ended> by_list, by_leaf;
};

struct Rays {
  std::vector<Ray> training, counted;
};

// The depth of each node, and of each block the depth of its leaf.
struct Depths {
  std::vector<std::uint32_t> of_node, of_block;
  std::uint32_t most = 0;

  explicit Depths(const detail::Tree& tree) : of_node(tree.nodes.size()), of_block(tree.blocks.size()) {
    visit(tree, 0, 0);
  }

 private:
  void visit(const detail::Tree& tree, std::uint32_t index, std::uint32_t depth) {
    const detail::Node& node = tree.nodes[index];
    of_node[index] = depth;
    most = std::max(most, depth);
    if (node.is_leaf()) {
      for (std::uint32_t b = 0; b < node.block_count(); ++b) of_block[node.first_block() + b] = depth;
      return;
    }
    visit(tree, node.low_child(), depth + 1);
    visit(tree, node.low_child() + 1, depth + 1);
  }
};

Status choose_rays(const Settings& settings, const workload::Geometry& geometry, Rays& out) {
  workload::Viewpoint viewpoint;
  if (Status status = workload::find_viewpoint(geometry, settings.setup, viewpoint); !status) return status;
  if (settings.light >= viewpoint.lights.size()) {
    return {StatusCode::invalid_argument,
            fmt::format("{}: no light {}; there are {}", geometry.path, settings.light, viewpoint.lights.size())};
  }
  Scene scene;
  if (Status status = workload::build_scene(geometry.views(), {}, scene); !status) return status;
  const io::Light& light = viewpoint.lights[settings.light];
  out.training = workload::shadow_rays(scene, geometry, viewpoint.camera, light, settings.size);
  // To the right by a hundredth of the scene.
  float lower[3], upper[3];
  if (scene.bounds(lower, upper)) {
    const double step =
        0.01 * std::hypot(double{upper[0]} - lower[0], double{upper[1]} - lower[1], double{upper[2]} - lower[2]);
    for (auto& row : viewpoint.camera.to_world) row[3] += step * row[0];
  }
  out.counted = workload::shadow_rays(scene, geometry, viewpoint.camera, light, settings.size);
  return {};
}

Status count(const workload::InnerScene& scene, const Depths& depths, const Rays& rays, Selection& out) {
  KernelId kernel;
  if (Status status = find_kernel(out.kernel.c_str(), kernel); !status) return status;
  const detail::SceneView view = scene.view();
  Training training;
  training.rays = {rays.training.data(), rays.training.size()};
  const std::unique_ptr<detail::SideTable> side = detail::kernel_at(kernel).prepare({view, training});
  const auto& index = static_cast<const detail::PrimitiveIndex&>(*side);
  out.lists = index.lists().size();
  out.rays = rays.counted.size();
  out.by_list.resize(depths.most + 1);
  out.by_leaf.resize(depths.most + 1);
  const detail::Block* const first_list = index.lists().data();
  const detail::Block* const first_block = view.tree->blocks.data();
  for (const detail::Ending& ending :
       detail::find_endings(scene.view(side.get()), {rays.counted.data(), rays.counted.size()}, nullptr, nullptr)) {
    if (!ending.block) continue;
    ++out.occluded;
    if (ending.is_indexed)
      out.by_list[depths.of_node[index.nodes()[static_cast<std::size_t>(ending.block - first_list)]]].add(ending);
    else
      out.by_leaf[depths.of_block[static_cast<std::size_t>(ending.block - first_block)]].add(ending);
  }
  return {};
}

double share(const Ended& ended, const Selection& of) {
  return of.occluded == 0 ? 0 : 100 * static_cast<double>(ended.rays) / static_cast<double>(of.occluded);
}

nlohmann::json to_json(const Ended& ended) {
  return {{"rays", ended.rays}, {"node_tests", ended.node_tests}, {"primitive_tests", ended.primitive_tests}};
}

// Prints the scene's table and adds it to the report.
void report(const workload::Geometry& geometry, const std::vector<Selection>& selections, nlohmann::json& rows) {
  fmt::print("{}: {} triangles\n", geometry.name, geometry.triangle_count());
  for (const Selection& s : selections) {
    Ended by_lists;
    for (const Ended& list : s.by_list) by_lists.rays += list.rays;
    fmt::print("  {}: {} lists{}; {} rays, {} occluded, {:.1f} % of them by lists\n", s.kernel, s.lists,
               s.lists == 0 ? " (would not pay)" : "", s.rays, s.occluded, share(by_lists, s));
    fmt::print("  {:>7} {:>12} {:>12} {:>12} {:>12}\n", "depth", "by list %", "tests", "by leaf %", "tests");
    for (std::size_t depth = 0; depth < s.by_list.size(); ++depth) {
      const Ended &list = s.by_list[depth], &leaf = s.by_leaf[depth];
      if (list.rays + leaf.rays == 0) continue;
      const auto cost = [](const Ended& ended) {
        return ended.rays == 0 ? std::string("-") : fmt::format("{:.1f}", ended.mean_cost());
      };
      fmt::print("  {:>7} {:>12.2f} {:>12} {:>12.2f} {:>12}\n", depth, share(list, s), cost(list), share(leaf, s),
                 cost(leaf));
      rows.push_back({{"scene", geometry.name},
                      {"kernel", s.kernel},
                      {"lists", s.lists},
                      {"rays", s.rays},
                      {"occluded", s.occluded},
                      {"depth", depth},
                      {"by_list", to_json(list)},
                      {"by_leaf", to_json(leaf)}});
    }
  }
  std::fflush(stdout);
}

plot::LineChart chart_of(const workload::Geometry& geometry, const std::vector<Selection>& selections) {
  plot::LineChart chart;
  chart.title = geometry.name + ": where lists end rays";
  chart.width = 960;
  chart.x.title = "depth in the tree";
  chart.x.low = 0;
  chart.y.title = "occluded rays ended there, %";
  chart.right.title = "tests a ray";
  for (const Selection& s : selections) {
    plot::Series ended{s.kernel + ": by a list", {}, plot::Mark::bars, false};
    plot::Series leaves{s.kernel + ": by a leaf", {}, plot::Mark::bars, false};
    plot::Series cost{s.kernel + ": tests, by a list", {}, plot::Mark::line, true};
    for (std::size_t depth = 0; depth < s.by_list.size(); ++depth) {
      const auto x = static_cast<double>(depth);
      ended.points.push_back({x, share(s.by_list[depth], s)});
      leaves.points.push_back({x, share(s.by_leaf[depth], s)});
      cost.points.push_back({x, s.by_list[depth].mean_cost()});
    }
    chart.series.insert(chart.series.end(), {std::move(ended), std::move(leaves), std::move(cost)});
  }
  return chart;
}

Status measure(const Settings& settings, const std::string& path, nlohmann::json& rows) {
  workload::Geometry geometry;
  if (Status status = workload::load_geometry(path, geometry); !status) return status;
  Rays rays;
  if (Status status = choose_rays(settings, geometry, rays); !status) return status;
  const workload::InnerScene scene(geometry);
  const Depths depths(*scene.view().tree);
  std::vector<Selection> selections(2);
  selections[0].kernel = "indexed-paper";
  selections[1].kernel = "indexed";
  for (Selection& selection : selections) {
    if (Status status = count(scene, depths, rays, selection); !status) return status;
  }
  report(geometry, selections, rows);
  if (settings.svg.empty()) return {};
  return plot::write_svg(chart_path(settings.svg, geometry.name, settings.scenes.size()),
                         chart_of(geometry, selections), true);
}

ExitCode run(const Settings& settings) {
  nlohmann::json rows = nlohmann::json::array();
  for (const std::string& path : settings.scenes) {
    if (const Status status = measure(settings, path, rows); !status) return fail(status);
  }
  return write_json(settings.json, {{"size", settings.size}, {"light", settings.light}, {"rows", rows}});
}

}  // namespace

std::function<ExitCode()> depth_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("scene", settings->scenes, "glTF files")->required();
  app.add_option("--setup", settings->setup, "Camera and lights from this file");
  app.add_option("--size", settings->size, "Primary rays in each direction")->check(CLI::Range(1, 1 << 14));
  app.add_option("--light", settings->light, "Which light, counted from 0");
  app.add_option("--json", settings->json, "Write the rows to this file");
  app.add_option("--svg", settings->svg, "Draw the histogram into this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
