// SPDX-License-Identifier: Apache-2.0
#include "workload/shadow_rays.h"

#include <array>
#include <cmath>
#include <limits>

#include "render/camera.h"

namespace umbrix::workload {
namespace {

using Double3 = std::array<double, 3>;

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Double3 normalized(const Double3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

Double3 edge(const oracle::Triangle& t, std::size_t corner) {
  return {double{t.v[corner][0]} - t.v[0][0], double{t.v[corner][1]} - t.v[0][1], double{t.v[corner][2]} - t.v[0][2]};
}

// The unit normal on the side that the ray comes from.
Double3 facing_normal(const oracle::Triangle& t, const Ray& ray) {
  const Double3 a = edge(t, 1), b = edge(t, 2);
  Double3 n = normalized({a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
  if (dot(n, {ray.direction[0], ray.direction[1], ray.direction[2]}) > 0) n = {-n[0], -n[1], -n[2]};
  return n;
}

// The segment from a primary hit to the light, and the irradiance that it would bring; false if the surface faces away.
bool shadow_ray(const Ray& primary, const Hit& hit, const oracle::Triangle& triangle, const io::Light& light,
                double offset, Ray& out, float& irradiance) {
  const Double3 n = facing_normal(triangle, primary);
  for (std::size_t k = 0; k < 3; ++k) {
    const double point = primary.origin[k] + double{hit.t} * primary.direction[k];
    out.origin[k] = static_cast<float>(point + offset * n[k]);
  }
  const bool is_directional = light.type == io::LightType::directional;
  Double3 to_light;
  for (std::size_t k = 0; k < 3; ++k) {
    to_light[k] = is_directional ? -light.direction[k] : light.position[k] - out.origin[k];
  }
  if (!(dot(n, to_light) > 0)) return false;
  const double distance = std::sqrt(dot(to_light, to_light));
  for (std::size_t k = 0; k < 3; ++k) out.direction[k] = static_cast<float>(to_light[k] / distance);
  out.tmin = 0;
  out.tmax = is_directional ? std::numeric_limits<float>::infinity() : static_cast<float>(distance);
  irradiance = static_cast<float>(dot(n, to_light) / distance / (is_directional ? 1 : distance * distance));
  return true;
}

constexpr int kTile = 16;

// Pixels of a tile as coherent packets want them: in blocks of 4x4.
std::vector<std::array<int, 2>> tile_pixels(int tile_x, int tile_y, int size) {
  std::vector<std::array<int, 2>> pixels;
  for (int i = 0; i < kTile * kTile; ++i) {
    const int block = i / 16, within = i % 16;
    const int x = tile_x + 4 * (block % 4) + within % 4;
    const int y = tile_y + 4 * (block / 4) + within / 4;
    if (x < size && y < size) pixels.push_back({x, y});
  }
  return pixels;
}

}  // namespace

double diagonal(const Scene& scene) {
  float lower[3], upper[3];
  if (!scene.bounds(lower, upper)) return 0;
  return std::hypot(double{upper[0]} - lower[0], double{upper[1]} - lower[1], double{upper[2]} - lower[2]);
}

Status find_viewpoint(const Geometry& geometry, const std::string& setup_path, Viewpoint& out) {
  const io::SceneFile& file = geometry.file;
  out.camera = file.cameras.empty() ? io::framing_camera(file) : file.cameras[0];
  out.lights = file.lights;
  if (!setup_path.empty()) {
    io::Setup setup;
    if (Status status = io::load_setup(setup_path, file, setup); !status) return status;
    if (setup.camera) out.camera = *setup.camera;
    if (!setup.lights.empty()) out.lights = setup.lights;
  }
  if (out.lights.empty()) out.lights = io::default_lights(file, out.camera);
  return {};
}

TiledRays tiled_shadow_rays(const Scene& scene, const Geometry& geometry, const io::Camera& camera,
                            const io::Light& light, int size) {
  const render::Camera view(camera, size, size);
  const double offset = 1e-5 * diagonal(scene);
  TiledRays tiled;
  for (int tile_y = 0; tile_y < size; tile_y += kTile) {
    for (int tile_x = 0; tile_x < size; tile_x += kTile) {
      tiled.tile_starts.push_back(tiled.rays.size());
      for (const auto& [x, y] : tile_pixels(tile_x, tile_y, size)) {
        const Ray primary = view.ray(x + 0.5, y + 0.5);
        Hit hit;
        Ray ray;
        float irradiance = 0;
        if (!scene.closest(primary, hit)) continue;
        if (!shadow_ray(primary, hit, geometry.triangle(hit.primitive), light, offset, ray, irradiance)) continue;
        tiled.rays.push_back(ray);
        tiled.irradiance.push_back(irradiance);
        tiled.pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
      }
    }
  }
  tiled.tile_starts.push_back(tiled.rays.size());
  return tiled;
}

std::vector<Ray> shadow_rays(const Scene& scene, const Geometry& geometry, const io::Camera& camera,
                             const io::Light& light, int size) {
  return tiled_shadow_rays(scene, geometry, camera, light, size).rays;
}

}  // namespace umbrix::workload
