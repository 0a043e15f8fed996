// SPDX-License-Identifier: Apache-2.0
// The building blocks of the atrium; their dimensions follow the orders loosely (Vignola 1562).
#include "atrium_parts.h"

#include <algorithm>

#include "numbers.h"

namespace umbrix::scenes::atrium_parts {

using glm::dvec3;

Palette add_materials(Scene& scene) {
  return {scene.add(Material{"sandstone", {0.63, 0.52, 0.38}, 0.85}),
          scene.add(Material{"pale stone", {0.74, 0.67, 0.55}, 0.7}),
          scene.add(Material{"plaster", {0.66, 0.5, 0.36}, 0.95}),
          scene.add(Material{"terracotta", {0.5, 0.22, 0.12}, 0.8}),
          scene.add(Material{"wood", {0.22, 0.12, 0.06}, 0.6}),
          scene.add(Material{"iron", {0.08, 0.08, 0.09}, 0.5, 0.5}),
          scene.add(Material{"water", {0.08, 0.24, 0.27}, 0.15}),
          scene.add(Material{"leaf", {0.13, 0.25, 0.05}, 0.7, 0, {0, 0, 0}, true}),
          scene.add(Material{"lantern", {0.8, 0.6, 0.3}, 0.8, 0, {1, 0.72, 0.36}}),
          scene.add(Material{"red cloth", {0.55, 0.06, 0.05}, 0.9}),
          scene.add(Material{"blue cloth", {0.07, 0.14, 0.4}, 0.9}),
          scene.add(Material{"gold cloth", {0.75, 0.5, 0.12}, 0.8})};
}

namespace {

/// An acanthus leaf that stands on the bell of a capital and curls outwards at its tip.
Shape capital_leaf(double height, double base_radius, int detail) {
  const Surface face = [=](double u, double v) {
    const double side = 2 * u - 1;
    const double width = 0.075 * (1 - 0.75 * v * v * v);
    const double curl = v * v * v;
    const double rib = 0.012 * (1 - side * side);
    return dvec3(side * width, height * (v - 0.22 * curl * v), base_radius + 0.03 * v + 0.1 * curl + rib);
  };
  return slab(detail, detail + 2, face, [=](double u, double v) { return face(u, v) - dvec3(0, -0.012, 0.025); });
}

}  // namespace

Mesh column(const Palette& palette, const char* name, int detail, int flutes) {
  Mesh mesh{name, {}};
  mesh.add(palette.pale, box({-0.42, 0, -0.42}, {0.42, 0.2, 0.42}));
  mesh.add(palette.pale, lathe({{0, 0.2},
                                {0.36, 0.2, true},
                                {0.4, 0.22},
                                {0.41, 0.26},
                                {0.4, 0.3},
                                {0.36, 0.32, true},
                                {0.34, 0.34},
                                {0.33, 0.37},
                                {0.34, 0.4, true},
                                {0.37, 0.41},
                                {0.375, 0.44},
                                {0.36, 0.47, true},
                                {0.31, 0.48, true},
                                {0.29, 0.55, true},
                                {0, 0.55}},
                               6 * detail));
  // A slight swelling (entasis) keeps the shaft from looking waisted.
  mesh.add(palette.sandstone,
           lathe({{0, 0.5}, {0.285, 0.5, true}, {0.285, 1.1}, {0.275, 1.8}, {0.245, 2.62, true}, {0, 2.62}},
                 flutes == 0 ? 6 * detail : 6 * flutes, flutes, 0.07));
  mesh.add(palette.pale, lathe({{0, 2.58},
                                {0.255, 2.58, true},
                                {0.28, 2.6},
                                {0.28, 2.64},
                                {0.255, 2.66, true},
                                {0.24, 2.7},
                                {0.245, 2.9},
                                {0.29, 3.1},
                                {0.37, 3.22, true},
                                {0, 3.22}},
                               32));
  for (int i = 0; i < 8; ++i) {
    mesh.add(palette.pale, moved(turned(capital_leaf(0.32, 0.235, detail), {0, 1, 0}, i / 8.0), {0, 2.67, 0}));
    mesh.add(palette.pale, moved(turned(capital_leaf(0.52, 0.24, detail), {0, 1, 0}, (i + 0.5) / 8), {0, 2.67, 0}));
  }
  mesh.add(palette.pale, moved(rounded_box({0.42, 0.035, 0.42}, 0.02, 2), {0, 3.255, 0}));
  mesh.add(palette.pale, box({-0.45, 3.29, -0.45}, {0.45, 3.4, 0.45}));
  return mesh;
}

Mesh arcade(const Palette& palette, const char* name, double width, double radius, double top) {
  const double depth = 0.6;
  Mesh mesh{name, {}};
  mesh.add(palette.plaster, arch(radius, top, depth, 32));
  for (const double side : {-1, 1}) {
    const double inner = side * radius, outer = side * width / 2;
    mesh.add(palette.plaster, box({std::min(inner, outer), 0, -depth / 2}, {std::max(inner, outer), top, depth / 2}));
  }
  mesh.add(palette.pale, half_ring(radius, radius + 0.12, depth + 0.1, 32));
  mesh.add(palette.sandstone, half_ring(radius + 0.12, radius + 0.24, depth + 0.04, 32));
  mesh.add(palette.pale, moved(rounded_box({0.11, 0.2, depth / 2 + 0.1}, 0.02, 1), {0, radius + 0.12, 0}));
  return mesh;
}

Mesh cornice(const Palette& palette, double width) {
  Mesh mesh{"cornice", {}};
  const double half = width / 2;
  mesh.add(palette.pale, box({-half, 0, -0.3}, {half, 0.06, 0.36}));
  mesh.add(palette.pale, box({-half, 0.14, -0.3}, {half, 0.2, 0.5}));
  mesh.add(palette.pale, box({-half, 0.2, -0.3}, {half, 0.3, 0.56}));
  mesh.add(palette.pale, box({-half, 0.06, -0.3}, {half, 0.14, 0.38}));
  const int dentils = static_cast<int>(width / 0.16);
  for (int i = 0; i < dentils; ++i) {
    const double x = -half + width * (i + 0.5) / dentils;
    mesh.add(palette.pale, box({x - 0.045, 0.07, 0.37}, {x + 0.045, 0.14, 0.46}));
  }
  return mesh;
}

Mesh balustrade(const Palette& palette, double width) {
  Mesh mesh{"balustrade", {}};
  const double half = width / 2 - 0.16;
  mesh.add(palette.pale, box({-half, 0, -0.1}, {half, 0.08, 0.1}));
  mesh.add(palette.pale, moved(rounded_box({half, 0.05, 0.14}, 0.03, 2), {0, 0.83, 0}));
  mesh.add(palette.pale, box({half, 0, -0.16}, {width - half, 0.92, 0.16}));
  const int count = static_cast<int>(width / 0.3);
  const Shape baluster = lathe({{0, 0.08},
                                {0.07, 0.08, true},
                                {0.07, 0.12, true},
                                {0.04, 0.14},
                                {0.055, 0.2},
                                {0.075, 0.28},
                                {0.07, 0.36},
                                {0.04, 0.5},
                                {0.032, 0.62},
                                {0.045, 0.66, true},
                                {0.06, 0.7, true},
                                {0.06, 0.78, true},
                                {0, 0.78}},
                               12);
  for (int i = 0; i < count; ++i) {
    mesh.add(palette.pale, moved(baluster, {-half + 2 * half * (i + 0.5) / count, 0, 0}));
  }
  return mesh;
}

Mesh paving(const Palette& palette) {
  Mesh mesh{"paving", {}};
  const Shape slab = rounded_box({0.49, 0.05, 0.49}, 0.012, 1);
  for (int i = 0; i < 16; ++i) {
    const int x = i % 4, z = i / 4;
    const bool dark = (x + z) % 2 == 0;
    mesh.add(dark ? palette.terracotta : palette.pale, moved(slab, {x - 1.5, 0, z - 1.5}));
  }
  return mesh;
}

Mesh door(const Palette& palette) {
  Mesh mesh{"door", {}};
  const Surface face = [](double u, double v) {
    return dvec3(-0.8 * cos_turns(u / 2), v * (2 + 0.8 * sin_turns(u / 2)), 0.06);
  };
  mesh.add(palette.wood, slab(24, 1, face, dvec3(0, 0, -0.1)));
  mesh.add(palette.pale, moved(half_ring(0.8, 1, 0.3, 24), {0, 2, 0}));
  for (const double side : {-1, 1}) {
    mesh.add(palette.pale, box({side * 0.9 - 0.1, 0, -0.15}, {side * 0.9 + 0.1, 2, 0.15}));
    mesh.add(palette.iron, moved(sphere(0.05, 12, 8), {side * 0.12, 1.2, 0.09}));
  }
  mesh.add(palette.iron, box({-0.012, 0, 0.05}, {0.012, 2.78, 0.075}));
  for (const double y : {0.5, 1.1, 1.7, 2.2}) mesh.add(palette.iron, box({-0.72, y, 0.05}, {0.72, y + 0.05, 0.072}));
  return mesh;
}

Mesh coffers(const Palette& palette) {
  Mesh mesh{"coffers", {}};
  const double half = (kOuter - kHalfWidth) / 2;
  for (int i = -2; i <= 2; ++i) mesh.add(palette.wood, box({-half, -0.22, i - 0.09}, {half, 0.02, i + 0.09}));
  for (int i = -1; i <= 1; ++i) {
    for (int bay = 0; bay < 4; ++bay) {
      mesh.add(palette.wood, box({i * 0.9 - 0.07, -0.18, bay - 1.91}, {i * 0.9 + 0.07, 0.01, bay - 1.09}));
    }
  }
  return mesh;
}

Mesh banner(std::uint32_t cloth, std::uint32_t hem, const Palette& palette, int seed) {
  Mesh mesh{"banner", {}};
  const Surface face = [=](double u, double v) {
    const double down = 1 - v, point = 0.35 * (1 - (2 * u - 1) * (2 * u - 1)) * (v < 0.2 ? 1 - v / 0.2 : 0);
    const double billow = 0.1 * down * sin_turns(0.7 * u + 0.9 * down + 0.3 * seed) + 0.06 * noise(3 * u, 4 * v, 7);
    return dvec3(1.3 * (u - 0.5), -2.6 * down - point, billow * (0.2 + down));
  };
  mesh.add(cloth, slab(16, 32, face, dvec3(0, 0, -0.012)));
  mesh.add(hem, slab(
                    16, 1, [&](double u, double v) { return face(u, 0.09 + 0.04 * v) + dvec3(0, 0, 0.006); },
                    dvec3(0, 0, -0.024)));
  mesh.add(palette.iron, rod({{-0.8, 0, 0}, {0.8, 0, 0}}, 0.025, 10));
  return mesh;
}

Mesh lantern(const Palette& palette) {
  Mesh mesh{"lantern", {}};
  mesh.add(palette.iron, rod({{0, 0, 0}, {0, -0.9, 0}}, 0.012, 6));
  mesh.add(palette.iron, lathe({{0, -1.05}, {0.17, -1.05, true}, {0.17, -1.02, true}, {0.03, -0.9}, {0, -0.88}}, 6));
  mesh.add(palette.lantern, lathe({{0, -1.4}, {0.09, -1.4, true}, {0.14, -1.05, true}, {0, -1.05}}, 6));
  mesh.add(palette.iron, lathe({{0, -1.46}, {0.06, -1.45}, {0.11, -1.42, true}, {0.11, -1.39, true}, {0, -1.39}}, 6));
  return mesh;
}

Mesh fountain(const Palette& palette) {
  Mesh mesh{"fountain", {}};
  mesh.add(palette.pale, lathe({{0, 0},
                                {1.6, 0, true},
                                {1.6, 0.12, true},
                                {1.4, 0.14, true},
                                {1.36, 0.2},
                                {1.38, 0.42},
                                {1.48, 0.5, true},
                                {1.5, 0.58},
                                {1.46, 0.6, true},
                                {1.3, 0.6, true},
                                {1.26, 0.2, true},
                                {0, 0.2}},
                               8));
  mesh.add(palette.water, lathe({{0, 0.4}, {1.25, 0.4, true}, {1.25, 0.5, true}, {0, 0.5}}, 8));
  mesh.add(palette.pale, lathe({{0, 0.1},
                                {0.3, 0.1, true},
                                {0.3, 0.62},
                                {0.16, 0.72},
                                {0.12, 0.9},
                                {0.16, 1.08},
                                {0.3, 1.16},
                                {0.6, 1.26},
                                {0.75, 1.4, true},
                                {0.7, 1.41, true},
                                {0.5, 1.32},
                                {0.14, 1.3, true},
                                {0.09, 1.4},
                                {0.08, 1.62},
                                {0.16, 1.72},
                                {0.12, 1.84},
                                {0, 1.92}},
                               48));
  mesh.add(palette.water, lathe({{0, 1.36}, {0.66, 1.37, true}, {0.66, 1.385, true}, {0, 1.39}}, 48));
  return mesh;
}

Mesh potted_palm(const Palette& palette) {
  Mesh mesh{"potted palm", {}};
  mesh.add(palette.terracotta, lathe({{0, 0},
                                      {0.24, 0, true},
                                      {0.26, 0.08},
                                      {0.36, 0.45},
                                      {0.38, 0.58, true},
                                      {0.43, 0.6},
                                      {0.43, 0.68, true},
                                      {0.37, 0.68, true},
                                      {0.35, 0.58, true},
                                      {0, 0.58}},
                                     32));
  Random random(11);
  for (int frond = 0; frond < 22; ++frond) {
    const double around = frond * 0.382, rise = random.between(0.5, 1.5), reach = 1.5 - 0.75 * rise;
    const auto spine = [&](double t) { return dvec3(0, 0.58 + rise * t - 0.55 * reach * t * t * t, reach * t); };
    for (int i = 3; i < 26; ++i) {
      const double t = i / 26.0, length = 0.34 * (1.15 - t) + 0.05;
      for (const double side : {-1, 1}) {
        Shape blade = leaf(length, 0.05, 0.008);
        blade = turned(turned(blade, {1, 0, 0}, 0.04 + 0.05 * t), {0, 1, 0}, side * (0.19 - 0.09 * t));
        mesh.add(palette.leaf, turned(moved(blade, spine(t)), {0, 1, 0}, around));
      }
    }
    std::vector<Station> stem;
    for (int i = 0; i <= 6; ++i)
      stem.push_back(
          {turned(spine(i / 6.0), {0, 1, 0}, around), turned(dvec3(1, 0, 0), {0, 1, 0}, around), 0.014 - 0.0015 * i});
    mesh.add(palette.leaf, tube(stem, 5));
  }
  return mesh;
}

}  // namespace umbrix::scenes::atrium_parts
