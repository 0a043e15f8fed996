// SPDX-License-Identifier: Apache-2.0
#include "judge/minimise.h"

#include <fmt/format.h>

#include <algorithm>

#include "oracle/brute_force.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

using Triangles = std::vector<oracle::Triangle>;

struct Answers {
  std::string truth;
  std::string given;
};

std::string describe_hit(bool is_hit, std::uint32_t triangle, double t) {
  return is_hit ? fmt::format("triangle {} at t = {:a}", triangle, t) : "no hit";
}

// The answers to one question about one ray, asked alone.
Answers ask(const Triangles& triangles, const Ray& ray, const Question& question) {
  Scene scene;
  if (Status status = build(triangles, scene); !status) return {"a scene", status.message()};
  QueryOptions options;
  if (Status status = find_kernel(question.kernel.c_str(), options.kernel); !status) return {"a kernel", ""};
  if (Status status = prepare(question.kernel, {ray}, scene); !status) return {"a kernel", status.message()};
  const oracle::BruteForce truth(triangles);
  if (question.query == Query::occluded) {
    std::uint8_t given = 0;
    scene.occluded({&ray, 1}, &given, options);
    return {truth.occluded(ray) ? "occluded" : "not occluded", given != 0 ? "occluded" : "not occluded"};
  }
  Hit hit;
  scene.closest({&ray, 1}, &hit, options);
  const auto right = truth.closest(ray);
  if (right.has_value() == hit.valid() && (!right || right->triangle == hit.primitive.triangle)) return {};
  return {describe_hit(right.has_value(), right ? right->triangle : 0, right ? right->t : 0),
          describe_hit(hit.valid(), hit.primitive.triangle, double{hit.t})};
}

bool is_wrong(const Triangles& triangles, const Ray& ray, const Question& question) {
  const Answers answers = ask(triangles, ray, question);
  return answers.truth != answers.given;
}

// Drops ever smaller runs of triangles as long as the answer stays wrong.
Triangles fewest(Triangles triangles, const Ray& ray, const Question& question) {
  for (std::size_t run = triangles.size() / 2; run > 0; run /= 2) {
    for (std::size_t begin = 0; begin < triangles.size();) {
      Triangles fewer = triangles;
      const auto first = fewer.begin() + static_cast<std::ptrdiff_t>(begin);
      fewer.erase(first, first + static_cast<std::ptrdiff_t>(std::min(run, fewer.size() - begin)));
      if (is_wrong(fewer, ray, question)) {
        triangles = std::move(fewer);
      } else {
        begin += run;
      }
    }
  }
  return triangles;
}

std::string vector_text(const float v[3]) { return fmt::format("{{{:a}f, {:a}f, {:a}f}}", v[0], v[1], v[2]); }

}  // namespace

std::string describe(const cases::CaseData& data, const Complaint& complaint) {
  const Ray& ray = data.rays[complaint.ray];
  const Question& question = complaint.question;
  std::string text = fmt::format("{} {} {}", question.kernel, question.simd_target,
                                 question.query == Query::occluded ? "occluded" : "closest");
  if (Status status = use_simd_target(question.simd_target.c_str()); !status) return text + status.message();
  if (is_wrong(data.triangles, ray, question)) {
    const Triangles triangles = fewest(data.triangles, ray, question);
    const Answers answers = ask(triangles, ray, question);
    text += fmt::format(": answered {}, the truth is {}\n  triangles", answers.given, answers.truth);
    constexpr std::size_t kShown = 8;
    for (std::size_t i = 0; i < std::min(kShown, triangles.size()); ++i) {
      const auto& v = triangles[i].v;
      text += fmt::format("\n    {{{}, {}, {}}}", vector_text(v[0]), vector_text(v[1]), vector_text(v[2]));
    }
    if (triangles.size() > kShown) text += fmt::format("\n    and {} more", triangles.size() - kShown);
  } else {
    text += fmt::format(": wrong only among the rays beside it (ray {})", complaint.ray);
  }
  text += fmt::format("\n  ray {{{}, {:a}f, {}, {:a}f}}", vector_text(ray.origin), ray.tmin, vector_text(ray.direction),
                      ray.tmax);
  if (Status status = use_simd_target(nullptr); !status) text += status.message();
  return text;
}

}  // namespace umbrix::judge
