// SPDX-License-Identifier: Apache-2.0
// The frame is cut into tiles, and a tile is rendered one sample a pixel at a time: all camera rays, then all shadow
// rays of each light, then all rays to the next surfaces, and so on. Rays that are traced together so are near each
// other, and a tile's memory stays small.
#include "render/render.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>

#include "render/ambient_occlusion.h"
#include "render/aovs/aov.h"
#include "render/bounces.h"
#include "render/camera.h"
#include "render/direct_light.h"
#include "render/light_rays.h"
#include "render/pixel_samples.h"

namespace umbrix::render {
namespace {

constexpr int kTileSize = 32;

/// 4 GB of colour; more is asked for by mistake, or is better rendered as crops.
constexpr std::uint64_t kMostPixels = 1u << 28;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// All that the tiles of a frame share; read only.
struct Frame {
  const World& world;
  const View& view;
  const RenderOptions& options;
  const LightSet& lights;
  Camera camera;
  PixelRect window;  ///< the crop, or all
  std::vector<const Aov*> aovs;
  ShadowQuery shadow_query;
  FilterSampler filter;
  bool looks_around;

  bool cancelled() const { return options.cancel && options.cancel->load(std::memory_order_relaxed); }
};

/// Which of a pixel's samples.
struct SampleRange {
  std::uint32_t begin, end;
};

/// Renders one tile, a sample a pixel at a time, keeping its memory from sample to sample.
class TileRenderer {
 public:
  explicit TileRenderer(const Frame& frame)
      : frame_(frame),
        light_rays_(frame.lights, frame.options, DirectLight(frame.world, frame.shadow_query)),
        bounces_(frame.world, frame.lights, frame.options),
        ambient_occlusion_(frame.world, frame.options) {
    stats_.lights.resize(frame.lights.size());
  }

  void render(const PixelRect& tile, const SampleRange& range, TileFilm& film) {
    order_pixels(tile);
    for (std::uint32_t index = range.begin; index < range.end && !frame_.cancelled(); ++index) {
      look(index);
      shade();
      if (frame_.looks_around) ambient_occlusion_.trace(index, tile_);
      follow_paths(index);
      for (std::size_t i = 0; i < tile_.samples.size(); ++i) {
        const Pixel pixel = tile_.pixels[i];
        const auto row = static_cast<std::size_t>(pixel.y - tile.y) * static_cast<std::size_t>(tile.width);
        film.add(row + static_cast<std::size_t>(pixel.x - tile.x), tile_.samples[i]);
      }
    }
  }

  const RenderStats& stats() const { return stats_; }

 private:
  /// Lists the tile's pixels so that those near each other follow each other: in blocks of 4x4, these in blocks of
  /// 16x16.
  void order_pixels(const PixelRect& tile) {
    tile_.pixels.clear();
    for (int i = 0; i < kTileSize * kTileSize; ++i) {
      const int big = i / 256, block = i / 16 % 16, within = i % 16;
      const int x = big % 2 * 16 + block % 4 * 4 + within % 4;
      const int y = big / 2 * 16 + block / 4 * 4 + within / 4;
      if (x < tile.width && y < tile.height)
        tile_.pixels.push_back({static_cast<std::uint16_t>(tile.x + x), static_cast<std::uint16_t>(tile.y + y)});
    }
  }

  /// Sends one camera ray through each pixel.
  void look(std::uint32_t index) {
    rays_.clear();
    for (const Pixel& pixel : tile_.pixels) {
      const SamplePoint at = pixel_sample(pixel.x, pixel.y, index, frame_.options.samples, frame_.options.seed);
      const double x = 0.5 + frame_.filter.offset(at.x), y = 0.5 + frame_.filter.offset(at.y);
      rays_.push_back(frame_.camera.ray(pixel.x + x, pixel.y + y));
    }
    hits_.assign(rays_.size(), Hit());
    QueryOptions query;
    query.kernel = frame_.options.kernel;
    const auto start = std::chrono::steady_clock::now();
    frame_.world.scene.closest({rays_.data(), rays_.size()}, hits_.data(), query);
    stats_.camera_seconds += seconds_since(start);
    stats_.camera_rays += rays_.size();
  }

