// SPDX-License-Identifier: Apache-2.0
// Bytes as triangles and rays: the answers of every kernel, and of a frame tracer over three frames, against exact
// arithmetic.
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "byte_stream.h"
#include "cases/cases.h"
#include "judge/judge.h"
#include "judge/minimise.h"
#include "promise.h"
#include "umbrix/frame.h"
#include "umbrix/kernel.h"

namespace {

using namespace umbrix;
using fuzz::ByteStream;
using fuzz::promise;

constexpr std::size_t kMostTriangles = 40, kMostRays = 24;

// How a stream's numbers are made.
struct Numbers {
  enum class Form { bits, grid, grid_at_scale } form;
  int exponent;
};

Numbers take_numbers(ByteStream& bytes) {
  constexpr Numbers::Form kForms[] = {Numbers::Form::grid, Numbers::Form::bits, Numbers::Form::grid_at_scale};
  const Numbers::Form form = bytes.one_of(kForms);
  return {form, form == Numbers::Form::grid_at_scale ? static_cast<int>(bytes.below(256)) - 150 : -2};
}

float take_number(ByteStream& bytes, const Numbers& numbers) {
  if (numbers.form == Numbers::Form::bits) return bytes.take<float>();
  return std::ldexp(static_cast<float>(bytes.take<std::int8_t>()), numbers.exponent);
}

void take_point(ByteStream& bytes, const Numbers& numbers, float (&out)[3]) {
  for (float& x : out) x = take_number(bytes, numbers);
}

// Triangles share vertices with those before, or are new.
std::vector<oracle::Triangle> take_triangles(ByteStream& bytes, const Numbers& numbers) {
  std::vector<oracle::Triangle> triangles(bytes.below(kMostTriangles + 1));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (float(&vertex)[3] : triangles[i].v) {
      const std::size_t from = bytes.below(256);
      if (i > 0 && from % 3 == 0) {
        const float(&other)[3] = triangles[from % i].v[from / 3 % 3];
        std::copy(other, other + 3, vertex);
      } else {
        take_point(bytes, numbers, vertex);
      }
    }
  }
  return triangles;
}

// A vertex, the middle of an edge, or any point.
void take_target(ByteStream& bytes, const Numbers& numbers, const std::vector<oracle::Triangle>& triangles,
                 float (&out)[3]) {
  const std::size_t kind = bytes.below(4);
  if (kind == 0 || triangles.empty()) return take_point(bytes, numbers, out);
  const oracle::Triangle& t = triangles[bytes.below(triangles.size())];
  const std::size_t a = bytes.below(3), b = kind == 1 ? a : (a + 1) % 3;
  for (std::size_t k = 0; k < 3; ++k) out[k] = 0.5f * t.v[a][k] + 0.5f * t.v[b][k];
  if (kind == 3) out[bytes.below(3)] += take_number(bytes, numbers);
}

// Ends: the open segment between two points, one that goes on, and any.
Ray take_ray(ByteStream& bytes, const Numbers& numbers, const std::vector<oracle::Triangle>& triangles) {
  Ray ray{};
  take_target(bytes, numbers, triangles, ray.origin);
  float target[3];
  take_target(bytes, numbers, triangles, target);
  const std::size_t kind = bytes.below(4);
  for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = kind == 3 ? target[k] : target[k] - ray.origin[k];
  ray.tmin = 0;
  ray.tmax = kind == 0 ? 1 : HUGE_VALF;
  if (kind >= 2) {
    ray.tmin = take_number(bytes, numbers);
    ray.tmax = take_number(bytes, numbers);
  }
  return ray;
}

