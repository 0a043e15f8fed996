// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "judge/judge.h"

namespace umbrix::judge {

using Triangles = std::vector<oracle::Triangle>;

/// Drops ever smaller runs of triangles as long as `is_wrong` of what is left (delta debugging, Zeller & Hildebrandt
/// 2002). Needs is_wrong(triangles).
Triangles fewest(Triangles triangles, const std::function<bool(const Triangles&)>& is_wrong);

/// A wrong answer so that it can be kept as a test.
struct Failure {
  std::string text;     ///< the question, the answers, the ray and the triangles, all numbers hexadecimal
  Triangles triangles;  ///< the fewest found with which the answer is still wrong
  Ray ray;
};

/// Minimises a complaint about a case.
Failure minimise(const cases::CaseData& data, const Complaint& complaint);

}  // namespace umbrix::judge