  /// Finds what the rays met, and its own light.
  void shade() {
    tile_.samples.assign(rays_.size(), CameraSample());
    tile_.surfaces.resize(rays_.size());
    tile_.active.resize(rays_.size());
    tile_.throughput.assign(rays_.size(), Rgb(1));
    tile_.depth = 0;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      CameraSample& sample = tile_.samples[i];
      tile_.active[i] = hits_[i].valid();
      if (!tile_.active[i]) {
        sample.opaque = frame_.lights.has_background();
        if (sample.opaque) sample.radiance = frame_.lights.background(glm::normalize(load(rays_[i].direction)));
        continue;
      }
      Surface& surface = tile_.surfaces[i];
      find_surface(frame_.world, rays_[i], hits_[i], surface);
      sample.hit = sample.opaque = true;
      sample.radiance = surface.emission;
      sample.depth = hits_[i].t;
      sample.normal = surface.shading_normal;
      sample.albedo = surface.bsdf.base_color;
      ++stats_.camera_hits;
    }
  }

  /// Adds the light of each surface of the paths.
  void follow_paths(std::uint32_t index) {
    for (std::uint32_t left = frame_.options.bounces;; --left) {
      tile_.goes_on = left > 0;
      light_rays_.trace(index, tile_, stats_.lights);
      if (left == 0 || !bounces_.follow(index, tile_, stats_)) return;
    }
  }

  const Frame& frame_;
  LightRays light_rays_;
  Bounces bounces_;
  AmbientOcclusion ambient_occlusion_;
  RenderStats stats_;
  TileSamples tile_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
};

/// Row by row, so that what is done when a render is watched grows from the top.
std::vector<PixelRect> cut_into_tiles(const PixelRect& window) {
  std::vector<PixelRect> tiles;
  for (int y = 0; y < window.height; y += kTileSize) {
    for (int x = 0; x < window.width; x += kTileSize) {
      tiles.push_back(
          {window.x + x, window.y + y, std::min(kTileSize, window.width - x), std::min(kTileSize, window.height - y)});
    }
  }
  return tiles;
}

Status find_aovs(const RenderOptions& options, std::vector<const Aov*>& aovs) {
  aovs = {&beauty_aov()};
  for (const std::string& name : options.aovs) {
    const Aov* aov = find_aov(name);
    if (!aov) return {StatusCode::invalid_argument, fmt::format("no AOV is named '{}'", name)};
    if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) aovs.push_back(aov);
  }
  return {};
}

Status find_window(const RenderOptions& options, PixelRect& window) {
  if (options.width < 1 || options.height < 1 || options.samples < 1) {
    return {StatusCode::invalid_argument, "an image needs at least one pixel and one sample"};
  }
  if (options.samples > kMostSamples || options.light_samples < 1 || options.light_samples > kMostLightSamples) {
    return {StatusCode::invalid_argument,
            fmt::format("{} samples a pixel and {} a light are not from 1 to {} and {}", options.samples,
                        options.light_samples, kMostSamples, kMostLightSamples)};
  }
  if (options.bounces > kMostBounces) {
    return {StatusCode::invalid_argument,
            fmt::format("{} bounces are more than the limit of {}", options.bounces, kMostBounces)};
  }
  const Crop crop = options.crop.value_or(Crop{0, 0, options.width, options.height});
  if (crop.width < 1 || crop.height < 1 || crop.x < 0 || crop.y < 0 || crop.x > options.width - crop.width ||
      crop.y > options.height - crop.height) {
    return {StatusCode::invalid_argument,
            fmt::format("the crop {}x{}+{}+{} is not within the image of {}x{}", crop.width, crop.height, crop.x,
                        crop.y, options.width, options.height)};
  }
  window = {crop.x, crop.y, crop.width, crop.height};
  if (window.size() > kMostPixels) {
    return {StatusCode::resource_limit, fmt::format("{}x{} pixels are more than the limit of {} in one image",
                                                    crop.width, crop.height, kMostPixels)};
  }
  return {};
}

void prepare_image(const Frame& frame, io::Image& image) {
  image = io::Image();
  image.width = frame.window.width;
  image.height = frame.window.height;
  image.x = frame.window.x;
  image.y = frame.window.y;
  image.frame_width = frame.options.width;
  image.frame_height = frame.options.height;
  for (const char* name : channel_names(frame.aovs)) image.channels.emplace_back(name);
  image.pixels.resize(frame.window.size() * image.channels.size());
  image.matrices = {{"worldToCamera", frame.camera.world_to_camera()}, {"worldToNDC", frame.camera.world_to_ndc()}};
}

