// SPDX-License-Identifier: Apache-2.0
// EXT_mesh_gpu_instancing: many places of a node's mesh, in arrays. Attributes of other names are the application's.

#include "io/gltf_instancing.h"

#include "io/load_error.h"
#include "io/node_transform.h"

namespace umbrix::io::detail {
namespace {

constexpr const char* kExtension = "EXT_mesh_gpu_instancing";

// An attribute's accessor, or -1. The JSON's rules know it to exist.
int attribute(const tinygltf::Node& node, const char* name) {
  const tinygltf::Value& attributes = node.extensions.at(kExtension).Get("attributes");
  return attributes.Has(name) ? attributes.Get(name).GetNumberAsInt() : -1;
}

}  // namespace

bool has_gpu_instances(const tinygltf::Node& node) { return node.extensions.count(kExtension) > 0; }

std::uint64_t gpu_instance_count(const tinygltf::Node& node, const AccessorReader& reader, const std::string& label) {
  std::uint64_t count = 0;
  const char* first = nullptr;
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    const int accessor = attribute(node, name);
    if (accessor < 0) continue;
    const std::uint64_t elements = reader.count(accessor);
    if (first && elements != count) {
      bad_input("{}: {} of its instances has {} elements, {} has {}", label, name, elements, first, count);
    }
    if (!first) first = name;
    count = elements;
  }
  if (!first) bad_input("{}: its instances have neither TRANSLATION, ROTATION nor SCALE", label);
  return count;
}

std::vector<glm::dmat4> read_gpu_instances(const tinygltf::Node& node, AccessorReader& reader,
                                           const std::string& label) {
  std::vector<Pose> poses(gpu_instance_count(node, reader, label));
  const auto read = [&](const char* name, auto decode) {
    if (const int accessor = attribute(node, name); accessor >= 0) decode(accessor);
  };
  read("TRANSLATION", [&](int accessor) {
    const auto values = reader.vectors(accessor, AccessorUse::placement);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].translation = {values[i][0], values[i][1], values[i][2]};
  });
  read("ROTATION", [&](int accessor) {
    const auto values = reader.values<4>(accessor, AccessorUse::turn);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      poses[i].rotation = glm::dquat(values[i][3], values[i][0], values[i][1], values[i][2]);
    }
  });
  read("SCALE", [&](int accessor) {
    const auto values = reader.vectors(accessor, AccessorUse::placement);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].scale = {values[i][0], values[i][1], values[i][2]};
  });
  std::vector<glm::dmat4> out;
  out.reserve(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::string where = fmt::format("{}: instance {}", label, i);
    out.push_back(to_matrix(poses[i], where));
    if (!is_finite(out.back())) bad_input("{}: the transform is not finite", where);
  }
  return out;
}

}  // namespace umbrix::io::detail
