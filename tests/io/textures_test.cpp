// SPDX-License-Identifier: Apache-2.0
// Textures of materials: found, described, decoded if something samples them, and refused or left out if they are bad.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gltf_text.h"
#include "picture_bytes.h"
#include "refusal.h"

namespace umbrix::io {
namespace {

using nlohmann::json;
using testing::bytes_of;
using testing::Gltf;
using testing::png_bytes;
using testing::TempFolder;

// One triangle with texture coordinates and material 0.
Gltf textured_triangle() {
  Gltf g = testing::one_triangle();
  json& primitive = g.json["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = g.accessor(bytes_of(std::vector<float>{0, 1, 1, 1, 0, 0}), 5126, 3, "VEC2");
  primitive["material"] = 0;
  g.json["materials"] = json::array({json::object()});
  return g;
}

// Adds an image that is held by the file, and a texture of it.
int add_texture(Gltf& g, const json& image) {
  g.json["images"].push_back(image);
  g.json["textures"].push_back({{"source", g.json["images"].size() - 1}});
  return static_cast<int>(g.json["textures"].size()) - 1;
}

int add_texture(Gltf& g, const std::string& bytes, const char* type = "image/png") {
  const int view = g.view(bytes);
  return add_texture(g, json{{"bufferView", view}, {"mimeType", type}});
}

json& base_color(Gltf& g) { return g.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]; }

SceneFile load(const std::string& path) {
  SceneFile scene;
  const Status status = load_scene(path, scene);
  EXPECT_TRUE(status.ok()) << status.message();
  return scene;
}

SceneFile load_text(const std::string& text) {
  const TempFolder folder;
  return load(folder.write("scene.gltf", text));
}

bool mentions(const std::vector<std::string>& lines, const std::string& what) {
  return std::any_of(lines.begin(), lines.end(), [&](const auto& l) { return l.find(what) != std::string::npos; });
}

const std::vector<std::uint8_t> kTwoPixels = {1, 2, 3, 4, 5, 6, 7, 0};

TEST(Textures, ImagesInViewsInUrisAndInFilesAreDecoded) {
  const TempFolder folder;
  const std::string png = png_bytes(2, 1, 4, kTwoPixels);
  Gltf g = textured_triangle();
  base_color(g)["index"] = add_texture(g, png);
  json& material = g.json["materials"][0];
  material["normalTexture"]["index"] = add_texture(g, json{{"uri", "data:image/png;base64," + testing::base64(png)}});
  material["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] =
      add_texture(g, json{{"uri", "a%20folder/a.png"}});
  material["emissiveFactor"] = {1, 1, 1};
  material["emissiveTexture"]["index"] =
      add_texture(g, json{{"uri", std::string("data:image/jpeg;base64,") + testing::kGreyJpeg}});
  std::filesystem::create_directories(folder.path("a folder"));
  folder.write("a folder/a.png", png);

  for (const auto& [name, bytes] : {std::pair("scene.gltf", g.text()), std::pair("scene.glb", g.glb())}) {
    SceneFile scene = load(folder.write(name, bytes));
    ASSERT_EQ(scene.images.size(), 4u);
    for (const TextureImage& image : scene.images) EXPECT_TRUE(image.pixels.empty()) << "nothing samples it yet";
    const Status status = read_textures(scene);
    ASSERT_TRUE(status.ok()) << status.message();
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(scene.images[i].width, 2u);
      EXPECT_EQ(scene.images[i].height, 1u);
      EXPECT_EQ(scene.images[i].channels, 4u);
      EXPECT_EQ(scene.images[i].pixels, kTwoPixels) << "colours are not multiplied by alpha";
    }
    EXPECT_EQ(scene.images[3].channels, 1u);
    EXPECT_EQ(scene.images[3].pixels, std::vector<std::uint8_t>(64, 188));
  }
}

TEST(Textures, OnlyWhatIsSampledIsRead) {
  const std::string png = png_bytes(1, 1, 3, {9, 9, 9});
  Gltf g = textured_triangle();
  base_color(g)["index"] = add_texture(g, png);
  g.json["materials"][0]["occlusionTexture"]["index"] = add_texture(g, png);
  g.json["materials"][0]["emissiveTexture"]["index"] = add_texture(g, png);              // times a factor of 0
  g.json["materials"].push_back({{"normalTexture", {{"index", add_texture(g, png)}}}});  // of no mesh
  SceneFile scene = load_text(g.text());
  EXPECT_TRUE(mentions(scene.ignored, "occlusion textures"));
  ASSERT_TRUE(read_textures(scene).ok());
  EXPECT_FALSE(scene.images[0].pixels.empty());
  for (std::size_t i = 1; i < 4; ++i) EXPECT_TRUE(scene.images[i].pixels.empty()) << i;
}

TEST(Textures, HeadersAreDescribedWithoutDecoding) {
  const TempFolder folder;
  Gltf g = textured_triangle();
  add_texture(g, png_bytes(2, 1, 4, kTwoPixels));
  add_texture(g, json{{"uri", std::string("data:image/jpeg;base64,") + testing::kGreyJpeg}});
  add_texture(g, json{{"uri", "missing.png"}});
  const SceneFile scene = load(folder.write("scene.gltf", g.text()));
  ImageInfo info;
  ASSERT_TRUE(describe_image(scene, scene.images[0], info).ok());
  EXPECT_EQ(info.format, "png");
  EXPECT_EQ(info.width, 2u);
  EXPECT_EQ(info.channels, 4u);
  ASSERT_TRUE(describe_image(scene, scene.images[1], info).ok());
  EXPECT_EQ(info.format, "jpeg");
  EXPECT_EQ(info.height, 8u);
  const Status missing = describe_image(scene, scene.images[2], info);
  EXPECT_EQ(missing.code(), StatusCode::bad_input);
  EXPECT_NE(missing.message().find("missing.png"), std::string::npos) << missing.message();
}

TEST(Textures, UsesSamplersAndTransformsAreConverted) {
  Gltf g = textured_triangle();
  json& attributes = g.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = g.accessor(bytes_of(std::vector<float>{3, 3, 4, 4, 5, 5}), 5126, 3, "VEC2");
  attributes["TANGENT"] = g.accessor(bytes_of(std::vector<float>(12, 1)), 5126, 3, "VEC4");
  attributes["COLOR_0"] = g.accessor(std::string("\xff\x80\x00\x00", 4) + std::string(8, '\xff'), 5121, 3, "VEC4", 4);
  g.json["accessors"].back()["normalized"] = true;
  const int texture = add_texture(g, png_bytes(1, 1, 3, {9, 9, 9}));
  g.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  g.json["textures"][0]["sampler"] = 0;
  g.json["extensionsUsed"] = {"KHR_texture_transform"};
  g.json["extensionsRequired"] = {"KHR_texture_transform"};
  base_color(g) = {
      {"index", texture},
      {"extensions",
       {{"KHR_texture_transform",
         {{"offset", {0.5, 0.25}}, {"rotation", 1.5707963267948966}, {"scale", {2, 3}}, {"texCoord", 1}}}}}};
  g.json["materials"][0]["normalTexture"] = {{"index", texture}, {"scale", 0.5}};
  const SceneFile scene = load_text(g.text());
  EXPECT_TRUE(scene.ignored.empty()) << scene.ignored[0];
  EXPECT_EQ(scene.textures[0].sampler.wrap_u, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].sampler.wrap_v, Wrap::mirror);
  EXPECT_TRUE(scene.textures[0].sampler.nearest);
  const Material& material = scene.materials[0];
  EXPECT_EQ(material.normal_scale, 0.5f);
  const TextureUse& use = material.base_color_texture;
  EXPECT_EQ(use.texcoord, 1u);
  // A quarter turn counter-clockwise on the image, whose v points down: right goes to the top, the top to the left.
  const double expected[2][3] = {{0, 3, 0.5}, {-2, 0, 0.25}};
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(use.transform[row][c], expected[row][c], 1e-12);
  }
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.texcoord_sets[1][2], (std::array<float, 2>{5, 5}));
  EXPECT_EQ(mesh.tangents.size(), 3u);
  EXPECT_EQ(mesh.colors[0], (Float4{1, 128 / 255.0f, 0, 0}));
}

