// SPDX-License-Identifier: Apache-2.0
// Triangles that may well block the next ray, as one block: what blocked rays nearby (Haines & Greenberg 1986, "The
// light buffer", section on shadow caches).

#if defined(UMBRIX_KERNELS_CANDIDATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef UMBRIX_KERNELS_CANDIDATES_INL_H_
#undef UMBRIX_KERNELS_CANDIDATES_INL_H_
#else
#define UMBRIX_KERNELS_CANDIDATES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "kernels/tree_kernel-inl.h"
#include "tree/block.h"

HWY_BEFORE_NAMESPACE();
namespace umbrix::detail {
namespace HWY_NAMESPACE {

/// Up to kMost rays side by side, so that one triangle meets eight at a time.
class RayLanes {
 public:
  static constexpr std::uint32_t kMost = 16;

  void set(std::uint32_t lane, const WalkRay& ray) {
    for (int k = 0; k < 3; ++k) {
      origin_[k][lane] = ray.origin[k];
      direction_[k][lane] = ray.direction[k];
    }
    length_[lane] = ray.length;
    tmin_[lane] = ray.tmin;
    tmax_[lane] = ray.tmax;
  }

  /// Those of the `open` rays that surely hit the triangle in the block's lane: the float test of leaf_test-inl.h with
  /// the parts of ray and triangle exchanged. Which of the others hit it stays open.
  HWY_INLINE std::uint32_t surely_hit(const Block& block, std::uint32_t lane, std::uint32_t open) const {
    const Lanes8 f;
    const auto e1x = hn::Set(f, block.e1[0][lane]), e1y = hn::Set(f, block.e1[1][lane]);
    const auto e1z = hn::Set(f, block.e1[2][lane]), e2x = hn::Set(f, block.e2[0][lane]);
    const auto e2y = hn::Set(f, block.e2[1][lane]), e2z = hn::Set(f, block.e2[2][lane]);
    const auto edge = hn::Set(f, block.edge_bound);
    std::uint32_t hits = 0;
    for (std::uint32_t i = 0; i < kMost; i += static_cast<std::uint32_t>(hn::Lanes(f))) {
      if ((open >> i & ((1u << hn::Lanes(f)) - 1)) == 0) continue;
      const auto dx = hn::Load(f, direction_[0] + i), dy = hn::Load(f, direction_[1] + i);
      const auto dz = hn::Load(f, direction_[2] + i);
      const auto sx = hn::Sub(hn::Load(f, origin_[0] + i), hn::Set(f, block.v0[0][lane]));
      const auto sy = hn::Sub(hn::Load(f, origin_[1] + i), hn::Set(f, block.v0[1][lane]));
      const auto sz = hn::Sub(hn::Load(f, origin_[2] + i), hn::Set(f, block.v0[2][lane]));
      const auto px = cross_term(dy, e2z, dz, e2y), py = cross_term(dz, e2x, dx, e2z),
                 pz = cross_term(dx, e2y, dy, e2x);
      const auto qx = cross_term(sy, e1z, sz, e1y), qy = cross_term(sz, e1x, sx, e1z),
                 qz = cross_term(sx, e1y, sy, e1x);
      const auto signed_det = dot(e1x, e1y, e1z, px, py, pz);
      const auto sign = hn::And(signed_det, hn::Set(f, -0.0f));
      const auto det = hn::Abs(signed_det);
      const auto u = hn::Xor(dot(sx, sy, sz, px, py, pz), sign);
      const auto v = hn::Xor(dot(dx, dy, dz, qx, qy, qz), sign);
      const auto w = hn::Sub(hn::Sub(det, u), v);
      const auto t = hn::Xor(dot(e2x, e2y, e2z, qx, qy, qz), sign);

      // The bounds, with the distance to the first vertex, a little more for the rounding of its own sum.
      const auto length = hn::Load(f, length_ + i);
      const auto distance = hn::Mul(hn::Add(hn::Abs(sx), hn::Add(hn::Abs(sy), hn::Abs(sz))), hn::Set(f, 1 + 0x1p-20f));
      const auto tmin = hn::Load(f, tmin_ + i), tmax = hn::Load(f, tmax_ + i);
      const auto bound = hn::Set(f, kNormBound);
      const auto e = hn::MulAdd(hn::Mul(bound, hn::Mul(length, edge)), hn::Add(hn::Add(distance, distance), edge),
                                hn::Set(f, kTinyEdge));
      const auto square = hn::Mul(bound, hn::Mul(edge, edge));
      const auto tiny = hn::Set(f, kTinyTime);
      const auto ea = hn::MulAdd(square, hn::MulAdd(hn::Abs(tmin), length, distance), tiny);
      const auto eb = hn::MulAdd(square, hn::MulAdd(hn::Abs(tmax), length, distance), tiny);
      const auto inside = hn::Gt(hn::Min(hn::Min(u, v), w), e);
      const auto after_start = hn::Gt(hn::Sub(t, hn::Mul(tmin, det)), ea);
      const auto before_end = hn::Gt(hn::Sub(hn::Mul(tmax, det), t), eb);
      hits |= bits_of(hn::And(inside, hn::And(after_start, before_end))) << i;
    }
    return hits & open;
  }

