// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <vector>

#include "core/alpha_range.h"
#include "core/mesh_triangles.h"
#include "umbrix/opacity.h"

namespace umbrix {
namespace {

using detail::AlphaRanges;
using detail::ByteRange;
using detail::TexelSpan;

/// What can be said of a whole triangle.
enum class Kind : std::uint8_t { depends, opaque, transparent };

template <class T>
const T* element(const T* first, std::size_t stride, std::size_t index) noexcept {
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + stride * index);
}

std::uint32_t vertex_of(const AlphaMap& map, std::uint32_t triangle, std::size_t corner) noexcept {
  return detail::vertex_of(map.indices, map.index_stride, triangle, corner);
}

/// A value at the corners, blended. Exact where all are equal.
double between_corners(const double corner[3], double u, double v) noexcept {
  return corner[0] + (corner[1] - corner[0]) * u + (corner[2] - corner[0]) * v;
}

/// The image's coordinates at the corners: [axis][corner].
struct ImageCorners {
  double at[2][3];

  ImageCorners(const AlphaMap& map, std::uint32_t triangle) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      const float* uv = element(map.texcoords, map.texcoord_stride, vertex_of(map, triangle, k));
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double* row = map.transform[axis];
        at[axis][k] = row[0] * static_cast<double>(uv[0]) + row[1] * static_cast<double>(uv[1]) + row[2];
      }
    }
  }
};

struct VertexAlpha {
  double at[3] = {1, 1, 1};

  VertexAlpha(const AlphaMap& map, std::uint32_t triangle) noexcept {
    for (std::size_t k = 0; map.vertex_alpha && k < 3; ++k) {
      at[k] = static_cast<double>(*element(map.vertex_alpha, map.vertex_alpha_stride, vertex_of(map, triangle, k)));
    }
  }
};

double alpha_at(const AlphaMap& map, std::uint32_t triangle, double u, double v) noexcept {
  double alpha = static_cast<double>(map.factor);
  if (map.image) {
    const ImageCorners corners(map, triangle);
    const TexelQuad quad = texels_at(map.sampler, map.width, map.height, between_corners(corners.at[0], u, v),
                                     between_corners(corners.at[1], u, v));
    alpha *=
        quad.blend([&](std::uint32_t x, std::uint32_t y) -> double { return detail::alpha_byte(map, x, y); }) / 255;
  }
  if (map.vertex_alpha) alpha *= between_corners(VertexAlpha(map, triangle).at, u, v);
  return alpha;
}

/// Texels that a look-up between `low` and `high` may read, and some more on both sides: u and v are floats.
TexelSpan texels_between(double low, double high, std::uint32_t size) noexcept {
  constexpr double kFar = 0x1p40;
  const double margin = 1 + (high - low) * size * 0x1p-20;
  const double first = low * size - 0.5 - margin, last = high * size + 0.5 + margin;
  if (!(first > -kFar && last < kFar)) return {0, size};
  return {static_cast<std::int64_t>(std::floor(first)), static_cast<std::int64_t>(std::floor(last))};
}

Kind kind_of(const AlphaMap& map, const AlphaRanges* ranges, std::uint32_t triangle) {
  ByteRange bytes;
  bytes.low = bytes.high = 255;
  if (map.image) {
    const ImageCorners corners(map, triangle);
    TexelSpan spans[2];
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto [low, high] = std::minmax_element(corners.at[axis], corners.at[axis] + 3);
      const bool finite = std::isfinite(corners.at[axis][0] + corners.at[axis][1] + corners.at[axis][2]);
      const std::uint32_t size = axis == 0 ? map.width : map.height;
      spans[axis] = finite ? texels_between(*low, *high, size) : TexelSpan{0, size};
    }
    bytes = ranges->range(spans[0], spans[1]);
  }
  const VertexAlpha vertices(map, triangle);
  const auto [least, most] = std::minmax_element(vertices.at, vertices.at + 3);
  if (!std::isfinite(vertices.at[0] + vertices.at[1] + vertices.at[2])) return Kind::depends;
  // As alpha_at has it where all is the same; else u and v, which are floats, may lead a little beyond the corners.
  const double slack = bytes.low == bytes.high && *least == *most ? 0 : 1e-6;
  const double factor = static_cast<double>(map.factor);
  const double low = factor * (bytes.low / 255.0) * *least - slack,
               high = factor * (bytes.high / 255.0) * *most + slack;
  const double enough = map.stochastic ? 1 : static_cast<double>(map.cutoff);
  if (low >= enough) return Kind::opaque;
  return (map.stochastic ? high <= 0 : high < enough) ? Kind::transparent : Kind::depends;
}

