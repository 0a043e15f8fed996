// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <new>
#include <optional>

#include "core/parallel_for.h"
#include "frame/frame_instances.h"
#include "frame/frame_kernel.h"
#include "frame/frame_samples.h"
#include "frame/tile_memory.h"
#include "index/select_paper.h"
#include "umbrix/frame.h"

namespace umbrix {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Status check(const FrameOptions& options) {
  const bool is_power = options.slots >= 8 && options.slots <= 1u << 28 && (options.slots & (options.slots - 1)) == 0;
  if (options.slots != 0 && !is_power)
    return {StatusCode::invalid_argument, "frame tracer: slots must be 0 or a power of two from 8 to 2^28"};
  if (!(options.cell >= 0) || options.region == 0)
    return {StatusCode::invalid_argument, "frame tracer: the cell must not be negative, nor the region 0"};
  return {};
}

/// More than a screen has regions, few enough to stay in the cache.
constexpr std::uint32_t kRegionSlots = 1u << 16;

/// The power of two that is one to two times the triangles, within reason.
std::uint32_t slots_for(std::size_t triangles) {
  std::uint32_t slots = 1u << 12;
  while (slots < 1u << 22 && slots < triangles) slots *= 2;
  return slots;
}

/// A triangle's share of the scene's extent, if they tiled a square of it.
double cell_for(std::size_t triangles) {
  return 1 / std::clamp(std::sqrt(static_cast<double>(triangles)), 64.0, 4096.0);
}

/// Of the views of two frames: did the camera jump by a tenth of the scene, or turn by more than a quarter of a right
/// angle?
bool jumped(const FrameView& from, const FrameView& to, double extent) {
  double moved = 0, dot = 0, from2 = 0, to2 = 0;
  for (int k = 0; k < 3; ++k) {
    moved = std::hypot(moved, double{to.eye[k]} - double{from.eye[k]});
    dot += double{to.forward[k]} * double{from.forward[k]};
    from2 += double{from.forward[k]} * double{from.forward[k]};
    to2 += double{to.forward[k]} * double{to.forward[k]};
  }
  constexpr double kCosine = 0.92387953;
  return moved > 0.1 * extent || dot < kCosine * std::sqrt(from2 * to2);
}

void add(Confusion& sum, const Confusion& part) {
  for (const int occluded : {0, 1}) {
    sum.predicted_occluded[occluded] += part.predicted_occluded[occluded];
    sum.predicted_unoccluded[occluded] += part.predicted_unoccluded[occluded];
    sum.not_predicted[occluded] += part.not_predicted[occluded];
  }
}

}  // namespace

// Hidden: the class that holds it is exported.
struct __attribute__((visibility("hidden"))) FrameTracer::Impl {
  Impl(const Scene& the_scene, const FrameOptions& the_options)
      : scene(*detail::SceneAccess::view(the_scene)),
        instances(detail::SceneAccess::instances(the_scene)),
        options(the_options) {
    const detail::Tree& tree = *scene.tree;
    extent = std::ldexp(static_cast<double>(tree.root.largest_extent()), -tree.scale_exponent);
    if (!(extent > 0) || !std::isfinite(extent)) extent = 1;
    cell_size = extent * (options.cell > 0 ? static_cast<double>(options.cell) : cell_for(scene.kept_count));
    if (remembers()) {
      regions.emplace(kRegionSlots);
      choose_memory(true);
    }
    if (options.method == FrameMethod::best) {
      view_table = std::static_pointer_cast<const detail::LightViewTable>(detail::SceneAccess::default_side(the_scene));
      tables.view = view_table.get();
    }
    if (!tables.view) scene.lazy_tree->build(options.executor);
    if (!tables.view && uses_groups()) {
      wide = std::make_unique<detail::WideTree>(tree, scene.triangles);
      tables.wide = wide.get();
    }
    if (options.method == FrameMethod::paper || options.method == FrameMethod::linked) make_links(options.links);
    if (uses_index() && options.index == IndexMode::paper) {
      index = std::make_unique<detail::PrimitiveIndex>(
          tree, scene.triangles, detail::select_paper(tree, scene.triangles, scene.kept, scene.kept_count));
      tables.index = index.get();
    }
  }

  bool uses_index() const { return options.method == FrameMethod::paper || options.method == FrameMethod::indexed; }

  bool uses_groups() const {
    return options.method == FrameMethod::best || options.method == FrameMethod::cached ||
           options.method == FrameMethod::beam;
  }

