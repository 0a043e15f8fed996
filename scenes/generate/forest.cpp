// SPDX-License-Identifier: Apache-2.0
// A path through a wood. Three trees, one tuft and one stone are stored once and stand in many places.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "numbers.h"
#include "scene.h"

namespace umbrix::scenes {
namespace {

using glm::dvec3;

constexpr double kHalfSize = 30;

struct Palette {
  std::uint32_t moss, earth, bark, pale_bark, leaf, light_leaf, needle, grass, stone, red, cream, wood, lantern, iron;
};

Palette add_materials(Scene& scene) {
  const auto foliage = [&](const char* name, const dvec3& color) {
    return scene.add(Material{name, color, 0.75, 0, {0, 0, 0}, true});
  };
  return {scene.add(Material{"moss", {0.17, 0.19, 0.07}, 1}),
          scene.add(Material{"earth", {0.3, 0.2, 0.11}, 1}),
          scene.add(Material{"bark", {0.22, 0.16, 0.11}, 0.95}),
          scene.add(Material{"pale bark", {0.5, 0.46, 0.4}, 0.9}),
          foliage("leaf", {0.22, 0.38, 0.07}),
          foliage("light leaf", {0.42, 0.4, 0.07}),
          foliage("needle", {0.12, 0.25, 0.07}),
          foliage("grass", {0.22, 0.34, 0.07}),
          scene.add(Material{"stone", {0.33, 0.32, 0.3}, 0.9}),
          scene.add(Material{"mushroom cap", {0.62, 0.07, 0.04}, 0.5}),
          scene.add(Material{"mushroom", {0.8, 0.74, 0.62}, 0.8}),
          scene.add(Material{"wood", {0.36, 0.24, 0.13}, 0.8}),
          scene.add(Material{"lantern", {0.8, 0.6, 0.3}, 0.8, 0, {1, 0.7, 0.32}}),
          scene.add(Material{"iron", {0.07, 0.07, 0.08}, 0.5, 0.5})};
}

double path(double z) { return 1.3 * sin_turns(z / 31) + 0.5 * sin_turns(z / 13); }

double height(double x, double z) {
  const double off = glm::clamp((std::abs(x - path(z)) - 0.7) / 2.5, 0.0, 1.0);
  const double hills = 0.8 * noise(x / 7, z / 7, 1) + 0.25 * noise(x / 2.5, z / 2.5, 2) + 0.5;
  const double rim = std::max(0.0, -z - 8) / 22;
  return off * off * (3 - 2 * off) * hills + 0.05 * noise(1.4 * x, 1.4 * z, 3) + 3.4 * rim * rim;
}

dvec3 on_ground(double x, double z, double above = 0) { return {x, height(x, z) + above, z}; }

/// Some direction across `along`, turned around it.
dvec3 across(const dvec3& along, double turns) {
  const dvec3 other = std::abs(along.y) > 0.7 ? dvec3(0.8, 0, 0.6) : dvec3(0, 1, 0);
  return turned(glm::normalize(glm::cross(along, other)), along, turns);
}

/// How one level of branches grows out of the one before.
struct Level {
  int stations, sides, children;
  double first_child;   ///< fraction of the length that stays bare
  double child_length;  ///< relative to this one
  double child_angle;   ///< turns
  double wander;        ///< change of direction from station to station
};

struct TreeKind {
  std::uint32_t wood, foliage;
  std::vector<Level> levels;
  int leaves;  ///< on each last branch
  double leaf_length, leaf_width, lift;
};

/// A branch, its branches, and on the last ones the leaves.
void grow(Mesh& tree, const TreeKind& kind, std::size_t depth, dvec3 at, dvec3 along, double length, double radius,
          Random& random) {
  const Level& level = kind.levels[depth];
  std::vector<Station> line;
  std::vector<dvec3> directions;
  for (int i = 0; i <= level.stations; ++i) {
    const double t = static_cast<double>(i) / level.stations;
    line.push_back(
        {at, across(along, 0), i == level.stations ? 0 : radius * (1 - 0.75 * t) * (depth == 0 && i == 0 ? 1.5 : 1)});
    directions.push_back(along);
    const dvec3 lift(0, kind.lift * (depth > 0 ? 1 : 0.3), 0);
    const double bend = level.wander * random.between(-1, 1);
    along = glm::normalize(along + bend * across(along, random.next()) + lift);
    at += along * (length / level.stations);
  }
  for (Station& s : line) s.up = across(directions.front(), 0.1);
  tree.add(kind.wood, tube(line, level.sides));

  const auto along_branch = [&](double t) {
    const double position = t * level.stations;
    const auto i = std::min(static_cast<std::size_t>(position), line.size() - 2);
    return line[i].point + (line[i + 1].point - line[i].point) * (position - static_cast<double>(i));
  };
  if (depth + 1 == kind.levels.size()) {
    for (int i = 0; i < kind.leaves; ++i) {
      const double t = 0.15 + 0.85 * (i + random.next()) / kind.leaves;
      const Shape one = leaf(kind.leaf_length * random.between(0.7, 1.2), kind.leaf_width, 0.2 * kind.leaf_width);
      const double roll = random.between(-0.15, 0.15), pitch = random.between(-0.08, 0.16);
      const Shape tilted = turned(turned(one, {0, 0, 1}, roll), {1, 0, 0}, pitch);
      tree.add(kind.foliage, moved(turned(tilted, {0, 1, 0}, random.next()), along_branch(t)));
    }
    return;
  }
  double spin = random.next();
  for (int i = 0; i < level.children; ++i) {
    const double t = level.first_child + (0.98 - level.first_child) * (i + 0.5) / level.children;
    const dvec3 parent = directions[static_cast<std::size_t>(t * level.stations)];
    spin += 0.381966;  // the golden angle, as leaves grow (Vogel 1979)
    const dvec3 child = turned(parent, across(parent, spin), level.child_angle * random.between(0.8, 1.2));
    const double shorter = depth == 0 ? 1.15 - 0.75 * t : 1;
    grow(tree, kind, depth + 1, along_branch(t), child, length * level.child_length * shorter,
         radius * (1 - 0.75 * t) * 0.6, random);
  }
}

Mesh tree(const char* name, const TreeKind& kind, double tall, double radius, std::uint32_t seed) {
  Mesh mesh{name, {}};
  Random random(seed);
  grow(mesh, kind, 0, {0, -0.25, 0}, {0, 1, 0}, tall, radius, random);
  return mesh;
}

/// Blades of three triangles, bent outwards.
Mesh tuft(const Palette& palette) {
  Mesh mesh{"grass", {}};
  Random random(6);
  for (int i = 0; i < 22; ++i) {
    const double tall = random.between(0.14, 0.36), bend = random.between(0.03, 0.16),
                 wide = random.between(0.008, 0.014);
    Shape blade;
    blade.smooth = false;
    blade.positions = {{-wide, -0.04, 0},
                       {wide, -0.04, 0},
                       {-0.8 * wide, 0.6 * tall, 0.35 * bend},
                       {0.8 * wide, 0.6 * tall, 0.35 * bend},
                       {0, tall, bend}};
    blade.triangles = {{0, 1, 3}, {0, 3, 2}, {2, 3, 4}};
    const double x = random.between(-0.22, 0.22), z = random.between(-0.22, 0.22);
    mesh.add(palette.grass, moved(turned(blade, {0, 1, 0}, random.next()), {x, 0, z}));
  }
  return mesh;
}

Mesh stone(const Palette& palette) {
  Mesh mesh{"stone", {}};
  Shape shape = sphere(1, 24, 14);
  for (dvec3& p : shape.positions) {
    p *= 1 + 0.22 * noise(1.7 * p.x + 5, 1.7 * p.z + 1.3 * p.y, 5) + 0.06 * noise(5 * p.x, 5 * p.z + 4 * p.y, 6);
    p.y *= 0.62;
  }
  mesh.add(palette.stone, shape);
  return mesh;
}

Mesh mushroom(const Palette& palette) {
  Mesh mesh{"mushroom", {}};
  mesh.add(palette.cream, lathe({{0, -0.03}, {0.022, -0.03, true}, {0.017, 0.03}, {0.014, 0.09, true}, {0, 0.09}}, 16));
  mesh.add(palette.red,
           lathe({{0, 0.078}, {0.06, 0.074, true}, {0.066, 0.083}, {0.056, 0.108}, {0.032, 0.126}, {0, 0.132}}, 24));
  return mesh;
}

Mesh lantern_post(const Palette& palette) {
  Mesh mesh{"lantern post", {}};
  mesh.add(palette.wood, box({-0.06, -0.3, -0.06}, {0.06, 2, 0.06}));
  mesh.add(palette.wood, box({-0.05, 1.82, 0.06}, {0.05, 1.92, 0.62}));
  mesh.add(palette.wood, rod({{0, 1.45, 0.05}, {0, 1.84, 0.4}}, 0.03, 8));
  const auto hung = [](const Shape& shape) { return moved(shape, {0, 1.42, 0.52}); };
  mesh.add(palette.iron, rod({{0, 1.83, 0.52}, {0, 1.72, 0.52}}, 0.008, 6));
  mesh.add(palette.iron, hung(lathe({{0, 0.22}, {0.12, 0.22, true}, {0.12, 0.24, true}, {0.03, 0.31}, {0, 0.32}}, 6)));
  mesh.add(palette.lantern, hung(lathe({{0, 0.02}, {0.06, 0.02, true}, {0.09, 0.22, true}, {0, 0.22}}, 6)));
  mesh.add(palette.iron, hung(lathe({{0, -0.01}, {0.075, 0, true}, {0.075, 0.02, true}, {0, 0.02}}, 6)));
  return mesh;
}

void add_terrain(Scene& scene, const Palette& palette) {
  // Stored at an eighth, so that the coordinates fit 16 bits.
  const Surface face = [](double u, double v) {
    const double x = kHalfSize * (2 * u - 1), z = kHalfSize * (1 - 2 * v);
    return on_ground(x, z) / 8.0;
  };
  Mesh terrain{"terrain", {}};
  terrain.add(palette.moss, slab(48, 48, face, [&](double u, double v) {
                const dvec3 p = face(u, v);
                return dvec3(p.x, -0.3, p.z);
              }));
  const std::uint32_t mesh = scene.add(std::move(terrain));
  scene.place(mesh, {0, 0, 0}, 0, dvec3(8));

  Mesh way{"path", {}};
  const Surface trodden = [](double u, double v) {
    const double z = 15 - 40 * v, side = 2 * u - 1, x = path(z) + side * (0.75 + 0.15 * noise(0.6 * z, side, 9));
    return on_ground(x, z, 0.05 - 0.12 * side * side) / 8.0;
  };
  way.add(palette.earth, slab(8, 120, trodden, dvec3(0, -0.04, 0)));
  const std::uint32_t path_mesh = scene.add(std::move(way));
  scene.place(path_mesh, {0, 0, 0}, 0, dvec3(8));
}

void add_trees(Scene& scene, const Palette& palette) {
  const std::vector<Level> broad{
      {8, 10, 11, 0.3, 0.42, 0.16, 0.1}, {5, 6, 5, 0.25, 0.45, 0.12, 0.25}, {3, 4, 0, 0, 0, 0, 0.2}};
  const std::vector<Level> conifer{{10, 9, 74, 0.12, 0.3, 0.27, 0.015}, {3, 4, 0, 0, 0, 0, 0.05}};
  const TreeKind beech{palette.bark, palette.leaf, broad, 27, 0.3, 0.17, 0.06};
  const TreeKind birch{palette.pale_bark, palette.light_leaf, broad, 25, 0.22, 0.14, 0.02};
  const TreeKind spruce{palette.bark, palette.needle, conifer, 26, 0.5, 0.09, -0.04};
  const std::uint32_t kinds[] = {scene.add(tree("beech", beech, 7.5, 0.21, 1)),
                                 scene.add(tree("birch", birch, 8, 0.13, 2)),
                                 scene.add(tree("spruce", spruce, 9, 0.17, 3))};
  Random random(16);
  std::vector<dvec3> taken;
  while (taken.size() < 74) {
    const double x = random.between(-19, 19), z = random.between(-27, 7.5);
    const auto near = [&](const dvec3& p) { return glm::length(p - dvec3(x, 0, z)) < 2.3; };
    if (std::abs(x - path(z)) < 2.2 || std::any_of(taken.begin(), taken.end(), near)) continue;
    taken.push_back({x, 0, z});
    const double size = random.between(0.8, 1.25), tall = size * random.between(0.9, 1.1), turn = random.next();
    scene.place(kinds[random.below(3)], on_ground(x, z), turn, {size, tall, size});
  }
}

void add_undergrowth(Scene& scene, const Palette& palette) {
  const std::uint32_t grass = scene.add(tuft(palette)), stones = scene.add(stone(palette));
  const std::uint32_t mushrooms = scene.add(mushroom(palette));
  Random random(4);
  for (int i = 0; i < 850;) {
    const double spread = random.next();
    // Denser near the camera at z = 13.
    const double away = 34 * spread * random.next(), z = 12 - away;
    const double x = path(z) + random.between(-1, 1) * (4 + 0.4 * away);
    if (std::abs(x - path(z)) < 0.8 + 0.5 * random.next()) continue;
    const double size = random.between(0.7, 1.5);
    scene.place(grass, on_ground(x, z), random.next(), dvec3(size));
    ++i;
  }
  for (int i = 0; i < 34; ++i) {
    const double z = random.between(-16, 9), side = random.below(2) == 0 ? -1 : 1;
    const double x = path(z) + side * random.between(0.9, 4), size = random.between(0.08, 0.38);
    const double deep = size * random.between(0.7, 1.2);
    scene.place(stones, on_ground(x, z), random.next(), {size, size, deep});
  }
  for (int i = 0; i < 16; ++i) {
    const double z = 8.2 + random.between(-0.7, 0.7), x = path(z) - 1.45 + random.between(-0.3, 0.35);
    const double size = random.between(0.8, 2);
    scene.place(mushrooms, on_ground(x, z), random.next(), dvec3(size));
  }
  Mesh log{"log", {}};
  std::vector<Station> line;
  for (int i = 0; i <= 12; ++i) {
    const double t = i / 12.0;
    line.push_back({{2.6 * t - 1.3, 0.03 * noise(6 * t, 0, 8), 0.12 * t},
                    {0, 1, 0},
                    0.24 - 0.05 * t + 0.025 * noise(9 * t, 1, 8)});
  }
  log.add(palette.bark, tube(line, 28));
  scene.place(std::move(log), on_ground(path(6.5) + 2.2, 6.5, 0.12), 0.07);
  scene.place(lantern_post(palette), on_ground(path(4) - 1.3, 4), 0.2);
}

}  // namespace

Scene forest() {
  Scene scene;
  scene.name = "forest";
  scene.quantized = true;
  scene.camera = {{path(13), 1.7, 13}, {path(0), 2.3, 0}, 0.85};
  const Palette palette = add_materials(scene);
  add_terrain(scene, palette);
  add_trees(scene, palette);
  add_undergrowth(scene, palette);
  scene.place(sky(scene, 46, 40, 0.08, 0.42));
  scene.lights = {
      {"sun", LightType::directional, {1, 0.9, 0.72}, 7, {-5, 7, 5}, {0, 0, 0}},
      {"sky", LightType::directional, {0.65, 0.8, 1}, 1, {3, 8, 4}, {0, 0, 0}},
      {"open sky behind the camera", LightType::directional, {0.8, 0.88, 1}, 1.2, {0.4, 1.5, 6}, {0, 0, 0}},
      {"lantern", LightType::point, {1, 0.7, 0.38}, 3, on_ground(path(4) - 0.75, 4, 1.2)},
  };
  return scene;
}

}  // namespace umbrix::scenes
