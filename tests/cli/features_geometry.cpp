// SPDX-License-Identifier: Apache-2.0
// Meshes and where nodes place them. What is told apart is whether a square, or half of it, is there.
#include <cmath>

#include "feature_cases.h"

namespace umbrix::app {
namespace {

std::vector<FeatureCase> mesh_cases() {
  return {
      {"TriangleWithoutIndices.gltf", 1, 1, {{0.25, 0.25, kWhite}, {0.7, 0.7, kBlack}}},
      {"IndexTypes.gltf", 3, 1, squares({kRed, kGreen, kBlue})},
      // The squares shine in front: both triangles must face the camera, as section 3.7.2.1 winds strips and fans.
      {"MeshPrimitiveModes.gltf",
       4,
       1,
       squares({kWhite, kWhite, kWhite, kBlack}),
       {},
       "umbrix: ignored: primitives of points or lines: 4, first in meshes[3] primitives[0]\n"},
      // Light along the view, at a cosine of 0.8 to the normal, times the vertices' colour.
      {"BoxInterleaved.gltf", 1, 1, squares({{0.4, 0.8, 0.2}})},
      {"SimpleSparseAccessor.gltf", 2, 1, squares({kWhite, kWhite})},
      // The normal of the last is (76, 0, 102), in light along the view.
      {"MeshQuantization.gltf", 4, 1,
       squares({kWhite, kWhite, grey(102 / std::hypot(76, 102))}) +
           std::vector<Probe>{{3.2, 0.3, kRed}, {3.8, 0.3, kGreen}}},
      // Colours of vertices are linear (section 3.7.2.1), bytes as well; between vertices they change evenly.
      {"VertexColorTest.gltf", 4, 1,
       squares({{0.5, 0.25, 1}, {188 / 255., 0, 1}, {0.5, 0.1, 0}}) +
           std::vector<Probe>{{3 + 4.5 / 16, 0.8, grey(4.5 / 16)}, {3 + 11.5 / 16, 0.2, grey(11.5 / 16)}}},
      {"MeshoptBox.gltf", 1, 1, squares({kWhite}), {}, "", "meshoptimizer"},
      {"BoxDraco.gltf", 1, 1, squares({kWhite}), {}, "", "draco"},
      {"Box.glb", 1, 1, squares({{0.25, 0.5, 1}})},
      {"Box With Spaces.gltf", 1, 1, squares({kGreen})},
  };
}

std::vector<FeatureCase> node_cases() {
  return {
      // (x, y) goes to (-y, x) in the first two squares, by quaternion and matrix, to (x, -y) in the third, and to
      // (-y / 2, x) in the last: scaled first, then turned, then moved.
      {"OrientationTest.gltf",
       4,
       1,
       {{0.8, 0.1, kWhite},
        {0.9, 0.8, kWhite},
        {0.1, 0.8, kBlack},
        {0.7, 0.8, kBlack},
        {1.8, 0.1, kWhite},
        {1.9, 0.8, kWhite},
        {1.1, 0.8, kBlack},
        {1.7, 0.8, kBlack},
        {2.1, 0.8, kWhite},
        {2.1, 0.3, kWhite},
        {2.8, 0.2, kBlack},
        {2.3, 0.1, kBlack},
        {3.9, 0.7, kWhite},
        {3.6, 0.1, kWhite},
        {3.4, 0.1, kBlack},
        {3.7, 0.8, kBlack}}},
      // Section 3.7.4: where the determinant is negative, the other winding is in front. So a square mirrored along x
      // still faces the camera, one mirrored along z does not.
      {"NegativeScaleTest.gltf", 4, 1, squares({kWhite, kBlack, kWhite, kBlack})},
      {"SimpleMeshes.gltf", 3, 1, squares({kBlack, kWhite, kWhite})},
      {"MultipleScenes.gltf",
       2,
       1,
       squares({kBlack, kWhite}),
       {},
       "umbrix: ignored: scenes other than the default one\n"},
      // Right angles at (1, 0); at (3, 0), turned by a quarter; and there, half as large.
      {"SimpleInstancing.gltf",
       4,
       1,
       {{0.5, 0.3, kBlack},
        {1.2, 0.2, kWhite},
        {1.2, 0.7, kWhite},
        {1.8, 0.8, kBlack},
        {2.8, 0.2, kWhite},
        {2.9, 0.8, kWhite},
        {2.2, 0.8, kBlack},
        {3.1, 0.3, kWhite},
        {3.1, 0.6, kBlack},
        {3.6, 0.1, kBlack}}},
  };
}

}  // namespace

std::vector<FeatureCase> geometry_cases() {
  std::vector<FeatureCase> cases = mesh_cases();
  for (FeatureCase& one : node_cases()) cases.push_back(std::move(one));
  return cases;
}

}  // namespace umbrix::app
