// SPDX-License-Identifier: Apache-2.0
// A program for scripts/image_hashes.sh: renders a scene with each instruction set, from 1 to 7 threads and with each
// kernel, and prints a hash of all channels that show the scene. The words of a line: instruction set, kernel, threads,
// hash.
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>

#include "render/render.h"
#include "render/threads.h"
#include "umbrix/io/scene_file.h"
#include "umbrix/kernel.h"

namespace umbrix::render {
namespace {

/// FNV-1a (Fowler, Noll & Vo) of the pixels' bytes.
std::uint64_t hash(const io::Image& image) {
  std::uint64_t result = 0xCBF29CE484222325u;
  const auto* bytes = reinterpret_cast<const unsigned char*>(image.pixels.data());
  for (std::size_t i = 0; i < image.pixels.size() * sizeof(float); ++i) result = (result ^ bytes[i]) * 0x100000001B3u;
  return result;
}

/// A sphere and a rectangle where the camera is, and a dim sky: a picture has lights of all sizes.
void add_lamps(View& view) {
  io::Light lamp;
  lamp.position = {view.camera.to_world[0][3], view.camera.to_world[1][3], view.camera.to_world[2][3]};
  lamp.type = io::LightType::sphere;
  lamp.radius = 0.1f;
  view.lights.push_back(lamp);
  lamp.type = io::LightType::rectangle;
  view.lights.push_back(lamp);
  lamp.type = io::LightType::environment;
  lamp.intensity = 0.1f;
  view.lights.push_back(lamp);
}

Status load(const char* path, const char* setup_path, io::SceneFile& scene, View& view) {
  if (Status status = io::load_scene(path, scene); !status) return status;
  if (Status status = io::read_textures(scene); !status) return status;
  io::Setup setup;
  if (setup_path) {
    if (Status status = io::load_setup(setup_path, scene, setup); !status) return status;
  }
  view.camera = setup.camera            ? *setup.camera
                : scene.cameras.empty() ? io::framing_camera(scene)
                                        : scene.cameras.front();
  view.lights = setup.lights.empty() ? scene.lights : setup.lights;
  if (view.lights.empty()) view.lights = io::default_lights(scene, view.camera);
  for (io::Light& light : io::emissive_lights(scene)) view.lights.push_back(std::move(light));
  add_lamps(view);
  return {};
}

Status print_picture(const World& world, const View& view, RenderOptions options, int threads, const char* simd,
                     const char* kernel) {
  io::Image image;
  RenderStats stats;
  Status status;
  with_threads(threads, [&] { status = render(world, view, options, image, stats); });
  if (status.ok()) fmt::print("{} {} {} {:016x}\n", simd, kernel, threads, hash(image));
  return status;
}

Status print_pictures(const World& world, const View& view) {
  RenderOptions options;
  options.width = 192;
  options.height = 108;
  options.samples = 4;
  options.bounces = 1;
  options.filter = PixelFilter::gaussian;
  options.aovs = {"normal", "depth", "albedo", "shadow", "indirect"};
  for (std::size_t target = 0; target < simd_target_count(); ++target) {
    const char* const simd = simd_target_name(target);
    if (Status status = use_simd_target(simd); !status) return status;
    FrameTracer tracer;
    if (Status status = tracer.start(world.scene); !status) return status;
    options.tracer = &tracer;
    options.kernel = {};
    for (int threads = 1; threads <= 7; ++threads) {
      options.frame = threads;
      if (Status status = print_picture(world, view, options, threads, simd, "frames"); !status) return status;
    }
    options.tracer = nullptr;
    for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
      const std::string name = kernel_info(kernel).name;
      if (name == "brute") continue;  // hours on a real scene
      options.kernel.index = static_cast<int>(kernel);
      const int threads = 1 + static_cast<int>(kernel % 7);
      if (Status status = print_picture(world, view, options, threads, simd, name.c_str()); !status) return status;
    }
  }
  return {};
}

Status run(const char* path, const char* setup_path) {
  io::SceneFile scene;
  View view;
  if (Status status = load(path, setup_path, scene, view); !status) return status;
  World world;
  if (Status status = build_world(scene, {}, world); !status) return status;
  for (std::size_t kernel = 0; kernel < kernel_count(); ++kernel) {
    if (Status status = world.scene.prepare({static_cast<int>(kernel)}); !status) return status;
  }
  return print_pictures(world, view);
}

}  // namespace
}  // namespace umbrix::render

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::fprintf(stderr, "usage: umbrix_picture_hashes SCENE [SETUP]\n");
    return 2;
  }
  const umbrix::Status status = umbrix::render::run(argv[1], argc == 3 ? argv[2] : nullptr);
  if (!status.ok()) std::fprintf(stderr, "umbrix_picture_hashes: %s\n", status.message().c_str());
  return status.ok() ? 0 : 1;
}
