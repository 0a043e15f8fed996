// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "embree/embree_scene.h"
#include "table1/contestant.h"

namespace umbrix::bench {

/// Embree in each of its modes ("embree:MODE:suffix"), one tile a call. `scene` holds the same triangles as the Scene
/// that run() is given, and must outlive them.
std::vector<std::unique_ptr<Contestant>> embree_contestants(const embree::EmbreeScene& scene,
                                                            const std::string& suffix);

}  // namespace umbrix::bench
