// SPDX-License-Identifier: Apache-2.0
// What the shadow rays of a pixel cost. The only outputs that depend on the kernel.
#include "render/aovs/aov.h"

namespace umbrix::render {
namespace {

double contribute_nodes(const CameraSample& sample, double* values) {
  values[0] = static_cast<double>(sample.node_tests);
  return 1;
}

double contribute_triangles(const CameraSample& sample, double* values) {
  values[0] = static_cast<double>(sample.primitive_tests);
  return 1;
}

}  // namespace

extern const Aov kNodesAov, kTrianglesAov;
const Aov kNodesAov = {
    "nodes",         "node tests of the shadow rays of a camera sample, mean", {"nodes.Y"}, Reduction::mean, 0, true,
    contribute_nodes};
const Aov kTrianglesAov = {"triangles",
                           "triangle tests of the shadow rays of a camera sample, mean",
                           {"triangles.Y"},
                           Reduction::mean,
                           0,
                           true,
                           contribute_triangles};

}  // namespace umbrix::render
