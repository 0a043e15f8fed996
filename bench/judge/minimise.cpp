// SPDX-License-Identifier: Apache-2.0
#include "judge/minimise.h"

#include <fmt/format.h>

#include <algorithm>

#include "oracle/brute_force.h"
#include "umbrix/kernel.h"

namespace umbrix::judge {
namespace {

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

std::string vector_text(const float v[3]) { return fmt::format("{{{:a}f, {:a}f, {:a}f}}", v[0], v[1], v[2]); }

std::string triangles_text(const Triangles& triangles) {
  constexpr std::size_t kShown = 8;
  std::string text = "\n  triangles";
  for (std::size_t i = 0; i < std::min(kShown, triangles.size()); ++i) {
    const auto& v = triangles[i].v;
    text += fmt::format("\n    {{{}, {}, {}}}", vector_text(v[0]), vector_text(v[1]), vector_text(v[2]));
  }
  return triangles.size() > kShown ? text + fmt::format("\n    and {} more", triangles.size() - kShown) : text;
}

}  // namespace

Triangles fewest(Triangles triangles, const std::function<bool(const Triangles&)>& is_wrong) {
  for (std::size_t run = triangles.size() / 2; run > 0; run /= 2) {
    for (std::size_t begin = 0; begin < triangles.size();) {
      Triangles fewer = triangles;
      const auto first = fewer.begin() + static_cast<std::ptrdiff_t>(begin);
      fewer.erase(first, first + static_cast<std::ptrdiff_t>(std::min(run, fewer.size() - begin)));
      if (is_wrong(fewer)) {
        triangles = std::move(fewer);
      } else {
        begin += run;
      }
    }
  }
  return triangles;
}

Failure minimise(const cases::CaseData& data, const Complaint& complaint) {
  const Question& question = complaint.question;
  Failure failure{fmt::format("{} {} {}", question.kernel, question.simd_target,
                              question.query == Query::occluded ? "occluded" : "closest"),
                  {},
                  data.rays[complaint.ray]};
  const Ray& ray = failure.ray;
  if (Status status = use_simd_target(question.simd_target.c_str()); !status) failure.text += status.message();
  const auto wrong = [&](const Triangles& triangles) { return is_wrong(triangles, ray, question); };
  if (wrong(data.triangles)) {
    failure.triangles = fewest(data.triangles, wrong);
    const Answers answers = ask(failure.triangles, ray, question);
    failure.text += fmt::format(": answered {}, the truth is {}", answers.given, answers.truth);
    failure.text += triangles_text(failure.triangles);
  } else {
    failure.text += fmt::format(": wrong only among the rays beside it (ray {})", complaint.ray);
  }
  failure.text += fmt::format("\n  ray {{{}, {:a}f, {}, {:a}f}}", vector_text(ray.origin), ray.tmin,
                              vector_text(ray.direction), ray.tmax);
  if (Status status = use_simd_target(nullptr); !status) failure.text += status.message();
  return failure;
}

}  // namespace umbrix::judge
