// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "io/shape.h"
#include "io/tinygltf.h"
#include "umbrix/io/scene_file.h"

/// The steps from tinygltf's model to a SceneFile, in the order in which load_scene takes them. All throw LoadError.
namespace umbrix::io::detail {

/// Counts kinds of remarks, so that a file with a thousand odd primitives makes one line.
class Remarks {
 public:
  /// `where` is kept for the first of a kind.
  void add(const std::string& kind, const std::string& where, std::uint64_t count = 1);

  /// "kind: 12 times, first in meshes[3]".
  std::vector<std::string> lines() const;

 private:
  struct Entry {
    std::uint64_t count = 0;
    std::string first;
  };
  std::map<std::string, Entry> entries_;
};

struct Conversion {
  const tinygltf::Model& model;
  const LoadLimits& limits;  ///< decoded_bytes is set
  SceneFile& scene;
  Remarks ignored;
  Remarks warnings;
  /// Primitives of glTF mesh i are scene.meshes[first_mesh[i]] up to first_mesh[i + 1].
  std::vector<std::uint32_t> first_mesh;
  /// For each of scene.meshes what its vertices are made from; null if they are as they are.
  std::vector<std::shared_ptr<const Shape>> shapes;
};

/// "meshes[3] 'Wall'", fit for a message.
std::string label_of(const char* array, std::size_t index, const std::string& name);

void convert_textures(Conversion& conversion);
void convert_images(Conversion& conversion);
void convert_materials(Conversion& conversion);
void convert_meshes(Conversion& conversion);

/// Walks the scene's nodes and places meshes, cameras and lights, at rest. `animation`: as for load_scene.
void convert_nodes(Conversion& conversion, const std::string& animation);

/// A material's use of texture number `texture`, or of none for -1 and for what cannot be used, which is then noted.
TextureUse convert_texture_use(Conversion& conversion, int texture, int texcoord,
                               const tinygltf::ExtensionMap& extensions, const std::string& label);

/// A camera or light without its place. The caller sets to_world, position and direction.
Camera convert_camera(const tinygltf::Camera& camera, const std::string& label);
Light convert_light(const tinygltf::Light& light, const std::string& label);

}  // namespace umbrix::io::detail
