// SPDX-License-Identifier: Apache-2.0
// What textures, vertex colours and material extensions make of a surface, where a ray meets it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "textured_scenes.h"
#include "traced.h"

namespace umbrix::render {
namespace {

/// What is seen at (x, y) from above, or from below.
Surface seen(io::SceneFile scene, float x, float y, bool from_below = false,
             const io::Transform& to_world = io::kIdentity) {
  scene.instances.clear();
  place(scene, 0, to_world);
  World world;
  EXPECT_TRUE(build_world(scene, {}, world).ok());
  const float side = from_below ? -1 : 1;
  const Ray ray = {{x, y, side}, 0, {0, 0, -side}, std::numeric_limits<float>::infinity()};
  Hit hit;
  EXPECT_TRUE(world.scene.closest(ray, hit));
  return surface_at(world, ray, hit);
}

void expect_near(const Vec3& actual, const Vec3& expected, double error = 1e-5) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], error) << "component " << c;
}

const std::vector<std::uint8_t> kRedOverGreenBlue = {255, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255};

TEST(Materials, ImagesAreUpright) {
  io::SceneFile scene = card_scene();
  scene.materials[0].base_color_texture.texture = add_texture(scene, 2, 2, kRedOverGreenBlue);
  expect_near(seen(scene, 0.25f, 0.75f).bsdf.base_color, {1, 0, 0});
  expect_near(seen(scene, 0.75f, 0.75f).bsdf.base_color, {1, 0, 0});
  expect_near(seen(scene, 0.25f, 0.25f).bsdf.base_color, {0, 1, 0});
  expect_near(seen(scene, 0.75f, 0.25f).bsdf.base_color, {0, 0, 1});
  expect_near(seen(scene, 0.5f, 0.25f).bsdf.base_color, {0, 0.5, 0.5});
}

TEST(Materials, ColoursAreSrgbAndFactorsMultiply) {
  io::SceneFile scene = card_scene();
  scene.materials[0].base_color_texture.texture = add_texture(scene, 1, 1, {188, 0, 10});
  const double linear = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(linear, 0.5, 0.003);
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.base_color, {linear, 0, 10 / 255.0 / 12.92});
  scene.materials[0].base_color = {0.5f, 1, 1};
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.base_color, {linear / 2, 0, 10 / 255.0 / 12.92});
  scene.images[0].channels = 1;
  scene.images[0].pixels = {188};
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.base_color, {linear / 2, linear, linear});
}

// Between black and white the light is halved, not the code value.
TEST(Materials, TexelsAreBlendedAsLight) {
  io::SceneFile scene = card_scene();
  scene.materials[0].base_color_texture.texture = add_texture(scene, 2, 1, {0, 255});
  EXPECT_NEAR(seen(scene, 0.5f, 0.5f).bsdf.base_color.r, 0.5, 1e-6);
}

TEST(Materials, MetallicAndRoughnessAreLinear) {
  io::SceneFile scene = card_scene();
  scene.materials[0].metallic = 0.5f;
  scene.materials[0].roughness = 0.5f;
  scene.materials[0].metallic_roughness_texture.texture = add_texture(scene, 1, 1, {255, 51, 102});
  const Surface surface = seen(scene, 0.5f, 0.5f);
  EXPECT_NEAR(surface.bsdf.roughness, 0.5 * 51 / 255, 1e-9);
  EXPECT_NEAR(surface.bsdf.metallic, 0.5 * 102 / 255, 1e-9);
}

TEST(Materials, EmissionIsOnTheFront) {
  io::SceneFile scene = card_scene();
  scene.materials[0].emission = {2, 4, 6};
  scene.materials[0].emissive_texture.texture = add_texture(scene, 1, 1, {255, 188, 0});
  expect_near(seen(scene, 0.5f, 0.5f).emission, {2, 4 * std::pow((188 / 255.0 + 0.055) / 1.055, 2.4), 0});
  expect_near(seen(scene, 0.5f, 0.5f, true).emission, {0, 0, 0});
  scene.materials[0].double_sided = true;
  EXPECT_NEAR(seen(scene, 0.5f, 0.5f, true).emission.r, 2, 1e-6);
}

TEST(Materials, EachTextureHasItsCoordinates) {
  io::SceneFile scene = card_scene();
  scene.meshes[0].texcoord_sets[1] = {{1, 0}, {0, 0}, {0, 1}, {1, 1}};  // turned by half
  io::TextureUse& use = scene.materials[0].base_color_texture;
  use.texture = add_texture(scene, 2, 2, kRedOverGreenBlue);
  use.texcoord = 1;
  expect_near(seen(scene, 0.25f, 0.75f).bsdf.base_color, {0, 0, 1});
  expect_near(seen(scene, 0.25f, 0.25f).bsdf.base_color, {1, 0, 0});
  use.texcoord = 0;
  use.transform = {{{1, 0, 0.5}, {0, 1, 0}}};  // to the right by half
  expect_near(seen(scene, 0.25f, 0.25f).bsdf.base_color, {0, 0, 1});
}

TEST(Materials, WithoutCoordinatesOrImageTheFactorIsLeft) {
  io::SceneFile scene = card_scene();
  scene.materials[0].base_color = {0.25f, 0.5f, 1};
  scene.materials[0].base_color_texture.texture = add_texture(scene, 1, 1, {9, 9, 9});
  scene.materials[0].normal_texture.texture = 0;
  scene.meshes[0].texcoord_sets[0].clear();
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.base_color, {0.25, 0.5, 1});
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0, 0, 1});
  scene = card_scene();
  scene.materials[0].base_color_texture.texture = add_texture(scene, 1, 1, {9, 9, 9});
  scene.images[0].pixels.clear();
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.base_color, {1, 1, 1});
}

