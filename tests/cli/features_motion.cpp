// SPDX-License-Identifier: Apache-2.0
// What moves, from 0 to 1 second or 2. Without --frames a scene is as its nodes say, or as its first key.
#include <cmath>

#include "feature_cases.h"

namespace umbrix::app {
namespace {

/// The arguments for one frame, which is at a time of `frame` / `fps`.
std::vector<std::string> frame(const char* number, const char* fps) { return {"--frames", number, "--fps", fps}; }

/// A square of InterpolationTest that has risen by this from 0.5: what is at its lower and its upper edge.
std::vector<Probe> risen(double x, double by) {
  return {{x + 0.3, by + 0.55, kWhite},
          {x + 0.3, by + 1.45, kWhite},
          {x + 0.3, by + 0.45, kBlack},
          {x + 0.3, by + 1.55, kBlack}};
}

std::vector<FeatureCase> node_cases() {
  return {
      {"AnimatedTriangle.gltf", 2, 1, {{1.3, 0.3, kWhite}, {0.8, 0.1, kBlack}}},
      // By an eighth of a turn: the legs go up to the right and to the left.
      {"AnimatedTriangle.gltf",
       2,
       1,
       {{1, 0.6, kWhite}, {1.3, 0.45, kWhite}, {1.3, 0.1, kBlack}, {0.7, 0.45, kWhite}, {0.7, 0.1, kBlack}},
       frame("1", "2")},
      {"AnimatedTriangle.gltf", 2, 1, {{1.3, 0.3, kBlack}, {0.8, 0.1, kWhite}, {0.7, 0.6, kWhite}}, frame("1", "1")},
      // At a quarter: not yet; 1/4 of the way, which is 2 long; and by appendix C.5, with u = 1/4 and 2 seconds,
      // 2 (3 u^2 - 2 u^3) - 3 * 2 (u^3 - u^2).
      {"InterpolationTest.gltf", 3, 4, risen(0, 0) + risen(1, 0.5) + risen(2, 0.59375), frame("1", "2")},
      {"InterpolationTest.gltf", 3, 4, risen(0, 2) + risen(1, 2) + risen(2, 2), frame("2", "1")},
      // The child is at 1 and shrinks there; its parent has moved it by 1 when it has three quarters of its size.
      {"BoxAnimated.gltf", 4, 1, squares({kBlack, kWhite, kBlack, kBlack})},
      {"BoxAnimated.gltf",
       4,
       1,
       {{1.9, 0.3, kBlack}, {2.1, 0.3, kWhite}, {2.7, 0.7, kWhite}, {2.8, 0.3, kBlack}, {2.3, 0.8, kBlack}},
       frame("1", "2")},
      {"AnimatedCamera.gltf", 1, 1, squares({kRed})},
      {"AnimatedCamera.gltf", 1, 1, {{0.45, 0.3, kRed}, {0.55, 0.3, kGreen}}, frame("1", "2")},
      {"AnimatedCamera.gltf", 1, 1, squares({kGreen}), frame("1", "1")},
      {"AnimatedLight.gltf", 1, 1, squares({kWhite})},
      {"AnimatedLight.gltf", 1, 1, squares({grey(std::sqrt(0.75))}), frame("1", "2")},
      {"AnimatedLight.gltf", 1, 1, squares({grey(0.5)}), frame("1", "1")},
  };
}

std::vector<FeatureCase> choice_cases() {
  const std::string left_out =
      "umbrix: ignored: animations that are not played (an earlier one moves the same nodes, or another was chosen): "
      "in "
      "animations";
  std::vector<std::string> chosen = frame("1", "1");
  chosen.insert(chosen.end(), {"--animation", "Run"});
  return {
      {"Fox.gltf", 3, 1, squares({kWhite, kBlack, kBlack}), {}, left_out + "[1] 'Run'\n"},
      {"Fox.gltf", 3, 1, squares({kBlack, kWhite, kBlack}), frame("1", "1"), left_out + "[1] 'Run'\n"},
      {"Fox.gltf", 3, 1, squares({kBlack, kBlack, kWhite}), chosen, left_out + "[0] 'Walk'\n"},
  };
}

std::vector<FeatureCase> shape_cases() {
  return {
      {"MorphPrimitivesTest.gltf", 4, 2,
       squares({kBlack, kWhite, kBlack, kWhite}) + squares({kBlack, kWhite, kBlack, kWhite}, 1e-6, 1)},
      // Normals are blended, then made unit length: (0.3, 0, 0.9) on half the way.
      {"AnimatedMorphCube.gltf", 2, 1, squares({kWhite, kBlack})},
      {"AnimatedMorphCube.gltf",
       2,
       1,
       {{0.45, 0.3, kBlack}, {0.55, 0.3, grey(std::sqrt(0.9))}, {1.45, 0.7, grey(std::sqrt(0.9))}, {1.55, 0.7, kBlack}},
       frame("1", "2")},
      {"AnimatedMorphCube.gltf", 2, 1, squares({kBlack, grey(0.8)}), frame("1", "1")},
      {"SimpleSkin.gltf", 3, 3, {{1.1, 0.3, kWhite}, {1.9, 1.8, kWhite}, {2.3, 1, kBlack}}},
      // The upper square lies at the right of its joint, from 0.5 to 1.5.
      {"SimpleSkin.gltf",
       3,
       3,
       {{1.1, 0.3, kWhite},
        {1.1, 1.3, kBlack},
        {1.9, 1.8, kBlack},
        {2.4, 0.6, kWhite},
        {1.6, 1.4, kWhite},
        {2.4, 1.6, kBlack}},
       frame("1", "1")},
      // By half a unit, and by four fifths of one.
      {"RiggedSimple.gltf",
       3,
       2,
       {{0.45, 0.3, kBlack},
        {0.55, 0.3, kWhite},
        {1.45, 0.7, kWhite},
        {1.55, 0.7, kBlack},
        {0.75, 1.3, kBlack},
        {0.85, 1.3, kWhite},
        {1.75, 1.7, kWhite},
        {1.85, 1.7, kBlack}}},
  };
}

}  // namespace

std::vector<FeatureCase> motion_cases() {
  std::vector<FeatureCase> cases = node_cases();
  for (FeatureCase& one : choice_cases()) cases.push_back(std::move(one));
  for (FeatureCase& one : shape_cases()) cases.push_back(std::move(one));
  return cases;
}

}  // namespace umbrix::app