  bool remembers() const {
    return options.method == FrameMethod::paper || (uses_groups() && options.method != FrameMethod::beam);
  }

  bool learns_from_rays() const {
    return (tables.links && options.links == LinkMode::reached) ||
           (uses_index() && options.index == IndexMode::learned);
  }

  /// By cells, either a few rays go by one that holds many triangles, or each by one of its own. Where what blocked the
  /// last ray mostly blocks the next one, the former will do and costs less time; among leaves of trees it will not.
  /// The first frame that has rays learns for both; what is chosen then stays.
  void choose_memory(bool is_first) {
    if (is_first) use = {&*regions};
    if (options.key == PredictorKey::screen) return;
    constexpr std::uint64_t kEnoughTries = 256;
    const bool by_points = stats.cache_tries >= kEnoughTries && 20 * stats.cache_hits < 9 * stats.cache_tries;
    if (is_first) {
      points.emplace(options.slots != 0 ? options.slots : slots_for(scene.kept_count));
      use = {&*points, &*regions, 1, 0, 1, true};
    } else if (by_points) {
      use = {&*points, nullptr, 1, 0, 0, true};
    } else {
      points.reset();
      use = {&*regions, nullptr, 16, 1};
    }
  }

  void make_links(LinkMode mode) {
    using detail::LinkBuilder;
    const LinkBuilder builder = mode == LinkMode::lazy   ? LinkBuilder::lazy
                                : mode == LinkMode::full ? LinkBuilder::full
                                                         : LinkBuilder::reached;
    links = std::make_unique<detail::Links>(*scene.tree, builder);
    if (mode == LinkMode::full) links->build_full(options.executor);
    tables.links = links.get();
  }

  /// The paper's links of a frame: over the leaves that the last frame's rays touched.
  void relink(const FrameView& next) {
    if (!tables.links || options.links != LinkMode::reached || samples.empty()) return;
    std::vector<detail::Vec3> lights;
    for (std::size_t i = 0; i < next.light_count; ++i) {
      const float* p = next.lights[i];
      lights.push_back(detail::Vec3(detail::DVec3(p[0], p[1], p[2]) * std::ldexp(1.0, scene.tree->scale_exponent)));
    }
    make_links(LinkMode::reached);
    links->build_reached(lights, samples.touched_leaves(*scene.tree));
  }

  void relearn() {
    if (!uses_index() || options.index != IndexMode::learned || samples.empty()) return;
    index = samples.learned_index(scene, options.executor);
    tables.index = index.get();
  }

  std::uint64_t bytes() const {
    return (regions ? regions->bytes() : 0) + (points ? points->bytes() : 0) + (wide ? wide->bytes() : 0) +
           (links ? links->bytes() : 0) + (index ? index->bytes() : 0);
  }

  detail::SceneView scene;
  const detail::InstanceTree* instances;  ///< asked after all else; nothing is remembered of them. Null: none
  FrameOptions options;
  double extent = 1;
  double cell_size = 1;
  std::optional<detail::OcclusionMemory> regions;  ///< by regions of the image, or by cells of space
  std::optional<detail::OcclusionMemory> points;   ///< by cells that are about a triangle large
  detail::MemoryUse use;
  std::shared_ptr<const detail::LightViewTable> view_table;  ///< the scene's
  std::unique_ptr<detail::WideTree> wide;
  std::unique_ptr<detail::Links> links;
  std::unique_ptr<detail::PrimitiveIndex> index;
  detail::FrameTables tables;
  detail::FrameSamples samples;
  FrameView view;
  bool any_frame = false;
  bool in_frame = false;
  FrameStats stats;
  std::mutex mutex;  ///< of stats and samples, while tiles come in

  void begin(const FrameView& next);
  void trace(const ShadowTile& tile, std::uint8_t* out);
  FrameStats end();
};

void FrameTracer::Impl::begin(const FrameView& next) {
  const auto start = Clock::now();
  stats = FrameStats();
  stats.frame = next.frame;
  stats.first = !any_frame;
  stats.cut = any_frame && regions && options.key == PredictorKey::screen &&
              (next.frame != view.frame + 1 || next.width != view.width || next.height != view.height ||
               jumped(view, next, extent));
  if (stats.cut) regions->forget();
  view = next;
  view.lights = nullptr;        // the host's, for this call only
  any_frame = in_frame = true;  // also if what follows finds no memory
  relink(next);
  relearn();
  samples.clear();
  stats.precompute_seconds = seconds_since(start);
}

