// SPDX-License-Identifier: Apache-2.0
// Materials. Where there is light, it has pi lux, so that white that only spreads it is as bright as the cosine.
#include <algorithm>
#include <cmath>

#include "feature_cases.h"

namespace umbrix::app {
namespace {

/// glTF 2.0, appendix B.3, with the light, the view and the normal in one line. There the microfacets' distribution is
/// 1 / (pi roughness^4) and their visibility 1/4, so that pi lux leave F / (4 roughness^4) beside what is spread.
double facing(double base, double metallic, double roughness) {
  const double fresnel = 0.04 + (base - 0.04) * metallic;
  return (1 - fresnel) * base * (1 - metallic) + fresnel / (4 * std::pow(roughness, 4));
}

/// KHR_materials_specular of a white dielectric of roughness 1, in the same light: the strongest channel of F is what
/// the spread light loses.
Color specular(const Color& fresnel) {
  const double most = *std::max_element(fresnel.begin(), fresnel.end());
  Color out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = 1 - most + fresnel[c] / 4;
  return out;
}

/// Metals also keep what their microfacets reflect more than once, which the appendix drops: at a roughness of a half
/// less than a hundredth.
Probe metal(double x, double value) { return {x, 0.4, grey(value * 1.005), value * 0.005}; }

/// A texel of NormalTangentTest, x to the right and y to the top of the picture.
struct Normal {
  double x, y, z;
};

/// The cosine to light from (0.48, 0.6, 0.64).
Color lit(const Normal& n, double scale) {
  const double x = n.x * scale, y = n.y * scale;
  return grey((0.48 * x + 0.6 * y + 0.64 * n.z) / std::hypot(x, y, n.z));
}

/// Codes go from -1 at 0 to 1 at 255.
double code(double value) { return 2 * value / 255 - 1; }

/// Straight up, right, left, to the top and to the bottom, where the texture's axes are those given.
std::vector<Probe> normals(const Normal& right, const Normal& top, double scale, double y) {
  const double zero = code(128), plus = code(204), minus = code(51), up = code(230);
  const Normal texels[] = {
      {zero, zero, code(255)}, {plus, zero, up}, {minus, zero, up}, {zero, plus, up}, {zero, minus, up}};
  std::vector<Color> row;
  for (const Normal& n : texels)
    row.push_back(lit({n.x * right.x + n.y * top.x, n.x * right.y + n.y * top.y, n.z}, scale));
  return squares(row, 1e-6, y);
}

std::vector<FeatureCase> reflecting_cases() {
  // Codes of the metallic-roughness texture: roughness in green, metallic in blue.
  const double smooth = 128 / 255., rough = 180 / 255.;
  return {
      {"MetalRoughSpheresNoTextures.gltf", 4, 1,
       squares({grey(facing(0.5, 0, 1)), grey(facing(0.5, 0, 0.5))}) +
           std::vector<Probe>{metal(2.5, facing(0.5, 1, 0.5)), metal(3.5, facing(0.5, 0.5, 0.5))}},
      {"MetalRoughSpheres.gltf",
       2,
       1,
       {{0.25, 0.4, grey(facing(0.5, 0, rough))},
        metal(0.75, facing(0.5, 1, smooth)),
        {1.25, 0.4, grey(facing(0.5, 0, rough / 2)), 1e-5},
        metal(1.75, facing(0.5, 0.5, smooth / 2))}},
      {"SpecularTest.gltf", 5, 1,
       squares({specular(kBlack), specular(grey(0.02)), specular({0.08, 0.04, 0}), specular(grey(0.04 * 128 / 255)),
                specular({0.04 * from_srgb(188), 0.04, 0})})},
      // ((ior - 1) / (ior + 1))^2 / 4; 0 stands for an index without bound.
      {"IORTestGrid.gltf", 4, 1, squares({kBlack, grey(0.01), grey(1 / 36.), grey(0.25)})},
      {"NormalTangentTest.gltf", 5, 2, normals({1, 0, 0}, {0, 1, 0}, 1, 1) + normals({1, 0, 0}, {0, 1, 0}, 0.5, 0)},
      // The top is cross(normal, tangent) times the handedness (section 3.7.2.1).
      {"NormalTangentMirrorTest.gltf", 5, 2,
       normals({1, 0, 0}, {0, -1, 0}, 1, 1) + normals({0, 1, 0}, {-1, 0, 0}, 1, 0)},
      // What points along the tangent points to the top when that has turned by a quarter.
      {"SkinMorphTangents.gltf", 2, 1,
       squares({lit({-code(128), code(204), code(230)}, 1), lit({-code(128), code(204), code(230)}, 1)})},
  };
}

std::vector<FeatureCase> shining_cases() {
  return {
      {"UnlitTest.gltf", 3, 1, squares({{1, 0.5, 0.25}, {0.25, 0.5, 1}, {1, 1, 0}})},
      {"EmissiveStrengthTest.gltf", 3, 1, squares({{1, 0.5, 0.25}, {8, 4, 2}, {8, 4 * from_srgb(188), 0}}, 4e-6)},
      // Without doubleSided a surface shines in front alone; both sides reflect.
      {"TwoSidedPlane.gltf", 4, 1, squares({kWhite, kBlack, kWhite, kWhite})},
  };
}

const char* const kChance =
    "umbrix: warning: blended materials ({}) stop rays by chance, as their alpha says: more samples, less noise\n";

std::string chance(const char* count) {
  std::string text = kChance;
  return text.replace(text.find("{}"), 2, count);
}

std::vector<FeatureCase> alpha_cases() {
  // Blended: the mean of 16 samples in each of 64 pixels or more, which is off by less than 4 sqrt(alpha (1 - alpha) /
  // 1024) but for one time in 16000; and pictures are the same every time.
  const double noise = 0.063;
  const auto through = [](double alpha) { return Color{alpha, alpha, 1}; };
  return {
      // Alpha is 64 / 255 in the left halves and 191 / 255 in the right ones, then 1/4, then from 0 to 1.
      {"AlphaBlendModeTest.gltf",
       6,
       1,
       {{0.25, 0.4, kWhite},
        {0.75, 0.4, kWhite},
        {1.25, 0.4, kBlue},
        {1.75, 0.4, kWhite},
        {2.25, 0.4, kBlue},
        {2.75, 0.4, kBlue},
        {3.25, 0.5, through(64 / 255.), noise, 0.4},
        {3.75, 0.5, through(191 / 255.), noise, 0.4},
        {4.5, 0.5, through(0.25), noise, 0.8},
        {5.4, 0.5, kBlue},
        {5.6, 0.5, kWhite}},
       {"--spp", "16"},
       chance("2")},
      // Light at a cosine of 0.8 falls through the left half of a mask, then through a quarter of what is blended.
      {"AlphaShadows.gltf",
       3,
       1,
       {{0.25, 0.4, grey(0.8)}, {0.75, 0.4, kBlack}, {1.5, 0.5, grey(0.8 * 0.75), noise, 0.8}, {2.5, 0.5, grey(0.8)}},
       {"--spp", "16"},
       chance("1")},
  };
}

}  // namespace

std::vector<FeatureCase> material_cases() {
  std::vector<FeatureCase> cases = reflecting_cases();
  for (FeatureCase& one : shining_cases()) cases.push_back(std::move(one));
  for (FeatureCase& one : alpha_cases()) cases.push_back(std::move(one));
  return cases;
}

}  // namespace umbrix::app
