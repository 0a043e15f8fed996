// SPDX-License-Identifier: Apache-2.0
#include "table1/table1_report.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include "report.h"
#include "umbrix/io/image_file.h"

namespace umbrix::bench {
namespace {

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

double per_ray(std::uint64_t tests, const RayCounts& counts) {
  return ratio(static_cast<double>(tests), static_cast<double>(counts.rays));
}

/// The paper's columns.
struct Figures {
  double node_occluded, primitive_occluded, node_unoccluded, primitive_unoccluded, seconds, precompute;
};

Figures figures(const TableRow& row) {
  const OcclusionCounts& c = row.result.counts;
  return {per_ray(c.occluded.node_tests, c.occluded),
          per_ray(c.occluded.primitive_tests, c.occluded),
          per_ray(c.unoccluded.node_tests, c.unoccluded),
          per_ray(c.unoccluded.primitive_tests, c.unoccluded),
          median(row.seconds),
          median(row.precompute_seconds)};
}

double occluded_fraction(const TableRow& row) {
  const OcclusionCounts& c = row.result.counts;
  return ratio(static_cast<double>(c.occluded.rays), static_cast<double>(c.occluded.rays + c.unoccluded.rays));
}

std::string change(double value, double from) {
  return from > 0 ? fmt::format("({:+.0f}%)", 100 * (value / from - 1)) : std::string();
}

nlohmann::json row_json(const TableRow& row) {
  const Figures f = figures(row);
  nlohmann::json json = {{"scene", row.scene},
                         {"kernel", row.kernel},
                         {"light", row.light},
                         {"rays", row.result.answers.size()},
                         {"occluded_fraction", occluded_fraction(row)},
                         {"node_tests_occluded", f.node_occluded},
                         {"primitive_tests_occluded", f.primitive_occluded},
                         {"node_tests_unoccluded", f.node_unoccluded},
                         {"primitive_tests_unoccluded", f.primitive_unoccluded},
                         {"seconds", f.seconds},
                         {"precompute_seconds", f.precompute},
                         {"memory_bytes", row.result.memory_bytes},
                         {"wrong", row.wrong},
                         {"triangles", row.build.triangles},
                         {"tree_depth", row.build.depth}};
  RayCounts all = row.result.counts.occluded;
  all += row.result.counts.unoccluded;
  if (all.links_followed + all.links_missing > 0) {
    json["links_followed"] = all.links_followed;
    json["links_missing"] = all.links_missing;
  }
  const FrameStats& frame = row.result.frame;
  if (frame.rays > 0) {
    json["misprediction_rate"] = 1 - frame.confusion.accuracy();
    json["cache_tries"] = frame.cache_tries;
    json["cache_hits"] = frame.cache_hits;
    json["regret"] = frame.regret();
    json["rays_by_route"] = frame.routes;
  }
  return json;
}

}  // namespace

void print_table(const std::vector<TableRow>& rows) {
  const TableRow& standard = rows.front();
  const Figures base = figures(standard);
  fmt::print("\n{}, light {}: {} triangles, tree depth {}, {} rays, {:.1f} % occluded\n", standard.scene,
             standard.light, standard.build.triangles, standard.build.depth, standard.result.answers.size(),
             100 * occluded_fraction(standard));
  fmt::print("  {:<14} {:>14} {:>14} {:>14} {:>14} {:>16} {:>9} {:>8} {:>6}\n", "kernel", "occl. node", "occl. prim",
             "unoccl. node", "unoccl. prim", "traversal ms", "pre. ms", "MB", "wrong");
  for (const TableRow& row : rows) {
    const Figures f = figures(row);
    fmt::print(
        "  {:<14} {:>6.1f} {:>7} {:>6.1f} {:>7} {:>6.1f} {:>7} {:>6.1f} {:>7} {:>8.1f} {:>7} {:>9.1f} {:>8.2f} {:>6}\n",
        row.kernel, f.node_occluded, change(f.node_occluded, base.node_occluded), f.primitive_occluded,
        change(f.primitive_occluded, base.primitive_occluded), f.node_unoccluded,
        change(f.node_unoccluded, base.node_unoccluded), f.primitive_unoccluded,
        change(f.primitive_unoccluded, base.primitive_unoccluded), 1e3 * f.seconds, change(f.seconds, base.seconds),
        1e3 * f.precompute, 1e-6 * static_cast<double>(row.result.memory_bytes), row.wrong);
  }
  for (const TableRow& row : rows) {
    const FrameStats& frame = row.result.frame;
    if (frame.rays == 0) continue;
    fmt::print(
        "  {}: {:.1f} % of predictions wrong, {} rays not predicted; cache {} of {} tries; regret {:.2f} tests a ray\n",
        row.kernel, 100 * (1 - frame.confusion.accuracy()),
        frame.confusion.not_predicted[0] + frame.confusion.not_predicted[1], frame.cache_hits, frame.cache_tries,
        frame.regret());
  }
}

nlohmann::json to_json(const std::vector<TableRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const TableRow& row : rows) list.push_back(row_json(row));
  return {{"simd_target", simd_target_name(0)}, {"rows", list}};
}

ExitCode write_table_csv(const std::string& path, const std::vector<TableRow>& rows) {
  if (path.empty()) return kDone;
  constexpr const char* kColumns[] = {"scene",
                                      "kernel",
                                      "light",
                                      "rays",
                                      "occluded_fraction",
                                      "node_tests_occluded",
                                      "primitive_tests_occluded",
                                      "node_tests_unoccluded",
                                      "primitive_tests_unoccluded",
                                      "seconds",
                                      "precompute_seconds",
                                      "memory_bytes",
                                      "wrong"};
  std::string text = fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const TableRow& row : rows) {
    const nlohmann::json json = row_json(row);
    std::vector<std::string> cells;
    for (const char* column : kColumns) {
      const nlohmann::json& cell = json.at(column);
      cells.push_back(cell.is_string() ? cell.get<std::string>() : cell.dump());
    }
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  const Status status = io::write_text(path, text, true);
  return status ? kDone : fail(status);
}

}  // namespace umbrix::bench
