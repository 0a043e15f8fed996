// SPDX-License-Identifier: Apache-2.0
#include "render/heat_map/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "render/heat_map/maps.h"

namespace umbrix::render {

Status make_heat_map(const HeatMapContent& content, const io::Image& image, const RenderStats& stats,
                     io::Image& picture) try {
  const Aov* found = find_aov(content.aov);
  if (!found || found->heat_map == HeatMapStyle::none) {
    return {StatusCode::invalid_argument, fmt::format("'{}' cannot be shown as a heat map", content.aov)};
  }
  const auto channel = std::find(image.channels.begin(), image.channels.end(), found->channels.front());
  if (channel == image.channels.end()) {
    return {StatusCode::invalid_argument, fmt::format("the image has no channel {}", found->channels.front())};
  }
  const AovPixels pixels = {*found, image, static_cast<std::size_t>(channel - image.channels.begin())};
  picture = found->heat_map == HeatMapStyle::scale ? scale_map(pixels, content.end)
                                                   : share_map(pixels, stats.shadow().routes);
  return {};
} catch (const std::bad_alloc&) {
  return Status::out_of_memory("no memory for a heat map");
}

}  // namespace umbrix::render
