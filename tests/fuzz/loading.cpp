// SPDX-License-Identifier: Apache-2.0
#include "loading.h"

#include <algorithm>
#include <cmath>

#include "promise.h"

namespace umbrix::fuzz {
namespace {

using io::Camera;
using io::Light;
using io::Mesh;
using io::SceneFile;

bool is_plain(const std::string& line) {
  return std::none_of(line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; });
}

bool is_finite(const io::Transform& m) {
  for (const auto& row : m) {
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); })) return false;
  }
  return true;
}

// Directions of a camera are of unit length and at right angles.
bool is_rigid(const io::Transform& m) {
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = a; b < 3; ++b) {
      const double dot = m[0][a] * m[0][b] + m[1][a] * m[1][b] + m[2][a] * m[2][b];
      if (!(std::abs(dot - (a == b ? 1 : 0)) < 1e-6)) return false;
    }
  }
  return true;
}

void check_mesh(const Mesh& mesh, std::size_t materials) {
  const std::size_t vertices = mesh.positions.size();
  promise(!mesh.triangles.empty(), "a mesh has triangles");
  promise(mesh.normals.empty() || mesh.normals.size() == vertices, "normals match positions");
  for (const auto& texcoords : mesh.texcoord_sets) {
    promise(texcoords.empty() || texcoords.size() == vertices, "texture coordinates match positions");
  }
  promise(mesh.colors.empty() || mesh.colors.size() == vertices, "colours match positions");
  promise(mesh.tangents.empty() || mesh.tangents.size() == vertices, "tangents match positions");
  promise(mesh.material < materials, "a mesh's material exists");
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) promise(v < vertices, "vertex indices are in range");
  }
}

void check_textures(const SceneFile& scene) {
  for (const io::Texture& texture : scene.textures) {
    promise(texture.image < static_cast<std::int32_t>(scene.images.size()), "a texture's image exists");
  }
  for (const io::Material& material : scene.materials) {
    for (const auto member : io::kMaterialTextures) {
      const io::TextureUse& use = material.*member;
      if (use.texture < 0) continue;
      promise(use.texture < static_cast<std::int32_t>(scene.textures.size()), "a material's texture exists");
      promise(scene.textures[static_cast<std::size_t>(use.texture)].image >= 0, "a texture in use has an image");
      promise(use.texcoord < 2, "a texture's coordinates are of a set that is read");
      for (const auto& row : use.transform) {
        for (const double x : row) promise(std::isfinite(x), "a texture's transform is finite");
      }
    }
  }
}

// What is decoded is whole, or not there and told.
void check_images(SceneFile& scene, const io::LoadLimits& limits) {
  const Status status = io::read_textures(scene, limits);
  if (!status) promise(status.code() == StatusCode::resource_limit && is_plain(status.message()), "images have limits");
  for (const io::TextureImage& image : scene.images) {
    promise(image.pixels.empty() || image.channels <= 4, "an image has at most four channels");
    promise(image.pixels.empty() || image.pixels.size() == std::size_t{image.width} * image.height * image.channels,
            "an image's pixels match its size");
  }
}

void check_still(const SceneFile& scene) {
  check_textures(scene);
  for (const Mesh& mesh : scene.meshes) check_mesh(mesh, scene.materials.size());
  for (const io::Instance& instance : scene.instances) {
    promise(instance.mesh < scene.meshes.size(), "an instance's mesh exists");
    promise(is_finite(instance.to_world), "an instance's transform is finite");
  }
  for (const Camera& camera : scene.cameras) check_camera(camera);
  for (const Light& light : scene.lights) check_light(light);
}

// At any moment the scene is as whole as at rest, or stays as it was.
void check_moments(const SceneFile& scene) {
  if (!scene.motion) return;
  const auto [first, last] = io::motion_span(scene);
  promise(std::isfinite(first) && std::isfinite(last) && first <= last, "a scene's span is in order");
  SceneFile moved = scene;
  for (const double time : {first, last, first + 0.3 * (last - first), -1e30, 1e30, 0.0}) {
    io::SceneChanges changes;
    const Status status = io::pose_scene(moved, {time, time}, changes);
    if (!status) check_refusal(status);
    for (const std::uint32_t i : changes.instances)
      promise(i < scene.instances.size(), "an instance that moved exists");
    for (const std::uint32_t m : changes.meshes) {
      promise(m < scene.meshes.size() && moved.meshes[m].positions.size() == scene.meshes[m].positions.size(),
              "a mesh that moved keeps its vertices");
    }
    check_still(moved);
  }
}