TEST(Textures, MaterialExtensionsAreRead) {
  Gltf g = textured_triangle();
  const int texture = add_texture(g, png_bytes(1, 1, 4, {9, 9, 9, 9}));
  g.json["materials"] = {{{"extensions",
                           {{"KHR_materials_ior", {{"ior", 2.5}}},
                            {"KHR_materials_specular",
                             {{"specularFactor", 0.5},
                              {"specularColorFactor", {1, 2, 0.5}},
                              {"specularTexture", {{"index", texture}, {"texCoord", 1}}},
                              {"specularColorTexture", {{"index", texture}}}}}}}},
                         {{"emissiveFactor", {1, 1, 1}}, {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
  g.json["extensionsUsed"] = {"KHR_materials_ior", "KHR_materials_specular", "KHR_materials_unlit"};
  const SceneFile scene = load_text(g.text());
  EXPECT_TRUE(scene.ignored.empty()) << scene.ignored[0];
  EXPECT_EQ(scene.materials[0].ior, 2.5f);
  EXPECT_EQ(scene.materials[0].specular, 0.5f);
  EXPECT_EQ(scene.materials[0].specular_color, (Float3{1, 2, 0.5f}));
  EXPECT_EQ(scene.materials[0].specular_texture.texcoord, 1u);
  EXPECT_EQ(scene.materials[0].specular_color_texture.texture, 0);
  EXPECT_TRUE(scene.materials[1].unlit);
  EXPECT_EQ(scene.materials[1].emission, (Float3{0, 0, 0})) << "unlit materials are no lights";
}

TEST(Textures, WhatCannotBeUsedIsTold) {
  Gltf g = textured_triangle();
  const int texture = add_texture(g, png_bytes(1, 1, 3, {9, 9, 9}));
  g.json["textures"].push_back({{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
  g.json["extensionsUsed"] = {"KHR_texture_basisu"};
  base_color(g)["index"] = 1;
  g.json["materials"][0]["normalTexture"] = {{"index", texture}, {"texCoord", 2}};
  g.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", texture}, {"texCoord", 1}};
  SceneFile scene = load_text(g.text());
  EXPECT_TRUE(mentions(scene.ignored, "without an image in PNG or JPEG"));
  EXPECT_TRUE(mentions(scene.ignored, "KHR_texture_basisu"));
  EXPECT_TRUE(mentions(scene.ignored, "third or further set"));
  EXPECT_TRUE(mentions(scene.warnings, "without TEXCOORD_1"));
  EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
}

// The texture's own image stands in for one of a format that need not be understood.
TEST(Textures, FallbackImagesAreUsed) {
  Gltf g = textured_triangle();
  base_color(g)["index"] = add_texture(g, png_bytes(1, 1, 3, {9, 8, 7}));
  g.json["images"].push_back({{"uri", "picture.ktx2"}});
  g.json["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 1;
  g.json["extensionsUsed"] = {"KHR_texture_basisu"};
  SceneFile scene = load_text(g.text());
  ASSERT_TRUE(read_textures(scene).ok());
  EXPECT_EQ(scene.images[0].pixels, (std::vector<std::uint8_t>{9, 8, 7}));
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(Textures, BadFilesAreRefused) {
  const auto material = [](Gltf& g) -> json& { return g.json["materials"][0]; };
  const auto with_texture = [](Gltf& g) {
    g = textured_triangle();
    base_color(g)["index"] = add_texture(g, png_bytes(1, 1, 3, {9, 9, 9}));
  };
  const testing::Fault faults[] = {
      {"texture_out_of_range", [&](Gltf& g) { with_texture(g), base_color(g)["index"] = 7; }, "is 7"},
      {"no_index", [&](Gltf& g) { with_texture(g), material(g)["normalTexture"] = json::object(); },
       "'index' is missing"},
      {"not_an_object", [&](Gltf& g) { with_texture(g), material(g)["normalTexture"] = 3; }, "not an object"},
      {"image_out_of_range", [&](Gltf& g) { with_texture(g), g.json["textures"][0]["source"] = 3; }, "is 3"},
      {"sampler_out_of_range", [&](Gltf& g) { with_texture(g), g.json["textures"][0]["sampler"] = 0; }, "samplers"},
      {"view_out_of_range", [&](Gltf& g) { with_texture(g), g.json["images"][0]["bufferView"] = 99; }, "bufferView"},
      {"odd_wrap",
       [&](Gltf& g) {
         with_texture(g), g.json["textures"][0]["sampler"] = 0;
         g.json["samplers"] = {{{"wrapS", 7}}};
       },
       "no way to wrap"},
      {"transform_of_three",
       [&](Gltf& g) {
         with_texture(g);
         base_color(g)["extensions"]["KHR_texture_transform"]["scale"] = {1, 2, 3};
       },
       "must be 2 numbers"},
      {"transform_too_large",
       [&](Gltf& g) {
         with_texture(g);
         base_color(g)["extensions"]["KHR_texture_transform"]["offset"] = {1e300, 0};
       },
       "KHR_texture_transform"},
      {"ior", [&](Gltf& g) { with_texture(g), material(g)["extensions"]["KHR_materials_ior"]["ior"] = 0.5; }, "ior"},
      {"outside",
       [&](Gltf& g) {
         with_texture(g), g.json["images"][0] = {{"uri", "../../etc/passwd"}};
       },
       "outside"},
      {"outside_escaped",
       [&](Gltf& g) {
         with_texture(g), g.json["images"][0] = {{"uri", "%2e%2e/x.png"}};
       },
       "outside"},
      {"absolute",
       [&](Gltf& g) {
         with_texture(g), g.json["images"][0] = {{"uri", "/etc/passwd"}};
       },
       "outside"},
      {"network",
       [&](Gltf& g) {
         with_texture(g), g.json["images"][0] = {{"uri", "http://a/b.png"}};
       },
       "local files"},
      {"required_basisu", [](Gltf& g) { g.json["extensionsRequired"] = {"KHR_texture_basisu"}; }, "KHR_texture_basisu"},
      {"required_webp", [](Gltf& g) { g.json["extensionsRequired"] = {"EXT_texture_webp"}; }, "EXT_texture_webp"},
  };
  for (const testing::Fault& fault : faults) testing::expect_refused(fault);
}

// A missing or damaged picture is no reason not to see the scene.
TEST(Textures, BadImagesAreLeftOutWithAWarning) {
  const std::string png = png_bytes(4, 4, 3, std::vector<std::uint8_t>(48, 7));
  const std::pair<const char*, std::string> images[] = {
      {"cut", png.substr(0, 40)},           {"empty_size", testing::png_without_pixels(0, 4, 3)},
      {"text", "not an image at all"},      {"gif", "GIF89a and more"},
      {"ktx2", "\xABKTX 20\xBB\r\n\x1A\n"}, {"no_jpeg", "\xff\xd8\xff\xe0 nothing"}};
  for (const auto& [name, bytes] : images) {
    SCOPED_TRACE(name);
    Gltf g = textured_triangle();
    base_color(g)["index"] = add_texture(g, bytes);
    SceneFile scene = load_text(g.text());
    const Status status = read_textures(scene);
    EXPECT_TRUE(status.ok()) << status.message();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].rfind("images[0]", 0), 0u) << scene.warnings[0];
    EXPECT_TRUE(scene.images[0].pixels.empty());
  }
  Gltf g = textured_triangle();
  base_color(g)["index"] = add_texture(g, json{{"uri", "missing.png"}});
  SceneFile scene = load_text(g.text());
  EXPECT_TRUE(read_textures(scene).ok());
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("missing.png"), std::string::npos) << scene.warnings[0];
}

TEST(Textures, CutAnywhereTheyAreWholeOrLeftOut) {
  const std::string jpeg_uri = std::string("data:image/jpeg;base64,") + testing::kGreyJpeg;
  Gltf whole = textured_triangle();
  base_color(whole)["index"] = add_texture(whole, json{{"uri", jpeg_uri}});
  const SceneFile decoded = load_text(whole.text());
  const std::vector<unsigned char>& jpeg = *decoded.images[0].encoded;
  for (std::size_t length = 4; length < jpeg.size(); ++length) {
    SceneFile scene = decoded;
    scene.images[0].encoded = std::make_shared<const std::vector<unsigned char>>(
        jpeg.begin(), jpeg.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_TRUE(read_textures(scene).ok());
    EXPECT_EQ(scene.images[0].pixels.empty(), !scene.warnings.empty()) << length;
    EXPECT_TRUE(scene.images[0].pixels.empty() || scene.images[0].pixels.size() == 64) << length;
  }
}

TEST(Textures, LimitsHoldBeforeMemoryIsAskedFor) {
  struct Case {
    const char* name;
    std::string bytes;
    LoadLimits limits;
    const char* said;
  };
  LoadLimits few_bytes, few_pixels;
  few_bytes.image_bytes = 100;
  few_pixels.image_pixels = 15;
  const std::string small = png_bytes(6, 6, 3, std::vector<std::uint8_t>(108, 7));
  const Case cases[] = {
      {"bomb", testing::png_without_pixels(16384, 16384, 4), {}, "16384 x 16384"},
      {"huge", testing::png_without_pixels(1u << 30, 1u << 30, 3), {}, ""},
      {"bytes", small, few_bytes, "100 bytes"},
      {"pixels", small, few_pixels, "6 x 6"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    Gltf g = textured_triangle();
    base_color(g)["index"] = add_texture(g, c.bytes);
    SceneFile scene = load_text(g.text());
    const Status status = read_textures(scene, c.limits);
    if (*c.said == '\0') {  // libpng has a limit of its own
      EXPECT_TRUE(status.code() == StatusCode::resource_limit || !scene.warnings.empty());
      continue;
    }
    EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
    EXPECT_NE(status.message().find(c.said), std::string::npos) << status.message();
    EXPECT_NE(status.message().find("scene.gltf"), std::string::npos) << status.message();
  }
}

// Each scan has the decoder go over the whole image.
TEST(Textures, JpegsOfManyScansAreRefused) {
  Gltf g = textured_triangle();
  base_color(g)["index"] = add_texture(g, json{{"uri", std::string("data:image/jpeg;base64,") + testing::kGreyJpeg}});
  SceneFile scene = load_text(g.text());
  std::vector<unsigned char> bytes = *scene.images[0].encoded;
  const unsigned char marker[] = {0xFF, 0xDA};
  const auto scan = std::search(bytes.begin(), bytes.end(), std::begin(marker), std::end(marker));
  const std::vector<unsigned char> head(scan, scan + 10);
  for (int i = 0; i < 200; ++i) bytes.insert(bytes.end() - 2, head.begin(), head.end());
  scene.images[0].encoded = std::make_shared<const std::vector<unsigned char>>(bytes);
  const Status status = read_textures(scene);
  EXPECT_EQ(status.code(), StatusCode::resource_limit) << status.message();
  EXPECT_NE(status.message().find("scans"), std::string::npos) << status.message();
}

}  // namespace
}  // namespace umbrix::io
