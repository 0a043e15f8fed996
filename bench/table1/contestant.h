// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "report.h"
#include "umbrix/umbrix.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {

/// The frames of a moving camera: the same light's shadow rays in each.
using Frames = std::vector<workload::TiledRays>;

/// What tracing the last frame took.
struct FrameResult {
  std::vector<std::uint8_t> answers;
  OcclusionCounts counts;          ///< if counted
  double seconds = 0;              ///< of traversal, processor time of one thread
  double precompute_seconds = 0;   ///< what had to be made for it, on one thread
  std::uint64_t memory_bytes = 0;  ///< beside the tree
  std::string notes;               ///< what else there is to say, for the table's foot
  FrameStats frame;                ///< of frame tracers
};

/// The rays of a tile.
RaySpan tile_rays(const workload::TiledRays& frame, std::size_t tile);

/// Calls trace(tile, answers) for all tiles and returns the thread's seconds.
template <typename Trace>
double trace_tiles(const workload::TiledRays& frame, std::vector<std::uint8_t>& answers, const Trace& trace) {
  answers.assign(frame.rays.size(), 0);
  const std::size_t tiles = frame.tile_starts.size() - 1;
  const double start = thread_seconds();
  for (std::size_t tile = 0; tile < tiles; ++tile) trace(tile, answers.data() + frame.tile_starts[tile]);
  return thread_seconds() - start;
}

/// A way to answer a frame's shadow rays.
class Contestant {
 public:
  virtual ~Contestant() = default;
  virtual const std::string& name() const = 0;

  /// Starts anew, goes through all frames and reports of the last one.
  virtual Status run(Scene& scene, const Frames& frames, const Training& lights, bool count, FrameResult& out) = 0;
};

/// One for each kernel of the table ("standard", "ropes", ...), for the frame tracer ("auto") and for the paper's
/// method in full ("paper"). `names` may name them, or a family before a dash ("sato" for "sato-box" and the others);
/// "all" is everything but "brute". invalid_argument names the known ones.
Status make_contestants(const std::vector<std::string>& names, std::vector<std::unique_ptr<Contestant>>& out);

/// A kernel of the table as a contestant.
std::unique_ptr<Contestant> kernel_contestant(std::string name, KernelId kernel);

/// A frame tracer with these options as a contestant.
std::unique_ptr<Contestant> frame_contestant(std::string name, const FrameOptions& options);

/// Runs everything on the calling thread, so that what is made beforehand is charged like traversal.
const Executor& one_thread();

}  // namespace umbrix::bench
