// SPDX-License-Identifier: Apache-2.0
// A box after the one at Cornell (Goral et al. 1984) with curved things in it: a knot, a sphere, a vase.
#include <glm/geometric.hpp>

#include "numbers.h"
#include "scene.h"

namespace umbrix::scenes {
namespace {

using glm::dvec3;

/// The (2, 3) torus knot around the z axis; it fits into a ball of 1.5 radius.
Shape knot(double radius, double thickness, int stations, int sides) {
  const auto point = [&](double turns, double scale) {
    const double from_axis = radius * (1 + 0.5 * scale * cos_turns(3 * turns));
    return dvec3(from_axis * cos_turns(2 * turns), from_axis * sin_turns(2 * turns),
                 radius * 0.5 * scale * sin_turns(3 * turns));
  };
  std::vector<Station> line;
  for (int i = 0; i < stations; ++i) {
    const double turns = static_cast<double>(i) / stations;
    // Away from the torus's core circle: smooth, periodic and never along the line.
    line.push_back({point(turns, 1), point(turns, 1) - point(turns, 0), thickness});
  }
  return tube(line, sides, true);
}

void add_room(Scene& scene) {
  const std::uint32_t white = scene.add(Material{"white", {0.73, 0.71, 0.68}, 0.9});
  const std::uint32_t red = scene.add(Material{"red", {0.63, 0.06, 0.05}, 0.9});
  const std::uint32_t green = scene.add(Material{"green", {0.13, 0.43, 0.09}, 0.9});
  const std::uint32_t lamp = scene.add(Material{"lamp", {0.8, 0.8, 0.8}, 1, 0, {1, 0.95, 0.85}});
  Mesh room{"room", {}};
  room.add(white, box({-1.1, -0.1, -1.1}, {1.1, 0, 1}));
  room.add(white, box({-1.1, 2, -1.1}, {1.1, 2.1, 1}));
  room.add(white, box({-1, 0, -1.1}, {1, 2, -1}));
  room.add(red, box({-1.1, 0, -1.1}, {-1, 2, 1}));
  room.add(green, box({1, 0, -1.1}, {1.1, 2, 1}));
  room.add(lamp, box({-0.3, 1.995, -0.3}, {0.3, 2, 0.3}));
  scene.place(std::move(room));
}

void add_objects(Scene& scene) {
  const std::uint32_t plaster = scene.add(Material{"plaster", {0.7, 0.69, 0.66}, 0.8});
  const std::uint32_t gold = scene.add(Material{"gold", {0.95, 0.62, 0.22}, 0.38, 0.6});
  const std::uint32_t blue = scene.add(Material{"glazed blue", {0.06, 0.17, 0.42}, 0.25});
  const std::uint32_t ivory = scene.add(Material{"ivory", {0.82, 0.76, 0.62}, 0.3});

  Mesh tall{"tall block", {}};
  tall.add(plaster, rounded_box({0.29, 0.44, 0.29}, 0.02, 4));
  scene.place(std::move(tall), {-0.38, 0.44, -0.38}, 0.05);
  Mesh low{"low block", {}};
  low.add(plaster, rounded_box({0.28, 0.15, 0.28}, 0.02, 4));
  scene.place(std::move(low), {0.42, 0.15, 0.22}, -0.05);

  Mesh knotted{"knot", {}};
  knotted.add(gold, knot(0.22, 0.062, 224, 20));
  scene.place(std::move(knotted), {-0.38, 1.264, -0.38}, 0.06);

  Mesh vase{"vase", {}};
  vase.add(blue, lathe({{0, 0},        {0.09, 0, true}, {0.1, 0.012},  {0.09, 0.03},  {0.1, 0.06},
                        {0.14, 0.12},  {0.165, 0.19},   {0.168, 0.25}, {0.15, 0.32},  {0.11, 0.38},
                        {0.07, 0.43},  {0.055, 0.47},   {0.055, 0.51}, {0.075, 0.55}, {0.095, 0.57},
                        {0.09, 0.572}, {0.065, 0.548},  {0.045, 0.51}, {0.045, 0.47}, {0.06, 0.43},
                        {0.1, 0.375},  {0.138, 0.32},   {0.15, 0.25},  {0.12, 0.12},  {0, 0.06}},
                       64));
  scene.place(std::move(vase), {0.42, 0.3, 0.22});

  Mesh ball{"ball", {}};
  ball.add(ivory, sphere(0.2, 64, 32));
  scene.place(std::move(ball), {-0.3, 0.2, 0.45});

  Mesh ring{"ring", {}};
  std::vector<Station> circle;
  for (int i = 0; i < 72; ++i)
    circle.push_back({dvec3(cos_turns(i / 72.0), 0, -sin_turns(i / 72.0)) * 0.13, {0, 1, 0}, 0.035});
  ring.add(gold, tube(circle, 20, true));
  scene.place(std::move(ring), {0.12, 0.035, 0.7});
}

}  // namespace

Scene cornell() {
  Scene scene;
  scene.name = "cornell";
  scene.camera = {{0, 1, 3.6}, {0, 0.99, 0}, 0.74};
  add_room(scene);
  add_objects(scene);
  const dvec3 warm(1, 0.9, 0.75);
  scene.lights = {
      {"lamp", LightType::point, warm, 4.2, {0, 1.72, 0}},
      {"picture light", LightType::spot, warm, 8, {0.7, 1.9, 0.8}, {-0.38, 1.15, -0.38}, 0.15, 0.4},
      {"behind the camera", LightType::point, {0.8, 0.88, 1}, 5, {0.5, 1.3, 3.4}},
  };
  return scene;
}

}  // namespace umbrix::scenes