void FrameTracer::Impl::trace(const ShadowTile& tile, std::uint8_t* out) {
  const detail::PlaceFinder places(options, view.frame, cell_size);
  const detail::MemoryUse used = in_frame ? use : detail::MemoryUse();
  detail::TileMemory tile_memory(used, places, tile.light, tile.pixels);
  std::optional<detail::WorkSums> sums;
  if (options.count_work) sums.emplace();
  std::uint64_t routes[kRayRoutes] = {};
  detail::FrameTile work{scene, tables, options.method, {tile.rays, out, tile.skip, tile.mask}, tile_memory};
  work.rays.routes = tile.routes;
  work.rays.each = tile.each;
  work.rays.sums = sums ? &*sums : nullptr;
  work.rays.route_rays = routes;
  work.rays.executor = tile.executor;
  instances ? detail::trace_tile(*instances, work) : detail::trace_tile(work);
  if (!in_frame) return;

  const std::lock_guard<std::mutex> lock(mutex);
  stats.rays += tile.rays.count;
  stats.occluded += static_cast<std::uint64_t>(std::count(out, out + tile.rays.count, std::uint8_t{1}));
  add(stats.confusion, tile_memory.confusion());
  stats.cache_tries += work.tries.tried;
  stats.cache_hits += work.tries.blocked;
  for (std::size_t route = 0; route < kRayRoutes; ++route) stats.routes[route] += routes[route];
  if (sums) {
    stats.counts.occluded += sums->counts.occluded;
    stats.counts.unoccluded += sums->counts.unoccluded;
    for (std::size_t route = 0; route < kRayRoutes; ++route)
      for (const int occluded : {0, 1}) stats.route_counts[route][occluded] += sums->by_route[route][occluded];
  }
  if (learns_from_rays()) samples.add(tile);
}

FrameStats FrameTracer::Impl::end() {
  const auto start = Clock::now();
  in_frame = false;
  if (regions) regions->next_frame();
  if (points) points->next_frame();
  if (use.also && stats.rays > 0) choose_memory(false);
  stats.precompute_seconds += seconds_since(start);
  stats.bytes = bytes();
  return stats;
}

FrameTracer::FrameTracer() noexcept = default;
FrameTracer::~FrameTracer() = default;
FrameTracer::FrameTracer(FrameTracer&&) noexcept = default;
FrameTracer& FrameTracer::operator=(FrameTracer&&) noexcept = default;

Status FrameTracer::start(const Scene& scene, const FrameOptions& options) {
  impl_.reset();
  if (Status status = check(options); !status) return status;
  if (!detail::SceneAccess::view(scene))
    return {StatusCode::invalid_argument, "frame tracer: the scene is not committed"};
  try {
    impl_ = std::make_unique<Impl>(scene, options);
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("frame tracer: out of memory");
  } catch (const std::exception& e) {
    return detail::parallel_failure("frame tracer", options.executor, e);
  }
}

Status FrameTracer::begin_frame(const FrameView& view) {
  if (!impl_) return {StatusCode::invalid_argument, "frame tracer: not started"};
  if (impl_->in_frame) return {StatusCode::invalid_argument, "frame tracer: the last frame has not ended"};
  try {
    impl_->begin(view);
    return {};
  } catch (const std::bad_alloc&) {
    return Status::out_of_memory("frame tracer: out of memory for the frame's links and indices");
  } catch (const std::exception& e) {
    return detail::parallel_failure("frame tracer", impl_->options.executor, e);
  }
}

void FrameTracer::occluded(const ShadowTile& tile, std::uint8_t* out) const noexcept {
  if (impl_)
    impl_->trace(tile, out);
  else
    std::fill(out, out + tile.rays.count, std::uint8_t{0});
}

FrameStats FrameTracer::end_frame() { return impl_ && impl_->in_frame ? impl_->end() : FrameStats(); }

double FrameStats::regret() const noexcept {
  const RayCounts& walked = route_counts[static_cast<std::size_t>(RayRoute::beam)][1];
  if (rays == 0 || walked.rays == 0 || cache_tries == 0) return 0;
  const auto work = [](const RayCounts& c) { return static_cast<double>(c.node_tests + c.primitive_tests); };
  const double walk = work(walked) / static_cast<double>(walked.rays);
  const double tests = static_cast<double>(counts.occluded.index_tests + counts.unoccluded.index_tests);
  return (tests - static_cast<double>(cache_hits) * walk) / static_cast<double>(rays);
}

}  // namespace umbrix
