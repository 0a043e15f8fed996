// SPDX-License-Identifier: Apache-2.0
// Morph targets and skins.
#include "stage.h"

namespace umbrix::features {
namespace {

/// Four times the same three numbers.
int deltas(Stage& s, float x, float y, float z) { return s.floats({x, y, z, x, y, z, x, y, z, x, y, z}, 3); }

/// Both targets of both primitives move by 1 to the right. The mesh says that the first counts in full, one node that
/// both do.
Stage morph_primitives() {
  Stage s(4, 2);
  const int material = s.material(unlit(1, 1, 1));
  const int right = deltas(s, 1, 0, 0);
  json lower = s.square(material);
  lower["targets"] = {{{"POSITION", right}}, {{"POSITION", right}}};
  json upper = lower;
  upper["attributes"]["POSITION"] = s.floats({0, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0}, 3);
  s.json["meshes"] = {{{"primitives", {lower, upper}}, {"weights", {1, 0}}}};
  s.root({{"mesh", 0}});
  s.root({{"mesh", 0}, {"translation", {1, 0, 0}}, {"weights", {1, 1}}});
  return s;
}

/// The square moves to the right by 1, and its normal turns from (0, 0, 1) to (0.6, 0, 0.8).
Stage animated_morph() {
  Stage s(2, 1);
  const int material = s.material(lambert());
  json square = s.square(material, {{"NORMAL", deltas(s, 0, 0, 1)}});
  const int moved = deltas(s, 1, 0, 0), turned = deltas(s, 0.6f, 0, -0.2f);
  square["targets"] = json::array({{{"POSITION", moved}, {"NORMAL", turned}}});
  const int node = s.place(square, 0);
  const int times = s.floats({0, 1}, 1), weights = s.floats({0, 1}, 1);
  s.json["animations"] = {{{"samplers", {{{"input", times}, {"output", weights}, {"interpolation", "LINEAR"}}}},
                           {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}}}}}};
  s.light_straight_on();
  return s;
}

/// A square that follows a joint at (1.5, 0), below one that follows a joint at (1.5, 1), which turns by a quarter to
/// the right. Where the mesh's own node is does not matter.
Stage simple_skin() {
  Stage s(3, 3);
  const int positions = s.floats({1, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1, 0, 1, 1, 0, 2, 1, 0, 2, 2, 0, 1, 2, 0}, 3);
  const int indices = s.integers(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7}, 5121, 1);
  std::vector<std::uint8_t> joints(32, 0);
  std::vector<float> weights(32, 0);
  for (std::size_t v = 0; v < 8; ++v) {
    joints[4 * v] = v < 4 ? 0 : 1;
    weights[4 * v] = 1;
  }
  const json attributes = {
      {"POSITION", positions}, {"JOINTS_0", s.integers(joints, 5121, 4)}, {"WEIGHTS_0", s.floats(weights, 4)}};
  const int mesh = s.mesh({{"attributes", attributes}, {"indices", indices}, {"material", s.material(unlit(1, 1, 1))}});
  s.root({{"mesh", mesh}, {"skin", 0}, {"translation", {7, 0, 0}}});
  const int upper = static_cast<int>(s.json["nodes"].size());
  s.json["nodes"].push_back({{"translation", {0, 1, 0}}});
  const int lower = s.root({{"translation", {1.5, 0, 0}}, {"children", {upper}}});
  const std::vector<float> inverse_bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.5f, 0,  0, 1,
                                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1.5f, -1, 0, 1};
  const int matrices = s.accessor(io::testing::bytes_of(inverse_bind), 5126, 2, "MAT4");
  s.json["skins"] = {{{"joints", {lower, upper}}, {"inverseBindMatrices", matrices}}};
  s.animate(0, upper, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, -0.70710678f, 0.70710678f});
  return s;
}

/// Joints at rest, without inverse bind matrices: one stays, one is 1 to the right. The lower square follows them by
/// halves, in two sets of four, the upper one by a fifth and four fifths, in bytes.
Stage rigged_simple() {
  Stage s(3, 2);
  const int material = s.material(unlit(1, 1, 1));
  std::vector<std::uint16_t> first(16, 0), second(16, 0), both(16, 0);
  std::vector<std::uint8_t> fifths(16, 0);
  std::vector<float> half(16, 0);
  for (std::size_t v = 0; v < 16; v += 4) {
    second[v] = both[v + 1] = 1;
    fifths[v] = 51;
    fifths[v + 1] = 204;
    half[v] = 0.5f;
  }
  const int halves = s.floats(half, 4);
  const json by_halves = {{"JOINTS_0", s.integers(first, 5123, 4)},
                          {"WEIGHTS_0", halves},
                          {"JOINTS_1", s.integers(second, 5123, 4)},
                          {"WEIGHTS_1", halves}};
  const json by_fifths = {{"POSITION", s.floats({0, 1, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0}, 3)},
                          {"JOINTS_0", s.integers(both, 5123, 4)},
                          {"WEIGHTS_0", s.normalized(fifths, 5121, 4)}};
  for (const json& attributes : {by_halves, by_fifths}) {
    s.root({{"mesh", s.mesh(s.square(material, attributes))}, {"skin", 0}});
  }
  const int moved = static_cast<int>(s.json["nodes"].size());
  s.json["nodes"].push_back({{"translation", {1, 0, 0}}});
  const int stays = s.root({{"children", {moved}}});
  s.json["skins"] = {{{"joints", {stays, moved}}}};
  return s;
}

/// Squares whose normal texture points along their tangents, which turn from x to y: with a joint, that takes the
/// square to itself, and by a morph target.
Stage tangents() {
  Stage s(2, 1);
  json lit = lambert();
  lit["normalTexture"] = {{"index", s.texture(1, 1, 3, {204, 128, 230})}};
  const int material = s.material(lit);
  const int along_x = s.floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
  const json attributes = {{"NORMAL", deltas(s, 0, 0, 1)}, {"TANGENT", along_x}, {"TEXCOORD_0", s.texcoords()}};
  json carried = s.square(material, attributes);
  carried["attributes"]["JOINTS_0"] = s.integers(std::vector<std::uint8_t>(16, 0), 5121, 4);
  carried["attributes"]["WEIGHTS_0"] = s.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 4);
  s.root({{"mesh", s.mesh(carried)}, {"skin", 0}});
  const int joint = s.root({{"translation", {1, 0, 0}}, {"rotation", {0, 0, 0.70710678, 0.70710678}}});
  s.json["skins"] = {{{"joints", {joint}}}};
  json morphed = s.square(material, attributes);
  morphed["targets"] = json::array({{{"TANGENT", deltas(s, -1, 1, 0)}}});
  s.place(morphed, 1);
  s.json["meshes"].back()["weights"] = nlohmann::json::array({1});
  s.slanted_light();
  return s;
}

}  // namespace

void add_shapes(Files& files) {
  files["MorphPrimitivesTest.gltf"] = morph_primitives().readable();
  files["AnimatedMorphCube.gltf"] = animated_morph().readable();
  files["SimpleSkin.gltf"] = simple_skin().readable();
  files["RiggedSimple.gltf"] = rigged_simple().readable();
  files["SkinMorphTangents.gltf"] = tangents().readable();
}

}  // namespace umbrix::features
