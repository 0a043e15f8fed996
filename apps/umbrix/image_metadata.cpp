// SPDX-License-Identifier: Apache-2.0
#include "image_metadata.h"

#include <fmt/format.h>

#include <algorithm>

#include "job_hash.h"
#include "output_pattern.h"
#include "umbrix/version.h"

namespace umbrix::app {
namespace {

Metadata common(const RenderJob& job, const Frame& frame) {
  const RenderArguments& a = job.arguments;
  Metadata metadata = {{"Software", fmt::format("umbrix {}", version_string())},
                       {"umbrix:seed", std::to_string(a.seed)},
                       {"umbrix:spp", std::to_string(a.samples)}};
  if (a.light_samples > 1) metadata.emplace_back("umbrix:light_samples", std::to_string(a.light_samples));
  if (a.bounces > 0) metadata.emplace_back("umbrix:bounces", std::to_string(a.bounces));
  if (frame.number) metadata.emplace_back("umbrix:frame", std::to_string(*frame.number));
  if (a.tile) {
    metadata.emplace_back("umbrix:tile", tile_text(*a.tile));
  } else if (job.window) {
    const render::Crop& c = *job.window;
    metadata.emplace_back("umbrix:crop", fmt::format("{}x{}+{}+{}", c.width, c.height, c.x, c.y));
    metadata.emplace_back("umbrix:frame_size", fmt::format("{}x{}", job.size.width, job.size.height));
  }
  return metadata;
}

}  // namespace

Metadata image_metadata(const RenderJob& job, const Frame& frame, const std::string& path) {
  Metadata metadata = common(job, frame);
  metadata.emplace_back("umbrix:job", job_hash(job, path));
  return metadata;
}

Metadata image_metadata(const RenderJob& job, const Frame& frame, const render::HeatMapContent& heat_map) {
  Metadata metadata = common(job, frame);
  metadata.emplace_back("umbrix:heat_map", heat_map.aov);
  metadata.emplace_back("umbrix:job", job_hash(job, heat_map));
  return metadata;
}

std::string value_of(const Metadata& metadata, const std::string& name) {
  const auto found =
      std::find_if(metadata.begin(), metadata.end(), [&](const auto& attribute) { return attribute.first == name; });
  return found == metadata.end() ? "" : found->second;
}

std::string first_difference(const Metadata& a, const Metadata& b) {
  for (const auto& [some, others] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const auto& attribute : *some) {
      if (std::find(others->begin(), others->end(), attribute) == others->end()) return attribute.first;
    }
  }
  return "";
}

bool is_done(const std::string& path, const Metadata& wanted) {
  io::Image image;
  if (!io::read_image(path, image)) return false;
  const auto& found = image.metadata;
  for (const auto& attribute : wanted) {
    if (std::find(found.begin(), found.end(), attribute) == found.end()) return false;
  }
  // Of a frame, but not of a part of it, or the other way round.
  for (const auto& [name, value] : found) {
    const bool part = name == "umbrix:tile" || name == "umbrix:crop" || name == "umbrix:frame";
    if (part && std::find(wanted.begin(), wanted.end(), std::pair(name, value)) == wanted.end()) return false;
  }
  const std::string checksum = value_of(found, "umbrix:checksum");
  return checksum.empty() ? !has_extension(path, ".exr") : checksum == io::image_checksum(image);
}

}  // namespace umbrix::app
