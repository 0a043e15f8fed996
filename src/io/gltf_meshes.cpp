// SPDX-License-Identifier: Apache-2.0
// Primitives to triangle lists (glTF 2.0, section 3.7.2).

#include <algorithm>
#include <limits>
#include <numeric>

#include "io/accessor.h"
#include "io/gltf_compression.h"
#include "io/gltf_convert.h"
#include "io/gltf_shapes.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

using Triangle = std::array<std::uint32_t, 3>;

// Reads a corner: through the indices, or in order if there are none.
struct Corners {
  std::vector<std::uint32_t> indices;
  std::uint64_t count = 0;

  std::uint32_t operator()(std::uint64_t i) const {
    return indices.empty() ? static_cast<std::uint32_t>(i) : indices[i];
  }
};

std::uint64_t triangle_count(int mode, std::uint64_t corners) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

// The windings are those of the specification's formulas: all triangles of a strip face the same way.
Triangle triangle(int mode, const Corners& corner, std::uint64_t i) {
  if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {corner(i), corner(i + 1 + i % 2), corner(i + 2 - i % 2)};
  if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {corner(i + 1), corner(i + 2), corner(0)};
  return {corner(3 * i), corner(3 * i + 1), corner(3 * i + 2)};
}

// Keeps what `place` has a place for, `each` elements a vertex.
template <class T>
void keep_used(std::vector<T>& values, const std::vector<std::uint32_t>& place, std::size_t kept,
               std::size_t each = 1) {
  if (values.empty()) return;
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] == kUnused) continue;
    for (std::size_t i = 0; i < each; ++i) values[place[v] * each + i] = values[v * each + i];
  }
  values.resize(kept * each);
  values.shrink_to_fit();
}

// Keeps only the vertices that are used, in their order. Exporters like to cut one big vertex array into many
// primitives; each would carry it whole.
void drop_unused_vertices(Mesh& mesh, Shape* shape) {
  std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) place[v] = 0;
  }
  std::uint32_t kept = 0;
  for (std::uint32_t& v : place) {
    if (v != kUnused) v = kept++;
  }
  keep_used(mesh.positions, place, kept);
  keep_used(mesh.normals, place, kept);
  for (auto& texcoords : mesh.texcoord_sets) keep_used(texcoords, place, kept);
  keep_used(mesh.colors, place, kept);
  keep_used(mesh.tangents, place, kept);
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = place[v];
  }
  if (!shape) return;
  keep_used(shape->positions, place, kept);
  keep_used(shape->normals, place, kept);
  keep_used(shape->tangents, place, kept);
  for (Shape::Target& target : shape->targets) {
    keep_used(target.positions, place, kept);
    keep_used(target.normals, place, kept);
    keep_used(target.tangents, place, kept);
  }
  keep_used(shape->joints, place, kept, shape->influences);
  keep_used(shape->weights, place, kept, shape->influences);
}

// An attribute's accessor, or -1. Refuses one of another length than the positions.
int attribute(const tinygltf::Primitive& primitive, const char* name, const AccessorReader& reader,
              std::uint64_t vertex_count, const std::string& label) {
  const auto found = primitive.attributes.find(name);
  if (found == primitive.attributes.end()) return -1;
  if (const std::uint64_t count = reader.count(found->second); count != vertex_count) {
    bad_input("{}: {} has {} elements, POSITION has {}", label, name, count, vertex_count);
  }
  return found->second;
}

void note_ignored(const tinygltf::Primitive& primitive, const std::string& label, Remarks& ignored) {
  for (const auto& target : primitive.targets) {
    const bool more = std::any_of(target.begin(), target.end(), [](const auto& attribute) {
      return attribute.first != "POSITION" && attribute.first != "NORMAL" && attribute.first != "TANGENT";
    });
    if (more) ignored.add("morph targets of other things than positions and normals", label);
  }
  for (const char* more : {"COLOR_1", "TEXCOORD_2"}) {
    if (primitive.attributes.count(more) > 0) ignored.add(fmt::format("vertex attribute {}", more), label);
  }
}

class MeshConverter {
 public:
  explicit MeshConverter(Conversion& conversion)
      : conversion_(conversion),
        reader_(conversion.model, conversion.limits.decoded_bytes),
        triangles_left_(conversion.limits.triangles) {}

