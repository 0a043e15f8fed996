// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  values[0] = sample.openness;
  return sample.hit ? 1 : 0;
}

}  // namespace

extern const Aov kAmbientOcclusionAov;
const Aov kAmbientOcclusionAov = {"ao",
                                  "share of the directions from a surface in which nothing is near",
                                  {"ao.Y"},
                                  Reduction::mean,
                                  1,
                                  false,
                                  contribute,
                                  HeatMapStyle::scale,
                                  "share of directions in which nothing is near",
                                  true};

}  // namespace umbrix::render
