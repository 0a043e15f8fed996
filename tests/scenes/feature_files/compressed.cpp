// SPDX-License-Identifier: Apache-2.0
// Compressed squares, by the libraries' own encoders; what the build has no library for is left out.
#ifdef UMBRIX_READS_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef UMBRIX_READS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

#include "stage.h"

namespace umbrix::features {
namespace {

[[maybe_unused]] constexpr float kSquare[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

#ifdef UMBRIX_READS_MESHOPTIMIZER
/// Vertices and indices in compressed views that stand for those of a second buffer, which holds nothing.
Stage meshopt() {
  Stage s(1, 1);
  s.use("EXT_meshopt_compression", true);
  const auto view = [&](const std::vector<unsigned char>& data, std::size_t count, std::size_t stride,
                        const char* mode) {
    const int number = s.view({data.begin(), data.end()});
    json& out = s.json["bufferViews"][static_cast<std::size_t>(number)];
    json compressed = out;
    compressed.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
    out = {{"buffer", 1}, {"byteOffset", s.placeholder_bytes}, {"byteLength", count * stride}};
    out["extensions"]["EXT_meshopt_compression"] = compressed;
    s.placeholder_bytes += count * stride;
    return number;
  };
  std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, sizeof kSquare[0]));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), kSquare, 4, sizeof kSquare[0]));
  const std::vector<unsigned int> corners = {0, 1, 2, 0, 2, 3};
  std::vector<unsigned char> indices(meshopt_encodeIndexBufferBound(corners.size(), 4));
  indices.resize(meshopt_encodeIndexBuffer(indices.data(), indices.size(), corners.data(), corners.size()));
  s.json["accessors"] = {{{"bufferView", view(vertices, 4, sizeof kSquare[0], "ATTRIBUTES")},
                          {"componentType", 5126},
                          {"count", 4},
                          {"type", "VEC3"}},
                         {{"bufferView", view(indices, corners.size(), 4, "TRIANGLES")},
                          {"componentType", 5125},
                          {"count", corners.size()},
                          {"type", "SCALAR"}}};
  s.bound(0, {0, 0, 0}, {1, 1, 0});
  s.place({{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", s.material(unlit(1, 1, 1))}}, 0);
  return s;
}
#endif

#ifdef UMBRIX_READS_DRACO
/// Accessors without views, and the data of all in one.
Stage draco_box() {
  Stage s(1, 1);
  s.use("KHR_draco_mesh_compression", true);
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(0), kSquare[0], kSquare[1], kSquare[2]);
  builder.SetAttributeValuesForFace(position, draco::FaceIndex(1), kSquare[0], kSquare[2], kSquare[3]);
  draco::EncoderBuffer data;
  draco::Encoder().EncodeMeshToBuffer(*builder.Finalize(), &data);
  s.json["accessors"] = {{{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}},
                         {{"componentType", 5125}, {"count", 6}, {"type", "SCALAR"}}};
  s.bound(0, {0, 0, 0}, {1, 1, 0});
  json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", s.material(unlit(1, 1, 1))}};
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", s.view({data.data(), data.size()})},
                                                           {"attributes", {{"POSITION", position}}}};
  s.place(primitive, 0);
  return s;
}
#endif

}  // namespace

void add_compressed([[maybe_unused]] Files& files) {
#ifdef UMBRIX_READS_MESHOPTIMIZER
  files["MeshoptBox.gltf"] = meshopt().readable();
#endif
#ifdef UMBRIX_READS_DRACO
  files["BoxDraco.gltf"] = draco_box().readable();
#endif
}

}  // namespace umbrix::features
