// SPDX-License-Identifier: Apache-2.0
// Materials without and with textures, under a light that shines along the view.
#include "stage.h"

namespace umbrix::features {
namespace {

json metal_rough(double base, double metallic, double roughness) {
  return {{"pbrMetallicRoughness",
           {{"baseColorFactor", {base, base, base, 1}}, {"metallicFactor", metallic}, {"roughnessFactor", roughness}}}};
}

Stage metal_rough_no_textures() {
  Stage s(4, 1);
  s.show(metal_rough(0.5, 0, 1), 0);
  s.show(metal_rough(0.5, 0, 0.5), 1);
  s.show(metal_rough(0.5, 1, 0.5), 2);
  s.show(metal_rough(0.5, 0.5, 0.5), 3);
  s.light_straight_on();
  return s;
}

/// A texel that is a rather rough dielectric, and one of metal; then the same with factors of a half.
Stage metal_rough_textures() {
  Stage s(2, 1);
  const int texture = s.texture(2, 1, 3, {255, 180, 0, 255, 128, 255});
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  for (const double factor : {1.0, 0.5}) {
    json material = metal_rough(0.5, factor, factor);
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", texture}};
    s.place(s.square(s.material(material), attributes), factor == 1 ? 0 : 1);
  }
  s.light_straight_on();
  return s;
}

/// Texels that point straight up, right, left, to the top and to the bottom; the same with a scale of a half.
const std::vector<std::uint8_t> kNormals = {128, 128, 255, 204, 128, 230, 51, 128, 230, 128, 204, 230, 128, 51, 230};

json with_normals(int texture, double scale = 1) {
  json out = lambert();
  out["normalTexture"] = {{"index", texture}};
  if (scale != 1) out["normalTexture"]["scale"] = scale;
  return out;
}

Stage normal_tangents() {
  Stage s(5, 2);
  const int texture = s.texture(5, 1, 3, kNormals);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const auto wide = [&](const json& material, double y) {
    const int node = s.place(s.square(s.material(material), attributes), 0, y);
    s.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {5, 1, 1};
  };
  wide(with_normals(texture), 1);
  wide(with_normals(texture, 0.5), 0);
  s.slanted_light();
  return s;
}

/// Tangents of the file: along x, whose bitangent points down, as for mirrored texture coordinates; and along y.
Stage normal_tangents_mirrored() {
  Stage s(5, 2);
  const int material = s.material(with_normals(s.texture(5, 1, 3, kNormals)));
  const int texcoords = s.texcoords();
  const auto wide = [&](float x, float y, float handedness, double at) {
    std::vector<float> tangents;
    for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), {x, y, 0, handedness});
    std::vector<float> normals;
    for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {0, 0, 1});
    const int node = s.place(
        s.square(material,
                 {{"TEXCOORD_0", texcoords}, {"NORMAL", s.floats(normals, 3)}, {"TANGENT", s.floats(tangents, 4)}}),
        0, at);
    s.json["nodes"][static_cast<std::size_t>(node)]["scale"] = {5, 1, 1};
  };
  wide(1, 0, -1, 1);
  wide(0, 1, 1, 0);
  s.slanted_light();
  return s;
}

/// White surfaces whose mirroring is off, half, coloured, and from textures: of the strength (in alpha), of the colour.
Stage specular() {
  Stage s(5, 1);
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const int strength = s.texture(1, 1, 4, {255, 255, 255, 128}), color = s.texture(1, 1, 3, {188, 255, 0});
  const json kinds[] = {{{"specularFactor", 0}},
                        {{"specularFactor", 0.5}},
                        {{"specularColorFactor", {2, 1, 0}}},
                        {{"specularTexture", {{"index", strength}}}},
                        {{"specularColorTexture", {{"index", color}}}}};
  int x = 0;
  for (const json& kind : kinds) {
    json material = metal_rough(1, 0, 1);
    material["extensions"]["KHR_materials_specular"] = kind;
    s.place(s.square(s.material(material), attributes), x++);
  }
  s.light_straight_on();
  return s;
}

/// Black surfaces, which mirror as their index of refraction says.
Stage indices_of_refraction() {
  Stage s(4, 1);
  int x = 0;
  for (const double ior : {1.0, 1.5, 2.0, 0.0}) {
    json material = metal_rough(0, 0, 1);
    material["extensions"]["KHR_materials_ior"]["ior"] = ior;
    s.show(material, x++);
  }
  s.light_straight_on();
  return s;
}

/// In a light that must not matter; the second would be a mirror without the extension, the third turns its back.
Stage unlit_test() {
  Stage s(3, 1);
  json metal = unlit(0.25, 0.5, 1);
  metal["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  s.show(unlit(1, 0.5, 0.25), 0);
  s.show(metal, 1);
  const int turned = s.show(unlit(1, 1, 0), 3);
  s.json["nodes"][static_cast<std::size_t>(turned)]["rotation"] = {0, 1, 0, 0};
  s.light_straight_on();
  return s;
}

/// The factor; times a strength; times a texture.
Stage emissive_strength() {
  Stage s(3, 1);
  json strong = glow(1, 0.5, 0.25);
  strong["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 8;
  json textured = strong;
  textured["emissiveTexture"] = {{"index", s.texture(1, 1, 3, {255, 188, 0})}};
  s.show(glow(1, 0.5, 0.25), 0);
  s.show(strong, 1);
  s.place(s.square(s.material(textured), {{"TEXCOORD_0", s.texcoords()}}), 2);
  return s;
}

/// Shining squares: in front; from behind; from behind and double-sided. Last, a white one in light, from behind.
Stage two_sided() {
  Stage s(4, 1);
  json both = glow(1, 1, 1);
  both["doubleSided"] = true;
  const auto turned = [&](const json& material, double x) {
    s.json["nodes"][static_cast<std::size_t>(s.show(material, x + 1))]["rotation"] = {0, 1, 0, 0};
  };
  s.show(glow(1, 1, 1), 0);
  turned(glow(1, 1, 1), 1);
  turned(both, 2);
  turned(lambert(), 3);
  s.light_straight_on();
  return s;
}

}  // namespace

void add_materials(Files& files) {
  files["MetalRoughSpheresNoTextures.gltf"] = metal_rough_no_textures().readable();
  files["MetalRoughSpheres.gltf"] = metal_rough_textures().readable();
  files["NormalTangentTest.gltf"] = normal_tangents().readable();
  files["NormalTangentMirrorTest.gltf"] = normal_tangents_mirrored().readable();
  files["SpecularTest.gltf"] = specular().readable();
  files["IORTestGrid.gltf"] = indices_of_refraction().readable();
  files["UnlitTest.gltf"] = unlit_test().readable();
  files["EmissiveStrengthTest.gltf"] = emissive_strength().readable();
  files["TwoSidedPlane.gltf"] = two_sided().readable();
}

}  // namespace umbrix::features
