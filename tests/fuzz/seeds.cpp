// SPDX-License-Identifier: Apache-2.0
// Writes what fuzzing starts from, a folder for each target: seeds OUTPUT_FOLDER [SCENE ...]. A .gltf is taken as it
// is; of a .glb only the JSON is, and the first bytes of the buffer.
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "io/gltf_text.h"
#include "io/picture_bytes.h"
#include "umbrix/io/image_file.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using umbrix::io::testing::bytes_of;
using umbrix::io::testing::Gltf;
using umbrix::io::testing::one_triangle;

class Folder {
 public:
  explicit Folder(fs::path path) : path_(std::move(path)) { fs::create_directories(path_); }

  fs::path next(const std::string& extension = "") { return path_ / ("seed-" + std::to_string(number_++) + extension); }
  void add(const std::string& bytes) { std::ofstream(next(), std::ios::binary) << bytes; }

 private:
  fs::path path_;
  int number_ = 0;
};

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Gltf with_mode(int mode) {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0});
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", positions}}}, {"mode", mode}})}});
  return g;
}

Gltf with_sparse() {
  Gltf g = one_triangle();
  const int indices = g.view(bytes_of(std::vector<std::uint16_t>{0, 2}));
  const int values = g.view(bytes_of(std::vector<float>{5, 0, 0, 0, 5, 0}));
  g.json["accessors"][0]["sparse"] = {{"count", 2},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", values}}}};
  return g;
}

Gltf with_quantized() {
  Gltf g;
  g.json["extensionsUsed"] = g.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const int positions =
      g.accessor(bytes_of(std::vector<std::int16_t>{0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0, 0}), 5122, 3, "VEC3", 8);
  const int normals =
      g.accessor(bytes_of(std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0}), 5120, 3, "VEC3", 4);
  g.json["accessors"][1]["normalized"] = true;
  const int texcoords = g.accessor(bytes_of(std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535}), 5123, 3, "VEC2");
  g.json["accessors"][2]["normalized"] = true;
  g.root({{"mesh", g.mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texcoords}}}})},
          {"scale", {0.1, 0.1, 0.1}},
          {"rotation", {0, 0, 0, 1}},
          {"translation", {1, 2, 3}}});
  return g;
}

// A triangle of two joints, the second of which turns, with a morph target, many times over.
Gltf with_motion() {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int joints =
      g.accessor(bytes_of(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}), 5121, 3, "VEC4");
  const int weights = g.accessor(bytes_of(std::vector<float>{.5f, .5f, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 5126, 3, "VEC4");
  std::vector<float> matrices(32, 0);
  for (std::size_t i = 0; i < 32; i += i % 16 == 15 ? 1 : 5) matrices[i] = 1;
  const int skinned = g.mesh({{"attributes", {{"POSITION", positions}, {"JOINTS_0", joints}, {"WEIGHTS_0", weights}}},
                              {"targets", {{{"POSITION", positions}}}}});
  g.json["meshes"][0]["weights"] = nlohmann::json::array({0.5});
  g.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", g.accessor(bytes_of(matrices), 5126, 2, "MAT4")}}};
  g.root({{"mesh", skinned}, {"skin", 0}});
  g.root({{"children", {2}}});
  g.json["nodes"].push_back({{"translation", {0, 1, 0}}});
  g.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 1, 0});
  const int input = g.accessor(bytes_of(std::vector<float>{0, 2}), 5126, 2, "SCALAR");
  const int output = g.accessor(bytes_of(std::vector<float>{0, 1}), 5126, 2, "SCALAR");
  g.json["animations"][0]["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", "STEP"}});
  g.json["animations"][0]["channels"].push_back({{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}});
  const int mesh = g.mesh({{"attributes", {{"POSITION", positions}}}});
  const int many = g.root({{"mesh", mesh}});
  g.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  g.json["nodes"][static_cast<std::size_t>(many)]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", positions}};
  g.animate(0, many, "translation", {0, 1}, {0, 0, 0, 1, 2, 3});
  return g;
}

