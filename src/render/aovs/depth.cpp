// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  values[0] = sample.depth;
  return sample.hit ? 1 : 0;
}

}  // namespace

extern const Aov kDepthAov;
const Aov kDepthAov = {"depth",
                       "distance along the viewing axis of the nearest sample; infinite where there is nothing",
                       {"depth.Z"},
                       Reduction::minimum,
                       std::numeric_limits<double>::infinity(),
                       false,
                       contribute,
                       HeatMapStyle::scale,
                       "along the viewing axis, in scene units"};

}  // namespace umbrix::render
