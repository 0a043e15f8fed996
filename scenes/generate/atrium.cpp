// SPDX-License-Identifier: Apache-2.0
// A courtyard open to the sky between two-storey colonnades, after the atrium of the palace Sponza in Dubrovnik.
#include "atrium_parts.h"
#include "scene.h"

namespace umbrix::scenes {
namespace {

using namespace atrium_parts;
using glm::dvec3;

constexpr int kBays = 7;
constexpr double kBay = 4, kHalfLength = kBay * kBays / 2, kPorch = 8.0 / 3;
constexpr double kSpring = 3.4, kGallery = 5.6, kUpperSpring = 8, kEaves = 9.3;

/// The long sides face each other; the ends close the court. Calls f(side's turn, distance of the side from the middle,
/// half its length, width of its bays).
template <typename F>
void for_each_side(F f) {
  f(0.25, kHalfWidth, kHalfLength, kBay);
  f(-0.25, kHalfWidth, kHalfLength, kBay);
  f(0.0, kHalfLength, kHalfWidth, kPorch);
  f(0.5, kHalfLength, kHalfWidth, kPorch);
}

/// Where a side's point at `along` (from its middle) and `up` lies. A side's +z looks into the court.
dvec3 on_side(double turn, double distance, double along, double up) {
  return turned(dvec3(along, up, -distance), {0, 1, 0}, turn);
}

void add_colonnades(Scene& scene, const Palette& palette) {
  const std::uint32_t low_column = scene.add(column(palette, "column", 5, 12));
  const std::uint32_t high_column = scene.add(column(palette, "upper column", 3, 0));
  const auto add_bay_meshes = [&](double width) {
    const std::uint32_t first = scene.add(arcade(palette, "arch", width, width / 2 - 0.45, kGallery - 0.3 - kSpring));
    scene.add(arcade(palette, "upper arch", width / 2, width / 4 - 0.3, kEaves - kUpperSpring));
    scene.add(cornice(palette, width));
    scene.add(balustrade(palette, width));
    return first;
  };
  const std::uint32_t long_side = add_bay_meshes(kBay), short_side = add_bay_meshes(kPorch);

  for_each_side([&](double turn, double distance, double half, double width) {
    const std::uint32_t first = width == kBay ? long_side : short_side;
    const int bays = width == kBay ? kBays : 3;
    for (int i = 0; i < bays; ++i) {
      const double middle = -half + width * (i + 0.5);
      scene.place(first, on_side(turn, distance, middle, kSpring), turn);
      for (const double quarter : {-0.25, 0.25}) {
        scene.place(first + 1, on_side(turn, distance, middle + quarter * width, kUpperSpring), turn);
      }
      scene.place(first + 2, on_side(turn, distance, middle, kGallery - 0.3), turn);
      scene.place(first + 2, on_side(turn, distance, middle, kEaves), turn);
      scene.place(first + 3, on_side(turn, distance - 0.35, middle, kGallery), turn);
      scene.place(high_column, on_side(turn, distance, middle, kGallery), turn, {0.62, 12.0 / 17, 0.62});
    }
    // The corner columns belong to the long sides.
    for (int i = width == kBay ? 0 : 1; i <= (width == kBay ? bays : bays - 1); ++i) {
      scene.place(low_column, on_side(turn, distance, -half + width * i, 0), turn);
      scene.place(high_column, on_side(turn, distance, -half + width * i, kGallery), turn, {0.7, 12.0 / 17, 0.7});
    }
  });
}

void add_shell(Scene& scene, const Palette& palette) {
  const double far = kHalfLength + kOuter - kHalfWidth;
  Mesh shell{"walls and galleries", {}};
  shell.add(palette.sandstone, box({-kOuter - 0.3, -0.4, -far - 0.3}, {kOuter + 0.3, 0, far + 0.3}));
  for (const double side : {-1, 1}) {
    const double wall = side * (kOuter + 0.15), end = side * (far + 0.15);
    shell.add(palette.plaster, box({wall - 0.15, 0, -far}, {wall + 0.15, kEaves, far}));
    shell.add(palette.plaster, box({-kOuter - 0.3, 0, end - 0.15}, {kOuter + 0.3, kEaves, end + 0.15}));
    const double x = side * (kOuter + kHalfWidth) / 2, half_x = (kOuter - kHalfWidth) / 2;
    const double z = side * (far + kHalfLength) / 2, half_z = (far - kHalfLength) / 2;
    for (const double y : {kGallery - 0.3, kEaves}) {
      shell.add(palette.plaster, box({x - half_x, y, -far}, {x + half_x, y + 0.3, far}));
      shell.add(palette.plaster, box({-kHalfWidth, y, z - half_z}, {kHalfWidth, y + 0.3, z + half_z}));
    }
  }
  scene.place(std::move(shell));

  const std::uint32_t doors = scene.add(door(palette)), ceiling = scene.add(coffers(palette));
  const std::uint32_t lamp = scene.add(lantern(palette));
  for (const double turn : {0.25, -0.25}) {
    for (int i = 0; i < kBays; ++i) {
      const double along = kBay * (i - (kBays - 1) / 2.0);
      scene.place(doors, on_side(turn, kOuter, along, 0), turn);
      scene.place(doors, on_side(turn, kOuter, along, kGallery), turn, {0.8, 0.85, 1});
      const dvec3 under_gallery = on_side(turn, (kOuter + kHalfWidth) / 2, along, kGallery - 0.3);
      scene.place(ceiling, under_gallery);
      scene.place(lamp, under_gallery);
    }
  }
  for (const double along : {-kPorch, 0.0, kPorch}) scene.place(doors, {along, 0, -far});
}

void add_court(Scene& scene, const Palette& palette) {
  const std::uint32_t square = scene.add(paving(palette));
  for (int i = 0; i < 2 * kBays; ++i) {
    scene.place(square, {i % 2 == 0 ? -2 : 2, 0, kBay * (i / 2 - (kBays - 1) / 2)});
  }
  scene.place(fountain(palette), {0, 0.05, -3});
  const std::uint32_t palm = scene.add(potted_palm(palette));
  double turn = 0;
  for (const double z : {-10, -6, 2, 6}) {
    for (const double x : {-3.1, 3.1}) scene.place(palm, {x, 0.05, z}, turn += 0.3);
  }
  const std::uint32_t cloths[] = {palette.red, palette.blue, palette.gold};
  std::uint32_t banners[3];
  for (int i = 0; i < 3; ++i) banners[i] = scene.add(banner(cloths[i], i < 2 ? palette.gold : palette.red, palette, i));
  // None over the camera.
  for (int i = 0; i < kBays - 1; ++i) {
    const double along = kBay * (i - (kBays - 1) / 2.0);
    for (const double side : {0.25, -0.25}) {
      scene.place(banners[i % 3], on_side(side, kHalfWidth - 0.62, side > 0 ? -along : along, kGallery + 0.6), side);
    }
  }
}

}  // namespace

Scene atrium() {
  Scene scene;
  scene.name = "atrium";
  scene.quantized = true;
  scene.camera = {{-1, 2.3, 12.4}, {0.2, 3.75, -3}, 0.95};
  const Palette palette = add_materials(scene);
  add_shell(scene, palette);
  add_colonnades(scene, palette);
  add_court(scene, palette);
  scene.place(sky(scene, 44, 40, 0.12, 0.38));
  scene.lights = {
      {"sun", LightType::directional, {1, 0.9, 0.74}, 6.5, {4.4, 8, 6}, {0, 0, 0}},
      {"sky", LightType::directional, {0.62, 0.78, 1}, 0.9, {-2, 8, 5}, {0, 0, 0}},
      {"bounce", LightType::point, {1, 0.84, 0.64}, 36, {-0.2, 2.8, 4}},
      {"porch", LightType::spot, {1, 0.75, 0.45}, 60, {0, 4.6, -9.5}, {0, 1.6, -17}, 0.3, 0.7},
  };
  return scene;
}

}  // namespace umbrix::scenes