 private:
  static FloatVec dot(FloatVec ax, FloatVec ay, FloatVec az, FloatVec bx, FloatVec by, FloatVec bz) {
    return hn::MulAdd(az, bz, hn::MulAdd(ay, by, hn::Mul(ax, bx)));
  }
  static FloatVec cross_term(FloatVec a, FloatVec b, FloatVec c, FloatVec d) { return hn::MulSub(a, b, hn::Mul(c, d)); }

  alignas(32) float origin_[3][kMost] = {};
  alignas(32) float direction_[3][kMost] = {};
  alignas(32) float length_[kMost] = {};
  alignas(32) float tmin_[kMost] = {};
  alignas(32) float tmax_[kMost] = {};
};

class Candidates {
 public:
  /// More lanes cost no time, but each is a test: the last two blockers hold most of what the last eight do.
  static constexpr std::uint32_t kMost = 2;

  explicit Candidates(const SceneView& scene) : scene_(scene) {
    // No ray comes here in scenes whose scale is beyond float's (see prepare).
    scale_ = power_of_two(std::clamp(scene.tree->scale_exponent, -126, 126));
    block_.count = 0;
    block_.edge_bound = 0;
  }

  bool empty() const { return block_.count == 0; }
  const Block& block() const { return block_; }
  /// The lane of the triangle that was added last, or was there.
  std::uint32_t newest() const { return newest_; }

  /// Takes a triangle in, in place of the one that has been there longest.
  void add(std::uint32_t id) {
    if (holds(id)) return;
    Triangle triangle = scene_.triangles[id];
    for (Vec3& v : triangle.v) v *= scale_;
    pack_lane(id, triangle, next_lane(), block_);
  }

  /// The same for one that has just been tested, and so is at hand.
  void add(const Block& from, std::uint32_t lane) {
    if (holds(from.id[lane])) return;
    const std::uint32_t to = next_lane();
    for (int k = 0; k < 3; ++k) {
      block_.v0[k][to] = from.v0[k][lane];
      block_.e1[k][to] = from.e1[k][lane];
      block_.e2[k][to] = from.e2[k][lane];
    }
    block_.id[to] = from.id[lane];
    block_.edge_bound = std::max(block_.edge_bound, from.edge_bound);
  }

 private:
  bool holds(std::uint32_t id) {
    const auto lane = static_cast<std::uint32_t>(std::find(block_.id, block_.id + block_.count, id) - block_.id);
    if (lane < block_.count) newest_ = lane;
    return lane < block_.count;
  }
  std::uint32_t next_lane() { return newest_ = block_.count < kMost ? block_.count++ : next_++ % kMost; }

  const SceneView& scene_;
  float scale_;
  std::uint32_t next_ = 0;
  std::uint32_t newest_ = 0;
  Block block_;
};

}  // namespace HWY_NAMESPACE
}  // namespace umbrix::detail
HWY_AFTER_NAMESPACE();

#endif
