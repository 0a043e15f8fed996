// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "umbrix/export.h"
#include "umbrix/ray.h"
#include "umbrix/scene.h"
#include "umbrix/stats.h"
#include "umbrix/status.h"

namespace umbrix {

/// How a frame's shadow rays are answered. Answers are the same; time is not.
enum class FrameMethod {
  best,      ///< all rays of a tile as the light sees them, if it has 128 or more; where that does not serve, as cached
  cached,    ///< remembered occluders for rays predicted occluded, one walk for a group of rays for the others
  paper,     ///< indexed walk for rays predicted occluded, links for the others (Liang & Huang 2019)
  indexed,   ///< the indexed walk for all
  linked,    ///< links for all
  beam,      ///< groups for all, nothing remembered
  standard,  ///< the stack walk for all
};

/// What a prediction is kept by.
enum class PredictorKey {
  object,  ///< the place where the ray starts: holds while the camera moves
  screen,  ///< square regions of the image, as in the paper
};

/// What is predicted from what the last frame's rays met.
enum class PredictorRule {
  counter,   ///< a two-bit counter that each frame's majority moves; unsure in the middle
  majority,  ///< what most of the last frame's rays met
  sample,    ///< what one ray of the region met, another in each frame, as in the paper
};

/// How links come into being.
enum class LinkMode {
  lazy,     ///< by the first ray that wants one
  reached,  ///< at the start of a frame, breadth-first from the lights over leaves that were touched, as in the paper
  full,     ///< all at once
};

/// What is indexed on inner nodes.
enum class IndexMode {
  learned,  ///< triangles that blocked last frame's rays
  paper,    ///< large triangles, by the paper's cost model
};

struct FrameOptions {
  FrameMethod method = FrameMethod::best;
  PredictorKey key = PredictorKey::object;
  PredictorRule rule = PredictorRule::counter;
  std::uint32_t region = 8;  ///< pixels along a side, for PredictorKey::screen
  /// Of the scene's largest extent, for PredictorKey::object; 0: about the size of its triangles. Where blockers last
  /// from ray to ray, places of twice the size serve.
  float cell = 0;
  /// Remembered places of that size, a power of two, 16 bytes each, which places share by a hash; 0: one or two a
  /// triangle. Larger places and regions of the screen have a memory of fixed size.
  std::uint32_t slots = 0;
  LinkMode links = LinkMode::lazy;       ///< for FrameMethod::paper and linked
  IndexMode index = IndexMode::learned;  ///< for FrameMethod::paper and indexed
  bool count_work = false;               ///< fill FrameStats::counts; slower
  const Executor* executor = nullptr;    ///< for what is built between frames; null: oneTBB
};

/// What a frame is seen from. Only PredictorKey::screen, PredictorRule::sample and LinkMode::reached depend on it.
struct FrameView {
  std::int64_t frame = 0;               ///< its number; one that does not follow the last is a cut
  std::uint32_t width = 0, height = 0;  ///< of the image; 0: unknown
  float eye[3] = {0, 0, 0};
  float forward[3] = {0, 0, 0};        ///< the viewing direction, any length; zeros: unknown
  const float (*lights)[3] = nullptr;  ///< where lights are, for LinkMode::reached
  std::size_t light_count = 0;
};

/// A pixel of the image.
struct Pixel {
  std::uint16_t x = 0, y = 0;
};

/// How a ray was answered.
enum class RayRoute : std::uint8_t {
  cached,   ///< by a triangle that blocked rays there in the last frame, or rays just before
  beam,     ///< with its group, or as the light sees it
  indexed,  ///< by the indexed walk
  linked,   ///< from leaf to leaf
  other,    ///< by the stack walk, by an exact slow path, or not at all (see Ray)
};
inline constexpr std::size_t kRayRoutes = 5;

/// Shadow rays to one light that start near each other, in an order in which neighbours follow each other (blocks of
/// 4x4 pixels, say): what comes in one call is traced together.
struct ShadowTile {
  std::uint32_t light = 0;  ///< a number that stays the light's from frame to frame
  RaySpan rays;
  const Primitive* skip = nullptr;  ///< as in QueryOptions
  std::uint32_t mask = 0xFFFFFFFFu;
  const Pixel* pixels = nullptr;  ///< of each ray; needed by PredictorKey::screen, which else predicts nothing
  RayRoute* routes = nullptr;     ///< if given, receives each ray's route
  RayCounts* each = nullptr;      ///< if given, receives each ray's work; slower
  /// Shares many rays that are answered as the light sees them among its threads; Executor{} is oneTBB. Null, and where
  /// work is counted: the thread that calls does all.
  const Executor* executor = nullptr;
};

/// Rays by what was predicted and what was true.
struct Confusion {
  std::uint64_t predicted_occluded[2] = {0, 0};  ///< of these, [0] were not and [1] were
  std::uint64_t predicted_unoccluded[2] = {0, 0};
  std::uint64_t not_predicted[2] = {0, 0};

