// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "umbrix/frame.h"

namespace umbrix::render {

using umbrix::kRayRoutes;
using umbrix::RayRoute;

/// By index_of, in the order of the `kernel` channels.
constexpr std::array<const char*, kRayRoutes> kRouteNames = {"cached", "beam", "indexed", "linked", "other"};

/// Rays by route.
template <typename Count>
using RouteCounts = std::array<Count, kRayRoutes>;

constexpr std::size_t index_of(RayRoute route) { return static_cast<std::size_t>(route); }

}  // namespace umbrix::render
