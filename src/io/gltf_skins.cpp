// SPDX-License-Identifier: Apache-2.0
// Skins (glTF 2.0, section 5.28).

#include "io/gltf_skins.h"

#include <cmath>

#include "io/load_error.h"
#include "io/node_transform.h"

namespace umbrix::io::detail {
namespace {

// Exporters round what is 0 or 1 by definition; what is further off is another kind of matrix.
constexpr float kSlack = 1e-3f;

glm::dmat4 affine(const std::array<float, 16>& values, std::size_t joint, const std::string& label) {
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = values[static_cast<std::size_t>(i)];  // both are column-major
  if (!is_finite(m)) bad_input("{}: inverse bind matrix {} is not finite", label, joint);
  if (!(std::abs(m[0][3]) < kSlack && std::abs(m[1][3]) < kSlack && std::abs(m[2][3]) < kSlack &&
        std::abs(m[3][3] - 1) < kSlack)) {
    bad_input("{}: inverse bind matrix {} is not affine; its last row must be 0 0 0 1", label, joint);
  }
  m[0][3] = m[1][3] = m[2][3] = 0;
  m[3][3] = 1;
  return m;
}

}  // namespace

std::vector<glm::dmat4> read_inverse_bind(const tinygltf::Skin& skin, AccessorReader& reader,
                                          const std::string& label) {
  const std::size_t joints = skin.joints.size();
  if (joints == 0) bad_input("{}: has no joints", label);
  std::vector<glm::dmat4> out;
  if (skin.inverseBindMatrices < 0) {
    out.assign(joints, glm::dmat4(1));
    return out;
  }
  if (const std::uint64_t count = reader.count(skin.inverseBindMatrices); count < joints) {
    bad_input("{}: has {} inverse bind matrices for {} joints", label, count, joints);
  }
  const auto matrices = reader.values<16>(skin.inverseBindMatrices, AccessorUse::inverse_bind);
  for (std::size_t j = 0; j < joints; ++j) out.push_back(affine(matrices[j], j, label));
  return out;
}

}  // namespace umbrix::io::detail
