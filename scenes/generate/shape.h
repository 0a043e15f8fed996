// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

/// Triangle meshes and the ways to make them. Lengths in metres, y up, triangles counterclockwise seen from outside.
namespace umbrix::scenes {

/// Triangles over shared vertices. In a smooth shape a vertex has one normal, so an edge is sharp where its vertices
/// are stored twice; a shape that is not smooth is drawn with the normals of its triangles.
struct Shape {
  bool smooth = true;
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;

  /// Adds a quadrilateral, counterclockwise seen from outside.
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
};

/// Adds the triangles of `from`, which must be smooth if and only if `to` is.
void append(Shape& to, const Shape& from);

Shape moved(Shape shape, const glm::dvec3& by);
/// Right-handed rotation around an axis through the origin; the axis has unit length.
Shape turned(Shape shape, const glm::dvec3& axis, double turns);
Shape stretched(Shape shape, const glm::dvec3& factors);
glm::dvec3 turned(const glm::dvec3& point, const glm::dvec3& axis, double turns);

/// One unit normal a vertex: the area-weighted mean over its triangles.
std::vector<glm::dvec3> normals(const Shape& shape);

/// Eight vertices, twelve triangles, not smooth.
Shape box(const glm::dvec3& low, const glm::dvec3& high);

/// A box around the origin with edges rounded by `radius`, in `steps` steps for each quarter turn.
Shape rounded_box(const glm::dvec3& half_size, double radius, int steps);

struct ProfilePoint {
  double radius;
  double height;
  bool sharp = false;  ///< a crease around the shape
};

/// The profile (upwards) turned around the y axis: `sides` quadrilaterals a ring. Closed if both ends have radius 0 or
/// are the same. `flutes` grooves of relative depth `groove` run along it.
Shape lathe(const std::vector<ProfilePoint>& profile, int sides, int flutes = 0, double groove = 0);

Shape sphere(double radius, int sides, int rings);

/// A point of a tube's centre line. `up` tells where the first vertex of the ring lies; not parallel to the line.
struct Station {
  glm::dvec3 point;
  glm::dvec3 up;
  double radius;
};

/// Rings of `sides` vertices along a line. A loop is closed on itself, otherwise the ends get flat caps, or a tip where
/// the radius is 0.
Shape tube(const std::vector<Station>& stations, int sides, bool loop = false);

/// A tube of one radius along straight pieces.
Shape rod(const std::vector<glm::dvec3>& points, double radius, int sides);

using Surface = std::function<glm::dvec3(double u, double v)>;

/// f over the unit square; the outer side is that of df/du x df/dv.
Shape sheet(int columns, int rows, const Surface& f);

/// The solid between two surfaces: `outer` as for sheet, `inner` behind it. Closed, with sharp edges.
Shape slab(int columns, int rows, const Surface& outer, const Surface& inner);

/// A slab of one thickness behind the surface, along `inwards`.
Shape slab(int columns, int rows, const Surface& outer, const glm::dvec3& inwards);

/// The piece of a wall above a half-circle opening of `radius` around the origin, up to `top`, between z = -depth / 2
/// and depth / 2.
Shape arch(double radius, double top, double depth, int steps);

/// A half ring between two radii, as arch.
Shape half_ring(double inner, double outer, double depth, int steps);

/// A folded diamond of two triangles that starts at the origin and lies along +z; +y is its upper side. Not smooth.
Shape leaf(double length, double width, double fold);

}  // namespace umbrix::scenes
