// SPDX-License-Identifier: Apache-2.0
#include "error/ray_rows.h"

#include <cmath>
#include <map>
#include <tuple>

#include "error/statistics.h"

namespace umbrix::bench {
namespace {

nlohmann::json estimate_json(const Estimate& estimate, double factor = 1) {
  return {{"value", factor * estimate.value}, {"low", factor * estimate.low}, {"high", factor * estimate.high}};
}

Estimate rays_per_microsecond(std::uint64_t rays, const std::vector<double>& seconds) {
  std::vector<double> rates;
  for (const double s : seconds) rates.push_back(s > 0 ? 1e-6 * static_cast<double>(rays) / s : 0);
  return median_and_quartiles(rates);
}

/// Sets what follows from the counts of a row.
void add_rates(nlohmann::json& row) {
  const auto rays = row.at("rays").get<std::uint64_t>();
  const auto leaks = row.at("leaks").get<std::uint64_t>(), false_shadows = row.at("false_shadows").get<std::uint64_t>();
  row["wrong_per_million"] = estimate_json(share_of(leaks + false_shadows, rays), 1e6);
  row["leaks_per_million"] = estimate_json(share_of(leaks, rays), 1e6);
  row["false_shadows_per_million"] = estimate_json(share_of(false_shadows, rays), 1e6);
}

}  // namespace

nlohmann::json ray_rows(const std::string& scene, const std::vector<RayErrors>& sets) {
  nlohmann::json rows = nlohmann::json::array();
  for (const RayErrors& set : sets) {
    for (const PeerErrors& peer : set.peers) {
      nlohmann::json row = {{"scene", scene},
                            {"kind", set.kind},
                            {"aim", set.aim},
                            {"peer", peer.peer},
                            {"family", peer.family},
                            {"rays", set.rays},
                            {"occluded", set.occluded},
                            {"leaks", peer.leaks},
                            {"false_shadows", peer.false_shadows},
                            {"mrays_per_s", estimate_json(rays_per_microsecond(set.rays, peer.seconds))}};
      if (set.flux > 0) row["flux_error"] = peer.wrong_flux / set.flux;
      add_rates(row);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

nlohmann::json pooled_rows(const nlohmann::json& rows) {
  struct Pool {
    nlohmann::json sum;
    double log_speeds = 0;
    int scenes = 0;
  };
  using Key = std::tuple<std::string, std::string, std::string>;
  std::vector<Key> order;
  std::map<Key, Pool> pools;
  for (const nlohmann::json& row : rows) {
    const Key key = {row.at("kind"), row.at("aim"), row.at("peer")};
    Pool& pool = pools[key];
    if (pool.scenes == 0) {
      order.push_back(key);
      pool.sum = row;
      pool.sum["scene"] = "all scenes";
      pool.sum.erase("flux_error");
    } else {
      for (const char* count : {"rays", "occluded", "leaks", "false_shadows"})
        pool.sum[count] = pool.sum.at(count).get<std::uint64_t>() + row.at(count).get<std::uint64_t>();
    }
    pool.log_speeds += std::log(row.at("mrays_per_s").at("value").get<double>());
    ++pool.scenes;
  }
  nlohmann::json pooled = nlohmann::json::array();
  for (const Key& key : order) {
    Pool& pool = pools[key];
    const double speed = std::exp(pool.log_speeds / pool.scenes);
    pool.sum["mrays_per_s"] = estimate_json({speed, speed, speed});
    add_rates(pool.sum);
    pooled.push_back(std::move(pool.sum));
  }
  return pooled;
}

}  // namespace umbrix::bench
