// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "checkpoints.h"
#include "frame_size.h"
#include "memory_limit.h"
#include "progress.h"
#include "render/heat_map/heat_map.h"
#include "render/render.h"
#include "tile.h"
#include "umbrix/io/image_file.h"
#include "umbrix/scene.h"

namespace umbrix::app {

/// An AOV to be drawn, and the PNG it goes to.
struct HeatMapFile {
  render::HeatMapContent content;
  std::string path;
};

/// The command line of `umbrix render`, checked for itself: numbers in range, names known.
struct RenderArguments {
  std::string scene;
  std::vector<std::string> outputs;  ///< for frames, with a place for their number
  std::string setup;                 ///< empty: none
  std::string camera;                ///< name or number; empty: the first, or the setup's
  std::vector<int> frames;           ///< empty: a still
  double fps = 24;
  std::string animation;             ///< name or number; empty: all
  std::optional<Size> size;          ///< none: 720 rows in the camera's aspect
  std::optional<render::Crop> crop;  ///< or the one pixel
  std::optional<Tile> tile;          ///< not beside a crop
  bool print_pixel = false;          ///< of a crop of one pixel
  std::uint32_t samples = 1;
  std::uint32_t light_samples = 1;
  std::uint32_t bounces = 0;
  bool mesh_lights = true;
  render::PixelFilter filter = render::PixelFilter::box;
  std::uint64_t seed = 0;
  std::vector<std::string> aovs;
  float ao_distance = std::numeric_limits<float>::infinity();
  std::string preview;                 ///< file, or empty
  std::vector<HeatMapFile> heat_maps;  ///< for frames, with a place for their number
  io::WriteOptions write;              ///< exposure, tone map, pixel type, overwrite
  KernelId kernel;
  std::string kernel_name = "auto";
  std::string simd_target;  ///< empty: the best
  render::Instancing instancing = render::Instancing::automatic;
  BuildQuality build_quality = BuildQuality::high;
  int threads = 0;                                      ///< 0: all that are allowed
  std::uint64_t memory_limit = default_memory_limit();  ///< bytes; 0: none
  bool skip_existing = false;
  bool resume = false;  ///< and `write.overwrite`
  CheckpointOptions checkpoints;
  bool create_folders = false;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
  ProgressStyle progress = ProgressStyle::automatic;
  std::string log_file;         ///< empty: none
  std::string stats;            ///< file, "-" for stdout, or empty
  std::string picture_options;  ///< see job_hash.h
};

/// Are outputs that exist no reason to refuse?
inline bool may_exist(const RenderArguments& a) { return a.write.overwrite || a.skip_existing; }

/// Adds all options to the sub-command; parsing fills `arguments`.
void add_render_options(CLI::App& command, RenderArguments& arguments);

}  // namespace umbrix::app
