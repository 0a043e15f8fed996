// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene.h"

/// The building blocks of the atrium.
namespace umbrix::scenes::atrium_parts {

/// The court lies along z between x = -kHalfWidth and kHalfWidth; the aisles reach to kOuter.
inline constexpr double kHalfWidth = 4, kOuter = 7.5;

struct Palette {
  std::uint32_t sandstone, pale, plaster, terracotta, wood, iron, water, leaf, lantern, red, blue, gold;
};

Palette add_materials(Scene& scene);

/// 3.4 high, on the ground, with grooves along the shaft if `flutes` is not 0. Triangles grow with detail squared.
Mesh column(const Palette& palette, const char* name, int detail, int flutes);

/// One bay of the wall on the columns; the origin is the middle of the arch's springing line.
Mesh arcade(const Palette& palette, const char* name, double width, double radius, double top);

/// One bay of a cornice with dentils, its lower edge at y = 0, standing out towards +z.
Mesh cornice(const Palette& palette, double width);

/// One bay of the balustrade, standing on y = 0.
Mesh balustrade(const Palette& palette, double width);

/// A square of 4 x 4 paving slabs with joints.
Mesh paving(const Palette& palette);

/// A door with a round head in a stone surround, against a wall at z = 0.
Mesh door(const Palette& palette);

/// The ceiling of one aisle bay: beams that enclose coffers, under y = 0.
Mesh coffers(const Palette& palette);

/// A banner that hangs down from y = 0 and billows towards +z.
Mesh banner(std::uint32_t cloth, std::uint32_t hem, const Palette& palette, int seed);

/// A lamp on a chain, hanging from y = 0.
Mesh lantern(const Palette& palette);

Mesh fountain(const Palette& palette);
Mesh potted_palm(const Palette& palette);

}  // namespace umbrix::scenes::atrium_parts
