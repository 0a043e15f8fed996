// SPDX-License-Identifier: Apache-2.0
// Shadow rays as seen from the light that they end at: what one call works on, and what it needs beside the scene.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <vector>

#include "core/lazy_array.h"
#include "index/triangle_bvh.h"
#include "index/wide_tree.h"
#include "kernels/shaft.h"
#include "tree/lazy_tree.h"

namespace umbrix::detail {

/// One of six pictures that the light sees, along an axis or against it. A point is at (u, v), its offsets from the
/// light on the other two axes over its depth; w is one over the depth.
struct Face {
  std::uint32_t axis;
  float sign;

  explicit Face(std::uint32_t number) : axis(number / 2), sign(number % 2 ? -1.0f : 1.0f) {}
  std::uint32_t u_axis() const noexcept { return (axis + 1) % 3; }
  std::uint32_t v_axis() const noexcept { return (axis + 2) % 3; }
};
inline constexpr std::uint32_t kViewFaces = 6;

/// Where the rays end, as a sum: offsets from it are rounded as if it were a float.
struct LightPoint {
  float high[3] = {}, low[3] = {};
};

/// How far the ends of true segments may be from what is computed, over the depth of the start; and at most, anywhere.
struct ViewErrors {
  float start = 0, end = 0;
  float most = 0;
};

/// The most rays of a group.
inline constexpr std::uint32_t kGroupRays = 64;

/// Rays that are answered together: fewer are not worth it, and what is kept of more does not stay in a core's caches.
inline constexpr std::size_t kFewestBatchRays = std::size_t{1} << 14, kMostBatchRays = std::size_t{1} << 17;

/// Rays of one face whose starts are near each other as the light sees them.
struct RayGroup {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  float u, v, half_u, half_v;    ///< the rectangle that they are in
  float slope_u, slope_v, base;  ///< no start is farther than where w is base + slope_u u + slope_v v
  float nearest, farthest;       ///< the largest and the smallest w
  float reach;                   ///< the largest depth
  std::uint32_t first, count;    ///< in the order of groups
  std::uint32_t packets;         ///< the first of them, or kNone before a triangle comes near
  std::uint32_t open;            ///< packets with rays that are not blocked
};

/// Rectangles and depths side by side.
struct alignas(64) ViewRows {
  enum Row : std::uint32_t { low_u, high_u, low_v, high_v, depth, kRows };

  float rows[kRows][kRowLanes];  ///< depth as w: of groups the farthest start, of triangles the nearest point
};

/// A rectangle of the view and one depth, as w.
struct ViewBox {
  float low_u, high_u, low_v, high_v, depth;
};

/// Triangles prepared for one face. Each value is a linear function of r = (u, v, 1).
struct alignas(64) LightTriangles {
  ViewRows bounds;
  float edge[3][3][kRowLanes];      ///< by edge and coefficient: positive inside of the edge
  float plane[3][kRowLanes];        ///< w of the triangle's plane
  float edge_error[2][kRowLanes];   ///< of an edge's value: [0] + [1] / w
  float plane_error[2][kRowLanes];  ///< of the plane's value less w: [0] + [1] w
  const std::uint32_t* id;
  std::uint32_t edge_on;  ///< the light is too near to their planes: no side is known of edges, and there is no plane
};

/// Rays of a group side by side, as many as there are lanes.
struct LightPacket {
  ViewBox box;
  std::uint32_t first;    ///< in the order of groups
  std::uint32_t blocked;  ///< lanes, with those that have no ray
};

/// Triangles of a leaf that a group's rays may meet; and a packet's.
struct MetGroup {
  std::uint32_t group, triangles;
};
struct MetPacket {
  std::uint32_t group, packet, triangles;
};

/// Rays of a packet that may be blocked by a triangle: the exact test will tell, if nothing else blocks them.
struct OpenRays {
  std::uint32_t packet, lanes, id;
};

/// Memory of one call, used again by the next.
struct LightViewScratch {
  /// One value of each ray, in memory that all share: large pages serve one large piece better than four.
  template <class T>
  struct Column {
    T* begin = nullptr;

    T* data() const noexcept { return begin; }
    T& operator[](std::size_t i) const noexcept { return begin[i]; }
  };
  struct RayColumns {
    float values[4];
  };
  struct FaceGroups {
    std::vector<RayGroup> groups;
    std::vector<ViewRows> rows;
    std::vector<std::uint32_t> live;  ///< by row: groups that are not answered as a whole
  };
  struct Record {
    float u, v, w;
    std::int32_t name;
  };
  /// Node and leaf visits that a group's rays share.
  struct SharedWork {
    std::uint64_t nodes = 0, leaves = 0;
  };

