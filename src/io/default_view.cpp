// SPDX-License-Identifier: Apache-2.0
// A camera and lights for files that have none, and the lights that are surfaces.

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>

#include "umbrix/io/scene_file.h"

namespace umbrix::io {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Box {
  glm::dvec3 lower = glm::dvec3(std::numeric_limits<double>::infinity());
  glm::dvec3 upper = -lower;

  void add(const glm::dvec3& p) {
    if (!std::isfinite(p.x + p.y + p.z)) return;
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  bool empty() const { return !(lower.x <= upper.x); }
};

glm::dvec3 to_world(const Transform& m, const glm::dvec3& p) {
  glm::dvec3 out;
  for (int r = 0; r < 3; ++r) {
    const auto& row = m[static_cast<std::size_t>(r)];
    out[r] = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
  }
  return out;
}

glm::dvec3 point(const Float3& p) { return {p[0], p[1], p[2]}; }

// The corners of each mesh's box, placed: contains the scene, and need not look at each vertex of each instance.
Box scene_box(const SceneFile& scene) {
  std::vector<Box> boxes(scene.meshes.size());
  for (std::size_t m = 0; m < boxes.size(); ++m) {
    for (const Float3& p : scene.meshes[m].positions) boxes[m].add(point(p));
  }
  Box box;
  for (const Instance& instance : scene.instances) {
    const Box& mesh = boxes[instance.mesh];
    if (mesh.empty()) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p(corner & 1 ? mesh.upper.x : mesh.lower.x, corner & 2 ? mesh.upper.y : mesh.lower.y,
                         corner & 4 ? mesh.upper.z : mesh.lower.z);
      box.add(to_world(instance.to_world, p));
    }
  }
  return box;
}

// Distances from a point, weighted, in bins of a sixteenth of an octave.
class DistanceHistogram {
 public:
  void add(double distance, double weight) {
    if (!(distance > 0) || !std::isfinite(distance) || !(weight > 0)) return;
    const double bin = kBinsPerOctave * std::log2(distance);
    weights_[static_cast<int>(std::floor(bin))] += weight;
    total_ += weight;
  }
  // 0 if nothing was added.
  double median() const {
    double sum = 0;
    for (const auto& [bin, weight] : weights_) {
      sum += weight;
      if (2 * sum >= total_) return std::exp2((bin + 0.5) / kBinsPerOctave);
    }
    return 0;
  }

 private:
  static constexpr double kBinsPerOctave = 16;
  std::map<int, double> weights_;
  double total_ = 0;
};

// How far what a light shines on is: each triangle counts by the part of the light's sphere it may cover, so that
// neither a distant landscape nor a crowd of small triangles decides.
double median_distance(const SceneFile& scene, const glm::dvec3& light) {
  DistanceHistogram distances;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
      glm::dvec3 v[3];
      for (std::size_t k = 0; k < 3; ++k) v[k] = to_world(instance.to_world, point(mesh.positions[triangle[k]]));
      const double area = 0.5 * glm::length(glm::cross(v[1] - v[0], v[2] - v[0]));
      const double distance = glm::length((v[0] + v[1] + v[2]) / 3.0 - light);
      distances.add(distance, std::min(area / (distance * distance), 2 * kPi));
    }
  }
  return distances.median();
}

}  // namespace

float default_intensity(const SceneFile& scene, const Double3& position) {
  // A white diffuse surface facing a light of I candela at distance d has radiance I / (pi d^2).
  const double distance = median_distance(scene, {position[0], position[1], position[2]});
  const auto intensity = static_cast<float>(0.5 * kPi * distance * distance);
  return intensity > 0 && std::isfinite(intensity) ? intensity : 1.0f;
}

Camera framing_camera(const SceneFile& scene) {
  const Box box = scene_box(scene);
  glm::dvec3 centre(0);
  double radius = 1;
  if (!box.empty()) {
    centre = 0.5 * box.lower + 0.5 * box.upper;
    radius = std::max(glm::length(0.5 * box.upper - 0.5 * box.lower), 1e-30);
  }
  Camera camera;
  camera.name = "framing";
  // From the front, a little to the right and above, far enough for the bounding sphere.
  constexpr double kMargin = 1.05;
  const glm::dvec3 z = glm::normalize(glm::dvec3(0.5, 0.4, 1));
  const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
  const glm::dvec3 y = glm::cross(z, x);
  const glm::dvec3 eye = centre + z * (kMargin * radius / std::sin(camera.yfov / 2));
  for (int r = 0; r < 3; ++r) camera.to_world[static_cast<std::size_t>(r)] = {x[r], y[r], z[r], eye[r]};
  return camera;
}

std::vector<Light> default_lights(const SceneFile& scene, const Camera& camera) {
  // Where both shine straight on, they make a white surface about as bright as pi lux.
  constexpr double kOfSun = 0.75, kOfLamp = 0.5;
  Light sun, lamp;
  sun.name = "default sun";
  sun.type = LightType::directional;
  sun.intensity = static_cast<float>(kOfSun * kPi);
  // In the camera's frame: forward, to the right, down.
  const glm::dvec3 local = glm::normalize(glm::dvec3(0.5, -0.7, -1));
  for (std::size_t r = 0; r < 3; ++r) {
    const auto& row = camera.to_world[r];
    sun.direction[r] = row[0] * local.x + row[1] * local.y + row[2] * local.z;
    lamp.position[r] = row[3];
  }
  lamp.name = "default lamp";
  lamp.intensity = static_cast<float>(kOfLamp) * default_intensity(scene, lamp.position);
  return {sun, lamp};
}

std::vector<Light> emissive_lights(const SceneFile& scene) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    if (mesh.triangles.empty() || scene.materials[mesh.material].emission == Float3{0, 0, 0}) continue;
    Light light;
    for (const std::string* name : {&scene.instances[i].name, &mesh.name, &scene.materials[mesh.material].name}) {
      if (light.name.empty()) light.name = *name;
    }
    light.type = LightType::mesh;
    light.color = scene.materials[mesh.material].emission;
    light.instance = static_cast<std::uint32_t>(i);
    lights.push_back(std::move(light));
  }
  return lights;
}

}  // namespace umbrix::io
