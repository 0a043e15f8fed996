// SPDX-License-Identifier: Apache-2.0
//
// The stress matrix: hard rays by the hundred million, judged by exact arithmetic or by proof.
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cases/cases.h"
#include "command.h"
#include "embree/embree_scene.h"
#include "report.h"
#include "stress/matrix.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

struct Settings {
  StressSettings run;
  std::string rows;
  std::string json;
  bool list = false;
};

ExitCode print_list(const std::vector<MatrixRow>& rows, double scale) {
  const std::vector<cases::Case> all = cases::all_cases(scale);
  for (const MatrixRow& row : rows) {
    fmt::print("{:>2} {:<16} {}\n", row.number, row.name, row.expectation);
    for (const cases::Case& c : all) {
      if (c.row == row.number) fmt::print("     {:<26} {:>10.0f} rays  {}\n", c.name, c.rays * scale, c.summary);
    }
    if (row.check != nullptr) fmt::print("     {:<26} {:>10.0f} rays\n", "check", row.check_rays * scale);
  }
  return kDone;
}

void print_head() {
  fmt::print("{:<19} {:>10} {:>11} {:>6} {:>7} {:>6} {:>10} | {:>19} | {:>19} | {:>5}\n", "", "", "", "", "false", "",
             "Embree", "robust: wrong", "fast: wrong", "");
  fmt::print("{:<19} {:>10} {:>11} {:>6} {:>7} {:>6} {:>10} | {:>8} {:>10} | {:>8} {:>10} | {:>5}\n", "row", "rays",
             "answers", "leaks", "shadows", "other", "rays", "rays", "a million", "rays", "a million", "s");
}

void print_row(const std::string& name, const Counts& counts) {
  const auto per_million = [&](const WrongRays& wrong) {
    return counts.embree_rays == 0 ? 0
                                   : 1e6 * static_cast<double>(wrong.total()) / static_cast<double>(counts.embree_rays);
  };
  fmt::print("{:<19} {:>10} {:>11} {:>6} {:>7} {:>6} {:>10} | {:>8} {:>10.2f} | {:>8} {:>10.2f} | {:>5.0f}\n", name,
             counts.rays, counts.answers.total(), counts.ours.leaks, counts.ours.false_shadows,
             counts.closest_wrong + counts.refuted + counts.different, counts.embree_rays, counts.embree_robust.total(),
             per_million(counts.embree_robust), counts.embree_fast.total(), per_million(counts.embree_fast),
             counts.seconds);
  for (const std::string& note : counts.notes) fmt::print("   {}\n", note);
  std::fflush(stdout);
}

// How often the kernel and instruction set that were asked least were asked.
std::string least_asked(const judge::AnswerCounts& answers) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::string name;
  for (std::size_t k = 0; k < kernel_count(); ++k) {
    for (std::size_t t = 0; t < simd_target_count(); ++t) {
      if (answers.of(k, t) >= least) continue;
      least = answers.of(k, t);
      name = fmt::format("{} on {}", kernel_info(k).name, simd_target_name(t));
    }
  }
  return fmt::format("asked least: {}, {} answers", name, least);
}

// Where walls become too thin for offsets, or a point too near to a second wall.
void note_thickness(const std::vector<std::pair<std::string, Counts>>& cases, Counts& row) {
  std::string text = "walls that let light through:";
  for (const auto& [name, counts] : cases) {
    if (name.rfind("wall", 0) != 0) continue;
    text += fmt::format(" {} {} of {};", name, counts.rays - counts.occluded, counts.rays);
  }
  text.pop_back();
  row.notes.push_back(text);
}

Status run_row(const MatrixRow& row, const std::vector<cases::Case>& all, const StressSettings& settings, Counts& total,
               nlohmann::json& json) {
  Counts counts;
  nlohmann::json parts = nlohmann::json::array();
  std::vector<std::pair<std::string, Counts>> by_case;
  for (const cases::Case& c : all) {
    if (c.row != row.number) continue;
    Counts part;
    if (Status status = run_case(c, settings, part); !status) return status;
    nlohmann::json part_json = part.to_json();
    part_json["name"] = c.name;
    part_json.erase("answers_by_kernel");
    parts.push_back(std::move(part_json));
    counts.add(part);
    by_case.emplace_back(c.name, std::move(part));
  }
  if (row.check != nullptr) {
    const double start = wall_seconds();
    const auto rays = static_cast<std::size_t>(row.check_rays * settings.scale) + 1;
    if (Status status = row.check(settings, rays, counts); !status) return status;
    counts.seconds += wall_seconds() - start;
  }
  if (row.number == 27) note_thickness(by_case, counts);
  if (row.number == 21) {
    counts.notes.push_back(fmt::format("slowest build {:.1f} s, largest scene {} MB", counts.slowest_build,
                                       counts.largest_scene / 1'000'000));
  }
  print_row(fmt::format("{:>2} {}", row.number, row.name), counts);
  nlohmann::json row_json = counts.to_json();
  row_json["row"] = row.number;
  row_json["name"] = row.name;
  row_json["cases"] = std::move(parts);
  json.push_back(std::move(row_json));
  counts.notes.clear();
  total.add(counts);
  return {};
}

nlohmann::json report(const Settings& settings, const Counts& total, const nlohmann::json& rows) {
  nlohmann::json json = total.to_json();
  json["version"] = version_string();
  json["embree"] = embree::version();
  json["seed"] = settings.run.seed;
  json["scale"] = settings.run.scale;
  json["rows"] = rows;
  return json;
}

ExitCode run(const Settings& settings) {
  std::vector<MatrixRow> rows;
  if (const Status status = choose_rows(settings.rows, rows); !status) return fail(status);
  if (settings.list) return print_list(rows, settings.run.scale);
  fmt::print("Umbrix {} and Embree {} against exact arithmetic; scale {}, seed {}\n", version_string(),
             embree::version(), settings.run.scale, settings.run.seed);
  print_head();
  const std::vector<cases::Case> all = cases::all_cases(settings.run.scale);
  Counts total;
  nlohmann::json json = nlohmann::json::array();
  for (const MatrixRow& row : rows) {
    if (const Status status = run_row(row, all, settings.run, total, json); !status) return fail(status);
    // After each row, so that a run that is cut short still tells what it knows.
    if (settings.json == "-") continue;
    if (const ExitCode code = write_json(settings.json, report(settings, total, json)); code != kDone) return code;
  }
  print_row("all", total);
  fmt::print("{}\n", least_asked(total.answers));
  if (settings.json == "-") {
    if (const ExitCode code = write_json("-", report(settings, total, json)); code != kDone) return code;
  }
  return total.failures() > 0 ? kFailed : kDone;
}

}  // namespace

std::function<ExitCode()> stress_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("--row", settings->rows, "Only these rows, by number, range or name: 1,5-9,threads");
  app.add_option("--scale", settings->run.scale, "Of the matrix's numbers of rays, and of its largest scenes")
      ->check(CLI::Range(1e-6, 1e3));
  app.add_option("--seed", settings->run.seed, "Other triangles and rays for each");
  app.add_flag("--list", settings->list, "Show the rows and their cases");
  app.add_option("--json", settings->json, "Write the table to this file");
  app.add_option("--regressions", settings->run.regressions, "Add minimised failures to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
