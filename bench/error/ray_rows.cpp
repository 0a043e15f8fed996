// SPDX-License-Identifier: Apache-2.0
#include "error/ray_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

namespace umbrix::bench {
namespace {

constexpr const char* kCounts[] = {"rays", "occluded", "leaks", "false_shadows"};

/// Five digits are what a reader wants; more would be noise and weight.
double rounded(double value) { return std::stod(fmt::format("{:.5g}", value)); }

Estimate rays_per_microsecond(std::uint64_t rays, const std::vector<double>& seconds) {
  std::vector<double> rates;
  for (const double s : seconds) rates.push_back(s > 0 ? 1e-6 * static_cast<double>(rays) / s : 0);
  return median_and_quartiles(rates);
}

nlohmann::json counts_json(const RayErrors& set, std::size_t peer) {
  return {{"rays", set.rays},
          {"occluded", set.occluded},
          {"leaks", set.peers[peer].leaks},
          {"false_shadows", set.peers[peer].false_shadows}};
}

/// Sets what follows from the counts of a row.
void add_rates(nlohmann::json& row) {
  const auto rays = row.at("rays").get<std::uint64_t>();
  const auto leaks = row.at("leaks").get<std::uint64_t>(), false_shadows = row.at("false_shadows").get<std::uint64_t>();
  row["wrong_per_million"] = estimate_json(share_of(leaks + false_shadows, rays), 1e6);
  row["leaks_per_million"] = estimate_json(share_of(leaks, rays), 1e6);
  row["false_shadows_per_million"] = estimate_json(share_of(false_shadows, rays), 1e6);
}

void add_counts(const nlohmann::json& part, nlohmann::json& sum) {
  for (const char* count : kCounts)
    sum[count] = sum.at(count).get<std::uint64_t>() + part.at(count).get<std::uint64_t>();
}

}  // namespace

nlohmann::json estimate_json(const Estimate& estimate, double factor) {
  return {{"value", rounded(factor * estimate.value)},
          {"low", rounded(factor * estimate.low)},
          {"high", rounded(factor * estimate.high)}};
}

nlohmann::json ray_rows(const std::string& scene, const std::vector<RayErrors>& sets) {
  nlohmann::json rows = nlohmann::json::array();
  for (const char* kind : {"ordinary", "adversarial"}) {
    RayErrors sum{kind, ""};
    for (const RayErrors& set : sets) {
      if (set.kind == kind) sum += set;
    }
    for (std::size_t i = 0; i < sum.peers.size(); ++i) {
      const PeerErrors& peer = sum.peers[i];
      nlohmann::json row = counts_json(sum, i);
      row["scene"] = scene;
      row["kind"] = kind;
      row["peer"] = peer.peer;
      row["family"] = peer.family;
      row["mrays_per_s"] = estimate_json(rays_per_microsecond(sum.rays, peer.seconds));
      if (sum.flux > 0) row["flux_error"] = rounded(peer.wrong_flux / sum.flux);
      for (const RayErrors& set : sets) {
        if (set.kind != kind || set.aim.empty()) continue;
        nlohmann::json& aim = row["aims"][set.aim] = counts_json(set, i);
        aim["mrays_per_s"] = rounded(rays_per_microsecond(set.rays, set.peers[i].seconds).value);
      }
      add_rates(row);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

nlohmann::json pooled_rows(const nlohmann::json& rows) {
  using Key = std::pair<std::string, std::string>;
  std::vector<Key> order;
  std::map<Key, nlohmann::json> sums;
  std::map<Key, std::vector<double>> log_speeds;
  for (const nlohmann::json& row : rows) {
    const Key key = {row.at("kind"), row.at("peer")};
    log_speeds[key].push_back(std::log(row.at("mrays_per_s").at("value").get<double>()));
    if (sums.count(key) == 0) {
      order.push_back(key);
      nlohmann::json& sum = sums[key] = row;
      sum["scene"] = "all scenes";
      for (const char* own : {"flux_error", "aims"}) sum.erase(own);
      if (row.contains("aims")) {
        for (const auto& [aim, part] : row.at("aims").items()) {
          for (const char* count : kCounts) sum["aims"][aim][count] = part.at(count);
        }
      }
      continue;
    }
    nlohmann::json& sum = sums[key];
    add_counts(row, sum);
    if (!row.contains("aims")) continue;
    for (const auto& [aim, part] : row.at("aims").items()) add_counts(part, sum["aims"][aim]);
  }
  nlohmann::json pooled = nlohmann::json::array();
  for (const Key& key : order) {
    double sum = 0;
    for (const double log_speed : log_speeds[key]) sum += log_speed;
    const double speed = std::exp(sum / static_cast<double>(log_speeds[key].size()));
    sums[key]["mrays_per_s"] = estimate_json({speed, speed, speed});
    add_rates(sums[key]);
    pooled.push_back(std::move(sums[key]));
  }
  return pooled;
}

}  // namespace umbrix::bench