  void convert(const tinygltf::Primitive& primitive, const std::string& name, const std::string& label) {
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (mode > TINYGLTF_MODE_TRIANGLE_FAN) bad_input("{}: mode {} does not exist", label, mode);
    if (mode < TINYGLTF_MODE_TRIANGLES) return conversion_.ignored.add("primitives of points or lines", label);
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return conversion_.ignored.add("primitives without POSITION", label);

    if (primitive.extensions.count(kDraco) > 0 && !kReadsDraco &&
        conversion_.model.accessors[static_cast<std::size_t>(position->second)].bufferView < 0) {
      bad_input(
          "{}: is compressed with {}, which is not supported by this build; gltf-transform can decompress the file",
          label, kDraco);
    }

    const std::uint64_t vertex_count = reader_.count(position->second);
    if (vertex_count >= kUnused) over_limit("{}: {} vertices, the limit is {}", label, vertex_count, kUnused - 1);
    Corners corners;
    if (primitive.indices >= 0) corners.indices = reader_.indices(primitive.indices, vertex_count);
    corners.count = primitive.indices >= 0 ? corners.indices.size() : vertex_count;
    const std::uint64_t count = triangle_count(mode, corners.count);
    if (count > triangles_left_) {
      over_limit("{}: the file has more than {} triangles, which is the limit", label, conversion_.limits.triangles);
    }
    triangles_left_ -= count;
    if (mode == TINYGLTF_MODE_TRIANGLES && corners.count % 3 != 0) {
      conversion_.warnings.add("left-over vertices after the last whole triangle", label);
    }
    if (count == 0) return conversion_.warnings.add("primitives without triangles", label);

    Mesh mesh;
    mesh.name = name;
    mesh.positions = reader_.vectors(position->second, AccessorUse::position);
    mesh.material = primitive.material >= 0 ? static_cast<std::uint32_t>(primitive.material) : default_material();
    read_attributes(primitive, vertex_count, label, mesh);
    mesh.triangles.resize(count);
    for (std::uint64_t i = 0; i < count; ++i) mesh.triangles[i] = triangle(mode, corners, i);
    const std::shared_ptr<Shape> shape = read_shape(primitive, mesh, reader_, label);
    if (vertex_count > corners.count) drop_unused_vertices(mesh, shape.get());
    note_ignored(primitive, label, conversion_.ignored);
    conversion_.scene.meshes.push_back(std::move(mesh));
    conversion_.shapes.push_back(shape);
  }

  // glTF's material for primitives that name none; made when first needed.
  std::uint32_t default_material() {
    std::vector<Material>& materials = conversion_.scene.materials;
    if (materials.size() == conversion_.model.materials.size()) {
      materials.emplace_back();
      materials.back().name = "default";
    }
    return static_cast<std::uint32_t>(materials.size() - 1);
  }

 private:
  // What shading wants at the corners; of what only textures want, what the material's textures do.
  void read_attributes(const tinygltf::Primitive& primitive, std::uint64_t vertex_count, const std::string& label,
                       Mesh& mesh) {
    const Material& material = conversion_.scene.materials[mesh.material];
    const auto find = [&](const char* name) { return attribute(primitive, name, reader_, vertex_count, label); };
    if (const int normals = find("NORMAL"); normals >= 0) mesh.normals = reader_.vectors(normals, AccessorUse::normal);
    if (const int colors = find("COLOR_0"); colors >= 0) mesh.colors = reader_.colors(colors);
    const int tangents = find("TANGENT");
    if (tangents >= 0 && material.normal_texture.texture >= 0) mesh.tangents = reader_.tangents(tangents);
    const char* const names[] = {"TEXCOORD_0", "TEXCOORD_1"};
    for (std::uint32_t set = 0; set < 2; ++set) {
      const bool wanted = std::any_of(std::begin(kMaterialTextures), std::end(kMaterialTextures), [&](const auto use) {
        return (material.*use).texture >= 0 && (material.*use).texcoord == set;
      });
      const int texcoords = find(names[set]);
      if (texcoords >= 0 && (wanted || set == 0)) mesh.texcoord_sets[set] = reader_.texcoords(texcoords);
      if (texcoords < 0 && wanted) {
        conversion_.warnings.add(fmt::format("textures without {}, which they need; factors only are used", names[set]),
                                 label);
      }
    }
  }

  Conversion& conversion_;
  AccessorReader reader_;
  std::uint64_t triangles_left_;
};

}  // namespace

void convert_meshes(Conversion& conversion) {
  MeshConverter converter(conversion);
  conversion.first_mesh.push_back(0);
  for (std::size_t m = 0; m < conversion.model.meshes.size(); ++m) {
    const tinygltf::Mesh& mesh = conversion.model.meshes[m];
    const std::string label = label_of("meshes", m, mesh.name);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      converter.convert(mesh.primitives[p], mesh.name, fmt::format("{} primitives[{}]", label, p));
    }
    conversion.first_mesh.push_back(static_cast<std::uint32_t>(conversion.scene.meshes.size()));
  }
  if (conversion.scene.materials.empty()) converter.default_material();
}

}  // namespace umbrix::io::detail
