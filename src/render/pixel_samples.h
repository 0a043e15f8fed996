// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace umbrix::render {

/// A place in the unit square, each coordinate in [0, 1).
struct SamplePoint {
  double x = 0;
  double y = 0;
};

/// The position of sample `index` of `count` in pixel (x, y): a function of its arguments alone, so pixels do not
/// depend on tiles, threads or crops. The samples of a pixel are stratified in both axes; a lone one is the centre.
SamplePoint pixel_sample(std::uint32_t x, std::uint32_t y, std::uint32_t index, std::uint32_t count,
                         std::uint64_t seed);

/// Purposes of random numbers that are no light's own: a light's is its number.
enum SamplePurpose : std::uint32_t {
  kLookAround = 0xFFFFFFFBu,  ///< for ambient occlusion
  kLobeAndEnd = 0xFFFFFFFCu,  ///< which lobe of a material a path takes, and whether it ends
  kBounceDirection = 0xFFFFFFFDu,
  kPointOfChosen = 0xFFFFFFFEu,  ///< of a light that was chosen
  kChoiceOfLight = 0xFFFFFFFFu,
};

/// The same for anything else that a pixel's samples choose: independent of its positions and of other purposes. A lone
/// one is anywhere.
SamplePoint purpose_sample(std::uint32_t x, std::uint32_t y, std::uint32_t purpose, std::uint32_t index,
                           std::uint32_t count, std::uint64_t seed);

}  // namespace umbrix::render
