// SPDX-License-Identifier: Apache-2.0
#include "stress/embree_errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "embree/embree_scene.h"
#include "judge/blocks.h"
#include "oracle/oracle.h"

namespace umbrix::bench {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float moved(float x, int steps) {
  for (; steps > 0; --steps) x = std::nextafter(x, kInfinity);
  for (; steps < 0; ++steps) x = std::nextafter(x, -kInfinity);
  return x;
}

// Whether the answer is right for a ray a little longer or shorter.
bool is_right_at_ends(const oracle::Oracle& judge, const Ray& ray, bool answer) {
  Ray longer = ray, shorter = ray;
  longer.tmin = moved(ray.tmin, -kOpenEnds);
  longer.tmax = moved(ray.tmax, kOpenEnds);
  shorter.tmin = moved(ray.tmin, kOpenEnds);
  shorter.tmax = moved(ray.tmax, -kOpenEnds);
  return judge.occluded(answer ? longer : shorter) == answer;
}

// Wrong answers, but for those at the ends, which are counted apart.
WrongRays count_embree_wrong(const cases::CaseData& data, const std::vector<Ray>& rays,
                             const std::vector<std::uint8_t>& answers, const std::vector<std::uint8_t>& truth,
                             std::uint64_t& at_ends) {
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i] != truth[i]) wrong.push_back(i);
  }
  if (wrong.empty()) return {};
  const oracle::Oracle judge(data.triangles);
  std::vector<std::uint8_t> is_excused(wrong.size());
  tbb::parallel_for(std::size_t{0}, wrong.size(), [&](std::size_t k) {
    is_excused[k] = is_right_at_ends(judge, rays[wrong[k]], answers[wrong[k]] != 0) ? 1 : 0;
  });
  WrongRays result;
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    if (is_excused[k] != 0) {
      ++at_ends;
    } else {
      ++(truth[wrong[k]] != 0 ? result.leaks : result.false_shadows);
    }
  }
  return result;
}

// Where Embree splits triangles it divides by differences of coordinates. In scenes this small it flushes some to zero,
// and then ends the program.
bool splits_are_safe(const std::vector<oracle::Triangle>& triangles) {
  constexpr float kSmall = 0x1p-90f;
  float largest = 0;
  for (const oracle::Triangle& t : triangles) {
    for (const auto& v : t.v) {
      for (const float x : v) {
        if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
      }
    }
  }
  return largest > kSmall;
}

}  // namespace

WrongRays count_wrong(const std::vector<std::uint8_t>& answers, const std::vector<std::uint8_t>& truth) {
  WrongRays wrong;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    wrong.leaks += answers[i] == 0 && truth[i] != 0 ? 1 : 0;
    wrong.false_shadows += answers[i] != 0 && truth[i] == 0 ? 1 : 0;
  }
  return wrong;
}

Status count_embree_errors(const cases::CaseData& data, const std::vector<std::uint8_t>& truth, Counts& out) {
  std::vector<Ray> rays;
  std::vector<std::uint8_t> expected;
  for (std::size_t i = 0; i < data.rays.size(); ++i) {
    if (!embree::accepts(data.rays[i])) continue;
    rays.push_back(data.rays[i]);
    expected.push_back(truth[i]);
  }
  out.embree_rays += rays.size();
  for (const bool robust : {true, false}) {
    embree::Options options;
    options.quality = splits_are_safe(data.triangles) ? embree::Quality::high : embree::Quality::medium;
    options.robust = robust;
    embree::EmbreeScene scene;
    if (Status status = scene.build({judge::mesh_of(data.triangles)}, options); !status) return status;
    std::vector<std::uint8_t> answers(rays.size());
    judge::for_each_block(rays.size(), [&](std::size_t begin, std::size_t count) {
      scene.occluded({rays.data() + begin, count}, embree::Mode::single, answers.data() + begin);
    });
    WrongRays& wrong = robust ? out.embree_robust : out.embree_fast;
    std::uint64_t& at_ends = robust ? out.embree_robust_at_ends : out.embree_fast_at_ends;
    wrong.add(count_embree_wrong(data, rays, answers, expected, at_ends));
  }
  return {};
}

}  // namespace umbrix::bench