FrameView frame_view(const View& view, const RenderOptions& options) {
  FrameView result;
  result.frame = options.frame;
  result.width = static_cast<std::uint32_t>(options.width);
  result.height = static_cast<std::uint32_t>(options.height);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.eye[axis] = static_cast<float>(view.camera.to_world[axis][3]);
    result.forward[axis] = static_cast<float>(-view.camera.to_world[axis][2]);
  }
  return result;
}

/// One pass, or for a preview passes that double the samples.
std::vector<SampleRange> plan_passes(const RenderOptions& options) {
  std::vector<SampleRange> passes;
  for (std::uint32_t end = options.preview ? 1 : options.samples, begin = 0; begin < options.samples;) {
    passes.push_back({begin, std::min(end, options.samples)});
    begin = end;
    end *= 2;
  }
  return passes;
}

void render_tiles(const Frame& frame, io::Image& image, RenderStats& stats) {
  const std::vector<PixelRect> tiles = cut_into_tiles(frame.window);
  const std::vector<SampleRange> passes = plan_passes(frame.options);
  std::vector<std::optional<TileFilm>> films(tiles.size());  // from the first pass to the last
  std::vector<std::uint8_t> finished(tiles.size());
  TileStore* const store = frame.options.store;
  if (store) store->begin(tiles, image, finished);
  std::mutex mutex;
  auto done = passes.size() * static_cast<std::size_t>(std::count(finished.begin(), finished.end(), std::uint8_t{1}));
  for (const SampleRange& pass : passes) {
    const bool last = pass.end == frame.options.samples;
    tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t i) {
      if (frame.cancelled() || finished[i]) return;
      TileRenderer renderer(frame);
      if (!films[i]) films[i].emplace(frame.aovs, tiles[i]);
      renderer.render(tiles[i], pass, *films[i]);
      films[i]->write(frame.window, image);
      if (last) films[i].reset();
      const std::lock_guard<std::mutex> lock(mutex);
      // What was cancelled has not all of its samples.
      if (frame.cancelled()) return;
      stats += renderer.stats();
      ++done;
      if (store && last) store->finish(i);
      if (frame.options.progress) frame.options.progress(done, tiles.size() * passes.size());
    });
    if (!last && !frame.cancelled()) frame.options.preview(image, pass.end);
  }
}

}  // namespace

Status check_options(const RenderOptions& options) {
  PixelRect window;
  std::vector<const Aov*> aovs;
  Status status = find_window(options, window);
  return status.ok() ? find_aovs(options, aovs) : status;
}

std::uint64_t image_bytes(const RenderOptions& options) {
  PixelRect window;
  std::vector<const Aov*> aovs;
  if (!find_window(options, window) || !find_aovs(options, aovs)) return 0;
  return window.size() * channel_names(aovs).size() * sizeof(float);
}

Status render(const World& world, const View& view, const RenderOptions& options, io::Image& image,
              RenderStats& stats) try {
  PixelRect window;
  if (Status status = find_window(options, window); !status) return status;
  std::vector<const Aov*> aovs;
  if (Status status = find_aovs(options, aovs); !status) return status;
  const auto start = std::chrono::steady_clock::now();
  const LightSet lights(world, view.lights);
  const bool per_ray = std::any_of(aovs.begin(), aovs.end(), [](const Aov* aov) { return aov->counts_work; });
  const Frame frame = {world,
                       view,
                       options,
                       lights,
                       Camera(view.camera, options.width, options.height),
                       window,
                       aovs,
                       {options.kernel, options.tracer, options.count_work, per_ray},
                       FilterSampler(options.filter),
                       std::any_of(aovs.begin(), aovs.end(), [](const Aov* aov) { return aov->looks_around; })};

  prepare_image(frame, image);
  stats = RenderStats();
  stats.lights.resize(view.lights.size());
  if (options.tracer) {
    if (Status status = options.tracer->begin_frame(frame_view(view, options)); !status) return status;
  }
  render_tiles(frame, image, stats);
  if (options.tracer) stats.frame = options.tracer->end_frame();
  stats.seconds = seconds_since(start);
  return frame.cancelled() ? Status(StatusCode::cancelled, "rendering was cancelled") : Status();
} catch (const std::bad_alloc&) {
  if (options.tracer) (void)options.tracer->end_frame();  // for a next try
  char text[96] = {};
  fmt::format_to_n(text, sizeof text - 1, "no memory for lights and an image of {}x{}", options.width, options.height);
  return Status::out_of_memory(text);
}

}  // namespace umbrix::render
