// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cases/meshes.h"

namespace umbrix::cases {

/// A closed mesh to look at from inside, made anew from chance where its shape leaves some.
struct ClosedMeshKind {
  std::string name;
  std::function<ClosedMesh(Random&)> make;
};

/// The twelve of rows 1 to 3; smaller ones below size 1.
std::vector<ClosedMeshKind> closed_mesh_kinds(double size);

/// Whether each edge of a triangle has its opposite in exactly one other, bit for bit.
bool is_closed(const Triangles& triangles);

/// How often the mesh winds round a point: its solid angle (van Oosterom & Strackee 1983) over that of a sphere.
double winding_number(const Triangles& triangles, const Float3& point);

/// A bound below the distance from a point to the mesh.
double clearance(const Triangles& triangles, const Float3& point);

/// What the rays aim at.
enum class Aim { interior, vertex, edge };

/// Rays from within the mesh to beyond it.
CaseData from_inside(const ClosedMeshKind& kind, Aim aim, std::uint64_t seed, std::size_t ray_count);

}  // namespace umbrix::cases
