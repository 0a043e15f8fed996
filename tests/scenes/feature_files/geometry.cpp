// SPDX-License-Identifier: Apache-2.0
// Meshes: indices, kinds of primitives, and how attributes are stored.
#include "stage.h"

namespace umbrix::features {
namespace {

using io::testing::bytes_of;

Stage without_indices() {
  Stage s(1, 1);
  json triangle = {{"attributes", {{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3)}}},
                   {"material", s.material(unlit(1, 1, 1))}};
  s.place(triangle, 0);
  return s;
}

/// The same square by indices of 8, 16 and 32 bits, into vertices in no order.
Stage index_types() {
  Stage s(3, 1);
  const json attributes = {{"POSITION", s.floats({1, 1, 0, 0, 0, 0, 0, 1, 0, 1, 0, 0}, 3)}};
  const int indices[] = {s.integers(std::vector<std::uint8_t>{1, 3, 0, 1, 0, 2}, 5121, 1),
                         s.integers(std::vector<std::uint16_t>{1, 3, 0, 1, 0, 2}, 5123, 1),
                         s.integers(std::vector<std::uint32_t>{1, 3, 0, 1, 0, 2}, 5125, 1)};
  for (int i = 0; i < 3; ++i) {
    s.place(
        {{"attributes", attributes}, {"indices", indices[i]}, {"material", s.material(unlit(i == 0, i == 1, i == 2))}},
        i);
  }
  return s;
}

/// Squares that shine on their front alone, as triangles, strip and fan, then points and lines, which are no surface.
Stage primitive_modes() {
  Stage s(4, 1);
  const int material = s.material(glow(1, 1, 1));
  const int around = s.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 3);
  const int zigzag = s.floats({1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0}, 3);
  s.place({{"attributes", {{"POSITION", zigzag}}}, {"mode", 5}, {"material", material}}, 0);
  s.place({{"attributes", {{"POSITION", around}}}, {"mode", 6}, {"material", material}}, 1);
  s.place(s.square(material), 2);
  s.json["meshes"].back()["primitives"][0]["mode"] = 4;
  for (const int mode : {0, 1, 2, 3}) {
    s.place({{"attributes", {{"POSITION", around}}}, {"mode", mode}, {"material", material}}, 3);
  }
  return s;
}