/// The finaliser of MurmurHash3 (Appleby 2011).
std::uint64_t mixed(std::uint64_t h) noexcept {
  h = (h ^ (h >> 33)) * 0xFF51AFD7ED558CCDu;
  h = (h ^ (h >> 33)) * 0xC4CEB9FE1A85EC53u;
  return h ^ (h >> 33);
}

std::uint64_t bits(float value) noexcept {
  std::uint32_t result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

/// In [0, 1), from all bits of its arguments.
double hashed(std::uint64_t seed, std::uint32_t triangle, float u, float v) noexcept {
  const std::uint64_t place = mixed(bits(u) << 32 | bits(v));
  return static_cast<double>(mixed(place ^ mixed(seed + 0x9E3779B97F4A7C15u * (triangle + std::uint64_t{1}))) >> 11) *
         0x1p-53;
}

const char* fault_of(const AlphaMap& map) noexcept {
  if (map.image && (map.width == 0 || map.height == 0)) return "alpha map: the image is empty";
  if (map.image && !map.texcoords) return "alpha map: an image without texture coordinates";
  if (map.image && map.pixel_stride == 0) return "alpha map: pixel_stride is 0";
  if (map.texcoord_stride % 4 != 0 || map.vertex_alpha_stride % 4 != 0 || map.index_stride % 4 != 0) {
    return "alpha map: strides of vertices and indices must be multiples of 4";
  }
  return nullptr;
}

}  // namespace

struct __attribute__((visibility("hidden"))) AlphaTest::Impl {
  AlphaMap map;
  std::vector<Kind> kinds;
  std::size_t opaque = 0;
  std::size_t transparent = 0;

  static bool blocks(const void* user, std::uint32_t triangle, float u, float v) noexcept {
    const Impl& impl = *static_cast<const Impl*>(user);
    if (impl.kinds[triangle] != Kind::depends) return impl.kinds[triangle] == Kind::opaque;
    const double alpha = alpha_at(impl.map, triangle, static_cast<double>(u), static_cast<double>(v));
    return impl.map.stochastic ? hashed(impl.map.seed, triangle, u, v) < alpha
                               : alpha >= static_cast<double>(impl.map.cutoff);
  }
};

AlphaTest::AlphaTest() noexcept = default;
AlphaTest::~AlphaTest() = default;
AlphaTest::AlphaTest(AlphaTest&&) noexcept = default;
AlphaTest& AlphaTest::operator=(AlphaTest&&) noexcept = default;

Status AlphaTest::set(const AlphaMap& map) try {
  impl_.reset();
  if (const char* fault = fault_of(map)) return {StatusCode::invalid_argument, fault};
  for (std::uint32_t t = 0; t < map.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (vertex_of(map, t, k) < map.vertex_count) continue;
      return {StatusCode::invalid_argument, "alpha map: triangle " + std::to_string(t) + " uses vertex " +
                                                std::to_string(vertex_of(map, t, k)) + " of " +
                                                std::to_string(map.vertex_count)};
    }
  }
  auto impl = std::make_unique<Impl>();
  impl->map = map;
  impl->kinds.reserve(map.triangle_count);
  std::unique_ptr<AlphaRanges> ranges;
  if (map.image) ranges = std::make_unique<AlphaRanges>(map);
  for (std::uint32_t t = 0; t < map.triangle_count; ++t) {
    impl->kinds.push_back(kind_of(map, ranges.get(), t));
    impl->opaque += impl->kinds.back() == Kind::opaque;
    impl->transparent += impl->kinds.back() == Kind::transparent;
  }
  impl_ = std::move(impl);
  return {};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("alpha map: out of memory");
}

OpacityTest AlphaTest::test() const noexcept {
  if (!impl_ || impl_->opaque == impl_->kinds.size()) return {};
  return {&Impl::blocks, impl_.get()};
}

std::size_t AlphaTest::opaque_triangles() const noexcept { return impl_ ? impl_->opaque : 0; }
std::size_t AlphaTest::transparent_triangles() const noexcept { return impl_ ? impl_->transparent : 0; }

double AlphaTest::alpha(std::uint32_t triangle, double u, double v) const noexcept {
  return alpha_at(impl_->map, triangle, u, v);
}

}  // namespace umbrix
