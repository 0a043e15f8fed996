// SPDX-License-Identifier: Apache-2.0
// Shadow rays as seen from the light that they end at.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "core/math.h"
#include "index/triangle_bvh.h"

namespace umbrix::detail {

/// Which way the view looks: along an axis, or against it. A point's coordinates there are its offsets from the light on
/// the other two axes over its depth, and one over the depth.
struct Face {
  std::uint32_t axis = 0;
  float sign = 1;

  explicit Face(std::uint32_t number) : axis(number / 2), sign(number % 2 ? -1.0f : 1.0f) {}
  std::uint32_t u_axis() const { return (axis + 1) % 3; }
  std::uint32_t v_axis() const { return (axis + 2) % 3; }
};
inline constexpr std::uint32_t kViewFaces = 6;

/// The most rays of a group.
inline constexpr std::uint32_t kGroupRays = 48;

/// Rays of one face whose starts are near each other as the light sees them.
struct RayGroup {
  float u, v, half_u, half_v;  ///< the rectangle that they are in
  float slope_u, slope_v, base;  ///< no start is farther than where one over the depth is base + slope_u u + slope_v v
  float nearest, farthest;       ///< the largest and the smallest one over the depth
  float reach;  ///< the largest depth
  std::uint32_t first, count;
};

/// Groups side by side, by what boxes are tested against: the rectangle and the farthest start.
struct alignas(64) GroupRows {
  enum Row : std::uint32_t { low_u, high_u, low_v, high_v, farthest, kRows };

  float rows[kRows][kRowLanes];
};

/// Triangles side by side, prepared for one light: for a start that the light sees at (u, v), w = 1 over the depth, each
/// value is a linear function of r = (u, v, 1).
struct alignas(64) LightTriangles {
  float edge[3][3][kRowLanes];  ///< by edge and axis; r is inside of an edge where its product with it is positive
  float plane[3][kRowLanes];    ///< its product with r is one over the plane's depth at r
  float edge_error[2][kRowLanes];   ///< of an edge's product: [0] + [1] / w
  float plane_error[2][kRowLanes];  ///< of the plane's product less w: [0] + [1] w
  std::uint32_t id[kRowLanes];
};

/// Lanes of LightTriangles that a group's rays may meet.
struct Meeting {
  std::uint32_t group;
  std::uint32_t triangles;
  std::uint32_t lanes;    ///< sides known
  std::uint32_t edge_on;  ///< the light is too near their plane: edges are as they come, there is no plane
};

/// Memory for one call, used again by the next.
struct LightViewScratch {
  struct FaceGroups {
    std::vector<RayGroup> groups;
    std::vector<GroupRows> rows;
    std::vector<std::uint32_t> live;  ///< by row: groups that are not answered yet
  };

  /// Rays of one face that were read together.
  struct Segment {
    std::uint32_t face;
    std::size_t first, count;
  };
  struct Record {
    float u, v, w;
    std::int32_t name;
  };

  std::vector<float> u, v, w;      ///< of rays in the order of groups
  std::vector<std::int32_t> name;  ///< their places in the caller's order
  std::size_t ray_count = 0;
  std::vector<Segment> segments;
  std::vector<Record> records;
  std::vector<float> above[3];
  std::vector<std::int32_t> above_name;
  FaceGroups faces[kViewFaces];
  std::vector<LightTriangles> triangles;
  std::uint32_t triangle_count = 0;
  std::vector<Meeting> meetings, sorted;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint64_t> lists;
  std::vector<std::uint32_t> odd;  ///< rays that the view is not for

  /// Forgets all rays, and makes room.
  void clear(std::size_t room) {
    if (u.size() < room) {
      u.resize(room);
      v.resize(room);
      w.resize(room);
      name.resize(room);
    }
    ray_count = 0;
    odd.clear();
    segments.clear();
    for (FaceGroups& face : faces) face.groups.clear();
  }
};

/// The hierarchy, and memory that calls borrow.
class LightViewTable : public SideTable {
 public:
  explicit LightViewTable(std::unique_ptr<TriangleBvh> bvh) : bvh_(std::move(bvh)) {}

  const TriangleBvh& bvh() const noexcept { return *bvh_; }
  std::uint64_t bytes() const noexcept override { return bvh_->bytes(); }

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
  void give_back(std::unique_ptr<LightViewScratch> scratch) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(scratch));
  }

 private:
  std::unique_ptr<TriangleBvh> bvh_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<LightViewScratch>> idle_;
};

}  // namespace umbrix::detail