/// Positions, normals and colours of a vertex after each other, in one view with a stride.
Stage interleaved() {
  Stage s(1, 1);
  std::vector<float> vertices;
  for (const auto& [x, y] : {std::pair(0.f, 0.f), {1.f, 0.f}, {1.f, 1.f}, {0.f, 1.f}}) {
    for (const float value : {x, y, 0.f, 0.6f, 0.f, 0.8f, 0.5f, 1.f, 0.25f}) vertices.push_back(value);
  }
  const int view = s.view(bytes_of(vertices), 36);
  json attributes;
  int offset = 0;
  for (const char* name : {"POSITION", "NORMAL", "COLOR_0"}) {
    s.json["accessors"].push_back(
        {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
    attributes[name] = s.json["accessors"].size() - 1;
    offset += 12;
  }
  s.bound(attributes["POSITION"], {0, 0, 0}, {1, 1, 0});
  s.place(s.square(s.material(lambert()), attributes), 0);
  s.light_straight_on();
  return s;
}

/// Vertices that sparse values lift: over an array, and over zeros.
Stage sparse() {
  Stage s(2, 1);
  const auto lift = [&](int accessor, const std::vector<std::uint16_t>& which, const std::vector<float>& to) {
    const int indices = s.view(bytes_of(which)), values = s.view(bytes_of(to));
    s.json["accessors"][static_cast<std::size_t>(accessor)]["sparse"] = {
        {"count", which.size()},
        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
        {"values", {{"bufferView", values}}}};
    s.bound(accessor, {0, 0, 0}, {1, 1, 0});
  };
  const int material = s.material(unlit(1, 1, 1));
  const int flat = s.floats({0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}, 3);
  lift(flat, {2, 3}, {1, 1, 0, 0, 1, 0});
  s.place(s.square(material, {{"POSITION", flat}}), 0);
  s.json["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  const int zeros = static_cast<int>(s.json["accessors"].size()) - 1;
  lift(zeros, {1, 2, 3}, {1, 0, 0, 1, 1, 0, 0, 1, 0});
  s.place(s.square(material, {{"POSITION", zeros}}), 1);
  return s;
}

/// Positions in short, normalized unsigned short and normalized byte; a normal of bytes; texture coordinates from 0 to
/// 4096 in shorts, which a transform scales back.
Stage quantized() {
  Stage s(4, 1);
  s.use("KHR_mesh_quantization", true);
  const int material = s.material(lambert());
  // Four values a vertex, of which the last fills up to a multiple of four bytes.
  const auto vertices = [&](const std::string& bytes, int type, int stride, int lower, int upper) {
    const int number = s.accessor(bytes, type, 4, "VEC3", stride);
    s.json["accessors"][static_cast<std::size_t>(number)]["normalized"] = lower == 0;
    s.bound(number, {lower, lower, 0}, {upper, upper, 0});
    return number;
  };
  const std::vector<std::int16_t> whole = {-50, -50, 0, 0, 50, -50, 0, 0, 50, 50, 0, 0, -50, 50, 0, 0};
  const int node = s.place(s.square(material, {{"POSITION", vertices(bytes_of(whole), 5122, 8, -50, 50)}}), 0.5, 0.5);
  s.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {0.01, 0.01, 0.01};
  const std::uint16_t one = 65535;
  const std::vector<std::uint16_t> unit = {0, 0, 0, 0, one, 0, 0, 0, one, one, 0, 0, 0, one, 0, 0};
  s.place(s.square(material, {{"POSITION", vertices(bytes_of(unit), 5123, 8, 0, one)}}), 1);
  const std::vector<std::int8_t> bytes = {0, 0, 0, 0, 127, 0, 0, 0, 127, 127, 0, 0, 0, 127, 0, 0};
  std::vector<std::int8_t> normals;
  for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {76, 0, 102, 0});
  const int of_normals = s.accessor(bytes_of(normals), 5120, 4, "VEC3", 4);
  s.json["accessors"][static_cast<std::size_t>(of_normals)]["normalized"] = true;
  s.place(s.square(material, {{"POSITION", vertices(bytes_of(bytes), 5120, 4, 0, 127)}, {"NORMAL", of_normals}}), 2);
  json textured = unlit(1, 1, 1);
  textured["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", s.texture(2, 1, 3, {255, 0, 0, 0, 255, 0})},
      {"extensions", {{"KHR_texture_transform", {{"scale", {1 / 4096., 1 / 4096.}}}}}}};
  const int texcoords = s.integers(std::vector<std::uint16_t>{0, 4096, 4096, 4096, 4096, 0, 0, 0}, 5123, 2);
  s.place(s.square(s.material(textured), {{"TEXCOORD_0", texcoords}}), 3);
  s.light_straight_on();
  return s;
}

/// Colours of floats, of bytes with alpha, of shorts times a factor; and from black to white.
Stage vertex_colors() {
  Stage s(4, 1);
  const int white = s.material(unlit(1, 1, 1));
  const auto four_times = [](const auto& values) {
    auto out = values;
    for (int i = 0; i < 3; ++i) out.insert(out.end(), values.begin(), values.end());
    return out;
  };
  const int floats = s.floats(four_times(std::vector<float>{0.5f, 0.25f, 1}), 3);
  const int bytes = s.normalized(four_times(std::vector<std::uint8_t>{188, 0, 255, 255}), 5121, 4);
  const int shorts = s.normalized(four_times(std::vector<std::uint16_t>{65535, 13107, 0, 65535}), 5123, 4);
  const int ramp = s.floats({0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0}, 3);
  s.place(s.square(white, {{"COLOR_0", floats}}), 0);
  s.place(s.square(white, {{"COLOR_0", bytes}}), 1);
  s.place(s.square(s.material(unlit(0.5, 0.5, 0.5)), {{"COLOR_0", shorts}}), 2);
  s.place(s.square(white, {{"COLOR_0", ramp}}), 3);
  return s;
}

}  // namespace

void add_geometry(Files& files) {
  files["TriangleWithoutIndices.gltf"] = without_indices().readable();
  files["IndexTypes.gltf"] = index_types().readable();
  files["MeshPrimitiveModes.gltf"] = primitive_modes().readable();
  files["BoxInterleaved.gltf"] = interleaved().readable();
  files["SimpleSparseAccessor.gltf"] = sparse().readable();
  files["MeshQuantization.gltf"] = quantized().readable();
  files["VertexColorTest.gltf"] = vertex_colors().readable();
}

}  // namespace umbrix::features
