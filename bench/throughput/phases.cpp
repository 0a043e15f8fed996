// SPDX-License-Identifier: Apache-2.0
#include "throughput/phases.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace umbrix::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;

// To the disc that a point sees of the sphere, a ray for each of 4x4 strata, the other ends moved within theirs.
void add_area_rays(const Ray& to_center, double radius, std::mt19937& random, std::vector<Ray>& out) {
  const double n[3] = {to_center.direction[0], to_center.direction[1], to_center.direction[2]};
  const std::size_t least = std::abs(n[0]) < 0.6 ? 0 : 1;
  double a[3] = {0, 0, 0}, b[3];
  a[least] = 1;
  const double along = n[least];
  for (std::size_t k = 0; k < 3; ++k) a[k] -= along * n[k];
  const double length = std::hypot(a[0], a[1], a[2]);
  for (double& x : a) x /= length;
  for (std::size_t k = 0; k < 3; ++k) b[k] = n[(k + 1) % 3] * a[(k + 2) % 3] - n[(k + 2) % 3] * a[(k + 1) % 3];
  std::uniform_real_distribution<double> jitter(0, 1);
  for (int i = 0; i < 16; ++i) {
    const int ring = i % 4, sector = i / 4;
    const double r = radius * std::sqrt((ring + jitter(random)) / 4), angle = 2 * kPi * (sector + jitter(random)) / 4;
    double d[3];
    for (std::size_t k = 0; k < 3; ++k)
      d[k] = n[k] * double{to_center.tmax} + r * (std::cos(angle) * a[k] + std::sin(angle) * b[k]);
    const double distance = std::hypot(d[0], d[1], d[2]);
    Ray ray = to_center;
    for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = static_cast<float>(d[k] / distance);
    ray.tmax = static_cast<float>(distance);
    out.push_back(ray);
  }
}

}  // namespace

Status make_phase(const std::string& name, const Scene& scene, const workload::Geometry& geometry,
                  const workload::Viewpoint& viewpoint, std::size_t light, int size, int rounds, Phase& out) {
  out.name = name;
  const auto frame = [&](const io::Camera& camera, int wide) {
    return workload::shadow_rays(scene, geometry, camera, viewpoint.lights[light], wide);
  };
  std::mt19937 random(1);
  std::vector<Ray> rays;
  if (name == "first") {
    rays = frame(viewpoint.camera, size);
  } else if (name.rfind("next:", 0) == 0) {
    const double step = std::atof(name.c_str() + 5) * workload::diagonal(scene);
    io::Camera camera = viewpoint.camera;
    out.before = frame(camera, size);
    for (int round = 0; round < rounds; ++round) {
      for (auto& row : camera.to_world) row[3] += step * row[0];
      out.frames.push_back(frame(camera, size));
    }
  } else if (name == "shuffled") {
    rays = frame(viewpoint.camera, size);
    std::shuffle(rays.begin(), rays.end(), random);
    out.is_shuffled = true;
  } else if (name == "area") {
    for (const Ray& ray : frame(viewpoint.camera, std::max(1, size / 4)))
      if (std::isfinite(ray.tmax)) add_area_rays(ray, workload::diagonal(scene) / 80, random, rays);
  } else {
    return {StatusCode::invalid_argument,
            fmt::format("there is no phase '{}'; there are first, next:D, shuffled, area and build+first", name)};
  }
  if (out.frames.empty()) out.frames.push_back(std::move(rays));
  return {};
}

}  // namespace umbrix::bench
