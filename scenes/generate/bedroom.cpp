// SPDX-License-Identifier: Apache-2.0
// A bedroom on a sunny morning: cloth with folds, blinds that cut the light into stripes, small things on shelves.
#include <initializer_list>

#include "cloth.h"
#include "numbers.h"
#include "scene.h"

namespace umbrix::scenes {
namespace {

using glm::dvec3;

constexpr double kLeft = -2.3, kRight = 2.3, kBack = -2, kFront = 2.4, kHeight = 2.6;
constexpr double kBedX = -0.35;
constexpr dvec3 kMattress(0.78, 0.56, 1);  // half the width, height, half the length

struct Palette {
  std::uint32_t wall, white, linen, duvet, throw_cloth, oak, dark_oak, brass, shade, rug, rug_edge, curtain;
};

Palette add_materials(Scene& scene) {
  return {scene.add(Material{"wall", {0.62, 0.66, 0.64}, 0.95}),
          scene.add(Material{"white", {0.8, 0.79, 0.76}, 0.7}),
          scene.add(Material{"linen", {0.82, 0.8, 0.75}, 0.95}),
          scene.add(Material{"duvet", {0.35, 0.47, 0.58}, 0.95}),
          scene.add(Material{"throw", {0.68, 0.32, 0.16}, 0.95}),
          scene.add(Material{"oak", {0.45, 0.29, 0.16}, 0.55}),
          scene.add(Material{"dark oak", {0.25, 0.14, 0.08}, 0.5}),
          scene.add(Material{"brass", {0.85, 0.6, 0.28}, 0.35, 0.7}),
          scene.add(Material{"lamp shade", {0.8, 0.7, 0.5}, 0.9, 0, {0.95, 0.66, 0.34}}),
          scene.add(Material{"rug", {0.6, 0.5, 0.38}, 1}),
          scene.add(Material{"rug edge", {0.42, 0.12, 0.1}, 1}),
          scene.add(Material{"curtain", {0.72, 0.66, 0.52}, 0.95})};
}

void add_room(Scene& scene, const Palette& palette) {
  Mesh room{"room", {}};
  const double out = 0.15;
  room.add(palette.wall, box({kLeft - out, 0, kBack - out}, {kRight + out, kHeight, kBack}));
  room.add(palette.wall, box({kRight, 0, kBack}, {kRight + out, kHeight, kFront}));
  room.add(palette.wall, box({kLeft - out, 0, kFront}, {kRight + out, kHeight, kFront + out}));
  room.add(palette.white, box({kLeft - out, kHeight, kBack - out}, {kRight + out, kHeight + out, kFront + out}));
  room.add(palette.dark_oak, box({kLeft - out, -out, kBack - out}, {kRight + out, -0.02, kFront + out}));
  // The left wall, around the window (0.8 to 2.2 high, z from -1 to 0.9).
  room.add(palette.wall, box({kLeft - out, 0, kBack}, {kLeft, 0.8, kFront}));
  room.add(palette.wall, box({kLeft - out, 2.2, kBack}, {kLeft, kHeight, kFront}));
  room.add(palette.wall, box({kLeft - out, 0.8, kBack}, {kLeft, 2.2, -1}));
  room.add(palette.wall, box({kLeft - out, 0.8, 0.9}, {kLeft, 2.2, kFront}));
  room.add(palette.white, box({kLeft - out, 0.76, -1.08}, {kLeft + 0.1, 0.8, 0.98}));
  for (const double z : {-0.98, -0.05, 0.88})
    room.add(palette.white, box({kLeft - 0.14, 0.8, z - 0.03}, {kLeft - 0.09, 2.2, z + 0.03}));
  room.add(palette.white, box({kLeft - 0.15, 1.48, -1}, {kLeft - 0.1, 1.52, 0.9}));
  room.add(palette.white, box({kLeft, 0, kBack}, {kRight, 0.1, kBack + 0.015}));
  room.add(palette.white, box({kRight - 0.015, 0, kBack + 0.015}, {kRight, 0.1, kFront}));
  scene.place(std::move(room));

  const std::uint32_t tones[] = {scene.add(Material{"plank", {0.42, 0.27, 0.15}, 0.45}),
                                 scene.add(Material{"dark plank", {0.36, 0.22, 0.12}, 0.45}),
                                 scene.add(Material{"light plank", {0.48, 0.32, 0.18}, 0.45})};
  std::uint32_t planks[3];
  for (int i = 0; i < 3; ++i) {
    planks[i] = scene.add(Mesh{"plank", {}});
    scene.meshes.back().add(tones[i], rounded_box({1.145, 0.015, 0.068}, 0.004, 1));
  }
  Random random(5);
  for (int row = 0; row < 32; ++row) {
    for (int piece = 0; piece < 2; ++piece) {
      scene.place(planks[random.below(3)], {-1.15 + 2.3 * piece, -0.015, kBack + 0.07 + 0.14 * row});
    }
  }
}

void add_window(Scene& scene, const Palette& palette) {
  Mesh slat{"slat", {}};
  slat.add(palette.white, slab(
                              1, 4,
                              [](double u, double v) {
                                const double across = 2 * v - 1;
                                return dvec3(0.028 * across, 0.006 * (1 - across * across), 0.93 * (2 * u - 1));
                              },
                              dvec3(0, -0.0015, 0)));
  const std::uint32_t slats = scene.add(std::move(slat));
  for (int i = 0; i < 30; ++i) {
    scene.nodes.push_back({slats, {kLeft - 0.05, 0.86 + 0.044 * i, -0.05}, rotation({0, 0, 1}, -0.05), {1, 1, 1}});
  }
  Mesh curtain{"curtain", {}};
  curtain.add(palette.curtain, slab(
                                   64, 20,
                                   [](double u, double v) {
                                     const double fold = sin_turns(7.5 * u + 0.12 * noise(2 * u, 3 * v, 3));
                                     return dvec3(0.045 * fold * (1.25 - 0.5 * v), 0.05 + 2.3 * v,
                                                  0.3 * (1 - 2 * u) * (1.1 - 0.15 * v));
                                   },
                                   dvec3(-0.008, 0, 0)));
  const std::uint32_t curtains = scene.add(std::move(curtain));
  scene.place(curtains, {kLeft + 0.12, 0, -1.25});
  scene.place(curtains, {kLeft + 0.12, 0, 1.15});
  Mesh rail{"curtain rail", {}};
  rail.add(palette.brass, rod({{kLeft + 0.12, 2.38, -1.7}, {kLeft + 0.12, 2.38, 1.6}}, 0.016, 16));
  scene.place(std::move(rail));
  const std::uint32_t outside = scene.add(Material{"outside", {0, 0, 0}, 1, 0, {0.72, 0.86, 1}});
  Mesh garden{"outside", {}};
  garden.add(outside, box({-5.1, -1, -5}, {-5, 2.4, 5}));
  scene.place(std::move(garden));
}

void add_bed(Scene& scene, const Palette& palette) {
  Mesh bed{"bed", {}};
  bed.add(palette.oak, moved(rounded_box({0.86, 0.09, 1.03}, 0.02, 2), {0, 0.26, 0}));
  bed.add(palette.oak, moved(rounded_box({0.9, 0.55, 0.04}, 0.03, 3), {0, 0.6, -1.07}));
  for (const double x : {-0.78, 0.78}) {
    for (const double z : {-0.95, 0.95}) bed.add(palette.oak, box({x - 0.04, 0, z - 0.04}, {x + 0.04, 0.2, z + 0.04}));
  }
  bed.add(palette.linen, moved(rounded_box({0.79, 0.11, 1}, 0.05, 4), {0, 0.45, 0}));
  bed.add(palette.duvet, cloth_over(kMattress, 2.2, -0.42, 1.3, 0.06, 0.045, 64, 52));
  bed.add(palette.linen, cloth_over(kMattress, 2.1, -0.62, -0.3, 0.085, 0.03, 56, 10));
  bed.add(palette.throw_cloth, cloth_over(kMattress, 2.3, 0.35, 0.85, 0.1, 0.045, 56, 16));
  for (const double x : {-0.38, 0.38}) {
    bed.add(palette.linen, moved(turned(cushion({0.34, 0.1, 0.23}, x < 0 ? 1 : 2), {1, 0, 0}, 0.1), {x, 0.7, -0.8}));
  }
  bed.add(palette.throw_cloth, moved(turned(cushion({0.2, 0.075, 0.2}, 3), {1, 0, 0}, 0.16), {0.05, 0.78, -0.6}));
  scene.place(std::move(bed), {kBedX, 0, kBack + 1.12});
}

void add_bedside(Scene& scene, const Palette& palette) {
  Mesh table{"bedside table", {}};
  table.add(palette.oak, moved(rounded_box({0.22, 0.015, 0.19}, 0.01, 2), {0, 0.5, 0}));
  table.add(palette.oak, box({-0.2, 0.3, -0.17}, {0.2, 0.486, 0.17}));
  table.add(palette.dark_oak, box({-0.18, 0.32, 0.17}, {0.18, 0.465, 0.178}));
  table.add(palette.brass, moved(sphere(0.014, 16, 10), {0, 0.39, 0.19}));
  for (const double x : {-0.18, 0.18}) {
    for (const double z : {-0.15, 0.15})
      table.add(palette.oak, box({x - 0.018, 0, z - 0.018}, {x + 0.018, 0.3, z + 0.018}));
  }
  Mesh lamp{"lamp", {}};
  lamp.add(palette.brass, lathe({{0, 0},
                                 {0.075, 0, true},
                                 {0.078, 0.012},
                                 {0.06, 0.022},
                                 {0.02, 0.035},
                                 {0.03, 0.08},
                                 {0.055, 0.14},
                                 {0.045, 0.2},
                                 {0.014, 0.25},
                                 {0.01, 0.3},
                                 {0, 0.302}},
                                40));
  // The profile returns to its start: a ring that is open above and below.
  lamp.add(
      palette.shade,
      lathe({{0.145, 0.26, true}, {0.15, 0.26, true}, {0.095, 0.45, true}, {0.09, 0.45, true}, {0.145, 0.26}}, 48));
  const std::uint32_t tables = scene.add(std::move(table)), lamps = scene.add(std::move(lamp));
  for (const double x : {kBedX - 1.2, kBedX + 1.2}) {
    scene.place(tables, {x, 0, kBack + 0.25});
    scene.place(lamps, {x, 0.515, kBack + 0.22});
  }
}

void add_shelf(Scene& scene, const Palette& palette) {
  constexpr double kX = 1.35, kHalf = 0.5, kDepth = 0.26;
  Mesh shelf{"shelf", {}};
  for (int i = 0; i < 3; ++i) {
    const double y = 1.15 + 0.4 * i;
    shelf.add(palette.oak, moved(rounded_box({kHalf, 0.015, kDepth / 2}, 0.005, 1), {kX, y, kBack + kDepth / 2}));
  }
  for (const double x : {kX - kHalf + 0.02, kX + kHalf - 0.02}) {
    shelf.add(palette.dark_oak, box({x - 0.012, 1.0, kBack}, {x + 0.012, 2.05, kBack + 0.03}));
  }
  scene.place(std::move(shelf));

  const dvec3 colors[] = {{0.5, 0.1, 0.08}, {0.1, 0.2, 0.35}, {0.12, 0.3, 0.18}, {0.7, 0.55, 0.25}, {0.4, 0.38, 0.36}};
  std::uint32_t books[5];
  for (int i = 0; i < 5; ++i) {
    Mesh book{"book", {}};
    const std::uint32_t cover = scene.add(Material{"book cover", colors[i], 0.6});
    // A unit book: spine towards +z, scaled where it stands.
    book.add(cover, box({0, 0, 0}, {0.1, 1, 1}));
    book.add(cover, box({0.9, 0, 0}, {1, 1, 1}));
    book.add(cover, box({0.1, 0, 0.93}, {0.9, 1, 1}));
    book.add(palette.white, box({0.1, 0.03, 0.05}, {0.9, 0.97, 0.93}));
    books[i] = scene.add(std::move(book));
  }
  Random random(8);
  for (int row = 0; row < 3; ++row) {
    const double y = 1.165 + 0.4 * row, end = kX + kHalf - (row == 1 ? 0.36 : 0.2);
    for (double x = kX - kHalf + 0.05; x < end;) {
      const double thick = random.between(0.018, 0.05), tall = random.between(0.19, 0.31);
      const double deep = random.between(0.15, 0.2);
      scene.place(books[random.below(5)], {x, y, kBack + 0.03}, 0, {thick, tall, deep});
      x += thick + (random.below(9) == 0 ? 0.03 : 0.001);
    }
  }
  Mesh pot{"pot", {}};
  pot.add(palette.throw_cloth, lathe({{0, 0},
                                      {0.05, 0, true},
                                      {0.09, 0.06},
                                      {0.095, 0.1},
                                      {0.07, 0.16},
                                      {0.045, 0.19},
                                      {0.055, 0.21, true},
                                      {0.045, 0.21},
                                      {0.035, 0.19},
                                      {0, 0.12}},
                                     40));
  scene.place(std::move(pot), {kX + 0.32, 1.565, kBack + 0.13});
}

void add_rest(Scene& scene, const Palette& palette) {
  const auto pile = [](double half_x, double half_z, double top, std::uint32_t seed) {
    return slab(
        36, 20,
        [=](double u, double v) {
          const double x = half_x * (2 * u - 1), z = half_z * (1 - 2 * v);
          return dvec3(x, top + 0.004 * noise(16 * x, 16 * z, seed), z);
        },
        dvec3(0, -0.012, 0));
  };
  Mesh rug{"rug", {}};
  rug.add(palette.rug_edge, pile(1.15, 0.62, 0.016, 1));
  rug.add(palette.rug, pile(1.0, 0.5, 0.024, 2));
  rug.add(palette.rug_edge, pile(0.5, 0.25, 0.032, 3));
  scene.place(std::move(rug), {-0.1, 0.001, 1.15}, 0.01);

  const std::uint32_t sea = scene.add(Material{"sea", {0.12, 0.32, 0.42}, 0.9});
  const std::uint32_t sun = scene.add(Material{"painted sun", {0.85, 0.45, 0.2}, 0.9});
  Mesh picture{"picture", {}};
  picture.add(palette.dark_oak, moved(rounded_box({0.52, 0.34, 0.02}, 0.01, 2), {0, 0, 0.02}));
  picture.add(palette.linen, box({-0.48, -0.3, 0.03}, {0.48, 0.3, 0.045}));
  picture.add(sea, slab(
                       48, 1,
                       [](double u, double v) {
                         return dvec3(0.96 * u - 0.48, -0.3 + v * (0.24 + 0.05 * noise(5 * u, 2, 4)), 0.052);
                       },
                       dvec3(0, 0, -0.01)));
  picture.add(sun,
              moved(turned(lathe({{0, -0.006}, {0.09, -0.006, true}, {0.09, 0, true}, {0, 0}}, 48), {1, 0, 0}, 0.25),
                    {0.16, 0.09, 0.052}));
  scene.place(std::move(picture), {kBedX, 1.7, kBack});
}

}  // namespace

Scene bedroom() {
  Scene scene;
  scene.name = "bedroom";
  scene.quantized = true;
  scene.camera = {{1.75, 1.5, 2.25}, {-0.3, 0.85, -1}, 0.93};
  const Palette palette = add_materials(scene);
  add_room(scene, palette);
  add_window(scene, palette);
  add_bed(scene, palette);
  add_bedside(scene, palette);
  add_shelf(scene, palette);
  add_rest(scene, palette);
  scene.lights = {
      {"sun", LightType::directional, {1, 0.9, 0.72}, 9, {-6, 4, 1.2}, {0, 0, 0}},
      {"lamp", LightType::point, {1, 0.72, 0.42}, 1, {kBedX + 1.2, 0.9, kBack + 0.22}},
      {"room", LightType::point, {0.9, 0.94, 1}, 23, {1.2, 2.3, 1.7}},
      {"picture light", LightType::spot, {1, 0.85, 0.65}, 4, {kBedX, 2.55, kBack + 0.9}, {kBedX, 1.6, kBack}, 0.2, 0.5},
  };
  return scene;
}

}  // namespace umbrix::scenes
