// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace umbrix::render {

/// Which way answered a shadow ray. The order is that of the `kernel` channels.
enum class RayRoute {
  cached,   ///< an occluder remembered from a ray before
  indexed,  ///< a walk that an index shortened
  linked,   ///< a walk along links
  other     ///< the one kernel asked for
};

constexpr std::size_t kRayRoutes = 4;

/// By index_of.
constexpr std::array<const char*, kRayRoutes> kRouteNames = {"cached", "indexed", "linked", "other"};

/// Rays by route.
template <typename Count>
using RouteCounts = std::array<Count, kRayRoutes>;

constexpr std::size_t index_of(RayRoute route) { return static_cast<std::size_t>(route); }

}  // namespace umbrix::render
