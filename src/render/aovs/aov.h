// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/film.h"

namespace umbrix::render {

constexpr std::size_t kMaxAovChannels = 5;

/// How a pixel's samples become one value: their weighted mean, or the smallest (depths must not be mixed: between two
/// surfaces there is none).
enum class Reduction { mean, minimum };

/// How an AOV is drawn for the eye: not at all, by its one channel on a scale of colours, or by a mix of one colour for
/// each channel (the routes of rays).
enum class HeatMapStyle { none, scale, shares };

/// An arbitrary output variable: some channels of the image. Adding one is a file with an Aov and a line in
/// aov_table.cpp.
struct Aov {
  const char* name;                   ///< as asked for
  const char* summary;                ///< one line
  std::vector<const char*> channels;  ///< at most kMaxAovChannels
  Reduction reduction;
  double background;  ///< where no sample contributes
  bool counts_work;   ///< needs the work of each ray, which makes rendering slower
  double (*contribute)(const CameraSample& sample, double* values);  ///< returns the sample's weight; 0: nothing
  HeatMapStyle heat_map = HeatMapStyle::none;
  const char* unit = "";      ///< what is shown, for the legend of a heat map
  bool looks_around = false;  ///< needs CameraSample::openness
};

/// R, G, B, A; always the first.
const Aov& beauty_aov();

/// The others, by name; null if there is none.
const Aov* find_aov(const std::string& name);

std::vector<const char*> channel_names(const std::vector<const Aov*>& aovs);

}  // namespace umbrix::render
