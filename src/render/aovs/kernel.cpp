// SPDX-License-Identifier: Apache-2.0
// Which way answered the shadow rays of a pixel. Like the cost channels, this shows the tracer and not the scene.
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

static_assert(kRayRoutes <= kMaxAovChannels, "each route is a channel");

double contribute(const CameraSample& sample, double* values) {
  if (sample.shadow_rays == 0) return 0;
  for (std::size_t i = 0; i < kRayRoutes; ++i) {
    values[i] = static_cast<double>(sample.routes[i]) / sample.shadow_rays;
  }
  return sample.shadow_rays;
}

}  // namespace

extern const Aov kKernelAov;
const Aov kKernelAov = {"kernel",
                        "share of the pixel's shadow rays that each way answered; 0 where none was traced",
                        {"kernel.cached", "kernel.beam", "kernel.indexed", "kernel.linked", "kernel.other"},
                        Reduction::mean,
                        0,
                        true,
                        contribute,
                        HeatMapStyle::shares,
                        "what answered the shadow rays"};

}  // namespace umbrix::render
