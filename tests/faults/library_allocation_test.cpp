// SPDX-License-Identifier: Apache-2.0
// Each request for memory of the library fails in turn, alone or with all that follow: calls that can fail say so with
// a Status, queries answer as ever, and nothing throws or leaks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "failing_allocator.h"
#include "umbrix/umbrix.h"

namespace umbrix {
namespace {

struct Input {
  const char* name;
  std::vector<float> vertices;  ///< nine a triangle
  std::vector<Ray> rays;
  std::vector<std::uint8_t> expected;

  MeshView mesh() const {
    MeshView view;
    view.vertices = vertices.data();
    view.vertex_count = vertices.size() / 3;
    view.triangle_count = vertices.size() / 9;
    return view;
  }
};

constexpr FrameMethod kMethods[] = {FrameMethod::best,    FrameMethod::cached, FrameMethod::paper,
                                    FrameMethod::indexed, FrameMethod::linked, FrameMethod::beam,
                                    FrameMethod::standard};

std::vector<float> soup(std::size_t triangles, float size, std::mt19937& random) {
  std::uniform_real_distribution<float> u(-1, 1);
  std::vector<float> vertices;
  for (std::size_t i = 0; i < triangles; ++i) {
    const float center[] = {u(random), u(random), u(random)};
    for (int corner = 0; corner < 3; ++corner)
      for (const float c : center) vertices.push_back(c + size * u(random));
  }
  return vertices;
}

/// A field of bumps, of shared edges.
std::vector<float> terrain(int side) {
  std::vector<float> vertices;
  const auto add = [&](int x, int y) {
    const float s = 2.0f / static_cast<float>(side);
    const float px = static_cast<float>(x) * s - 1, py = static_cast<float>(y) * s - 1;
    vertices.insert(vertices.end(), {px, py, 0.2f * std::sin(9 * px) * std::cos(7 * py)});
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      add(x, y), add(x + 1, y), add(x + 1, y + 1);
      add(x, y), add(x + 1, y + 1), add(x, y + 1);
    }
  }
  return vertices;
}

std::vector<Input> inputs() {
  std::mt19937 random(7);
  std::vector<float> same;
  for (int i = 0; i < 40; ++i) same.insert(same.end(), {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0, 0.5f, 0});
  std::vector<Input> list = {{"one triangle", {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, 0, 0.5f, 0}, {}, {}},
                             {"coincident triangles", same, {}, {}},
                             {"terrain", terrain(12), {}, {}},
                             {"soup", soup(200, 0.2f, random), {}, {}},
                             {"small and large", soup(100, 1.0f, random), {}, {}}};
  std::uniform_real_distribution<float> u(-1.2f, 1.2f);
  for (Input& input : list) {
    for (int i = 0; i < 256; ++i) {
      const float from[] = {u(random), u(random), u(random)};
      input.rays.push_back({{from[0], from[1], from[2]}, 0, {0.3f - from[0], 0.2f - from[1], 0.9f - from[2]}, 1});
    }
  }
  return list;
}

/// The library in one pass, from an empty scene to the third frame. Holds the first failure of a Status, and how many
/// queries answered wrongly. Asks for no memory of its own.
struct Pass {
  explicit Pass(const Input& the_input) : input(the_input) {}

  const Input& input;
  std::array<std::uint8_t, 256> out{};
  StatusCode unexpected = StatusCode::ok;
  bool silent = false;  ///< a failure without a message
  int wrong = 0;

  bool done(const Status& status) {
    if (status.ok()) return true;
    if (status.code() != StatusCode::resource_limit) unexpected = status.code();
    silent |= status.message().empty();
    return false;
  }

  void compare(bool nothing = false) {
    for (std::size_t i = 0; i < out.size(); ++i) wrong += out[i] != (nothing ? 0 : input.expected[i]);
  }

  RaySpan rays() const { return {input.rays.data(), input.rays.size()}; }

