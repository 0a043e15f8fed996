// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cases/cases.h"
#include "umbrix/scene.h"
#include "umbrix/status.h"

namespace umbrix::judge {

enum class Query { occluded, closest };

/// A way to ask: kernel, instruction set, query.
struct Question {
  std::string kernel;
  std::string simd_target;
  Query query = Query::occluded;
};

/// An answer that exact arithmetic refutes.
struct Complaint {
  std::size_t ray;
  Question question;
};

struct Options {
  std::vector<std::string> kernels;         ///< empty: all
  bool all_targets = false;                 ///< every instruction set of the machine, not only the best
  std::vector<std::string> on_all_targets;  ///< the kernels that this goes for; empty: all
  std::size_t closest_rays = 0;             ///< the first so many rays are asked for their closest hit as well
};

struct Result {
  std::vector<std::uint8_t> occluded;  ///< the truth, for each ray
  std::vector<Complaint> complaints;
  std::uint64_t answers = 0;  ///< judged, over all questions
};

/// Prepares the kernels with the case's rays, asks everything and compares with the oracle. Changes the process's
/// instruction set while it runs.
Status judge(const cases::CaseData& data, const Options& options, Result& out);

/// The triangles as one mesh without indices; valid while `data` lives.
MeshView mesh_of(const std::vector<oracle::Triangle>& triangles);

/// The committed scene.
Status build(const std::vector<oracle::Triangle>& triangles, Scene& out);

/// Makes what a kernel needs beside the tree, with these rays to learn from.
Status prepare(const std::string& kernel, const std::vector<Ray>& rays, Scene& scene);

}  // namespace umbrix::judge
