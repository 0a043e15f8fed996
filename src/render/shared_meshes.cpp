// SPDX-License-Identifier: Apache-2.0
#include "render/shared_meshes.h"

namespace umbrix::render {
namespace {

/// An instance takes as much memory as a few triangles, and a ray that comes by as long as for some more.
constexpr std::size_t kSmallMesh = 64;

/// Placed, so many triangles take half a gigabyte while their tree is built: what sharing has to save. Rays take about
/// as long either way (docs/instances.md), but the work that --stats counts is told by kernel for placed ones alone.
constexpr std::uint64_t kWorthSharing = 1'000'000;

/// Meshes that move, if the rest is larger: else most would have to be built again in any case, and rays be slower.
void share_what_moves(const io::SceneFile& file, std::vector<bool>& shared) {
  const std::vector<bool> moving = io::moving_instances(file);
  std::uint64_t triangles[2] = {};
  for (std::size_t i = 0; i < moving.size(); ++i) {
    triangles[moving[i] ? 1 : 0] += file.meshes[file.instances[i].mesh].triangles.size();
  }
  if (triangles[0] <= triangles[1]) return;
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (moving[i]) shared[file.instances[i].mesh] = true;
  }
}

}  // namespace

std::vector<bool> shared_meshes(const io::SceneFile& file, Instancing instancing, bool moves) {
  std::vector<bool> shared(file.meshes.size());
  if (instancing == Instancing::flatten) return shared;
  std::vector<std::uint64_t> uses(file.meshes.size());
  for (const io::Instance& instance : file.instances) ++uses[instance.mesh];
  std::uint64_t saved = 0;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    shared[i] = uses[i] > 1 && file.meshes[i].triangles.size() >= kSmallMesh;
    if (shared[i]) saved += (uses[i] - 1) * file.meshes[i].triangles.size();
  }
  if (instancing == Instancing::automatic && saved < kWorthSharing) shared.assign(shared.size(), false);
  if (moves) share_what_moves(file, shared);
  return shared;
}

WorldSize world_size(const io::SceneFile& file, Instancing instancing) {
  const std::vector<bool> shared = shared_meshes(file, instancing);
  WorldSize size;
  for (const io::Instance& instance : file.instances) {
    const io::Mesh& mesh = file.meshes[instance.mesh];
    if (shared[instance.mesh]) {
      ++size.sharing_instances;
    } else {
      size.placed_vertices += mesh.positions.size();
      size.placed_triangles += mesh.triangles.size();
    }
  }
  for (std::size_t i = 0; i < shared.size(); ++i)
    if (shared[i]) size.shared_triangles += file.meshes[i].triangles.size();
  return size;
}

}  // namespace umbrix::render