  void ask(const Scene& scene, KernelId kernel, bool nothing) {
    QueryOptions options;
    options.kernel = kernel;
    out.fill(7);
    scene.occluded(rays(), out.data(), options);
    compare(nothing);
  }

  void trace_frames(const Scene& scene, FrameMethod method, LinkMode links, IndexMode index) {
    FrameTracer tracer;
    FrameOptions options;
    options.method = method;
    options.links = links;
    options.index = index;
    if (!done(tracer.start(scene, options))) return;
    const float light[1][3] = {{0.3f, 0.2f, 0.9f}};
    for (int frame = 0; frame < 3; ++frame) {
      FrameView view;
      view.frame = frame;
      view.lights = light;
      view.light_count = 1;
      (void)done(tracer.begin_frame(view));  // what it could not make is done without
      ShadowTile tile;
      tile.rays = rays();
      out.fill(7);
      tracer.occluded(tile, out.data());
      compare();
      (void)tracer.end_frame();
    }
  }

  void run() {
    Scene scene;
    const bool committed = done(scene.add(input.mesh())) && done(scene.commit());
    if (!committed) return ask(scene, {}, true);
    ask(scene, {}, false);
    for (std::size_t k = 0; k < kernel_count(); ++k) ask(scene, {static_cast<int>(k)}, false);  // the tree, in a query
    Training training;
    training.rays = rays();
    for (std::size_t k = 0; k < kernel_count(); ++k) {
      (void)done(scene.prepare({static_cast<int>(k)}, training));
      ask(scene, {static_cast<int>(k)}, false);
    }
    for (const FrameMethod method : kMethods) trace_frames(scene, method, LinkMode::lazy, IndexMode::learned);
    trace_frames(scene, FrameMethod::paper, LinkMode::reached, IndexMode::paper);
    trace_frames(scene, FrameMethod::paper, LinkMode::full, IndexMode::learned);
  }
};

TEST(LibraryAllocation, EveryFailureIsAStatusAndEveryAnswerRight) {
  const char* const text = std::getenv("UMBRIX_FAULT_RUNS");
  const bool all = text && std::atoi(text) >= 200;
  int runs = 0, failures = 0;
  std::uint64_t requests = 0;
  for (Input& input : inputs()) {
    Scene scene;
    ASSERT_TRUE(scene.add(input.mesh()).ok() && scene.commit().ok());
    input.expected.resize(input.rays.size());
    QueryOptions brute;
    ASSERT_TRUE(find_kernel("brute", brute.kernel).ok());
    scene.occluded({input.rays.data(), input.rays.size()}, input.expected.data(), brute);

    std::uint64_t count = 0;
    {
      const FailingAllocator never(UINT64_MAX, false);
      Pass pass(input);
      pass.run();
      count = FailingAllocator::requests();
      ASSERT_EQ(pass.wrong, 0) << input.name;
    }
    requests += count;
    const std::uint64_t step = all ? 1 : std::max<std::uint64_t>(1, count / 25);
    for (std::uint64_t n = 1; n <= count; n += step) {
      for (const bool all_after : {false, true}) {
        Pass pass(input);
        const std::int64_t before = FailingAllocator::live();
        {
          const FailingAllocator failing(n, all_after);
          pass.run();
        }
        const std::int64_t leaked = FailingAllocator::live() - before;
        const bool good = pass.unexpected == StatusCode::ok && !pass.silent && pass.wrong == 0 && leaked == 0;
        ++runs;
        failures += good ? 0 : 1;
        ASSERT_TRUE(good) << input.name << ", request " << n << (all_after ? " and all after" : "") << ": "
                          << static_cast<int>(pass.unexpected) << ", " << pass.wrong << " answers are wrong, " << leaked
                          << " objects leaked";
      }
    }
  }
  std::printf("fault-row | a request for memory fails in the library | %d | %d |  |  | of %llu requests |\n", runs,
              failures, static_cast<unsigned long long>(requests));
}

}  // namespace
}  // namespace umbrix
