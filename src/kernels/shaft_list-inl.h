// SPDX-License-Identifier: Apache-2.0
// The triangles that a shaft's bundles may meet, close together.

#if defined(UMBRIX_KERNELS_SHAFT_LIST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_SHAFT_LIST_INL_H_
#undef UMBRIX_KERNELS_SHAFT_LIST_INL_H_
#else
#define UMBRIX_KERNELS_SHAFT_LIST_INL_H_
#endif

#include <hwy/highway.h>

#include <cstring>

#include "kernels/ray_lanes-inl.h"
#include "kernels/shaft.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

class TriangleList {
 public:
  static constexpr std::uint32_t kRoom = 256;

  void clear() { count_ = 0; }
  bool is_full() const { return count_ + kRowLanes > kRoom; }
  std::uint32_t count() const { return count_; }
  std::uint32_t rows() const { return (count_ + kRowLanes - 1) / kRowLanes; }
  std::uint32_t id(std::uint32_t i) const { return id_[i]; }

  RayVec vertex(std::uint32_t vertex, std::uint32_t axis, std::uint32_t i) const {
    return hn::Load(RayTag(), v_[vertex][axis] + i);
  }
  RayVec edge(std::uint32_t edge, std::uint32_t axis, std::uint32_t i) const {
    return hn::Load(RayTag(), edge_[edge][axis] + i);
  }
  RayVec normal(std::uint32_t axis, std::uint32_t i) const { return hn::Load(RayTag(), normal_[axis] + i); }
  /// No vertex is farther from a start.
  RayVec reach(std::uint32_t i) const { return hn::Load(RayTag(), reach_ + i); }
  /// The longest edge times the reach.
  RayVec size(std::uint32_t i) const { return hn::Load(RayTag(), size_ + i); }

  /// Appends some lanes of a row; there must be room.
  void add(const TriangleRows& rows, std::uint32_t lanes) {
    const RayTag f;
    const RayBitsTag n;
    for (std::uint32_t i = 0; i < kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      const std::uint32_t here = lanes >> i & static_cast<std::uint32_t>((std::uint64_t{1} << hn::Lanes(f)) - 1);
      if (here == 0) continue;
      const auto keep = lane_mask(here);
      const auto put = [&](const float* from, float* to) {
        hn::StoreU(hn::Compress(hn::Load(f, from + i), keep), f, to + count_);
      };
      for (std::uint32_t k = 0; k < 3; ++k) {
        for (std::uint32_t vertex = 0; vertex < 3; ++vertex) put(rows.v[vertex][k], v_[vertex][k]);
        put(rows.normal[k], normal_[k]);
      }
      const auto* ids = reinterpret_cast<const std::int32_t*>(rows.id + i);
      hn::StoreU(hn::Compress(hn::Load(n, ids), hn::RebindMask(n, keep)), n,
                 reinterpret_cast<std::int32_t*>(id_ + count_));
      count_ += static_cast<std::uint32_t>(hn::CountTrue(f, keep));
    }
  }

  /// Completes the rows of what was added, for starts that are `radius` (a 1-norm) around the middle.
  void prepare(const float (&middle)[3], float radius) {
    const RayTag f;
    for (std::uint32_t i = 0; i < rows() * kRowLanes; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      RayVec squares[3] = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
      auto reach = hn::Set(f, radius);
      for (std::uint32_t k = 0; k < 3; ++k) {
        auto farthest = hn::Zero(f);
        for (std::uint32_t e = 0; e < 3; ++e) {
          const auto from = vertex(e, k, i), along = hn::Sub(vertex((e + 1) % 3, k, i), from);
          hn::Store(along, f, edge_[e][k] + i);
          squares[e] = hn::MulAdd(along, along, squares[e]);
          farthest = hn::Max(farthest, hn::Abs(hn::Sub(from, hn::Set(f, middle[k]))));
        }
        reach = hn::MulAdd(farthest, hn::Set(f, 1 + 0x1p-20f), reach);
      }
      const auto longest = hn::Sqrt(hn::Max(squares[0], hn::Max(squares[1], squares[2])));
      hn::Store(reach, f, reach_ + i);
      hn::Store(hn::Mul(reach, longest), f, size_ + i);
    }
  }

 private:
  static constexpr std::uint32_t kStride = kRoom + kRowLanes;

  alignas(64) float v_[3][3][kStride] = {};
  alignas(64) float edge_[3][3][kStride];
  alignas(64) float normal_[3][kStride] = {};
  alignas(64) float reach_[kStride];
  alignas(64) float size_[kStride];
  alignas(64) std::uint32_t id_[kStride];
  std::uint32_t count_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
