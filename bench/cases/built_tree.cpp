// SPDX-License-Identifier: Apache-2.0
#include "cases/built_tree.h"

#include "core/exact_test.h"
#include "tree/builder.h"

namespace umbrix::cases {

detail::Tree built_tree(const std::vector<oracle::Triangle>& triangles) {
  std::vector<detail::Triangle> list;
  std::vector<std::uint32_t> kept;
  for (const oracle::Triangle& t : triangles) {
    detail::Triangle& triangle = list.emplace_back();
    for (int k = 0; k < 3; ++k) triangle.v[k] = {t.v[k][0], t.v[k][1], t.v[k][2]};
    if (!detail::is_degenerate(triangle)) kept.push_back(static_cast<std::uint32_t>(list.size() - 1));
  }
  BuildStats stats;
  return detail::build_tree(list, kept, BuildQuality::high, nullptr, stats);
}

}  // namespace umbrix::cases
