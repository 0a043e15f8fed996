// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "judge/judge.h"

namespace umbrix::judge {

/// Describes a wrong answer so that it can be kept as a test: the question, the ray and the fewest triangles found
/// (delta debugging, Zeller & Hildebrandt 2002) with which the answer is still wrong, all numbers hexadecimal.
std::string describe(const cases::CaseData& data, const Complaint& complaint);

}  // namespace umbrix::judge
