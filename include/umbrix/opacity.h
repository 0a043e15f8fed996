// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "umbrix/export.h"
#include "umbrix/mesh.h"
#include "umbrix/status.h"
#include "umbrix/texels.h"

namespace umbrix {

/// Opacity as data: alpha over a mesh, as the product of a factor, of values at the vertices and of an image (glTF's
/// alphaMode MASK and BLEND). All memory is borrowed.
struct AlphaMap {
  const std::uint8_t* image = nullptr;  ///< the upper left pixel's alpha, 255 is opaque; null: no image
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t pixel_stride = 1;  ///< bytes from a pixel to the one on its right: 4 for the alpha of RGBA
  std::size_t row_stride = 0;    ///< bytes from a row to the one below; 0: width * pixel_stride
  TexelSampler sampler;
  const float* texcoords = nullptr;                 ///< u, v of each vertex; (0, 0) is the image's upper left corner
  std::size_t texcoord_stride = 8;                  ///< bytes
  double transform[2][3] = {{1, 0, 0}, {0, 1, 0}};  ///< from the vertices' coordinates to the image's

  const float* vertex_alpha = nullptr;  ///< null: 1
  std::size_t vertex_alpha_stride = 4;  ///< bytes
  float factor = 1;

  const std::uint32_t* indices = nullptr;  ///< as in MeshView
  std::size_t index_stride = 12;
  std::size_t triangle_count = 0;
  std::size_t vertex_count = 0;

  /// A point blocks if its alpha is not below the cut-off; or if stochastic with a probability of alpha, by a number
  /// that is hashed from the seed, the triangle and the point: the mean over many rays is that of a sheet which lets
  /// the share 1 - alpha through, and the same ray meets the same answer always.
  float cutoff = 0.5f;
  bool stochastic = false;
  std::uint64_t seed = 0;
};

/// Answers MeshView::opacity from an AlphaMap. What can be told of a triangle as a whole is found out beforehand, so
/// that most answers need no look at the image.
class UMBRIX_API AlphaTest {
 public:
  AlphaTest() noexcept;
  ~AlphaTest();
  AlphaTest(AlphaTest&&) noexcept;
  AlphaTest& operator=(AlphaTest&&) noexcept;

  /// Takes a map, whose memory must outlive the test. invalid_argument if its fields do not fit together;
  /// resource_limit without memory for a byte a triangle.
  Status set(const AlphaMap& map);

  /// For MeshView::opacity: none if no ray could tell the mesh from an opaque one. The test must outlive the scene, but
  /// may be moved. Thread-safe.
  OpacityTest test() const noexcept;

  /// Triangles that block everywhere, and nowhere; between them are those where it depends on the point.
  std::size_t opaque_triangles() const noexcept;
  std::size_t transparent_triangles() const noexcept;

  /// Alpha at a point of a triangle, u and v as in Hit. Only after set. Thread-safe.
  double alpha(std::uint32_t triangle, double u, double v) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace umbrix
