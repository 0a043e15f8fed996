// SPDX-License-Identifier: Apache-2.0
// Where nodes place meshes; and the containers of a file.
#include "io/picture_bytes.h"
#include "stage.h"

namespace umbrix::features {
namespace {

/// A primitive with a right angle at the origin and legs of length 1: it shows how it is turned.
json corner(Stage& s) {
  return {{"attributes", {{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3)}}},
          {"material", s.material(unlit(1, 1, 1))}};
}

/// Nodes with turns by a quaternion and by a matrix, about another axis, and with all three of TRS.
Stage orientation() {
  Stage s(4, 1);
  const int mesh = s.mesh(corner(s));
  s.root({{"mesh", mesh}, {"translation", {1, 0, 0}}, {"rotation", {0, 0, 0.70710678, 0.70710678}}});
  s.root({{"mesh", mesh}, {"matrix", {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 2, 0, 0, 1}}});
  s.root({{"mesh", mesh}, {"translation", {2, 1, 0}}, {"rotation", {1, 0, 0, 0}}});
  s.root({{"mesh", mesh},
          {"translation", {4, 0, 0}},
          {"rotation", {0, 0, 0.70710678, 0.70710678}},
          {"scale", {1, 0.5, 1}}});
  return s;
}

/// Squares that shine on their front alone; mirrored along x, along z, along x and y, along all.
Stage negative_scale() {
  Stage s(4, 1);
  const int mesh = s.mesh(s.square(s.material(glow(1, 1, 1))));
  s.root({{"mesh", mesh}, {"translation", {1, 0, 0}}, {"scale", {-1, 1, 1}}});
  s.root({{"mesh", mesh}, {"translation", {1, 0, 0}}, {"scale", {1, 1, -1}}});
  s.root({{"mesh", mesh}, {"translation", {3, 1, 0}}, {"scale", {-1, -1, 1}}});
  s.root({{"mesh", mesh}, {"translation", {4, 1, 0}}, {"scale", {-1, -1, -1}}});
  return s;
}

/// A mesh at two nodes, one of them below another.
Stage simple_meshes() {
  Stage s(3, 1);
  const int mesh = s.mesh(s.square(s.material(unlit(1, 1, 1))));
  s.json["nodes"].push_back({{"mesh", mesh}, {"translation", {1, 0, 0}}});
  s.root({{"mesh", mesh}, {"translation", {1, 0, 0}}, {"children", {s.json["nodes"].size() - 1}}});
  return s;
}

/// Two scenes, of which the second is the file's.
Stage several_scenes() {
  Stage s(2, 1);
  s.json["scene"] = 1;
  const int left = s.show(unlit(1, 1, 1), 0), right = s.show(unlit(1, 1, 1), 1);
  s.json["scenes"] = {{{"nodes", {0, left}}}, {{"nodes", {0, right}}}};
  return s;
}

/// Three places of a mesh in arrays: as it is; turned by a short; half as large.
Stage instancing() {
  Stage s(4, 1);
  const int mesh = s.mesh(corner(s));
  const int where = s.floats({0, 0, 0, 2, 0, 0, 2, 0, 0}, 3);
  const int turn = s.normalized(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170, 0, 0, 0, 32767}, 5122, 4);
  const int size = s.floats({1, 1, 1, 1, 1, 1, 0.5f, 0.5f, 0.5f}, 3);
  s.use("EXT_mesh_gpu_instancing", true);
  s.root({{"mesh", mesh},
          {"translation", {1, 0, 0}},
          {"extensions",
           {{"EXT_mesh_gpu_instancing",
             {{"attributes", {{"TRANSLATION", where}, {"ROTATION", turn}, {"SCALE", size}}}}}}}});
  return s;
}

Stage box() {
  Stage s(1, 1);
  s.show(unlit(0.25, 0.5, 1), 0);
  return s;
}

/// Buffer and picture in files of their own, whose names have spaces.
void add_box_with_spaces(Files& files) {
  const std::string name = "Box With Spaces";
  Stage s(1, 1);
  json material = unlit(1, 1, 1);
  material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  s.json["images"] = {{{"uri", "Box%20With%20Spaces.png"}}};
  s.json["textures"] = {{{"source", 0}}};
  s.place(s.square(s.material(material), {{"TEXCOORD_0", s.texcoords()}}), 0);
  files[name + ".bin"] = s.bin;
  files[name + ".png"] = io::testing::png_bytes(1, 1, 3, {0, 255, 0});
  s.json["buffers"] = {{{"byteLength", s.bin.size()}, {"uri", "Box%20With%20Spaces.bin"}}};
  s.bin.clear();
  files[name + ".gltf"] = s.readable();
}

}  // namespace

void add_placement(Files& files) {
  files["OrientationTest.gltf"] = orientation().readable();
  files["NegativeScaleTest.gltf"] = negative_scale().readable();
  files["SimpleMeshes.gltf"] = simple_meshes().readable();
  files["MultipleScenes.gltf"] = several_scenes().readable();
  files["SimpleInstancing.gltf"] = instancing().readable();
  files["Box.glb"] = box().glb();
  add_box_with_spaces(files);
}

}  // namespace umbrix::features
