// SPDX-License-Identifier: Apache-2.0
// What alpha lets through, to the eye and to the light.
#include "stage.h"

namespace umbrix::features {
namespace {

json with_alpha(json material, const char* mode, double cutoff = 0.5) {
  material["alphaMode"] = mode;
  if (cutoff != 0.5) material["alphaCutoff"] = cutoff;
  return material;
}

json textured(json material, int texture) {
  material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
  return material;
}

/// White in front of blue. Two texels of alpha, 64 and 191, in each mode; alpha of a factor; alpha of vertices.
Stage modes() {
  Stage s(6, 1);
  for (int x = 0; x < 6; ++x) s.show(unlit(0, 0, 1), x, 0, -1);
  const int texture = s.texture(2, 1, 4, {255, 255, 255, 64, 255, 255, 255, 191});
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  const json white = textured(unlit(1, 1, 1), texture);
  json faint = unlit(1, 1, 1);
  faint["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.25};
  s.place(s.square(s.material(white), attributes), 0);
  s.place(s.square(s.material(with_alpha(white, "MASK")), attributes), 1);
  s.place(s.square(s.material(with_alpha(white, "MASK", 0.75)), attributes), 2);
  s.place(s.square(s.material(with_alpha(white, "BLEND")), attributes), 3);
  s.show(with_alpha(faint, "BLEND"), 4);
  const int ramp = s.floats({1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0}, 4);
  s.place(s.square(s.material(with_alpha(unlit(1, 1, 1), "MASK")), {{"COLOR_0", ramp}}), 5);
  return s;
}

/// A floor that covers the picture, and squares beside it at a height of 4: light from the direction (0.6, 0, 0.8)
/// casts their shadows 3 to the left, onto [0, 1] and [1, 2].
Stage shadows() {
  Stage s(3, 1);
  const int floor = s.show(lambert(), 0);
  s.json["nodes"][static_cast<std::size_t>(floor)]["scale"] = {3, 1, 1};
  const int texture = s.texture(2, 1, 4, {255, 255, 255, 0, 255, 255, 255, 255});
  const json attributes = {{"TEXCOORD_0", s.texcoords()}};
  s.place(s.square(s.material(with_alpha(textured(lambert(), texture), "MASK")), attributes), 3, 0, 4);
  json faint = lambert();
  faint["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.25};
  s.show(with_alpha(faint, "BLEND"), 4, 0, 4);
  s.light({{"type", "directional"}, {"intensity", 3.14159265}}, {{"rotation", {0, 0.31622777, 0, 0.9486833}}});
  return s;
}

}  // namespace

void add_alpha(Files& files) {
  files["AlphaBlendModeTest.gltf"] = modes().readable();
  files["AlphaShadows.gltf"] = shadows().readable();
}

}  // namespace umbrix::features
