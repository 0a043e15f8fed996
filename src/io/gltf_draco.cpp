// SPDX-License-Identifier: Apache-2.0
// KHR_draco_mesh_compression, with Draco's own decoder. It takes sizes from the data on trust and asks for memory by
// them, so they are looked at first.

#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/geometry_metadata.h>
#include <draco/metadata/metadata_decoder.h>

#include <array>
#include <cstring>
#include <limits>

#include "io/gltf_compression.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

// Faces and points of regular meshes may take less than a bit each; a small file gets these, and what its bytes can
// pay.
constexpr std::uint64_t kFreeElements = 1u << 16, kElementsPerByte = 64;
constexpr std::uint64_t kBytesPerFace = 3 * sizeof(std::uint32_t);
// Of one attribute: four components of four bytes, decoded and as we keep it.
constexpr std::uint64_t kBytesPerValue = 2 * 4 * sizeof(float);

struct CompressedMesh {
  std::string label;
  const char* data = nullptr;
  std::size_t bytes = 0;
};

// How many faces and points the data says it has; its header is that of the bitstream specification, section 5.
struct MeshSize {
  std::uint32_t faces = 0;
  std::uint64_t points = 0;
};

[[noreturn]] void damaged(const CompressedMesh& mesh, const std::string& why) {
  bad_input("{}: the Draco data is damaged: {}", mesh.label, why);
}

MeshSize size_of(const CompressedMesh& mesh) {
  constexpr std::size_t kHeaderBytes = 11;
  constexpr unsigned char kTriangularMesh = 1, kSequential = 0, kEdgebreaker = 1, kMetadataFlag = 0x80;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(mesh.data[i]); };
  if (mesh.bytes < kHeaderBytes || std::memcmp(mesh.data, "DRACO", 5) != 0) damaged(mesh, "it has no header");
  if (byte(5) != 2 || byte(6) != 2) {
    bad_input("{}: is of version {}.{} of Draco's bitstream, which must be 2.2", mesh.label, byte(5), byte(6));
  }
  const unsigned char method = byte(8);
  if (byte(7) != kTriangularMesh || (method != kSequential && method != kEdgebreaker)) {
    damaged(mesh, "it is no mesh of triangles");
  }
  draco::DecoderBuffer buffer;
  buffer.Init(mesh.data + kHeaderBytes, mesh.bytes - kHeaderBytes, 0x0202);
  if (byte(10) & kMetadataFlag) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) damaged(mesh, "its metadata");
  }
  std::uint8_t traversal = 0;
  std::uint32_t first = 0, second = 0;
  if ((method == kEdgebreaker && !buffer.Decode(&traversal)) || !draco::DecodeVarint(&first, &buffer) ||
      !draco::DecodeVarint(&second, &buffer)) {
    damaged(mesh, "it is cut off");
  }
  // Seams make more points of an edgebreaker's vertices, at most one a corner.
  return method == kEdgebreaker ? MeshSize{second, std::uint64_t{3} * second} : MeshSize{first, second};
}

void check_size(const CompressedMesh& mesh, std::uint64_t attributes, std::uint64_t& bytes_left) {
  const MeshSize size = size_of(mesh);
  const std::uint64_t most = kFreeElements + mesh.bytes * kElementsPerByte;
  if (size.faces > most || size.points > 3 * most) {
    bad_input("{}: {} bytes cannot hold {} triangles", mesh.label, mesh.bytes, size.faces);
  }
  const std::uint64_t bytes = size.faces * kBytesPerFace * 2 + size.points * kBytesPerValue * attributes;
  if (bytes > bytes_left) {
    over_limit("{}: {} triangles, {} bytes are left of the limit", mesh.label, size.faces, bytes_left);
  }
  bytes_left -= bytes;
}

CompressedMesh find_data(const json& extension, const tinygltf::Model& model, const std::string& label) {
  const tinygltf::BufferView& view = model.bufferViews.at(extension.at("bufferView").get<std::size_t>());
  const std::vector<unsigned char>& buffer = model.buffers.at(static_cast<std::size_t>(view.buffer)).data;
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    bad_input("{}: its bufferView lies beyond its buffer of {} bytes", label, buffer.size());
  }
  return {label, reinterpret_cast<const char*>(buffer.data() + view.byteOffset), view.byteLength};
}

std::unique_ptr<draco::Mesh> decoded(const CompressedMesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(mesh.data, mesh.bytes);
  draco::Decoder decoder;
  auto result = decoder.DecodeMeshFromBuffer(&buffer);
  if (!result.ok()) damaged(mesh, one_line(result.status().error_msg_string()));
  return std::move(result).value();
}

