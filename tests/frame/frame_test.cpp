// SPDX-License-Identifier: Apache-2.0
#include "frame_test.h"

#include <algorithm>

namespace umbrix::frame_tests {

std::vector<FrameOptions> all_options() {
  std::vector<FrameOptions> list;
  const auto add = [&](FrameMethod method, PredictorKey key, PredictorRule rule, LinkMode links, IndexMode index) {
    FrameOptions options;
    options.method = method;
    options.key = key;
    options.rule = rule;
    options.links = links;
    options.index = index;
    options.slots = 256;
    list.push_back(options);
  };
  constexpr LinkMode kLinks[] = {LinkMode::lazy, LinkMode::reached, LinkMode::full};
  constexpr IndexMode kIndices[] = {IndexMode::learned, IndexMode::paper};
  for (const PredictorKey key : {PredictorKey::object, PredictorKey::screen}) {
    for (const PredictorRule rule : {PredictorRule::counter, PredictorRule::majority, PredictorRule::sample}) {
      for (const FrameMethod method : {FrameMethod::best, FrameMethod::cached})
        add(method, key, rule, LinkMode::lazy, IndexMode::learned);
      for (const LinkMode links : kLinks)
        for (const IndexMode index : kIndices) add(FrameMethod::paper, key, rule, links, index);
    }
  }
  const FrameOptions usual;
  for (const LinkMode links : kLinks) add(FrameMethod::linked, usual.key, usual.rule, links, usual.index);
  for (const IndexMode index : kIndices) add(FrameMethod::indexed, usual.key, usual.rule, usual.links, index);
  for (const FrameMethod method : {FrameMethod::beam, FrameMethod::standard})
    add(method, usual.key, usual.rule, usual.links, usual.index);
  return list;
}

FrameOptions paper_options() {
  FrameOptions options;
  options.method = FrameMethod::paper;
  options.key = PredictorKey::screen;
  options.rule = PredictorRule::sample;
  options.links = LinkMode::reached;
  options.index = IndexMode::paper;
  return options;
}

std::string describe(const FrameOptions& options) {
  constexpr const char* kMethods[] = {"best", "cached", "paper", "indexed", "linked", "beam", "standard"};
  constexpr const char* kKeys[] = {"object", "screen"};
  constexpr const char* kRules[] = {"counter", "majority", "sample"};
  constexpr const char* kLinks[] = {"lazy", "reached", "full"};
  constexpr const char* kIndices[] = {"learned", "paper"};
  return std::string(kMethods[static_cast<int>(options.method)]) + ", key " + kKeys[static_cast<int>(options.key)] +
         ", rule " + kRules[static_cast<int>(options.rule)] + ", links " + kLinks[static_cast<int>(options.links)] +
         ", index " + kIndices[static_cast<int>(options.index)];
}

std::vector<std::uint8_t> trace(const FrameTracer& tracer, const std::vector<Ray>& rays, const Handover& how) {
  std::vector<std::uint8_t> out(rays.size(), 7);
  for (std::size_t begin = 0; begin < rays.size(); begin += how.tile) {
    ShadowTile tile;
    tile.light = how.light;
    tile.rays = {rays.data() + begin, std::min(how.tile, rays.size() - begin)};
    tile.mask = how.mask;
    if (how.skip) tile.skip = how.skip + begin;
    if (how.pixels) tile.pixels = how.pixels + begin;
    if (how.routes) tile.routes = how.routes + begin;
    if (how.each) tile.each = how.each + begin;
    tracer.occluded(tile, out.data() + begin);
  }
  return out;
}

std::vector<std::uint8_t> brute(const Scene& scene, const std::vector<Ray>& rays, const Handover& how) {
  QueryOptions options;
  EXPECT_TRUE(find_kernel("brute", options.kernel).ok());
  options.mask = how.mask;
  options.skip = how.skip;
  std::vector<std::uint8_t> out(rays.size());
  scene.occluded({rays.data(), rays.size()}, out.data(), options);
  return out;
}

std::vector<Ray> shuffled(std::vector<Ray> rays, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::shuffle(rays.begin(), rays.end(), random);
  return rays;
}

std::vector<Ray> moved(std::vector<Ray> rays, float step) {
  for (Ray& ray : rays)
    for (int k = 0; k < 3; ++k) ray.origin[k] += step * ray.direction[k];
  return rays;
}

std::vector<Pixel> pixel_rows(std::size_t count, std::uint32_t width) {
  std::vector<Pixel> pixels(count);
  for (std::size_t i = 0; i < count; ++i)
    pixels[i] = {static_cast<std::uint16_t>(i % width), static_cast<std::uint16_t>(i / width)};
  return pixels;
}

namespace {

constexpr float kHeight = 0.5f, kLight = 0.9f;

/// Two triangles in the plane z.
void add_rectangle(std::vector<float>& out, float x0, float y0, float x1, float y1, float z) {
  out.insert(out.end(), {x0, y0, z, x1, y0, z, x1, y1, z, x0, y0, z, x1, y1, z, x0, y1, z});
}

}  // namespace

Hall::Hall() {
  std::vector<float> vertices;
  add_rectangle(vertices, 0, 0, 1, 1, 0);
  add_rectangle(vertices, 0, 0, 1, 1, 1);
  for (int i = 0; i < 6; ++i) {
    const float x = 0.07f + 0.15f * static_cast<float>(i);
    add_rectangle(vertices, x, 0.1f, x + 0.08f, 0.8f, kHeight);
  }
  MeshView mesh;
  mesh.vertices = vertices.data();
  mesh.vertex_count = vertices.size() / 3;
  mesh.triangle_count = mesh.vertex_count / 3;
  EXPECT_TRUE(scene.add(mesh).ok());
  EXPECT_TRUE(scene.commit().ok());
  for (std::uint32_t i = 0; i < kWidth * kWidth; ++i) {
    const std::uint32_t tile = i / 256, block = i / 16 % 16, n = i % 16;
    const std::uint32_t x = tile % (kWidth / 16) * 16 + block % 4 * 4 + n % 4;
    const std::uint32_t y = tile / (kWidth / 16) * 16 + block / 4 * 4 + n / 4;
    pixels.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  }
}

std::vector<Ray> Hall::rays(float shift, float light_x) const {
  std::vector<Ray> result;
  for (const Pixel& pixel : pixels) {
    const float x = (static_cast<float>(pixel.x) + 0.5f + shift) / (kWidth + 2);
    const float y = (static_cast<float>(pixel.y) + 0.5f) / kWidth;
    result.push_back({{x, y, 1e-4f}, 0, {light_x - x, 0.5f - y, kLight}, 1});
  }
  return result;
}

}  // namespace umbrix::frame_tests