void check_scene(const SceneFile& scene) {
  check_still(scene);
  if (scene.instanced_triangles() <= 10000) check_moments(scene);
  for (const auto* lines : {&scene.ignored, &scene.warnings}) {
    for (const std::string& line : *lines) promise(is_plain(line), "remarks are plain text");
  }
  if (scene.instanced_triangles() > 10000) return;
  check_camera(io::framing_camera(scene));
  const float intensity = io::default_intensity(scene, {1, 2, 3});
  promise(std::isfinite(intensity) && intensity > 0, "the default intensity is finite and above 0");
}

}  // namespace

void check_refusal(const Status& status) {
  promise(status.code() == StatusCode::bad_input || status.code() == StatusCode::resource_limit,
          "a refusal is bad_input or resource_limit");
  promise(is_plain(status.message()), "a refusal is one plain line");
  promise(!status.message().empty() && status.message().size() < 1000, "a refusal's message is of a fair length");
}

void check_camera(const Camera& camera) {
  promise(is_finite(camera.to_world) && is_rigid(camera.to_world), "a camera's directions are of unit length");
  promise(camera.yfov > 0 && camera.yfov < 3.1416, "a camera's angle is between 0 and pi");
  promise(camera.zfar > camera.znear && camera.znear >= 0, "a camera's planes are in order");
  promise(std::isfinite(camera.aspect) && camera.aspect >= 0, "a camera's aspect is finite");
  promise(std::isfinite(camera.xmag) && std::isfinite(camera.ymag), "a camera's extents are finite");
  if (!camera.motion) return;
  const auto [first, last] = io::motion_span(camera);
  promise(std::isfinite(first) && std::isfinite(last) && first <= last, "a motion's span is in order");
  for (const double time : {first, last, first + 0.3 * (last - first), -1e30, 1e30, 0.0}) {
    Camera moved;
    const Status status = io::camera_at(camera, {time, time}, moved);
    if (!status) {
      check_refusal(status);
    } else {
      promise(is_finite(moved.to_world) && is_rigid(moved.to_world), "a moved camera's directions are of unit length");
    }
  }
}

void check_light(const Light& light) {
  for (const float c : light.color) promise(std::isfinite(c) && c >= 0, "a light's colour is finite");
  promise(std::isfinite(light.intensity) && light.intensity >= 0, "a light's intensity is finite");
  promise(light.range > 0, "a light's range is above 0");
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    promise(std::isfinite(light.position[k]), "a light's position is finite");
    squares += light.direction[k] * light.direction[k];
  }
  promise(std::abs(squares - 1) < 1e-6, "a light's direction is of unit length");
  for (const io::Double3& edge : light.half_edges) {
    for (const double x : edge) promise(std::isfinite(x), "a light's edges are finite");
  }
  promise(std::isfinite(light.radius) && light.radius >= 0 && std::isfinite(light.rotation),
          "a light's size is finite");
  if (light.environment) {
    const io::EnvironmentMap& map = *light.environment;
    promise(map.pixels.size() == std::size_t{map.width} * map.height && map.width > 0, "a map is whole");
  }
  promise(light.inner_cone_angle >= 0 && light.outer_cone_angle > 0 && light.inner_cone_angle <= light.outer_cone_angle,
          "a light's cones are in order");
}

void check_loading(const std::string& path, bool strict) {
  io::LoadLimits limits;
  if (strict) {
    limits.triangles = 1u << 14;
    limits.nodes = 1000;
    limits.image_pixels = 1u << 16;
  }
  SceneFile scene;
  const Status status = io::load_scene(path, scene, limits);
  if (status) {
    check_scene(scene);
    check_images(scene, limits);
    for (const std::string& line : scene.warnings) promise(is_plain(line), "remarks are plain text");
    return;
  }
  check_refusal(status);
  promise(scene.meshes.empty() && scene.instances.empty() && scene.path.empty(), "nothing is left of a refused scene");
}

}  // namespace umbrix::fuzz
