// SPDX-License-Identifier: Apache-2.0
#include "error/image_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>

#include "error/ray_rows.h"
#include "error/statistics.h"
#include "render/image_metrics.h"
#include "render/render.h"
#include "render/threads.h"
#include "render/vec.h"
#include "report.h"
#include "umbrix/io/image_file.h"
#include "workload/shadow_rays.h"

namespace umbrix::bench {
namespace {

/// A way to trace shadow rays: a kernel of the table, or the frame tracer, which goes on from image to image.
struct Tracing {
  std::string name;
  KernelId kernel = {};
  std::unique_ptr<FrameTracer> frames = {};
  std::int64_t next_frame = 0;
};

struct Studio {
  render::World world;
  render::View view;
  std::vector<Tracing> tracings;
};

/// The light itself if it has an area, else a sphere around it that gives off as much.
io::Light area_light(const io::Light& light, double radius) {
  if (io::light_type_info(light.type).has(io::kHasArea)) return light;
  io::Light sphere = light;
  sphere.type = io::LightType::sphere;
  sphere.radius = static_cast<float>(radius);
  sphere.intensity = static_cast<float>(light.intensity / (render::kPi * radius * radius));
  return sphere;
}

Status set_up(const workload::Geometry& geometry, const io::Camera& camera, const io::Light& light,
              const ImageCurveOptions& options, Studio& studio) {
  if (Status status = render::build_world(geometry.file, {}, studio.world); !status) return status;
  const double radius = options.radius * workload::diagonal(studio.world.scene);
  studio.view = {camera, {area_light(light, radius)}};
  for (const std::string& name : options.kernels) {
    Tracing tracing{name};
    if (name == "frames:best") {
      tracing.frames = std::make_unique<FrameTracer>();
      if (Status status = tracing.frames->start(studio.world.scene); !status) return status;
    } else {
      if (Status status = find_kernel(name.c_str(), tracing.kernel); !status) return status;
      if (Status status = studio.world.scene.prepare(tracing.kernel); !status) return status;
    }
    studio.tracings.push_back(std::move(tracing));
  }
  return {};
}

Status render_image(Studio& studio, const ImageCurveOptions& options, std::uint32_t samples, std::uint64_t seed,
                    Tracing* tracing, io::Image& image, std::uint64_t& shadow_rays) {
  render::RenderOptions render;
  render.width = render.height = options.size;
  render.light_samples = samples;
  render.seed = seed;
  if (tracing && tracing->frames) {
    render.tracer = tracing->frames.get();
    render.frame = tracing->next_frame++;
  } else if (tracing) {
    render.kernel = tracing->kernel;
  }
  render::RenderStats stats;
  Status status = render::render(studio.world, studio.view, render, image, stats);
  shadow_rays = stats.shadow().rays();
  return status;
}

/// The mean of images of as many rays as one can have: at least as many in all as the options ask for.
Status render_half(Studio& studio, const ImageCurveOptions& options, std::uint64_t first_seed, render::RgbValues& out,
                   std::uint64_t& samples) {
  const std::uint32_t most = std::min(options.reference, render::kMostLightSamples);
  const std::uint32_t images = (options.reference + most - 1) / most;
  samples += std::uint64_t{most} * images;
  for (std::uint32_t i = 0; i < images; ++i) {
    io::Image image;
    std::uint64_t rays = 0;
    if (Status status = render_image(studio, options, most, first_seed + i, nullptr, image, rays); !status)
      return status;
    const render::RgbValues rgb = render::rgb_of(image);
    out.resize(rgb.size());
    for (std::size_t k = 0; k < rgb.size(); ++k) out[k] += rgb[k] / images;
  }
  return {};
}

struct Reference {
  render::RgbValues rgb;
  render::ImageError noise;
  std::uint64_t samples = 0;
};

Status render_reference(Studio& studio, const ImageCurveOptions& options, Reference& out) {
  constexpr std::uint64_t kSeeds[] = {1'000'000, 2'000'000};  // far from those of the images
  render::RgbValues halves[2];
  for (std::size_t i = 0; i < 2; ++i) {
    if (Status status = render_half(studio, options, kSeeds[i], halves[i], out.samples); !status) return status;
  }
  out.noise = render::noise_of_mean(halves[0], halves[1]);
  out.rgb.resize(halves[0].size());
  for (std::size_t i = 0; i < out.rgb.size(); ++i) out.rgb[i] = (halves[0][i] + halves[1][i]) / 2;
  return {};
}

Status keep_image(const ImageCurveOptions& options, const std::string& name, io::Image image) {
  if (options.keep.empty()) return {};
  io::WriteOptions write;
  write.overwrite = true;
  return io::write_image(fmt::format("{}/{}.png", options.keep, name), image, write);
}

Status keep_reference(const ImageCurveOptions& options, const std::string& scene, const render::RgbValues& rgb) {
  io::Image image;
  image.width = image.height = options.size;
  image.channels = {"R", "G", "B"};
  image.pixels.assign(rgb.begin(), rgb.end());
  return keep_image(options, scene + "-reference", std::move(image));
}

/// The images of one number of samples.
struct Point {
  std::vector<render::ImageError> errors;    ///< of each seed
  std::vector<std::vector<double>> seconds;  ///< of each kernel and seed
  std::uint64_t shadow_rays = 0;             ///< of the last image
};

Status measure_point(Studio& studio, const ImageCurveOptions& options, const std::string& scene, std::uint32_t samples,
                     const Reference& reference, Point& out) {
  out.seconds.resize(studio.tracings.size());
  for (int seed = 1; seed <= options.seeds; ++seed) {
    io::Image first;
    for (std::size_t i = 0; i < studio.tracings.size(); ++i) {
      io::Image image;
      Status status;
      double seconds = 0;
      render::with_threads(1, [&] {
        const double start = thread_seconds();
        status = render_image(studio, options, samples, static_cast<std::uint64_t>(seed), &studio.tracings[i], image,
                              out.shadow_rays);
        seconds = thread_seconds() - start;
      });
      if (!status) return status;
      out.seconds[i].push_back(seconds);
      if (i == 0) first = image;
      if (std::memcmp(first.pixels.data(), image.pixels.data(), first.pixels.size() * sizeof(float)) != 0) {
        return {StatusCode::internal, fmt::format("{}: {} renders another image than {}, seed {}, {} samples", scene,
                                                  studio.tracings[i].name, studio.tracings[0].name, seed, samples)};
      }
    }
    out.errors.push_back(render::image_error(render::rgb_of(first), reference.rgb));
    if (Status status = keep_image(options, fmt::format("{}-{}-{}", scene, samples, seed), first); !status)
      return status;
  }
  return {};
}

std::vector<double> each(const std::vector<render::ImageError>& errors, double render::ImageError::*measure) {
  std::vector<double> values;
  for (const render::ImageError& error : errors) values.push_back(error.*measure);
  return values;
}

nlohmann::json point_json(const Studio& studio, std::uint32_t samples, const Reference& reference, const Point& point) {
  const auto spread = [&](double render::ImageError::*measure) {
    return estimate_json(median_and_quartiles(each(point.errors, measure)));
  };
  const double common = reference.noise.mean_difference * reference.noise.mean_difference;
  nlohmann::json json = {
      {"samples", samples},
      {"shadow_rays", point.shadow_rays},
      {"rmse", spread(&render::ImageError::rmse)},
      {"rmse_trimmed", spread(&render::ImageError::rmse_trimmed)},
      {"relmse", spread(&render::ImageError::relmse)},
      {"relmse_trimmed", spread(&render::ImageError::relmse_trimmed)},
      {"bias", estimate_json(mean_interval(each(point.errors, &render::ImageError::mean_difference), common))}};
  for (std::size_t i = 0; i < studio.tracings.size(); ++i) {
    json["times"].push_back(
        {{"kernel", studio.tracings[i].name}, {"seconds", estimate_json(median_and_quartiles(point.seconds[i]))}});
  }
  return json;
}

}  // namespace

bool can_have_area(const io::Light& light) {
  const io::LightTypeInfo& type = io::light_type_info(light.type);
  return type.has(io::kHasArea) || type.has(io::kHasPosition);
}

Status measure_images(const workload::Geometry& geometry, const io::Camera& camera, const io::Light& light,
                      const ImageCurveOptions& options, nlohmann::json& out) {
  Studio studio;
  if (Status status = set_up(geometry, camera, light, options, studio); !status) return status;
  Reference reference;
  if (Status status = render_reference(studio, options, reference); !status) return status;
  if (Status status = keep_reference(options, geometry.name, reference.rgb); !status) return status;

  nlohmann::json points = nlohmann::json::array();
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t samples : options.samples) {
    Point point;
    if (Status status = measure_point(studio, options, geometry.name, samples, reference, point); !status)
      return status;
    for (const render::ImageError& error : point.errors) smallest = std::min(smallest, error.rmse);
    points.push_back(point_json(studio, samples, reference, point));
  }
  const io::Light& shining = studio.view.lights[0];
  const double mean =
      std::accumulate(reference.rgb.begin(), reference.rgb.end(), 0.0) / static_cast<double>(reference.rgb.size());
  out.push_back({{"scene", geometry.name},
                 {"size", options.size},
                 {"seeds", options.seeds},
                 {"light", {{"type", io::light_type_info(shining.type).name}, {"radius", shining.radius}}},
                 {"reference",
                  {{"samples", reference.samples},
                   {"mean", mean},
                   {"noise_rmse", reference.noise.rmse},
                   {"noise_relmse", reference.noise.relmse},
                   {"smallest_rmse", smallest},
                   {"noise_share", smallest > 0 ? reference.noise.rmse / smallest : 0}}},
                 {"points", std::move(points)}});
  return {};
}

}  // namespace umbrix::bench
