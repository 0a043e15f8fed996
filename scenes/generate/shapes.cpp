// SPDX-License-Identifier: Apache-2.0
// Every curved shape is rows of vertices joined by bands of quadrilaterals, and fans where a row shrinks to a point.
#include <array>
#include <glm/geometric.hpp>
#include <map>

#include "numbers.h"
#include "shape.h"

namespace umbrix::scenes {
namespace {

using glm::dvec3;

std::uint32_t count(const Shape& shape) { return static_cast<std::uint32_t>(shape.positions.size()); }

/// Joins two rows of `n` vertices. The outer side is that of (along the row) x (from the first row to the second).
void band(Shape& shape, std::uint32_t first, std::uint32_t second, std::uint32_t n, bool loop) {
  for (std::uint32_t i = 0; i + (loop ? 0 : 1) < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    shape.quad(first + i, first + j, second + j, second + i);
  }
}

/// Joins a closed row with a tip that lies beyond it (`ends`) or before it.
void fan(Shape& shape, std::uint32_t row, std::uint32_t n, std::uint32_t tip, bool ends) {
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    shape.triangles.push_back(ends ? glm::uvec3(row + i, row + j, tip) : glm::uvec3(row + j, row + i, tip));
  }
}

/// A row or a single tip of a shape that closes around a line.
struct Ring {
  std::uint32_t first;
  bool tip;
};

void join(Shape& shape, const Ring& from, const Ring& to, std::uint32_t sides) {
  if (!from.tip && !to.tip) {
    band(shape, from.first, to.first, sides, true);
  } else if (!from.tip || !to.tip) {
    fan(shape, from.tip ? to.first : from.first, sides, from.tip ? from.first : to.first, to.tip);
  }
}

/// Adds columns + 1 vertices along a line and returns the first.
std::uint32_t add_row(Shape& shape, int columns, const std::function<dvec3(double)>& f) {
  const std::uint32_t first = count(shape);
  for (int i = 0; i <= columns; ++i) shape.positions.push_back(f(static_cast<double>(i) / columns));
  return first;
}

/// Joins two lines, given by functions, with vertices of their own.
void add_strip(Shape& shape, int columns, const std::function<dvec3(double)>& a,
               const std::function<dvec3(double)>& b) {
  const std::uint32_t first = add_row(shape, columns, a);
  band(shape, first, add_row(shape, columns, b), static_cast<std::uint32_t>(columns) + 1, false);
}

}  // namespace

Shape box(const dvec3& low, const dvec3& high) {
  Shape shape;
  shape.smooth = false;
  for (int i = 0; i < 8; ++i) {
    shape.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  }
  shape.quad(0, 2, 3, 1);
  shape.quad(4, 5, 7, 6);
  shape.quad(0, 1, 5, 4);
  shape.quad(2, 6, 7, 3);
  shape.quad(0, 4, 6, 2);
  shape.quad(1, 3, 7, 5);
  return shape;
}

Shape rounded_box(const dvec3& half_size, double radius, int steps) {
  // A lattice point's coordinates run over 0 .. 2 steps + 1; the lower half belongs to the low corner's sphere.
  const int last = 2 * steps + 1;
  const auto slope = [&](int i) { return i <= steps ? static_cast<double>(i) / steps - 1 : (i - steps - 1.0) / steps; };
  Shape shape;
  std::map<std::array<int, 3>, std::uint32_t> vertices;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = vertices.try_emplace(at, count(shape));
    if (is_new) {
      const dvec3 away = glm::normalize(dvec3(slope(at[0]), slope(at[1]), slope(at[2])));
      dvec3 p = radius * away;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] += (at[static_cast<std::size_t>(axis)] <= steps ? -1 : 1) * (half_size[axis] - radius);
      }
      shape.positions.push_back(p);
    }
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      // Right-handed (u, v, axis) on the high side; u and v change places on the low side.
      const std::size_t u = (axis + (high ? 1 : 2)) % 3, v = (axis + (high ? 2 : 1)) % 3;
      const auto at = [&](int i, int j) {
        std::array<int, 3> p{};
        p[axis] = high ? last : 0;
        p[u] = i;
        p[v] = j;
        return vertex(p);
      };
      for (int i = 0; i < last; ++i) {
        for (int j = 0; j < last; ++j) {
          // In order: the vertices are made here, and C++ leaves the order of arguments open.
          const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          shape.quad(a, b, c, d);
        }
      }
    }
  }
  return shape;
}

Shape lathe(const std::vector<ProfilePoint>& profile, int sides, int flutes, double groove) {
  Shape shape;
  const auto n = static_cast<std::uint32_t>(sides);
  const auto add_ring = [&](const ProfilePoint& p) {
    const Ring ring{count(shape), p.radius == 0};
    for (std::uint32_t i = 0; i < (ring.tip ? 1 : n); ++i) {
      const double turns = static_cast<double>(i) / n;
      const double wave = flutes == 0 ? 0 : sin_turns(turns * flutes);
      const double radius = p.radius * (1 - groove * wave * wave);
      shape.positions.push_back({radius * cos_turns(turns), p.height, -radius * sin_turns(turns)});
    }
    return ring;
  };
  Ring below = add_ring(profile.front());
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Ring ring = add_ring(profile[i]);
    join(shape, below, ring, n);
    below = profile[i].sharp && i + 1 < profile.size() ? add_ring(profile[i]) : ring;
  }
  return shape;
}

