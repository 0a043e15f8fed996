// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cases/cases.h"
#include "cases/random.h"

namespace umbrix::cases {

using Triangles = std::vector<oracle::Triangle>;

/// A mesh without holes; neighbours share vertices bit for bit.
struct ClosedMesh {
  Triangles triangles;
  Float3 inside;  ///< a point well within; every triangle can be seen from it
};

/// An icosahedron whose triangles are split 1:4 `levels` times, on a sphere whose radius varies by `noise` (0 to 0.5).
ClosedMesh icosphere(int levels, float radius, float noise, Float3 center, Random& random);

/// A sphere of rings and segments with needles round its poles.
ClosedMesh ring_sphere(int rings, float radius, Float3 center);

Triangles torus(int rings, int segments, float major_radius, float minor_radius);

/// A square in the plane z = height, 2 * half_size wide, of 2 * cells * cells triangles.
Triangles sheet(int cells, float half_size, float height);

/// Triangles of random shape and place in a cube.
Triangles soup(std::size_t count, float cube_half_size, float triangle_size, Random& random);

oracle::Triangle triangle(const Float3& a, const Float3& b, const Float3& c);

Float3 vertex(const oracle::Triangle& t, std::size_t corner);

Float3 add(const Float3& a, const Float3& b);
Float3 subtract(const Float3& a, const Float3& b);
Float3 scale(const Float3& a, float s);

/// a + (b - a) * s in float: for s = 0.5 and few bits the exact midpoint.
Float3 between(const Float3& a, const Float3& b, float s);

/// A point of the triangle: inside, on an edge or at a corner by turns of chance.
Float3 point_on(const oracle::Triangle& t, Random& random);

/// A ray from `origin` through `target`, reached at t = 1 but for rounding.
Ray ray_to(const Float3& origin, const Float3& target, float tmin, float tmax);

}  // namespace umbrix::cases
