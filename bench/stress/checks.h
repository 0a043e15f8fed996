// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "stress/case_run.h"

/// Rows of the matrix that are more than rays on which kernels must be right.
namespace umbrix::bench {

/// A check of about `rays` rays.
using Check = Status(const StressSettings& settings, std::size_t rays, Counts& out);

/// Row 19: meshes of random bits, some with indices that lead nowhere, as in Embree's own suite.
Check check_garbage;

/// Row 30: a walk from leaf to leaf by links visits the leaves that the stack walk visits.
Check check_leaf_walks;

/// Row 31: 1 to 64 threads, while links and the wide tree grow and a frame tracer learns.
Check check_threads;

/// Row 33: instances of every kind, any kernel and instruction set, against each placed as a mesh of its own.
Check check_instances;

}  // namespace umbrix::bench