Gltf with_everything() {
  Gltf g = one_triangle();
  g.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "EXT_none"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"},
       {"color", {1, 0.5, 0}},
       {"intensity", 3},
       {"range", 9},
       {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}},
      {{"type", "directional"}}};
  g.json["cameras"] = {
      {{"type", "perspective"},
       {"name", "eye"},
       {"perspective", {{"yfov", 0.8}, {"znear", 0.1}, {"zfar", 9}, {"aspectRatio", 2}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 9}}}}};
  g.json["materials"] = {{{"name", "m"},
                          {"pbrMetallicRoughness",
                           {{"baseColorFactor", {1, 1, 1, 0.5}},
                            {"metallicFactor", 0},
                            {"roughnessFactor", 0.5},
                            {"baseColorTexture", {{"index", 0}}}}},
                          {"emissiveFactor", {1, 0, 0}},
                          {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}},
                          {"alphaMode", "MASK"},
                          {"alphaCutoff", 0.3},
                          {"doubleSided", true}}};
  g.json["textures"] = {{{"source", 0}}};
  g.json["images"] = {{{"uri", "a.png"}}, {{"bufferView", 0}, {"mimeType", "image/png"}}};
  g.json["meshes"][0]["primitives"][0]["material"] = 0;
  g.json["nodes"][0]["children"] = {1, 2};
  g.json["nodes"].push_back({{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  g.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"extras", {{"a", {1, "b"}}}}});
  g.root({{"camera", 1}, {"name", "moving"}});
  g.animate(0, 3, "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  g.animate(0, 3, "rotation", {0, 0.5f, 1}, {0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 1}, "STEP");
  g.animate(0, 3, "scale", {0, 1}, {0, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0, 2, 2, 2, 0, 0, 0}, "CUBICSPLINE");
  return g;
}

