// SPDX-License-Identifier: Apache-2.0
// What moves nodes, from 0 to 1 second or 2.
#include "stage.h"

namespace umbrix::features {
namespace {

/// A right angle that turns by a quarter.
Stage animated_triangle() {
  Stage s(2, 1);
  const json triangle = {{"attributes", {{"POSITION", s.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3)}}},
                         {"material", s.material(unlit(1, 1, 1))}};
  const int node = s.place(triangle, 1);
  s.animate(0, node, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0.70710678f, 0.70710678f});
  return s;
}

/// Squares that rise by 2 in 2 seconds: at once, evenly, along a spline that is level at first and falls by 3 a second
/// at the end. Its slopes before and after both keys must not count.
Stage interpolations() {
  Stage s(3, 4);
  const int mesh = s.mesh(s.square(s.material(unlit(1, 1, 1))));
  const auto rising = [&](float x, const char* interpolation) {
    const int node = s.root({{"mesh", mesh}});
    std::vector<float> values = {x, 0.5f, 0, x, 2.5f, 0};
    if (interpolation == std::string("CUBICSPLINE")) {
      values = {0, 9, 0, x, 0.5f, 0, 0, 0, 0, 0, -3, 0, x, 2.5f, 0, 0, 9, 0};
    }
    s.animate(0, node, "translation", {0, 2}, values, interpolation);
  };
  rising(0, "STEP");
  rising(1, "LINEAR");
  rising(2, "CUBICSPLINE");
  return s;
}

/// A square that shrinks below a node that moves by 2, each by an animation of its own.
Stage box_animated() {
  Stage s(4, 1);
  const int child = s.show(unlit(1, 1, 1), 1);
  s.json["scenes"][0]["nodes"].erase(1);
  const int parent = s.root({{"children", {child}}});
  s.animate(0, parent, "translation", {0, 1}, {0, 0, 0, 2, 0, 0});
  s.animate(1, child, "scale", {0, 1}, {1, 1, 1, 0.5f, 0.5f, 1});
  return s;
}

/// The camera goes from a red square to a green one.
Stage animated_camera() {
  Stage s(1, 1);
  s.show(unlit(1, 0, 0), 0);
  s.show(unlit(0, 1, 0), 1);
  s.animate(0, 0, "translation", {0, 1}, {0.5f, 0.5f, 10, 1.5f, 0.5f, 10});
  return s;
}

/// A directional light that turns by 60 degrees.
Stage animated_light() {
  Stage s(1, 1);
  s.show(lambert(), 0);
  s.light_straight_on();
  s.animate(0, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0.5f, 0, 0.8660254f});
  return s;
}

/// Two animations of one square.
Stage several_animations() {
  Stage s(3, 1);
  const int node = s.show(unlit(1, 1, 1), 0);
  s.animate(0, node, "translation", {0, 1}, {0, 0, 0, 1, 0, 0});
  s.animate(1, node, "translation", {0, 1}, {0, 0, 0, 2, 0, 0});
  s.json["animations"][0]["name"] = "Walk";
  s.json["animations"][1]["name"] = "Run";
  return s;
}

}  // namespace

void add_animations(Files& files) {
  files["AnimatedTriangle.gltf"] = animated_triangle().readable();
  files["InterpolationTest.gltf"] = interpolations().readable();
  files["BoxAnimated.gltf"] = box_animated().readable();
  files["AnimatedCamera.gltf"] = animated_camera().readable();
  files["AnimatedLight.gltf"] = animated_light().readable();
  files["Fox.gltf"] = several_animations().readable();
}

}  // namespace umbrix::features