TEST(Materials, VertexColoursMultiply) {
  io::SceneFile scene = card_scene();
  scene.materials[0].base_color = {0.5f, 0.5f, 0.5f};
  scene.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 1}};
  expect_near(seen(scene, 0.25f, 0.5f).bsdf.base_color, {0.375, 0.125, 0});
}

TEST(Materials, UnlitLooksLikeItsColourOnBothSidesAndReflectsNothing) {
  io::SceneFile scene = card_scene();
  scene.materials[0].unlit = true;
  scene.materials[0].base_color = {0.25f, 0.5f, 1};
  for (const bool from_below : {false, true}) {
    const Surface surface = seen(scene, 0.5f, 0.5f, from_below);
    expect_near(surface.emission, {0.25, 0.5, 1});
    expect_near(evaluate_bsdf(surface.bsdf, surface.shading_normal, surface.shading_normal,
                              glm::normalize(surface.shading_normal + Vec3(0.9, 0, 0))),
                {0, 0, 0}, 0);
  }
}

TEST(Materials, IorAndSpecularSetTheReflectance) {
  io::SceneFile scene = card_scene();
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.dielectric_f0, Vec3(0.04));
  scene.materials[0].ior = 2;
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.dielectric_f0, Vec3(1 / 9.0));
  scene.materials[0].specular = 0.5f;
  scene.materials[0].specular_color = {0, 1, 100};
  expect_near(seen(scene, 0.5f, 0.5f).bsdf.dielectric_f0, {0, 1 / 18.0, 0.5});
  EXPECT_EQ(seen(scene, 0.5f, 0.5f).bsdf.dielectric_f90, 0.5);
  scene.materials[0].specular_texture.texture = add_texture(scene, 1, 1, {0, 0, 0, 51});
  EXPECT_NEAR(seen(scene, 0.5f, 0.5f).bsdf.dielectric_f90, 0.1, 1e-9);
}

/// A texel that leans: x and y as they are, z so that the length is about one.
std::vector<std::uint8_t> normal_texel(double x, double y) {
  const double z = std::sqrt(1 - x * x - y * y);
  std::vector<std::uint8_t> out;
  for (const double c : {x, y, z}) out.push_back(static_cast<std::uint8_t>(std::lround((c + 1) / 2 * 255)));
  return out;
}

TEST(Materials, NormalTexturesLeanToTheImagesRightAndTop) {
  constexpr double kStep = 0.01;  // of 8 bits
  io::SceneFile scene = card_scene();
  io::Material& material = scene.materials[0];
  material.normal_texture.texture = add_texture(scene, 1, 1, normal_texel(0.6, 0));
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0.6, 0, 0.8}, kStep);
  scene.images[0].pixels = normal_texel(0, 0.6);
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0, 0.6, 0.8}, kStep);
  expect_near(seen(scene, 0.5f, 0.5f, true).shading_normal, {0, -0.6, -0.8}, kStep);
  expect_near(seen(scene, 0.5f, 0.5f).geometric_normal, {0, 0, 1});
  material.normal_scale = 0.5f;
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, glm::normalize(Vec3(0, 0.3, 0.8)), kStep);
}

TEST(Materials, NormalTexturesFollowTurnedAndMirroredCoordinates) {
  constexpr double kStep = 0.01;
  io::SceneFile scene = card_scene();
  scene.materials[0].normal_texture.texture = add_texture(scene, 1, 1, normal_texel(0.6, 0));
  // The image turned by a quarter: its right is at +y. Mirrored: its right is at -x, its top stays.
  scene.meshes[0].texcoord_sets[0] = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0, 0.6, 0.8}, kStep);
  scene.meshes[0].texcoord_sets[0] = {{1, 1}, {0, 1}, {0, 0}, {1, 0}};
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {-0.6, 0, 0.8}, kStep);
  scene.images[0].pixels = normal_texel(0, 0.6);
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0, 0.6, 0.8}, kStep);
}

TEST(Materials, TangentsOfTheFileAreTaken) {
  constexpr double kStep = 0.01;
  io::SceneFile scene = card_scene();
  scene.meshes[0].normals.assign(4, {0, 0, 1});
  scene.meshes[0].tangents.assign(4, {0, 1, 0, 1});
  scene.materials[0].normal_texture.texture = add_texture(scene, 1, 1, normal_texel(0.6, 0));
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0, 0.6, 0.8}, kStep);
  scene.images[0].pixels = normal_texel(0, 0.6);
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {-0.6, 0, 0.8}, kStep);
  scene.meshes[0].tangents.assign(4, {0, 1, 0, -1});
  expect_near(seen(scene, 0.5f, 0.5f).shading_normal, {0.6, 0, 0.8}, kStep);
}

// A mirrored instance is the mirror image, lean and all.
TEST(Materials, MirroredInstancesMirrorTheirNormalTextures) {
  constexpr double kStep = 0.01;
  const io::Transform mirror = {{{-1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
  io::SceneFile scene = card_scene();
  scene.materials[0].normal_texture.texture = add_texture(scene, 1, 1, normal_texel(0.48, 0.36));
  expect_near(seen(scene, 0.5f, 0.5f, false, mirror).shading_normal, {-0.48, 0.36, 0.8}, kStep);
  scene.meshes[0].normals.assign(4, {0, 0, 1});
  scene.meshes[0].tangents.assign(4, {1, 0, 0, 1});
  expect_near(seen(scene, 0.5f, 0.5f, false, mirror).shading_normal, {-0.48, 0.36, 0.8}, kStep);
}

}  // namespace
}  // namespace umbrix::render
