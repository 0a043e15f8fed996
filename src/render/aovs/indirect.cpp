// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  for (int c = 0; c < 3; ++c) values[c] = sample.indirect[c];
  return 1;
}

}  // namespace

extern const Aov kIndirectAov;
const Aov kIndirectAov = {"indirect",
                          "the part of the radiance that came over at least two surfaces",
                          {"indirect.R", "indirect.G", "indirect.B"},
                          Reduction::mean,
                          0,
                          false,
                          contribute};

}  // namespace umbrix::render
