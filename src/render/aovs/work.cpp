// SPDX-License-Identifier: Apache-2.0
// What the shadow rays of a pixel cost. The only outputs that depend on the kernel.
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute_node_tests(const CameraSample& sample, double* values) {
  values[0] = static_cast<double>(sample.node_tests);
  return 1;
}

double contribute_primitive_tests(const CameraSample& sample, double* values) {
  values[0] = static_cast<double>(sample.primitive_tests);
  return 1;
}

}  // namespace

extern const Aov kNodeTestsAov, kPrimitiveTestsAov;
const Aov kNodeTestsAov = {"node_tests",
                           "node tests of the shadow rays of a camera sample, mean",
                           {"node_tests.Y"},
                           Reduction::mean,
                           0,
                           true,
                           contribute_node_tests,
                           HeatMapStyle::scale,
                           "of shadow rays, per camera sample"};
const Aov kPrimitiveTestsAov = {"primitive_tests",
                                "triangle tests of the shadow rays of a camera sample, mean",
                                {"primitive_tests.Y"},
                                Reduction::mean,
                                0,
                                true,
                                contribute_primitive_tests,
                                HeatMapStyle::scale,
                                "of shadow rays, per camera sample"};

}  // namespace umbrix::render
