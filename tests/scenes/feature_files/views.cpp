// SPDX-License-Identifier: Apache-2.0
// Cameras and lights.
#include "stage.h"

namespace umbrix::features {
namespace {

/// A unit square at z = 0 and a green one at z = 5, over the middle of the picture; cameras at z = 10, whose pictures
/// are 2 high at z = 0: by parallels, by perspective, and the same from z = 4 on and up to z = 4.
Stage cameras() {
  Stage s(2, 2);
  s.show(unlit(1, 1, 1), 1, 1, 0);
  s.show(unlit(0, 1, 0), 0, 0, 5);
  const double yfov = 0.19933730498232408;  // 2 atan(1 / 10)
  const json lenses[] = {{{"yfov", yfov}, {"znear", 0.1}},
                         {{"yfov", yfov}, {"znear", 6}, {"zfar", 100}},
                         {{"yfov", yfov}, {"znear", 0.1}, {"zfar", 6}}};
  for (const json& lens : lenses) {
    s.json["cameras"].push_back({{"type", "perspective"}, {"perspective", lens}});
    s.root({{"camera", s.json["cameras"].size() - 1}, {"translation", {1, 1, 10}}});
  }
  return s;
}

Stage white_floor(int width) {
  Stage s(width, 1);
  const int floor = s.show(lambert(), 0);
  s.json["nodes"][static_cast<std::size_t>(floor)]["scale"] = {width, 1, 1};
  return s;
}

/// Green straight down, and red from the direction (0.6, 0, 0.8).
Stage directional() {
  Stage s = white_floor(1);
  s.light({{"type", "directional"}, {"intensity", 3.14159265}, {"color", {0, 0.5, 0}}});
  s.light({{"type", "directional"}, {"intensity", 3.14159265}, {"color", {1, 0, 0}}},
          {{"rotation", {0, 0.31622777, 0, 0.9486833}}});
  return s;
}

/// Two candela over pi from a height of 2: red, and green with a range of 4.
Stage point() {
  Stage s = white_floor(4);
  s.light({{"type", "point"}, {"intensity", 12.5663706}, {"color", {1, 0, 0}}}, {{"translation", {0.5, 0.5, 2}}});
  s.light({{"type", "point"}, {"intensity", 12.5663706}, {"color", {0, 1, 0}}, {"range", 4}},
          {{"translation", {0.5, 0.5, 2}}});
  return s;
}

Stage spot() {
  Stage s = white_floor(4);
  s.light({{"type", "spot"}, {"intensity", 12.5663706}, {"spot", {{"innerConeAngle", 0.4}, {"outerConeAngle", 0.8}}}},
          {{"translation", {0.5, 0.5, 2}}});
  return s;
}

/// A shining square of 2 x 2 at a height of 1, its front down, over a white floor. The camera is below it.
Stage mesh_light() {
  Stage s = white_floor(1);
  const int panel = s.show(glow(1, 0.5, 0.25), -0.5, 1.5, 1);
  s.json["nodes"][static_cast<std::size_t>(panel)]["rotation"] = {1, 0, 0, 0};
  s.json["nodes"][static_cast<std::size_t>(panel)]["scale"] = {2, 2, 1};
  s.json["nodes"][0]["translation"] = {0.5, 0.5, 0.5};
  return s;
}

}  // namespace

void add_views(Files& files) {
  files["Cameras.gltf"] = cameras().readable();
  files["DirectionalLight.gltf"] = directional().readable();
  files["LightsPunctualLamp.gltf"] = point().readable();
  files["SpotLight.gltf"] = spot().readable();
  files["EmissiveMeshLight.gltf"] = mesh_light().readable();
}

}  // namespace umbrix::features
