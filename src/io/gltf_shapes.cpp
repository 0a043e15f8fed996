// SPDX-License-Identifier: Apache-2.0
// Morph targets and joints of primitives (glTF 2.0, sections 3.7.2.2 and 3.7.3.3).

#include "io/gltf_shapes.h"

#include <algorithm>
#include <cmath>

#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

// No face has more; each costs every vertex, and a file nothing but a pair of braces.
constexpr std::size_t kMostTargets = 4096;

using Attributes = std::map<std::string, int>;

std::vector<Float3> read_deltas(const Attributes& target, const char* name, AccessorUse use, std::size_t vertices,
                                AccessorReader& reader, const std::string& label) {
  const auto found = target.find(name);
  if (found == target.end()) return {};
  if (const std::uint64_t count = reader.count(found->second); count != vertices) {
    bad_input("{}: {} has {} elements, the mesh has {} vertices", label, name, count, vertices);
  }
  return reader.vectors(found->second, use);
}

void read_targets(const tinygltf::Primitive& primitive, Shape& shape, AccessorReader& reader,
                  const std::string& label) {
  if (primitive.targets.size() > kMostTargets) {
    over_limit("{}: {} morph targets, the limit is {}", label, primitive.targets.size(), kMostTargets);
  }
  for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
    const std::string where = fmt::format("{}.targets[{}]", label, t);
    const std::size_t vertices = shape.positions.size();
    Shape::Target target;
    target.positions = read_deltas(primitive.targets[t], "POSITION", AccessorUse::position, vertices, reader, where);
    if (!shape.normals.empty()) {
      target.normals = read_deltas(primitive.targets[t], "NORMAL", AccessorUse::normal, vertices, reader, where);
    }
    // Without the tangents' fourth component, so that they may be stored as normals are.
    if (!shape.tangents.empty()) {
      target.tangents = read_deltas(primitive.targets[t], "TANGENT", AccessorUse::normal, vertices, reader, where);
    }
    shape.targets.push_back(std::move(target));
  }
}

// The accessors of JOINTS_n and WEIGHTS_n for n from 0 on.
std::vector<std::pair<int, int>> influence_sets(const Attributes& attributes, std::size_t vertices,
                                                const AccessorReader& reader, const std::string& label) {
  std::vector<std::pair<int, int>> sets;
  for (;;) {
    const std::string joints = fmt::format("JOINTS_{}", sets.size()), weights = fmt::format("WEIGHTS_{}", sets.size());
    const auto j = attributes.find(joints), w = attributes.find(weights);
    if (j == attributes.end() && w == attributes.end()) return sets;
    if (j == attributes.end() || w == attributes.end()) {
      bad_input("{}: has {} but no {}", label, w == attributes.end() ? joints : weights,
                w == attributes.end() ? weights : joints);
    }
    for (const auto& [name, accessor] : {*j, *w}) {
      if (const std::uint64_t count = reader.count(accessor); count != vertices) {
        bad_input("{}: {} has {} elements, POSITION has {}", label, name, count, vertices);
      }
    }
    sets.emplace_back(j->second, w->second);
  }
}

// What weights nothing does not matter, and need not exist.
void add_influence(float joint, float weight, Shape& shape) {
  shape.joints.push_back(weight > 0 ? static_cast<std::uint16_t>(joint) : std::uint16_t{0});
  shape.weights.push_back(weight);
}

void read_influences(const tinygltf::Primitive& primitive, Shape& shape, AccessorReader& reader,
                     const std::string& label) {
  const std::size_t vertices = shape.positions.size();
  const auto sets = influence_sets(primitive.attributes, vertices, reader, label);
  if (sets.empty()) return;
  std::vector<std::vector<std::array<float, 4>>> joints, weights;
  for (const auto& [joint, weight] : sets) {
    joints.push_back(reader.values<4>(joint, AccessorUse::joint));
    weights.push_back(reader.values<4>(weight, AccessorUse::weight));
  }
  shape.influences = 4 * sets.size();
  shape.joints.reserve(vertices * shape.influences);
  shape.weights.reserve(vertices * shape.influences);
  for (std::size_t v = 0; v < vertices; ++v) {
    for (std::size_t i = 0; i < shape.influences; ++i) {
      const float weight = weights[i / 4][v][i % 4];
      if (!(weight >= 0) || !std::isfinite(weight)) {
        bad_input("{}: WEIGHTS_{} of vertex {} has a weight of {}", label, i / 4, v, weight);
      }
      add_influence(joints[i / 4][v][i % 4], weight, shape);
    }
    // As viewers do with vertices that an artist bound to nothing.
    const auto first = shape.weights.end() - static_cast<std::ptrdiff_t>(shape.influences);
    if (std::all_of(first, shape.weights.end(), [](float w) { return w == 0; })) *first = 1;
  }
}

}  // namespace

std::shared_ptr<Shape> read_shape(const tinygltf::Primitive& primitive, const Mesh& mesh, AccessorReader& reader,
                                  const std::string& label) {
  if (primitive.targets.empty() && primitive.attributes.count("JOINTS_0") == 0) return nullptr;
  auto shape = std::make_shared<Shape>();
  shape->positions = mesh.positions;
  shape->normals = mesh.normals;
  shape->tangents = mesh.tangents;
  read_targets(primitive, *shape, reader, label);
  read_influences(primitive, *shape, reader, label);
  return shape;
}

}  // namespace umbrix::io::detail
