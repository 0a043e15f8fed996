// SPDX-License-Identifier: Apache-2.0
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute(const CameraSample& sample, double* values) {
  for (int axis = 0; axis < 3; ++axis) values[axis] = sample.normal[axis];
  return sample.hit ? 1 : 0;
}

}  // namespace

// The mean of unit vectors is shorter than one where they differ; that is kept, as it tells a filter how far to trust
// it.
extern const Aov kNormalAov;
const Aov kNormalAov = {"normal",
                        "shading normal in world space, towards the viewer",
                        {"normal.X", "normal.Y", "normal.Z"},
                        Reduction::mean,
                        0,
                        false,
                        contribute};

}  // namespace umbrix::render
