// SPDX-License-Identifier: Apache-2.0
// A conference room: a long table, chairs, and blinds that let the afternoon sun in over the shoulders of the guests.
#include <initializer_list>

#include "numbers.h"
#include "scene.h"

namespace umbrix::scenes {
namespace {

using glm::dvec3;

constexpr double kHalfX = 4.5, kHalfZ = 3.2, kHeight = 3;
constexpr double kTableTop = 0.74, kHalfTable = 2.3;
constexpr double kWindowWidth = 2.2, kSill = 0.9, kLintel = 2.5;
constexpr double kWindows[] = {-2.7, 0, 2.7};

struct Palette {
  std::uint32_t wall, ceiling, walnut, dark, chrome, leather, white, carpet, dark_carpet, lamp, glass, leaf, clay,
      screen;
};

Palette add_materials(Scene& scene) {
  return {scene.add(Material{"wall", {0.7, 0.67, 0.61}, 0.95}),
          scene.add(Material{"ceiling", {0.8, 0.79, 0.77}, 0.95}),
          scene.add(Material{"walnut", {0.33, 0.17, 0.09}, 0.4}),
          scene.add(Material{"dark plastic", {0.05, 0.05, 0.06}, 0.5}),
          scene.add(Material{"chrome", {0.75, 0.76, 0.78}, 0.35, 0.7}),
          scene.add(Material{"leather", {0.34, 0.07, 0.05}, 0.45}),
          scene.add(Material{"white", {0.8, 0.8, 0.78}, 0.7}),
          scene.add(Material{"carpet", {0.2, 0.25, 0.31}, 1}),
          scene.add(Material{"dark carpet", {0.16, 0.2, 0.26}, 1}),
          scene.add(Material{"lamp", {0.8, 0.8, 0.8}, 1, 0, {1, 0.93, 0.8}}),
          scene.add(Material{"glass", {0.5, 0.62, 0.62}, 0.12}),
          scene.add(Material{"leaf", {0.12, 0.27, 0.07}, 0.6, 0, {0, 0, 0}, true}),
          scene.add(Material{"clay", {0.55, 0.52, 0.48}, 0.8}),
          scene.add(Material{"screen", {0.02, 0.02, 0.03}, 0.3, 0, {0.1, 0.24, 0.42}})};
}

void add_room(Scene& scene, const Palette& palette) {
  Mesh room{"room", {}};
  const double out = 0.2;
  room.add(palette.dark_carpet, box({-kHalfX - out, -out, -kHalfZ - out}, {kHalfX + out, -0.01, kHalfZ + out}));
  room.add(palette.ceiling, box({-kHalfX - out, kHeight, -kHalfZ - out}, {kHalfX + out, kHeight + out, kHalfZ + out}));
  room.add(palette.wall, box({-kHalfX - out, 0, -kHalfZ}, {-kHalfX, kHeight, kHalfZ}));
  room.add(palette.wall, box({kHalfX, 0, -kHalfZ}, {kHalfX + out, kHeight, kHalfZ}));
  room.add(palette.wall, box({-kHalfX - out, 0, kHalfZ}, {kHalfX + out, kHeight, kHalfZ + out}));
  // The wall with the windows.
  room.add(palette.wall, box({-kHalfX - out, 0, -kHalfZ - out}, {kHalfX + out, kSill, -kHalfZ}));
  room.add(palette.wall, box({-kHalfX - out, kLintel, -kHalfZ - out}, {kHalfX + out, kHeight, -kHalfZ}));
  double left = -kHalfX - out;
  for (const double x : kWindows) {
    room.add(palette.wall, box({left, kSill, -kHalfZ - out}, {x - kWindowWidth / 2, kLintel, -kHalfZ}));
    left = x + kWindowWidth / 2;
    room.add(palette.white, box({x - 0.03, kSill, -kHalfZ - 0.16}, {x + 0.03, kLintel, -kHalfZ - 0.1}));
  }
  room.add(palette.wall, box({left, kSill, -kHalfZ - out}, {kHalfX + out, kLintel, -kHalfZ}));
  room.add(palette.walnut, box({-kHalfX, kSill - 0.05, -kHalfZ}, {kHalfX, kSill - 0.01, -kHalfZ + 0.14}));
  room.add(palette.walnut, box({-kHalfX, 0, -kHalfZ}, {kHalfX, 0.1, -kHalfZ + 0.02}));
  // Panels and a screen on the left wall.
  for (int i = 0; i < 8; ++i) {
    const double z = -kHalfZ + 0.1 + 0.78 * i;
    room.add(palette.walnut, moved(rounded_box({0.02, 1.25, 0.37}, 0.008, 1), {-kHalfX + 0.02, 1.5, z + 0.37}));
  }
  room.add(palette.dark, moved(rounded_box({0.03, 0.62, 1.05}, 0.015, 2), {-kHalfX + 0.07, 1.6, 0}));
  room.add(palette.screen, box({-kHalfX + 0.09, 1.02, -1}, {-kHalfX + 0.105, 2.18, 1}));
  scene.place(std::move(room));

  std::uint32_t tiles[2];
  for (int i = 0; i < 2; ++i) {
    tiles[i] = scene.add(Mesh{"carpet tile", {}});
    scene.meshes.back().add(i == 0 ? palette.carpet : palette.dark_carpet,
                            box({-0.248, -0.012, -0.248}, {0.248, 0, 0.248}));
  }
  for (int i = 0; i < 18; ++i) {
    for (int j = 0; j < 13; ++j) scene.place(tiles[(i + j) % 2], {-4.25 + 0.5 * i, 0, -3 + 0.5 * j});
  }
  const std::uint32_t outside = scene.add(Material{"outside", {0, 0, 0}, 1, 0, {0.8, 0.9, 1}});
  Mesh view{"outside", {}};
  view.add(outside, box({-9, -1, -6.6}, {9, 2.8, -6.5}));
  scene.place(std::move(view));
}

void add_blinds(Scene& scene, const Palette& palette) {
  Mesh slat{"slat", {}};
  slat.add(palette.white, slab(
                              1, 4,
                              [](double u, double v) {
                                const double across = 2 * v - 1;
                                return dvec3((kWindowWidth / 2 - 0.02) * (2 * u - 1), 0.005 * (1 - across * across),
                                             -0.025 * across);
                              },
                              dvec3(0, -0.0015, 0)));
  Mesh rail{"blind's rail", {}};
  rail.add(palette.white, rounded_box({kWindowWidth / 2 - 0.01, 0.03, 0.035}, 0.006, 1));
  const std::uint32_t slats = scene.add(std::move(slat)), rails = scene.add(std::move(rail));
  for (const double x : kWindows) {
    // The middle one is drawn up a little.
    const double low = x == 0 ? 1.35 : kSill + 0.05;
    for (double y = low; y < kLintel - 0.07; y += 0.045) {
      scene.nodes.push_back({slats, {x, y, -kHalfZ - 0.04}, rotation({1, 0, 0}, 0.045), {1, 1, 1}});
    }
    scene.place(rails, {x, kLintel - 0.03, -kHalfZ - 0.04});
    scene.place(rails, {x, low - 0.03, -kHalfZ - 0.04}, 0, {1, 0.5, 0.7});
  }
}

/// The sitter looks along -z.
Mesh chair(const Palette& palette) {
  Mesh mesh{"chair", {}};
  mesh.add(palette.leather, moved(rounded_box({0.25, 0.045, 0.245}, 0.04, 4), {0, 0.47, 0}));
  const Surface back = [](double u, double v) {
    const double side = 2 * u - 1, bulge = 0.025 * (1 - side * side) * (1 - (2 * v - 1) * (2 * v - 1));
    const double width = 0.235 - 0.03 * (2 * v - 1) * (2 * v - 1);
    return dvec3(-side * width, 0.56 + 0.52 * v,
                 0.2 + 0.09 * v - 0.05 * side * side + 0.05 * (1 - v) * (1 - v) - bulge);
  };
  mesh.add(palette.leather, slab(12, 14, back, dvec3(0, 0, 0.045)));
  mesh.add(palette.chrome, rod({{0, 0.44, 0.1}, {0, 0.45, 0.29}, {0, 0.62, 0.31}, {0, 0.8, 0.325}}, 0.016, 12));
  for (const double x : {-0.27, 0.27}) {
    mesh.add(palette.chrome, rod({{x * 0.8, 0.43, 0.02}, {x, 0.45, 0.02}, {x, 0.63, 0.04}}, 0.011, 10));
    mesh.add(palette.dark, moved(rounded_box({0.025, 0.014, 0.13}, 0.012, 3), {x, 0.645, 0}));
  }
  mesh.add(palette.chrome, lathe({{0, 0.08},
                                  {0.045, 0.08, true},
                                  {0.045, 0.13, true},
                                  {0.028, 0.14, true},
                                  {0.028, 0.3, true},
                                  {0.018, 0.3, true},
                                  {0.018, 0.41, true},
                                  {0.09, 0.42, true},
                                  {0.09, 0.43, true},
                                  {0, 0.43}},
                                 20));
  for (int i = 0; i < 5; ++i) {
    const auto at = [&](double x, double y) { return turned(dvec3(x, y, 0), {0, 1, 0}, i / 5.0 + 0.05); };
    mesh.add(palette.chrome, tube({{at(0.03, 0.11), {0, 1, 0}, 0.02}, {at(0.28, 0.075), {0, 1, 0}, 0.013}}, 10));
    mesh.add(palette.dark, moved(sphere(0.032, 16, 10), at(0.28, 0.034)));
  }
  return mesh;
}

void add_table(Scene& scene, const Palette& palette) {
  Mesh table{"table", {}};
  const Surface top = [](double u, double v) {
    // Boat-shaped: wider in the middle.
    const double x = 2 * u - 1;
    return dvec3(kHalfTable * x, kTableTop, (0.78 - 0.2 * x * x) * (1 - 2 * v));
  };
  table.add(palette.walnut, slab(48, 4, top, dvec3(0, -0.04, 0)));
  table.add(palette.dark, moved(rounded_box({0.5, 0.006, 0.09}, 0.004, 1), {0, kTableTop + 0.004, 0}));
  for (const double x : {-1.35, 1.35}) {
    table.add(palette.walnut, moved(rounded_box({0.07, 0.33, 0.28}, 0.02, 2), {x, 0.37, 0}));
    table.add(palette.chrome, moved(rounded_box({0.13, 0.02, 0.42}, 0.015, 2), {x, 0.022, 0}));
  }
  scene.place(std::move(table));

  const std::uint32_t chairs = scene.add(chair(palette));
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    const double x = -1.72 + 0.86 * i, z = 1.05 - 0.03 * (i - 2) * (i - 2);
    for (const double side : {1, -1}) {
      // Nobody pushes a chair quite straight.
      const double dx = random.between(-0.04, 0.04), dz = random.between(0, 0.14), turn = random.between(-0.06, 0.06);
      scene.place(chairs, {x + dx, 0, side * (z + dz)}, (side > 0 ? 0 : 0.5) + turn);
    }
  }
  scene.place(chairs, {-2.75, 0, 0.05}, -0.25);
  scene.place(chairs, {2.85, 0, -0.1}, 0.2);
}

void add_things(Scene& scene, const Palette& palette) {
  Mesh laptop{"laptop", {}};
  laptop.add(palette.chrome, moved(rounded_box({0.16, 0.008, 0.11}, 0.006, 2), {0, 0.008, 0}));
  laptop.add(palette.dark, box({-0.14, 0.0155, -0.08}, {0.14, 0.0175, 0.02}));
  const auto lid = [](Shape shape) { return moved(turned(shape, {1, 0, 0}, -0.05), {0, 0.012, -0.11}); };
  laptop.add(palette.chrome, lid(moved(rounded_box({0.16, 0.1, 0.005}, 0.004, 2), {0, 0.1, 0})));
  laptop.add(palette.screen, lid(box({-0.15, 0.015, 0.005}, {0.15, 0.19, 0.0065})));
  Mesh glass{"glass", {}};
  glass.add(
      palette.glass,
      lathe({{0, 0}, {0.028, 0, true}, {0.034, 0.11, true}, {0.032, 0.11, true}, {0.026, 0.008, true}, {0, 0.008}},
            32));
  Mesh jug{"jug", {}};
  jug.add(palette.glass, lathe({{0, 0},
                                {0.06, 0, true},
                                {0.075, 0.03},
                                {0.078, 0.1},
                                {0.06, 0.17},
                                {0.045, 0.21},
                                {0.055, 0.25, true},
                                {0.05, 0.25, true},
                                {0.04, 0.21},
                                {0.055, 0.17},
                                {0.07, 0.1},
                                {0, 0.02}},
                               40));
  jug.add(palette.glass, rod({{0.05, 0.22, 0}, {0.115, 0.21, 0}, {0.12, 0.12, 0}, {0.074, 0.07, 0}}, 0.009, 10));
  Mesh paper{"paper", {}};
  paper.add(palette.white, box({-0.105, 0, -0.148}, {0.105, 0.006, 0.148}));
  paper.add(palette.dark, rod({{0.13, 0.006, -0.06}, {0.13, 0.006, 0.08}}, 0.005, 8));
  const std::uint32_t laptops = scene.add(std::move(laptop)), glasses = scene.add(std::move(glass));
  const std::uint32_t papers = scene.add(std::move(paper));
  for (int i = 0; i < 5; ++i) {
    const double x = -1.72 + 0.86 * i;
    for (const double side : {-1, 1}) {
      const double turn = side < 0 ? 0.5 : 0;
      const bool has_laptop = (i + (side < 0 ? 1 : 0)) % 2 == 0;
      scene.place(has_laptop ? laptops : papers, {x, kTableTop, side * 0.5}, turn + 0.015 * (i - 2));
      scene.place(glasses, {x + 0.26, kTableTop, side * 0.42});
    }
  }
  scene.place(std::move(jug), {0.95, kTableTop, 0.02});

  Mesh plant{"plant", {}};
  plant.add(palette.clay,
            lathe({{0, 0}, {0.16, 0, true}, {0.22, 0.42, true}, {0.2, 0.42, true}, {0.19, 0.36, true}, {0, 0.36}}, 32));
  Random random(9);
  for (int i = 0; i < 260; ++i) {
    const double up = random.between(0, 1), spread = 0.36 * (1.2 - up) * random.between(0.2, 1);
    const double length = random.between(0.16, 0.3), tilt = random.between(-0.14, 0.1);
    const Shape blade = turned(leaf(length, 0.09, 0.015), {1, 0, 0}, tilt);
    plant.add(palette.leaf,
              moved(turned(moved(blade, {0, 0, spread}), {0, 1, 0}, random.next()), {0, 0.5 + 0.95 * up, 0}));
  }
  plant.add(palette.walnut, rod({{0, 0.35, 0}, {0.02, 0.9, 0.01}, {-0.01, 1.4, 0}}, 0.018, 8));
  scene.place(std::move(plant), {-4, 0, -2.65});
}

void add_lamps(Scene& scene, const Palette& palette) {
  Mesh pendant{"pendant lamp", {}};
  pendant.add(palette.dark, rod({{0, 0.3, 0}, {0, 1.1, 0}}, 0.008, 8));
  // Down inside, up outside: a bell with a wall.
  pendant.add(palette.dark, lathe({{0, 0.25},
                                   {0.09, 0.2},
                                   {0.19, 0.11},
                                   {0.232, 0, true},
                                   {0.24, 0, true},
                                   {0.2, 0.12},
                                   {0.1, 0.22},
                                   {0.035, 0.27},
                                   {0.03, 0.32, true},
                                   {0, 0.32}},
                                  40));
  pendant.add(palette.lamp, moved(sphere(0.07, 24, 16), {0, 0.13, 0}));
  const std::uint32_t pendants = scene.add(std::move(pendant));
  for (const double x : {-1.4, 0.0, 1.4}) scene.place(pendants, {x, 1.9, 0});
  Mesh panel{"ceiling lamp", {}};
  panel.add(palette.white, moved(rounded_box({0.62, 0.025, 0.17}, 0.01, 1), {0, -0.025, 0}));
  panel.add(palette.lamp, box({-0.58, -0.056, -0.13}, {0.58, -0.05, 0.13}));
  const std::uint32_t panels = scene.add(std::move(panel));
  for (const double x : {-2.6, 0.0, 2.6}) {
    for (const double z : {-1.9, 1.9}) scene.place(panels, {x, kHeight, z});
  }
}

}  // namespace

Scene conference() {
  Scene scene;
  scene.name = "conference";
  scene.camera = {{3.9, 1.75, 2.75}, {-0.9, 0.75, -0.75}, 0.88};
  const Palette palette = add_materials(scene);
  add_room(scene, palette);
  add_blinds(scene, palette);
  add_table(scene, palette);
  add_things(scene, palette);
  add_lamps(scene, palette);
  scene.lights = {
      {"sun", LightType::directional, {1, 0.86, 0.66}, 7, {1.5, 3.4, -5}, {0, 0, 0}},
      {"left pendant", LightType::spot, {1, 0.88, 0.7}, 9, {-1.4, 1.95, 0}, {-1.4, 0, 0}, 0.5, 1.1},
      {"right pendant", LightType::spot, {1, 0.88, 0.7}, 9, {1.4, 1.95, 0}, {1.4, 0, 0}, 0.5, 1.1},
      {"room", LightType::point, {0.95, 0.96, 1}, 36, {3.2, 2.05, 2.9}},
  };
  return scene;
}

}  // namespace umbrix::scenes
