// SPDX-License-Identifier: Apache-2.0
#include "frame/frame_instances.h"

#include <memory>
#include <new>
#include <utility>

#include "kernels/instanced.h"

namespace umbrix::detail {
namespace {

/// The caller's array for all rays, or one for the time being; null if there is no memory.
template <class T>
class PerRay {
 public:
  PerRay(T*& given, std::size_t count) : given_(given), is_given_(given != nullptr) {
    if (is_given_) return;
    own_.reset(new (std::nothrow) T[count]{});
    given = own_.get();
  }
  ~PerRay() {
    if (!is_given_) given_ = nullptr;
  }
  PerRay(const PerRay&) = delete;
  PerRay& operator=(const PerRay&) = delete;

 private:
  T*& given_;
  bool is_given_;
  std::unique_ptr<T[]> own_;
};

QueryOptions options_of(const GroupRays& rays) {
  QueryOptions options;
  options.mask = rays.mask;
  options.skip = rays.skip;
  return options;
}

/// Work goes by the true answer, which is known when instances have been asked.
void trace_counted(const InstanceTree& instances, FrameTile& tile) {
  GroupRays& rays = tile.rays;
  const std::size_t count = rays.rays.count;
  WorkSums* const sums = std::exchange(rays.sums, nullptr);
  const PerRay<RayCounts> each(rays.each, count);
  const PerRay<RayRoute> routes(rays.routes, count);
  RayCounts* const more = new (std::nothrow) RayCounts[count];
  const std::unique_ptr<RayCounts[]> owner(more);
  trace_tile(tile);
  add_instances(instances, rays.rays, rays.out, options_of(rays), more);
  if (!more || !rays.each || !rays.routes) return;
  for (std::size_t i = 0; i < count; ++i) {
    rays.each[i] += more[i];
    if (!sums) continue;
    const bool occluded = rays.out[i] != 0;
    (occluded ? sums->counts.occluded : sums->counts.unoccluded) += rays.each[i];
    sums->by_route[static_cast<std::size_t>(rays.routes[i])][occluded ? 1 : 0] += rays.each[i];
  }
}

}  // namespace

void trace_tile(const InstanceTree& instances, FrameTile& tile) noexcept {
  if (tile.rays.counts()) {
    trace_counted(instances, tile);
  } else {
    trace_tile(tile);
    add_instances(instances, tile.rays.rays, tile.rays.out, options_of(tile.rays));
  }
}

}  // namespace umbrix::detail
