// SPDX-License-Identifier: Apache-2.0
#include "memory_plan.h"

#include <fmt/format.h>

#include "frame_loop.h"
#include "memory_guard.h"

namespace umbrix::app {
namespace {

/// At the peak of a build a triangle holds about this much: sorted events of the cells on the way down, references and
/// finished subtrees (docs/reliability.md has what was measured).
std::uint64_t build_bytes_per_triangle(BuildQuality quality) { return quality == BuildQuality::high ? 450 : 350; }

/// What libraries, threads and encoders come to hold while the program runs.
constexpr std::uint64_t kProgramBytes = 30 << 20;

/// A triangle that instances share, with its boxes, and an instance that shares.
constexpr std::uint64_t kSharedTriangleBytes = 220, kInstanceBytes = 700;

double megabytes(std::uint64_t bytes) { return static_cast<double>(bytes) / (1 << 20); }

}  // namespace

MemoryPlan plan_memory(const RenderJob& job) {
  MemoryPlan plan;
  plan.held = resident_bytes() + kProgramBytes;
  const render::WorldSize size = render::world_size(job.scene, job.arguments.instancing);
  plan.world = size.placed_vertices * sizeof(io::Float3) +
               size.placed_triangles * build_bytes_per_triangle(job.arguments.build_quality) +
               size.shared_triangles * kSharedTriangleBytes + size.sharing_instances * kInstanceBytes;
  // The floats, a copy of them while they are encoded, and one for a checkpoint.
  const std::uint64_t copies = job.arguments.checkpoints.writes() ? 3 : 2;
  plan.image = copies * render::image_bytes(render_options(job));
  return plan;
}

Status check_memory(const RenderJob& job) {
  const std::uint64_t limit = job.arguments.memory_limit;
  const MemoryPlan plan = plan_memory(job);
  if (limit == 0 || plan.peak() <= limit) return {};
  return {
      StatusCode::resource_limit,
      fmt::format("{}: about {:.0f} MB would be needed ({:.0f} for the tree over {} triangles, {:.0f} for an image of "
                  "{}x{}), the memory limit is {:.0f} MB (--memory-limit)",
                  job.scene.path, megabytes(plan.peak()), megabytes(plan.world), job.scene.instanced_triangles(),
                  megabytes(plan.image), job.size.width, job.size.height, megabytes(limit))};
}

}  // namespace umbrix::app