// Pictures of both formats, for a mask, a normal and an emission.
Gltf with_textures() {
  Gltf g = one_triangle();
  auto& primitive = g.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["attributes"]["TEXCOORD_0"] = g.accessor(bytes_of(std::vector<float>{0, 0, 1, 0, 0, 1}), 5126, 3, "VEC2");
  primitive["attributes"]["COLOR_0"] = g.accessor(bytes_of(std::vector<float>(12, 1)), 5126, 3, "VEC4");
  primitive["attributes"]["TANGENT"] = g.accessor(bytes_of(std::vector<float>(12, 1)), 5126, 3, "VEC4");
  const int png = g.view(umbrix::io::testing::png_bytes(1, 2, 4, {1, 2, 3, 4, 5, 6, 7, 8}));
  g.json["images"] = {{{"bufferView", png}, {"mimeType", "image/png"}},
                      {{"uri", std::string("data:image/jpeg;base64,") + umbrix::io::testing::kGreyJpeg}}};
  g.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
  g.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
  g.json["extensionsUsed"] = {"KHR_texture_transform", "KHR_materials_specular", "KHR_materials_ior"};
  g.json["materials"] = {
      {{"alphaMode", "MASK"},
       {"pbrMetallicRoughness",
        {{"baseColorTexture",
          {{"index", 0},
           {"extensions", {{"KHR_texture_transform", {{"offset", {0, 1}}, {"rotation", 1}, {"scale", {2, 3}}}}}}}},
         {"metallicRoughnessTexture", {{"index", 1}}}}},
       {"normalTexture", {{"index", 1}, {"scale", 0.5}}},
       {"emissiveFactor", {1, 1, 1}},
       {"emissiveTexture", {{"index", 1}, {"texCoord", 0}}},
       {"extensions",
        {{"KHR_materials_ior", {{"ior", 1.4}}},
         {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularTexture", {{"index", 0}}}}}}}}};
  return g;
}

void write_scenes(const fs::path& out, const std::vector<std::string>& scene_paths) {
  Folder text(out / "gltf_text"), binary(out / "gltf_binary");
  for (const Gltf& g : {one_triangle(), with_mode(5), with_mode(6), with_mode(1), with_sparse(), with_quantized(),
                        with_everything(), with_motion(), with_textures()}) {
    text.add(g.text());
    binary.add(g.glb());
  }
  Gltf external = one_triangle();
  external.json["buffers"] = {{{"byteLength", external.bin.size()}, {"uri", "a.bin"}}};
  text.add(external.json.dump(1));
  for (const std::string& path : scene_paths) {
    if (fs::path(path).extension() == ".gltf") {
      text.add(read(path));
      continue;
    }
    const std::string glb = read(path);
    std::uint32_t length = 0;
    if (glb.size() > 28) glb.copy(reinterpret_cast<char*>(&length), sizeof length, 12);
    if (length == 0 || length > 4000) continue;
    text.add(glb.substr(20, length));
    Gltf start;
    start.json = json::parse(glb.substr(20, length));
    start.bin = glb.substr(28 + length, 1024);
    binary.add(start.glb());
  }
}

void write_setups(const fs::path& out) {
  Folder setups(out / "setup_file");
  setups.add(R"({"camera":{"eye":[0,0,5],"target":[0,0,0],"up":[0,1,0],"fov_y_degrees":40},"lights":[[1,2,3]]})");
  setups.add(
      R"([{"file":"triangle.glb","camera":{"keyframes":[{"frame":1,"eye":[0,0,5],"target":[0,0,0]},{"frame":9,"eye":[1,0,5]},{"frame":20.5,"up":[1,0,0],"fov_y_degrees":9}],"interpolation":"smooth"}}])");
  setups.add(
      R"([{"name":"triangle","lights":[{"type":"spot","name":"l","position":[0,1,0],"direction":[0,-1,0],"color":[1,1,1],"intensity":5,"range":9,"inner_cone_degrees":10,"outer_cone_degrees":30},{"type":"point","position":[1,1,1]},{"type":"directional","direction":[1,1,1]}]}])");
  setups.add(
      R"({"lights":[{"type":"rectangle","position":[0,1,0],"direction":[0,-1,0],"up":[0,0,1],"width":2,"height":1,"radiance":[1,2,3]},{"type":"sphere","position":[0,2,0],"radius":0.5,"power":60,"color":[1,0,1]},{"type":"environment","file":"sky.exr","rotation_degrees":30,"radiance":2}]})");
}

void write_arguments(const fs::path& out) {
  Folder arguments(out / "arguments");
  arguments.add(
      "scene.glb\n-o\nout.####.exr\n--frames\n1-3,5,7-20:2\n--fps\n25\n--size\n16x8\n--crop\n4x4+1+2\n--spp\n4");
  arguments.add(
      "scene.glb\n--output=a.png\n--exposure\n-1.5\n--tonemap\naces\n--aov\nnormal,depth\n--float\n--seed\n7\n-j\n2");
  arguments.add(
      "scene.glb\n-o\no%04d.png\n--heat-map\nnode_tests=h.png\n--kernel\nlinked\n--simd\nAVX2\n--progress\nlines\n--"
      "stats\n-\n-q");
  arguments.add("--help\n-12--3x4,-5\nfolder#/a##.exr");
}

void write_images(const fs::path& out) {
  Folder images(out / "image_file");
  umbrix::io::Image image;
  image.width = 5;
  image.height = 3;
  image.channels = {"R", "G", "B"};
  image.pixels.assign(45, 0.5f);
  image.metadata = {{"umbrix:job", "1"}};
  image.matrices = {{"worldToCamera", std::vector<float>(16, 1)}};
  for (const char* extension : {".exr", ".png"}) {
    const fs::path path = images.next(extension);
    if (!umbrix::io::write_image(path.string(), image, {}).ok())
      std::fprintf(stderr, "cannot write %s\n", path.c_str());
  }
}

// Any bytes mean something to these.
void write_random(const fs::path& out) {
  std::mt19937 random(1);
  for (const char* target : {"exact_answers", "gltf_values"}) {
    Folder folder(out / target);
    for (std::size_t size = 16; size <= 1024; size *= 2) {
      for (int i = 0; i < 4; ++i) {
        std::string bytes(size, '\0');
        for (char& byte : bytes) byte = static_cast<char>(random());
        folder.add(bytes);
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const fs::path out = argv[1];
  write_scenes(out, {argv + 2, argv + argc});
  write_setups(out);
  write_arguments(out);
  write_images(out);
  write_random(out);
}
