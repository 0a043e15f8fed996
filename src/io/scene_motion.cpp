// SPDX-License-Identifier: Apache-2.0
#include "io/scene_motion.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "io/load_error.h"

namespace umbrix::io {
namespace {

using detail::PosedShape;
using Matrices = std::vector<glm::dmat4>;

PosedShape posed(const SceneMotion::MovedMesh& mesh, const Matrices& nodes, std::optional<double> seconds) {
  const bool moves = seconds && mesh.tracks && mesh.tracks->weights;
  Matrices joints;
  if (mesh.skin) {
    for (std::size_t j = 0; j < mesh.skin->joints.size(); ++j) {
      joints.push_back(nodes[mesh.skin->joints[j]] * mesh.skin->inverse_bind[j]);
    }
  }
  return pose_shape(*mesh.shape, moves ? mesh.tracks->weights_at(*seconds) : mesh.weights, joints);
}

Transform placed(const SceneMotion::MovedInstance& moved, const Matrices& nodes) {
  const glm::dmat4& node = nodes[moved.node];
  const glm::dmat4 m = moved.local ? node * *moved.local : node;
  if (!detail::is_finite(m)) detail::bad_input("an instance's transform is not finite");
  return detail::to_transform(m);
}

Light placed(const SceneMotion::MovedLight& moved, Light light, const Matrices& nodes) {
  detail::place_light(nodes[moved.node], moved.label, light);
  return light;
}

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

// A scene's next pose, made whole before anything of the scene is touched.
struct NextPose {
  std::vector<PosedShape> shapes;
  std::vector<Transform> transforms;
  std::vector<Light> lights;
};

// By their bits: a zero's sign and what is not a number count as well.
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a.front()) == 0);
}

void move_instance(SceneFile& scene, std::uint32_t number, const Transform& to_world, SceneChanges& changes) {
  Transform& place = scene.instances[number].to_world;
  if (place != to_world) changes.instances.push_back(number);
  place = to_world;
}

void apply(const SceneMotion& motion, NextPose& next, SceneFile& scene, SceneChanges& changes) {
  for (std::size_t i = 0; i < motion.instances.size(); ++i) {
    move_instance(scene, motion.instances[i].instance, next.transforms[i], changes);
  }
  for (std::size_t i = 0; i < motion.meshes.size(); ++i) {
    const SceneMotion::MovedMesh& moved = motion.meshes[i];
    Mesh& mesh = scene.meshes[moved.mesh];
    PosedShape& shape = next.shapes[i];
    if (!same(mesh.positions, shape.positions) || !same(mesh.normals, shape.normals) ||
        !same(mesh.tangents, shape.tangents)) {
      mesh.positions.swap(shape.positions);
      mesh.normals.swap(shape.normals);
      mesh.tangents.swap(shape.tangents);
      changes.meshes.push_back(moved.mesh);
      changes.instances.insert(changes.instances.end(), moved.instances.begin(), moved.instances.end());
    }
    if (!moved.skin) continue;
    for (const std::uint32_t instance : moved.instances) move_instance(scene, instance, shape.to_world, changes);
  }
  for (std::size_t i = 0; i < motion.lights.size(); ++i) {
    Light& light = scene.lights[motion.lights[i].light];
    changes.lights |= light.position != next.lights[i].position || light.direction != next.lights[i].direction;
    light.position = next.lights[i].position;
    light.direction = next.lights[i].direction;
  }
  sort_unique(changes.meshes);
  sort_unique(changes.instances);
}

}  // namespace

void SceneMotion::pose(SceneFile& scene, std::optional<double> seconds, SceneChanges& changes) const {
  const Matrices nodes = tree->all_to_world(seconds);
  NextPose next;
  for (const MovedInstance& moved : instances) next.transforms.push_back(placed(moved, nodes));
  for (const MovedLight& moved : lights) next.lights.push_back(placed(moved, scene.lights[moved.light], nodes));
  for (const MovedMesh& moved : meshes) next.shapes.push_back(posed(moved, nodes, seconds));
  // Room first, so that nothing fails half-way.
  SceneChanges changed;
  changed.meshes.reserve(meshes.size());
  changed.instances.reserve(instances.size() + 2 * scene.instances.size());
  apply(*this, next, scene, changed);
  changes = std::move(changed);
}

detail::KeySpan SceneMotion::span() const {
  detail::KeySpan span;
  for (const detail::NodeTree::Node& node : tree->nodes) {
    if (node.tracks) node.tracks->widen(span);
  }
  for (const MovedMesh& mesh : meshes) {
    if (mesh.tracks) mesh.tracks->widen(span);
  }
  return span;
}

Status pose_scene(SceneFile& scene, const Moment& moment, SceneChanges& changes) try {
  if (scene.motion) {
    scene.motion->pose(scene, moment.seconds, changes);
  } else {
    changes = {};
  }
  return {};
} catch (const detail::LoadError& e) {
  return {e.code, e.what};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("not enough memory for the moved scene");
}

std::vector<bool> moving_instances(const SceneFile& scene) {
  std::vector<bool> moving(scene.instances.size());
  if (!scene.motion) return moving;
  for (const SceneMotion::MovedInstance& moved : scene.motion->instances) moving[moved.instance] = true;
  for (const SceneMotion::MovedMesh& mesh : scene.motion->meshes) {
    for (const std::uint32_t instance : mesh.instances) moving[instance] = true;
  }
  return moving;
}

std::array<double, 2> motion_span(const SceneFile& scene) {
  return scene.motion ? scene.motion->span().get() : std::array<double, 2>{0, 0};
}

}  // namespace umbrix::io
