// SPDX-License-Identifier: Apache-2.0
// Textures, which colour surfaces that need no light.
#include "io/picture_bytes.h"
#include "stage.h"

namespace umbrix::features {
namespace {

/// Red and green above blue and white.
const std::vector<std::uint8_t> kFourColors = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};

json textured(json info, double factor = 1) {
  json out = unlit(factor, factor, factor);
  out["pbrMetallicRoughness"]["baseColorTexture"] = std::move(info);
  return out;
}

/// A PNG in a buffer view, and a JPEG in a data URI, times a factor.
Stage box_textured() {
  Stage s(2, 1);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const int png = s.texture(1, 1, 3, {255, 188, 0});
  s.json["images"].push_back({{"uri", std::string("data:image/jpeg;base64,") + io::testing::kGreyJpeg}});
  s.json["textures"].push_back({{"source", 1}});
  s.place(s.square(s.material(textured({{"index", png}})), attributes), 0);
  s.place(s.square(s.material(textured({{"index", 1}}, 0.5)), attributes), 1);
  return s;
}

/// Coordinates as floats, bytes and shorts.
Stage coordinates() {
  Stage s(3, 1);
  const int material = s.material(textured({{"index", s.texture(2, 2, 3, kFourColors)}}));
  const std::uint16_t one = 65535;
  // Bytes are filled up to four for each vertex.
  const std::vector<std::uint8_t> bytes = {0, 255, 0, 0, 255, 255, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0};
  const int of_bytes = s.accessor(io::testing::bytes_of(bytes), 5121, 4, "VEC2", 4);
  s.json["accessors"][static_cast<std::size_t>(of_bytes)]["normalized"] = true;
  const int of_shorts = s.normalized(std::vector<std::uint16_t>{0, one, one, one, one, 0, 0, 0}, 5123, 2);
  s.place(s.square(material, {{"TEXCOORD_0", s.texcoords()}}), 0);
  s.place(s.square(material, {{"TEXCOORD_0", of_bytes}}), 1);
  s.place(s.square(material, {{"TEXCOORD_0", of_shorts}}), 2);
  return s;
}

/// Coordinates from -1 to 2 over red and green texels: repeated, clamped and mirrored, along u and along v.
Stage settings() {
  Stage s(3, 2);
  const json along_u = {{"TEXCOORD_0", s.floats({-1, 1, 2, 1, 2, 0, -1, 0}, 2)}};
  const json along_v = {{"TEXCOORD_0", s.floats({0, 2, 1, 2, 1, -1, 0, -1}, 2)}};
  const std::vector<std::uint8_t> red_green = {255, 0, 0, 0, 255, 0};
  int x = 0;
  for (const int wrap : {10497, 33071, 33648}) {
    const int wide = s.texture(2, 1, 3, red_green, {{"magFilter", 9728}, {"wrapS", wrap}});
    const int high = s.texture(1, 2, 3, red_green, {{"magFilter", 9728}, {"wrapT", wrap}});
    s.place(s.square(s.material(textured({{"index", wide}})), along_u), x, 1);
    s.place(s.square(s.material(textured({{"index", high}})), along_v), x++);
  }
  return s;
}

/// Black and white texels: to the nearest, linear, and linear because the file says nothing.
Stage interpolation() {
  Stage s(3, 1);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  int x = 0;
  for (const json& filter : {json{{"magFilter", 9728}}, json{{"magFilter", 9729}}, json::object()}) {
    json sampler = filter;
    sampler["wrapS"] = sampler["wrapT"] = 33071;
    const int texture = s.texture(2, 1, 3, {0, 0, 0, 255, 255, 255}, sampler);
    s.place(s.square(s.material(textured({{"index", texture}})), attributes), x++);
  }
  return s;
}

/// Pictures of one to four channels.
Stage encodings() {
  Stage s(4, 1);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const std::vector<std::uint8_t> pixels[] = {{188}, {188, 255}, {255, 188, 0}, {188, 0, 255, 255}};
  for (std::uint32_t channels = 1; channels <= 4; ++channels) {
    const int texture = s.texture(1, 1, channels, pixels[channels - 1]);
    s.place(s.square(s.material(textured({{"index", texture}})), attributes), channels - 1);
  }
  return s;
}

/// An offset; a scale; a turn with both, the example of the extension's text; another set of coordinates.
Stage transforms() {
  Stage s(4, 1);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const int four = s.texture(2, 2, 3, kFourColors);
  const auto info = [](int texture, const json& transform) {
    return json{{"index", texture}, {"extensions", {{"KHR_texture_transform", transform}}}};
  };
  s.place(s.square(s.material(textured(info(four, {{"offset", {0.5, 0}}}))), attributes), 0);
  s.place(s.square(s.material(textured(info(four, {{"scale", {2, 1}}}))), attributes), 1);
  // The four colours are the lower left quarter of this picture, the rest is black.
  std::vector<std::uint8_t> quarter(4 * 4 * 3, 0);
  for (std::size_t row = 0; row < 2; ++row) {
    std::copy_n(kFourColors.begin() + static_cast<std::ptrdiff_t>(6 * row), 6,
                quarter.begin() + static_cast<std::ptrdiff_t>(12 * (row + 2)));
  }
  const json turn = {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
  s.place(s.square(s.material(textured(info(s.texture(4, 4, 3, quarter), turn))), attributes), 2);
  const json both_sets = {{"TEXCOORD_0", s.floats({0, 0, 0, 0, 0, 0, 0, 0}, 2)}, {"TEXCOORD_1", s.texcoords()}};
  s.place(s.square(s.material(textured(info(four, {{"texCoord", 1}}))), both_sets), 3);
  return s;
}

/// Base colour by the second set, emission by the first.
Stage multi_uv() {
  Stage s(2, 1);
  const int texture = s.texture(2, 1, 3, {255, 0, 0, 0, 0, 255});
  const json attributes = {{"TEXCOORD_0", s.floats({0.25f, 0, 0.25f, 0, 0.25f, 0, 0.25f, 0}, 2)},
                           {"TEXCOORD_1", s.floats({0.75f, 0, 0.75f, 0, 0.75f, 0, 0.75f, 0}, 2)}};
  json shining = glow(1, 1, 1);
  shining["emissiveTexture"] = {{"index", texture}};
  s.place(s.square(s.material(textured({{"index", texture}, {"texCoord", 1}})), attributes), 0);
  s.place(s.square(s.material(shining), attributes), 1);
  return s;
}

}  // namespace

void add_textures(Files& files) {
  files["BoxTextured.gltf"] = box_textured().readable();
  files["TextureCoordinateTest.gltf"] = coordinates().readable();
  files["TextureSettingsTest.gltf"] = settings().readable();
  files["TextureLinearInterpolationTest.gltf"] = interpolation().readable();
  files["TextureEncodingTest.gltf"] = encodings().readable();
  files["TextureTransformTest.gltf"] = transforms().readable();
  files["MultiUVTest.gltf"] = multi_uv().readable();
}

}  // namespace umbrix::features
