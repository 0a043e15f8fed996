// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  if (sample.shadow_rays == 0) return 0;
  values[0] = static_cast<double>(sample.unoccluded) / sample.shadow_rays;
  return sample.shadow_rays;
}

}  // namespace

extern const Aov kShadowAov;
const Aov kShadowAov = {"shadow",
                        "share of the pixel's shadow rays that reached their light; 0 where none was traced",
                        {"shadow.Y"},
                        Reduction::mean,
                        0,
                        false,
                        contribute,
                        HeatMapStyle::scale,
                        "share of shadow rays that see their light"};

}  // namespace umbrix::render
