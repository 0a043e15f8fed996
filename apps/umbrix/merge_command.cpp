// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "config_file.h"
#include "exit_code.h"
#include "frame_list.h"
#include "log_file.h"
#include "memory_guard.h"
#include "memory_limit.h"
#include "message.h"
#include "openjd_lines.h"
#include "output_pattern.h"
#include "progress_option.h"
#include "strict_number.h"
#include "tile_set.h"

namespace umbrix::app {
namespace {

struct MergeArguments {
  std::vector<std::string> tiles;  ///< files, or none: those that render gives the names of `output`
  std::string output;
  std::vector<int> frames;
  int count = 0;  ///< of tiles, where they are not named
  ProgressStyle progress = ProgressStyle::automatic;
  bool quiet = false;
  std::string log_file;  ///< empty: none
  std::uint64_t memory_limit = default_memory_limit();
  io::WriteOptions write;
};

/// One frame to put together.
struct Merge {
  std::optional<int> frame;
  std::vector<std::string> tiles;
  std::string output;
};

bool exists(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(path, error);
}

Status plan_merges(const MergeArguments& a, std::vector<Merge>& out) {
  const std::size_t places = frame_places(a.output);
  if (a.frames.size() > 1 && places != 1) {
    return {StatusCode::invalid_argument,
            fmt::format("{}: needs one place for the frame number, such as name.####.exr", a.output)};
  }
  if (places > 0 && a.frames.empty()) {
    return {StatusCode::invalid_argument,
            fmt::format("{}: has a place for a frame number; --frames tells which", a.output)};
  }
  if (a.frames.empty()) out.push_back({std::nullopt, a.tiles, a.output});
  for (const int frame : a.frames) out.push_back({frame, a.tiles, path_of_frame(a.output, frame)});
  for (Merge& merge : out) {
    for (int i = 0; i < a.count; ++i) merge.tiles.push_back(path_of_tile(merge.output, {i, a.count}));
    if (Status status = io::check_output(merge.output, a.write); !status) return status;
    for (const std::string& tile : merge.tiles) {
      std::error_code error;
      if (std::filesystem::equivalent(tile, merge.output, error)) {
        return {StatusCode::output_failed, fmt::format("{}: is an input of this command", merge.output)};
      }
    }
  }
  return {};
}

/// "3, 5", and no more than one can read.
std::string list(const std::vector<int>& numbers) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < numbers.size() && i < kMost; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
  return numbers.size() > kMost ? fmt::format("{} and {} more", text, numbers.size() - kMost) : text;
}

int incomplete(const Merge& merge, const std::vector<int>& missing, int count) {
  const std::string text =
      fmt::format("{}: {} of {} tiles missing: {}", merge.output, missing.size(), count, list(missing));
  say_error(text);
  say_openjd_failure(text.c_str());
  return kIncomplete;
}

int merge_frame(const MergeArguments& a, const Merge& merge) {
  set_phase("merging tiles");
  TileSet set;
  std::vector<int> absent;
  for (std::size_t i = 0; i < merge.tiles.size(); ++i) {
    if (a.count > 0 && !exists(merge.tiles[i])) {
      absent.push_back(static_cast<int>(i));
    } else if (Status status = set.add(merge.tiles[i]); !status) {
      return report_status(status);
    }
  }
  if (!absent.empty()) return incomplete(merge, absent, a.count);
  if (const std::vector<int> missing = set.missing(); !missing.empty()) return incomplete(merge, missing, set.count());
  io::WriteOptions write = a.write;
  write.pixel_type = set.frame().pixel_type;
  if (Status status = io::write_image(merge.output, set.frame(), write); !status) return report_status(status);
  return kComplete;
}

int run(const MergeArguments& a) {
  if (Status status = open_log(a.log_file); !status) return report_status(status);
  limit_memory(a.memory_limit);
  std::vector<Merge> merges;
  if (Status status = plan_merges(a, merges); !status) return report_status(status);
  Progress progress(a.quiet ? ProgressStyle::none : a.progress, merges.size());
  int code = kComplete;
  for (const Merge& merge : merges) {
    // After a failure the other frames are still worth having, and what they lack is worth knowing.
    const int own = merge_frame(a, merge);
    if (own == kComplete) progress.frame_done(merge.frame);
    if (own != kComplete) code = own;
  }
  progress.finish();
  return code;
}

void check_together(const MergeArguments& a) {
  const auto reject = [](const char* reason) { throw CLI::ValidationError(reason); };
  if (a.tiles.empty() && a.count == 0) reject("TILES or --tiles is required");
  if (!a.tiles.empty() && a.count > 0) reject("--tiles names the tiles itself, beside TILES it has no meaning");
  if (!a.tiles.empty() && !a.frames.empty()) reject("--frames needs --tiles: TILES are of one frame");
  if (!has_extension(a.output, ".exr")) throw CLI::ValidationError("--output: '" + a.output + "' is not an .exr");
}

void choose_frames(MergeArguments& a, const std::string& text) {
  if (Status status = parse_frames(text, a.frames); !status) {
    throw CLI::ValidationError("--frames: " + status.message());
  }
}

void add_merge_options(CLI::App& command, MergeArguments& a) {
  add_config_option(command);
  command.add_option("tiles", a.tiles, "Tiles of one frame, as 'umbrix render --tile' writes them")->type_name("TILES");
  command.add_option("-o,--output", a.output, "The frame's .exr; the same bytes as if rendered in one piece")
      ->required()
      ->type_name("FILE");
  add_integer(
      command, "--tiles", 1, kMostTiles, [&a](auto n) { a.count = static_cast<int>(n); },
      "Merge this many tiles, named after the output as 'umbrix render' does");
  command
      .add_option_function<std::string>(
          "--frames", [&a](const std::string& text) { choose_frames(a, text); },
          "With --tiles: these frames, such as 1-3,5,7-20:2; -o then needs #### or %04d")
      ->type_name("LIST");
  command.add_flag("--overwrite", a.write.overwrite, "Replace files that exist");
  add_memory_limit_option(command, a.memory_limit);
  add_progress_option(command, a.progress);
  command.add_flag("-q,--quiet", a.quiet, "Only errors");
  add_log_file_option(command, a.log_file);
  command.callback([&a] { check_together(a); });
}

}  // namespace

Command add_merge_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("merge", "Put the tiles of a frame together");
  const auto arguments = std::make_shared<MergeArguments>();
  add_merge_options(*parser, *arguments);
  return {parser, [arguments] { return run(*arguments); }};
}

}  // namespace umbrix::app
