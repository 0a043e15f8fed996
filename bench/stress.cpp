// SPDX-License-Identifier: Apache-2.0
//
// Hard rays by the million, each judged by exact arithmetic. A case is made anew, with other triangles, for every
// chunk of rays.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "cases/cases.h"
#include "command.h"
#include "embree/embree_scene.h"
#include "judge/judge.h"
#include "judge/minimise.h"
#include "report.h"
#include "umbrix/umbrix.h"

namespace umbrix::bench {
namespace {

struct Settings {
  std::uint64_t rays = 10'000'000;
  std::uint64_t seed = 1;
  std::vector<std::string> cases;
  std::vector<std::string> kernels;
  std::string json;
};

struct Row {
  std::string name;
  std::uint64_t rays = 0;
  std::uint64_t answers = 0;
  std::uint64_t wrong = 0;         // rays with a wrong answer
  std::uint64_t embree_rays = 0;   // that Embree accepts
  std::uint64_t embree_wrong = 0;  // rays that Embree answers wrongly: robust, one ray a call
  std::uint64_t described = 0;
};

constexpr std::uint64_t kChunk = 10'000;
constexpr std::uint64_t kTargetPeriod = 4;  // every fourth chunk is asked on all instruction sets
constexpr std::uint64_t kClosestShare = 4;  // a quarter of the rays is asked for the closest hit as well
constexpr std::uint64_t kDescribed = 5;     // wrong answers shown for each case

void print_row(const Row& row) {
  fmt::print("{:<22} {:>10} {:>12} {:>8} {:>12} {:>12}\n", row.name, row.rays, row.answers, row.wrong, row.embree_rays,
             row.embree_wrong);
  std::fflush(stdout);
}

Status choose_cases(const std::vector<std::string>& names, std::vector<const cases::Case*>& out) {
  if (names.empty()) {
    for (const cases::Case& c : cases::all_cases()) out.push_back(&c);
    return {};
  }
  for (const std::string& name : names) {
    const cases::Case* found = cases::find_case(name.c_str());
    if (found == nullptr) {
      std::string known;
      for (const cases::Case& c : cases::all_cases()) known += std::string(known.empty() ? "" : ", ") + c.name;
      return {StatusCode::invalid_argument, fmt::format("no case '{}'; there are: {}", name, known)};
    }
    out.push_back(found);
  }
  return {};
}

Status count_embree_errors(const cases::CaseData& data, const std::vector<std::uint8_t>& truth, Row& row) {
  embree::EmbreeScene scene;
  if (Status status = scene.build({judge::mesh_of(data.triangles)}, {}); !status) return status;
  std::vector<Ray> rays;
  std::vector<std::uint8_t> expected;
  for (std::size_t i = 0; i < data.rays.size(); ++i) {
    if (!embree::accepts(data.rays[i])) continue;
    rays.push_back(data.rays[i]);
    expected.push_back(truth[i]);
  }
  std::vector<std::uint8_t> answers(rays.size());
  scene.occluded({rays.data(), rays.size()}, embree::Mode::single, answers.data());
  row.embree_rays += rays.size();
  for (std::size_t i = 0; i < answers.size(); ++i) row.embree_wrong += answers[i] != expected[i] ? 1 : 0;
  return {};
}

// A ray that several kernels answer wrongly counts once.
std::uint64_t count_rays(const std::vector<judge::Complaint>& complaints) {
  std::vector<std::size_t> rays;
  for (const judge::Complaint& complaint : complaints) rays.push_back(complaint.ray);
  std::sort(rays.begin(), rays.end());
  return static_cast<std::uint64_t>(std::unique(rays.begin(), rays.end()) - rays.begin());
}

Status run_chunk(const cases::Case& c, std::uint64_t seed, std::uint64_t chunk, std::uint64_t rays,
                 const Settings& settings, Row& row) {
  const cases::CaseData data = c.make(seed, rays);
  judge::Options options;
  options.kernels = settings.kernels;
  options.all_targets = chunk % kTargetPeriod == 0;
  options.on_all_targets = {"auto", "standard", "linked"};  // the parts that differ by instruction set
  options.closest_rays = rays / kClosestShare;
  judge::Result result;
  if (Status status = judge::judge(data, options, result); !status) return status;

  for (const judge::Complaint& complaint : result.complaints) {
    if (row.described++ >= kDescribed) break;
    fmt::print("wrong: case {} seed {} rays {}: {}\n", c.name, seed, rays, judge::describe(data, complaint));
    std::fflush(stdout);
  }
  row.wrong += count_rays(result.complaints);
  row.rays += rays;
  row.answers += result.answers;
  return count_embree_errors(data, result.occluded, row);
}

Status run_case(const cases::Case& c, std::uint64_t rays, const Settings& settings, Row& row) {
  row.name = c.name;
  for (std::uint64_t chunk = 0; row.rays < rays; ++chunk) {
    const std::uint64_t seed = settings.seed * 1'000'003 + chunk;
    if (Status status = run_chunk(c, seed, chunk, std::min(kChunk, rays - row.rays), settings, row); !status) {
      return {status.code(), fmt::format("case {} seed {}: {}", c.name, seed, status.message())};
    }
  }
  print_row(row);
  return {};
}

ExitCode run(const Settings& settings) {
  std::vector<const cases::Case*> chosen;
  if (const Status status = choose_cases(settings.cases, chosen); !status) return fail(status);
  double shares = 0;
  for (const cases::Case* c : chosen) shares += c->share;

  fmt::print("Umbrix {} ({}) and Embree {} against exact arithmetic, seed {}\n", version_string(), simd_target_name(0),
             embree::version(), settings.seed);
  fmt::print("{:<22} {:>10} {:>12} {:>8} {:>12} {:>12}\n", "case", "rays", "answers", "wrong", "Embree rays",
             "Embree wrong");
  const double start = wall_seconds();
  Row total{"all"};
  nlohmann::json rows = nlohmann::json::array();
  for (const cases::Case* c : chosen) {
    Row row;
    const double rays = std::ceil(static_cast<double>(settings.rays) * c->share / shares);
    if (const Status status = run_case(*c, static_cast<std::uint64_t>(rays), settings, row); !status) {
      return fail(status);
    }
    rows.push_back({{"name", row.name},
                    {"rays", row.rays},
                    {"answers", row.answers},
                    {"wrong", row.wrong},
                    {"embree_rays", row.embree_rays},
                    {"embree_wrong", row.embree_wrong}});
    total.rays += row.rays;
    total.answers += row.answers;
    total.wrong += row.wrong;
    total.embree_rays += row.embree_rays;
    total.embree_wrong += row.embree_wrong;
  }
  print_row(total);
  fmt::print("{:.0f} s\n", wall_seconds() - start);
  const ExitCode written = write_json(settings.json, {{"seed", settings.seed},
                                                      {"rays", total.rays},
                                                      {"answers", total.answers},
                                                      {"wrong", total.wrong},
                                                      {"embree_rays", total.embree_rays},
                                                      {"embree_wrong", total.embree_wrong},
                                                      {"embree", embree::version()},
                                                      {"cases", rows}});
  return written != kDone ? written : total.wrong > 0 ? kFailed : kDone;
}

}  // namespace

std::function<ExitCode()> stress_command(CLI::App& app) {
  auto settings = std::make_shared<Settings>();
  app.add_option("--rays", settings->rays, "Rays over all cases (rounded up)");
  app.add_option("--seed", settings->seed, "Other triangles and rays for each");
  app.add_option("--case", settings->cases, "Only these cases")->delimiter(',');
  app.add_option("--kernel", settings->kernels, "Only these kernels")->delimiter(',');
  app.add_option("--json", settings->json, "Write the table to this file");
  return [settings] { return run(*settings); };
}

}  // namespace umbrix::bench