Shape sphere(double radius, int sides, int rings) {
  std::vector<ProfilePoint> profile{{0, -radius}};
  for (int i = 1; i < rings; ++i) {
    const double turns = 0.5 * i / rings - 0.25;
    profile.push_back({radius * cos_turns(turns), radius * sin_turns(turns)});
  }
  profile.push_back({0, radius});
  return lathe(profile, sides);
}

Shape tube(const std::vector<Station>& stations, int sides, bool loop) {
  Shape shape;
  const auto n = static_cast<std::uint32_t>(sides);
  const std::size_t size = stations.size();
  const auto add_ring = [&](std::size_t i) {
    const Station& s = stations[i];
    const Ring ring{count(shape), s.radius == 0};
    const dvec3& before = stations[loop ? (i + size - 1) % size : i - (i > 0)].point;
    const dvec3& after = stations[loop ? (i + 1) % size : i + (i + 1 < size)].point;
    const dvec3 along = glm::normalize(after - before);
    const dvec3 a = glm::normalize(s.up - along * glm::dot(along, s.up));
    const dvec3 b = glm::cross(along, a);
    for (std::uint32_t k = 0; k < (ring.tip ? 1 : n); ++k) {
      const double turns = static_cast<double>(k) / n;
      shape.positions.push_back(s.point + s.radius * (cos_turns(turns) * a + sin_turns(turns) * b));
    }
    return ring;
  };
  const auto add_cap = [&](std::size_t i) {
    if (stations[i].radius == 0) return;
    const Ring rim = add_ring(i);
    const Ring centre{count(shape), true};
    shape.positions.push_back(stations[i].point);
    fan(shape, rim.first, n, centre.first, i > 0);
  };
  const Ring first = add_ring(0);
  Ring below = first;
  for (std::size_t i = 1; i < size; ++i) {
    const Ring ring = add_ring(i);
    join(shape, below, ring, n);
    below = ring;
  }
  if (loop) {
    join(shape, below, first, n);
  } else {
    add_cap(0);
    add_cap(size - 1);
  }
  return shape;
}

Shape rod(const std::vector<dvec3>& points, double radius, int sides) {
  const dvec3 along = points.back() - points.front();
  const bool steep = along.y * along.y > 0.5 * glm::dot(along, along);
  std::vector<Station> stations;
  for (const dvec3& p : points) stations.push_back({p, steep ? dvec3(0.31, 0, 0.95) : dvec3(0.06, 1, 0.03), radius});
  return tube(stations, sides);
}

Shape sheet(int columns, int rows, const Surface& f) {
  Shape shape;
  const auto n = static_cast<std::uint32_t>(columns) + 1;
  for (int j = 0; j <= rows; ++j) {
    const std::uint32_t row = add_row(shape, columns, [&](double u) { return f(u, static_cast<double>(j) / rows); });
    if (j > 0) band(shape, row - n, row, n, false);
  }
  return shape;
}

Shape slab(int columns, int rows, const Surface& outer, const Surface& inner) {
  Shape shape = sheet(columns, rows, outer);
  append(shape, sheet(columns, rows, [&](double u, double v) { return inner(1 - u, v); }));
  add_strip(
      shape, columns, [&](double u) { return inner(u, 0); }, [&](double u) { return outer(u, 0); });
  add_strip(
      shape, rows, [&](double v) { return inner(1, v); }, [&](double v) { return outer(1, v); });
  add_strip(
      shape, columns, [&](double u) { return inner(1 - u, 1); }, [&](double u) { return outer(1 - u, 1); });
  add_strip(
      shape, rows, [&](double v) { return inner(0, 1 - v); }, [&](double v) { return outer(0, 1 - v); });
  return shape;
}

Shape slab(int columns, int rows, const Surface& outer, const dvec3& inwards) {
  return slab(columns, rows, outer, [&](double u, double v) { return outer(u, v) + inwards; });
}

Shape arch(double radius, double top, double depth, int steps) {
  const Surface face = [=](double u, double v) {
    const dvec3 low(-radius * cos_turns(u / 2), radius * sin_turns(u / 2), depth / 2);
    return dvec3(low.x, low.y + (top - low.y) * v, low.z);
  };
  return slab(steps, 1, face, dvec3(0, 0, -depth));
}

Shape half_ring(double inner, double outer, double depth, int steps) {
  const Surface face = [=](double u, double v) {
    const double radius = inner + (outer - inner) * v;
    return dvec3(-radius * cos_turns(u / 2), radius * sin_turns(u / 2), depth / 2);
  };
  return slab(steps, 1, face, dvec3(0, 0, -depth));
}

Shape leaf(double length, double width, double fold) {
  Shape shape;
  shape.smooth = false;
  shape.positions = {{0, 0, 0}, {width / 2, fold, length * 0.45}, {0, 0, length}, {-width / 2, fold, length * 0.45}};
  shape.triangles = {{0, 2, 1}, {0, 3, 2}};
  return shape;
}

}  // namespace umbrix::scenes
