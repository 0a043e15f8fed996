// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "index/instance_tree.h"
#include "kernels/kernel.h"

namespace umbrix::detail {

// Queries go to the kernel that was asked for, which knows nothing of instances, and with what it found they come here.

/// Sets out[i] for rays that are 0 there and that an instance blocks. `each`, if given, receives the work for each ray,
/// which is not counted as a ray again.
void add_instances(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, const QueryOptions& options,
                   RayCounts* each = nullptr) noexcept;

/// The same, and adds the work to counts that have the kernel's: rays that an instance blocks move to the occluded
/// ones, but what the kernel did for them stays where it was.
void add_instances(const InstanceTree& tree, RaySpan rays, std::uint8_t* out, QueryOptions options,
                   OcclusionCounts& counts) noexcept;

/// Replaces hits in triangles of the scene by those in instances that come before them. Work is added to `counts`, if
/// given.
void add_closest_instances(const InstanceTree& tree, const SceneView& scene, RaySpan rays, Hit* out,
                           const QueryOptions& options, RayCounts* counts = nullptr) noexcept;

}  // namespace umbrix::detail
