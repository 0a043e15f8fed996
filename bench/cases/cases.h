// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "oracle/exact_hit.h"
#include "umbrix/ray.h"

/// Triangles and rays on which tracers fail, each kind made by one function from a seed.
namespace umbrix::cases {

struct CaseData {
  std::vector<oracle::Triangle> triangles;
  std::vector<Ray> rays;
  /// If set, the same questions put otherwise: each ray here has the answer of the ray of its number there.
  std::shared_ptr<const CaseData> same_as = nullptr;
};

/// What is known of all rays of a case without looking.
enum class Claim { none, all_occluded, none_occluded };

/// The floating-point mode in which a host calls.
enum class HostMode { usual, flush_denormals, round_up, round_down, round_to_zero };

struct Case {
  std::string name;
  std::string summary;  ///< one line
  int row;              ///< of the stress matrix (bench/README.md)
  double rays;          ///< at scale 1
  /// The same data for the same arguments. Seeds differ in triangles as well as in rays.
  std::function<CaseData(std::uint64_t seed, std::size_t ray_count)> make;
  std::size_t rays_per_scene = 25'000;
  double closest_share = 0.25;  ///< of the rays that all kernels are asked; less where many hits tie
  Claim claim = Claim::none;
  bool is_proved = false;  ///< the claim needs no oracle but for a sample
  HostMode mode = HostMode::usual;
  bool is_huge = false;     ///< leave out kernels whose side tables take long to make
  bool is_variant = false;  ///< of the case before it; for tests with little time
};

/// Scenes that have up to ten million triangles at size 1 have that part of them.
std::vector<Case> all_cases(double size);

/// The table for tests, whose largest scenes have a thousand triangles.
const std::vector<Case>& small_cases();

/// Of small_cases(); null if there is none.
const Case* find_case(const char* name);

}  // namespace umbrix::cases
