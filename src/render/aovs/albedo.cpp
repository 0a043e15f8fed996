// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  for (int c = 0; c < 3; ++c) values[c] = sample.albedo[c];
  return sample.hit ? 1 : 0;
}

}  // namespace

extern const Aov kAlbedoAov;
const Aov kAlbedoAov = {
    "albedo",  "base colour of the surfaces", {"albedo.R", "albedo.G", "albedo.B"}, Reduction::mean, 0, false,
    contribute};

}  // namespace umbrix::render
