// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "render/pixel_filter.h"
#include "render/render_stats.h"
#include "render/tile_store.h"
#include "render/world.h"
#include "umbrix/frame.h"
#include "umbrix/io/image_file.h"

namespace umbrix::render {

/// A part of the frame, in pixels from its upper left corner.
struct Crop {
  int x = 0, y = 0, width = 0, height = 0;
};

/// What is seen, and in which light.
struct View {
  io::Camera camera;
  std::vector<io::Light> lights;  ///< of type mesh: of the world's file
};

struct RenderOptions {
  int width = 1280;
  int height = 720;
  std::optional<Crop> crop;   ///< the image holds this part; its pixels are those of the whole frame
  std::uint32_t samples = 1;  ///< a pixel
  /// Shadow rays of a sample to each light with an area; punctual lights need one. Where there are more than
  /// kMostSampledLights with an area, that many are chosen among them, by power, in place of each.
  std::uint32_t light_samples = 1;
  std::uint32_t bounces = 0;  ///< of light between the lights and what the camera sees, after the first
  PixelFilter filter = PixelFilter::box;
  float ao_distance = std::numeric_limits<float>::infinity();  ///< how near the AOV "ao" looks
  std::uint64_t seed = 0;
  std::vector<std::string> aovs;  ///< names of known_aovs()
  KernelId kernel;                ///< of camera rays, and of shadow rays if there is no tracer
  FrameTracer* tracer = nullptr;  ///< started for the world's scene: answers shadow rays, from frame to frame
  std::int64_t frame = 0;         ///< the tracer's frame number
  bool count_work = false;        ///< fill LightStats::counts; slower
  const std::atomic<bool>* cancel = nullptr;                          ///< polled for each tile and sample
  std::function<void(std::size_t done, std::size_t total)> progress;  ///< tiles; called by one thread at a time
  /// If set, the image is made in passes over all tiles, each with as many samples as all before it together, and shown
  /// after each but the last. Pixels are the same; memory is that of the image in double more.
  std::function<void(const io::Image& image, std::uint32_t samples)> preview;
  TileStore* store = nullptr;  ///< tiles that it has are not rendered again, and not part of the stats
};

constexpr std::size_t kMostSampledLights = 8;

/// Limits of RenderOptions::samples, light_samples and bounces.
constexpr std::uint32_t kMostSamples = 65536;
constexpr std::uint32_t kMostLightSamples = 4096;
constexpr std::uint32_t kMostBounces = 1000;

struct AovInfo {
  std::string name;
  std::string summary;
  bool heat_map;    ///< make_heat_map draws it
  bool heat_scale;  ///< and by a scale of numbers
  bool of_tracer;   ///< shows how rays were answered, which depends on kernel and instruction set
};

/// What RenderOptions::aovs may name.
std::vector<AovInfo> known_aovs();

/// Fails as render would for options that make no sense: an unknown AOV, an empty image, a crop beyond it, numbers of
/// samples beyond their limits; or with resource_limit for more than 2^28 pixels.
Status check_options(const RenderOptions& options);

/// The memory that the image's pixels take; 0 for options that check_options refuses.
std::uint64_t image_bytes(const RenderOptions& options);

/// Renders into `image`: R, G, B, A, then the channels of the AOVs in the order asked for. Runs on
/// oneTBB's threads (see with_threads). The pixels depend on the world, the view and the options' image, crop, both
/// kinds of samples and seed alone. Fails as check_options; cancelled leaves `image` unfinished.
Status render(const World& world, const View& view, const RenderOptions& options, io::Image& image, RenderStats& stats);

}  // namespace umbrix::render
