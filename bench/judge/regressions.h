// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "oracle/exact_hit.h"
#include "umbrix/ray.h"
#include "umbrix/status.h"

namespace umbrix::judge {

/// A ray and triangles that were answered wrongly once. What is right is asked of exact arithmetic.
struct Regression {
  std::string name;  ///< one line: where it comes from
  std::vector<oracle::Triangle> triangles;
  Ray ray;
};

/// The text of a file of them: `case NAME`, a line `triangle` with nine numbers for each, a line `ray` with origin,
/// tmin, direction and tmax; `#` starts a comment. Numbers are hexadecimal floats, nan, inf or -inf, bit for bit.
std::string to_text(const Regression& regression);

/// Reads such a file. bad_input names the file, the line and what is wrong.
Status read_regressions(const std::string& path, std::vector<Regression>& out);

/// The whole of a file; bad_input names it.
Status read_file(const std::string& path, std::string& out);

}  // namespace umbrix::judge