  /// The share of predictions that were right; 0 if there were none.
  double accuracy() const noexcept {
    const double right = static_cast<double>(predicted_occluded[1] + predicted_unoccluded[0]);
    const double all = right + static_cast<double>(predicted_occluded[0] + predicted_unoccluded[1]);
    return all > 0 ? right / all : 0;
  }
};

/// What a frame did. All but the seconds is the same for any number of threads, if the tiles are.
struct FrameStats {
  std::int64_t frame = 0;
  bool first = false;  ///< nothing was known before it
  bool cut = false;    ///< the screen's memory was dropped: the view jumped, or the size or numbering changed
  std::uint64_t rays = 0;
  std::uint64_t occluded = 0;
  Confusion confusion;            ///< of rays that may need a walk; zeros for methods that remember nothing
  std::uint64_t cache_tries = 0;  ///< how often a ray met triangles that blocked others (RayRoute::cached)
  std::uint64_t cache_hits = 0;   ///< and was blocked by one
  std::uint64_t routes[kRayRoutes] = {};
  OcclusionCounts counts;                 ///< if asked for
  RayCounts route_counts[kRayRoutes][2];  ///< if asked for; by route, [0] unoccluded and [1] occluded
  double precompute_seconds = 0;          ///< in begin_frame and end_frame
  std::uint64_t bytes = 0;                ///< held beside the scene after the frame

  /// Node and primitive tests a ray by which trying such triangles cost more than it saved, against never trying
  /// (negative: it saved), from the mean cost of walks. 0 without counts.
  double regret() const noexcept;
};

/// Shadow rays from frame to frame: learns from each frame what blocks rays and where, to answer the next one's sooner.
/// A wrong guess costs time, never an answer: all answers are those of Scene::occluded.
///
/// A frame is begin_frame, occluded for any tiles from any number of threads, end_frame. The scene must be committed,
/// and outlive the tracer. No call throws.
class UMBRIX_API FrameTracer {
 public:
  FrameTracer() noexcept;
  ~FrameTracer();
  FrameTracer(FrameTracer&&) noexcept;
  FrameTracer& operator=(FrameTracer&&) noexcept;
  FrameTracer(const FrameTracer&) = delete;
  FrameTracer& operator=(const FrameTracer&) = delete;

  /// Binds it to a scene and forgets all. invalid_argument: a scene that is not committed, `slots` that are neither
  /// 0 nor a power of two from 8 to 2^28, a negative cell, a region of 0. resource_limit: no memory.
  Status start(const Scene& scene, const FrameOptions& options = {});

  /// Frames have any numbers; gaps and steps back are cuts. invalid_argument: not started, or within a frame.
  /// resource_limit: no memory for what the frame wants to build; it may go on all the same.
  Status begin_frame(const FrameView& view = {});

  /// out[i] is 1 if the tile's ray i is occluded, else 0. Any threads, but not while start, begin_frame or end_frame
  /// run. Also right outside of a frame; FrameStats then does not count it.
  void occluded(const ShadowTile& tile, std::uint8_t* out) const noexcept;

  /// What the frame did; zeros outside of one.
  FrameStats end_frame();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace umbrix