// Values of one attribute, in the order of the points, as the accessor says they are.
template <class T>
std::vector<unsigned char> values_of(const draco::PointAttribute& attribute, std::uint32_t points,
                                     std::int8_t components, const std::string& label) {
  const std::size_t element_bytes = static_cast<std::size_t>(components) * sizeof(T);
  std::vector<unsigned char> out(points * element_bytes);
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < points) {
    bad_input("{}: the Draco data has {} values for {} vertices", label, attribute.indices_map_size(), points);
  }
  std::array<T, 4> value{};
  for (std::uint32_t p = 0; p < points; ++p) {
    const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(p));
    if (index.value() >= attribute.size() || !attribute.ConvertValue<T>(index, components, value.data())) {
      bad_input("{}: the Draco data has no value for vertex {}", label, p);
    }
    std::memcpy(out.data() + p * element_bytes, value.data(), element_bytes);
  }
  return out;
}

std::vector<unsigned char> values_of(const draco::PointAttribute& attribute, std::uint32_t points,
                                     const tinygltf::Accessor& accessor, const std::string& label) {
  const auto components =
      static_cast<std::int8_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
  if (components < 1 || components > 4 || int{attribute.num_components()} != int{components}) {
    bad_input("{}: the Draco data has {} components, the accessor is of another type", label,
              attribute.num_components());
  }
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return values_of<std::int8_t>(attribute, points, components, label);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return values_of<std::uint8_t>(attribute, points, components, label);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return values_of<std::int16_t>(attribute, points, components, label);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return values_of<std::uint16_t>(attribute, points, components, label);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return values_of<float>(attribute, points, components, label);
    default:
      bad_input("{}: componentType {} is not one of an attribute's", label, accessor.componentType);
  }
}

// Adds an accessor over bytes of its own, like another but for where its values are.
int add_accessor(tinygltf::Model& model, tinygltf::Accessor accessor, std::vector<unsigned char> bytes,
                 std::size_t count) {
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model.buffers.size());
  view.byteLength = bytes.size();
  model.buffers.emplace_back();
  model.buffers.back().data = std::move(bytes);
  accessor.bufferView = static_cast<int>(model.bufferViews.size());
  accessor.byteOffset = 0;
  accessor.count = count;
  accessor.sparse.isSparse = false;
  model.bufferViews.push_back(view);
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

int add_indices(const draco::Mesh& mesh, tinygltf::Model& model) {
  std::vector<unsigned char> bytes(mesh.num_faces() * kBytesPerFace);
  for (std::uint32_t f = 0; f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
    const std::uint32_t corners[] = {face[0].value(), face[1].value(), face[2].value()};
    std::memcpy(bytes.data() + f * kBytesPerFace, corners, kBytesPerFace);
  }
  tinygltf::Accessor accessor;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  return add_accessor(model, accessor, std::move(bytes), std::size_t{3} * mesh.num_faces());
}

void decode_primitive(const json& extension, const std::string& label, tinygltf::Model& model,
                      tinygltf::Primitive& primitive, std::uint64_t& bytes_left) {
  const json& attributes = extension.at("attributes");
  const CompressedMesh data = find_data(extension, model, label);
  check_size(data, attributes.size() + 1, bytes_left);
  const std::unique_ptr<draco::Mesh> mesh = decoded(data);
  for (const auto& [name, id] : attributes.items()) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) continue;
    const draco::PointAttribute* attribute = mesh->GetAttributeByUniqueId(id.get<std::uint32_t>());
    const std::string where = fmt::format("{}.attributes.{}", label, printable(name, 64));
    if (!attribute) bad_input("{}: the Draco data has no attribute {}", where, id.get<std::uint32_t>());
    const tinygltf::Accessor accessor = model.accessors.at(static_cast<std::size_t>(found->second));
    found->second =
        add_accessor(model, accessor, values_of(*attribute, mesh->num_points(), accessor, where), mesh->num_points());
  }
  primitive.indices = add_indices(*mesh, model);
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

}  // namespace

void decode_draco(const json& root, tinygltf::Model& model, std::uint64_t& bytes_left) {
  if (!root.contains("meshes")) return;
  std::size_t m = 0;
  for (const json& mesh : root.at("meshes")) {
    for (std::size_t p = 0; p < model.meshes.at(m).primitives.size(); ++p) {
      const json* extension = extension_of(mesh.at("primitives").at(p), kDraco);
      if (!extension) continue;
      const std::string label = fmt::format("meshes[{}].primitives[{}].extensions.{}", m, p, kDraco);
      decode_primitive(*extension, label, model, model.meshes[m].primitives[p], bytes_left);
    }
    ++m;
  }
}

}  // namespace umbrix::io::detail
