// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "umbrix/ray.h"
#include "umbrix/status.h"
#include "workload/geometry.h"

namespace umbrix::bench {

struct FirstFrameSettings {
  int threads = 1;
  int rounds = 7;
  bool has_embree = true;
};

/// Times what a host waits for until it has its first frame: a scene made from the meshes in memory and the frame's
/// rays answered by the default kernel; for Embree the commit of a scene of medium quality, and the same rays by the
/// mode that takes least. Builders take turns; medians. Also what each holds at most while it builds. Prints a line and
/// adds rows of the phase "build+first"; `any_wrong`: did we answer a ray wrong?
Status measure_first_frame(const workload::Geometry& geometry, const std::vector<Ray>& rays,
                           const FirstFrameSettings& settings, nlohmann::json& rows, bool& any_wrong);

}  // namespace umbrix::bench
