// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

// Colour is premultiplied: a sample that meets nothing adds black and no coverage. An environment covers.
double contribute(const CameraSample& sample, double* values) {
  for (int c = 0; c < 3; ++c) values[c] = sample.radiance[c];
  values[3] = sample.opaque ? 1 : 0;
  return 1;
}

}  // namespace

const Aov& beauty_aov() {
  static const Aov aov = {"beauty",  "radiance and coverage", {"R", "G", "B", "A"}, Reduction::mean, 0, false,
                          contribute};
  return aov;
}

}  // namespace umbrix::render