// So many that they are answered together: to where the first ray starts, from beyond vertices and middles of edges,
// from there, and from before.
std::vector<Ray> rays_to_one_light(const cases::CaseData& data) {
  const Ray& first = data.rays.front();
  std::vector<Ray> rays;
  for (std::size_t i = 0; !data.triangles.empty() && i < 160; ++i) {
    const oracle::Triangle& t = data.triangles[i % data.triangles.size()];
    const std::size_t a = i / data.triangles.size() % 3, b = i % 3 == 0 ? a : (a + 1) % 3;
    const float distance = i % 4 == 0 ? 1 : i % 4 == 1 ? 0.75f : 2;
    Ray ray{};
    ray.tmax = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const float target = 0.5f * t.v[a][k] + 0.5f * t.v[b][k];
      ray.origin[k] = first.origin[k] + (target - first.origin[k]) * distance;
      ray.direction[k] = first.origin[k] - ray.origin[k];
    }
    rays.push_back(ray);
  }
  return rays;
}

// A complaint is told so that it can be kept as a test.
void check_kernels(const cases::CaseData& data, bool all_targets, judge::Result& result) {
  judge::Options options;
  options.targets = all_targets ? judge::Targets::all : judge::Targets::current;
  options.rays_on_each_target = data.rays.size();
  options.truth.closest_rays = data.rays.size();
  const Status status = judge::judge(data, options, result);
  promise(status.ok(), "a small scene can be built and asked");
  if (result.complaints.empty()) return;
  const judge::Complaint& first = result.complaints.front();
  std::fprintf(stderr, "%s\n", judge::minimise(data, first).text.c_str());
  promise(false, "kernels give the answers of exact arithmetic");
}

FrameOptions take_frame_options(ByteStream& bytes) {
  FrameOptions options;
  options.method = static_cast<FrameMethod>(bytes.below(7));
  options.key = static_cast<PredictorKey>(bytes.below(2));
  options.rule = static_cast<PredictorRule>(bytes.below(3));
  options.links = static_cast<LinkMode>(bytes.below(3));
  options.index = static_cast<IndexMode>(bytes.below(2));
  options.region = 1 + static_cast<std::uint32_t>(bytes.below(9));
  options.slots = bytes.chance(2) ? 8 : 0;
  options.count_work = bytes.chance(2);
  return options;
}

void check_frames(const cases::CaseData& data, const std::vector<std::uint8_t>& truth, const FrameOptions& options) {
  Scene scene;
  promise(judge::build(data.triangles, scene).ok(), "a small scene can be built");
  FrameTracer tracer;
  promise(tracer.start(scene, options).ok(), "a frame tracer starts");
  std::vector<Pixel> pixels(data.rays.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = {static_cast<std::uint16_t>(i), 0};
  const float light[1][3] = {{1, 2, 3}};
  FrameView view;
  view.width = 64;
  view.height = 1;
  view.lights = light;
  view.light_count = 1;
  ShadowTile tile;
  tile.rays = {data.rays.data(), data.rays.size()};
  tile.pixels = pixels.data();
  for (view.frame = 0; view.frame < 3; ++view.frame) {
    promise(tracer.begin_frame(view).ok(), "a frame begins");
    std::vector<std::uint8_t> occluded(data.rays.size());
    tracer.occluded(tile, occluded.data());
    promise(occluded == truth, "a frame's answers are those of exact arithmetic");
    promise(tracer.end_frame().rays == data.rays.size(), "a frame counts its rays");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes_data, std::size_t size) {
  static const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  ByteStream bytes(bytes_data, size);
  const Numbers numbers = take_numbers(bytes);
  const FrameOptions frame_options = take_frame_options(bytes);
  const std::size_t choice = bytes.below(16);
  const bool all_targets = choice % 4 == 1, is_one_light = choice / 4 == 1;
  cases::CaseData data;
  data.triangles = take_triangles(bytes, numbers);
  while (!bytes.empty() && data.rays.size() < kMostRays) data.rays.push_back(take_ray(bytes, numbers, data.triangles));
  if (data.rays.empty()) return 0;
  if (is_one_light) {
    const std::vector<Ray> more = rays_to_one_light(data);
    data.rays.insert(data.rays.begin(), more.begin(), more.end());
  }
  judge::Result result;
  check_kernels(data, all_targets, result);
  check_frames(data, result.truth.occluded, frame_options);
  return 0;
}