  LazyArray<RayColumns> columns;
  Column<float> u, v, w;      ///< of rays, in the order of groups once there are groups
  Column<std::int32_t> name;  ///< their places in the caller's order
  std::size_t ray_count = 0;
  LazyArray<Record> records;        ///< sorted by cells
  LazyArray<std::uint16_t> cells;   ///< by ray, for sorting
  std::vector<std::uint32_t> ends;  ///< of cells, among what is sorted
  std::vector<float> above[3];      ///< for cutting groups
  std::vector<std::int32_t> above_name;
  FaceGroups faces[kViewFaces];
  std::vector<std::uint64_t> lists;  ///< of the walk: rows of groups and lanes
  /// Triangles that are being fetched, and the groups that want them.
  struct WaitingLeaf {
    std::uint32_t rows = 0;
    std::vector<std::uint64_t> list;
  };
  static constexpr std::uint32_t kWaitingLeaves = 8;
  WaitingLeaf waiting[kWaitingLeaves];
  std::vector<LightPacket> packets;
  std::vector<OpenRays> open;
  std::vector<MetGroup> met_groups;  ///< of a leaf
  std::vector<MetPacket> met_packets;
  std::vector<SharedWork> shared;  ///< by group; only for queries that count
  std::vector<std::uint32_t> odd;  ///< rays that do not end at the light, or are nothing for floats
  ShaftScratch shafts;             ///< of calls that are answered by those instead

  /// Forgets all rays, and makes room. Throws std::bad_alloc, as all that fills it.
  void clear(std::size_t room) {
    if (columns.size() < room) {
      columns = LazyArray<RayColumns>();
      columns = LazyArray<RayColumns>(room, Fill::nothing);
      u = {columns.data()->values};
      v = {u.begin + room};
      w = {v.begin + room};
      name = {reinterpret_cast<std::int32_t*>(w.begin + room)};
    }
    ray_count = 0;
    odd.clear();
    for (FaceGroups& face : faces) face.groups.clear();
  }
  /// For as many rays as there is room for.
  void make_room_to_sort() {
    if (cells.size() >= columns.size()) return;
    records = LazyArray<Record>(columns.size(), Fill::nothing);
    cells = LazyArray<std::uint16_t>(columns.size(), Fill::nothing);
  }
  std::uint64_t bytes() const noexcept {
    const std::uint64_t rays =
        columns.size() * sizeof(RayColumns) + records.size() * sizeof(Record) + cells.size() * sizeof(cells[0]);
    return rays + shafts.bytes() + packets.capacity() * sizeof(LightPacket) + open.capacity() * sizeof(OpenRays);
  }
  std::size_t group_count() const noexcept {
    std::size_t count = 0;
    for (const FaceGroups& face : faces) count += face.groups.size();
    return count;
  }
};

/// The hierarchy that the view walks; memory that calls borrow; and the wide tree, for rays that a view of the light is
/// not for, from when they want it. Any threads.
class LightViewTable : public SideTable {
 public:
  /// What is named must outlive it.
  LightViewTable(const TriangleBvh& bvh, const LazyTree& tree, const Triangle* triangles)
      : bvh_(bvh), tree_(tree), triangles_(triangles) {}

  const TriangleBvh& bvh() const noexcept { return bvh_; }
  std::uint64_t bytes() const noexcept override {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::uint64_t held = wide_ ? wide_->bytes() : 0;
    for (const auto& scratch : idle_) held += scratch->bytes();
    return held;
  }

  /// Builds the tree, if need be. Throws what that does.
  void make_wide(const Executor* executor) const {
    tree_.build(executor);
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!wide_) wide_ = std::make_unique<WideTree>(tree_.tree(), triangles_);
    wide_now_.store(wide_.get(), std::memory_order_release);
  }
  /// Null if there is no memory.
  const WideTree* need_wide() const noexcept { return tree_.need() ? wide_of_built() : nullptr; }
  /// Null if so few rays have wanted it that it does not pay yet, or if there is no memory.
  const WideTree* earn_wide(std::size_t rays) const noexcept { return tree_.earn(rays) ? wide_of_built() : nullptr; }

  /// Throws std::bad_alloc.
  std::unique_ptr<LightViewScratch> borrow() const {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!idle_.empty()) {
        auto scratch = std::move(idle_.back());
        idle_.pop_back();
        return scratch;
      }
    }
    return std::make_unique<LightViewScratch>();
  }
  /// For later calls, unless there is no memory to note it.
  void give_back(std::unique_ptr<LightViewScratch> scratch) const noexcept try {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(scratch));
  } catch (const std::bad_alloc&) {
  }

 private:
  const WideTree* wide_of_built() const noexcept {
    if (const WideTree* const wide = wide_now_.load(std::memory_order_acquire)) return wide;
    try {
      make_wide(nullptr);
    } catch (const std::bad_alloc&) {
      return nullptr;
    }
    return wide_now_.load(std::memory_order_acquire);
  }

  const TriangleBvh& bvh_;
  const LazyTree& tree_;
  const Triangle* triangles_;
  mutable std::mutex mutex_;  ///< of what follows
  mutable std::unique_ptr<WideTree> wide_;
  mutable std::atomic<const WideTree*> wide_now_{nullptr};
  mutable std::vector<std::unique_ptr<LightViewScratch>> idle_;
};

/// Memory of a table, as long as it is needed.
class BorrowedScratch {
 public:
  /// Throws std::bad_alloc.
  explicit BorrowedScratch(const LightViewTable& table) : table_(table), scratch_(table.borrow()) {}
  BorrowedScratch(const BorrowedScratch&) = delete;
  BorrowedScratch& operator=(const BorrowedScratch&) = delete;
  ~BorrowedScratch() { table_.give_back(std::move(scratch_)); }

  LightViewScratch& operator*() const noexcept { return *scratch_; }
  LightViewScratch* operator->() const noexcept { return scratch_.get(); }

 private:
  const LightViewTable& table_;
  std::unique_ptr<LightViewScratch> scratch_;
};

}  // namespace umbrix::detail
