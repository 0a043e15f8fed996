// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cases/cases.h"
#include "judge/truth.h"
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
  std::uint8_t given;  ///< for Query::occluded
};

/// Which instruction sets answer.
enum class Targets {
  current,  ///< the process's own; the only choice while others judge at the same time
  all,      ///< those of the machine, one after the other
};

struct Options {
  std::vector<std::string> kernels;  ///< empty: all
  std::size_t kernels_per_ray = 0;   ///< blocks of rays take turns among the kernels; 0: all kernels answer every ray
  Targets targets = Targets::current;
  std::size_t current_target = 0;       ///< the one in use, by its place
  std::size_t rays_on_each_target = 0;  ///< with Targets::all: so many are asked of all kernels on each, the others
                                        ///< of some kernels on one
  std::size_t training_rays = 4096;     ///< the first so many are what kernels learn from
  TruthOptions truth;
  cases::HostMode mode = cases::HostMode::usual;
};

/// How many answers each kernel gave on each instruction set, in their own orders.
struct AnswerCounts {
  AnswerCounts();
  void add(const AnswerCounts& other);
  std::uint64_t total() const;
  std::uint64_t& of(std::size_t kernel, std::size_t target);
  std::uint64_t of(std::size_t kernel, std::size_t target) const;

 private:
  std::vector<std::uint64_t> counts_;
};

struct Result {
  Truth truth;
  std::vector<Complaint> complaints;
  AnswerCounts answers;
  BuildStats build;
};

/// Prepares the kernels with some of the case's rays, asks and compares with the oracle. With Targets::all it
/// changes the process's instruction set while it runs.
Status judge(const cases::CaseData& data, const Options& options, Result& out);

/// The triangles as one mesh without indices; valid while `data` lives.
MeshView mesh_of(const std::vector<oracle::Triangle>& triangles);

/// The committed scene.
Status build(const std::vector<oracle::Triangle>& triangles, Scene& out);

/// Makes what a kernel needs beside the tree, with these rays to learn from.
Status prepare(const std::string& kernel, const std::vector<Ray>& rays, Scene& scene);

}  // namespace umbrix::judge
