// SPDX-License-Identifier: Apache-2.0
// Lines as the arguments of `umbrix render`; each is also taken for a frame list and for a pattern of outputs.
#include <CLI/CLI.hpp>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "frame_list.h"
#include "output_pattern.h"
#include "promise.h"
#include "render_arguments.h"

namespace {

using namespace umbrix;
using fuzz::promise;

std::vector<std::string> split_lines(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < size; ++i) {
    if (data[i] == '\n') {
      lines.emplace_back();
    } else if (data[i] != 0) {  // an argument ends at a zero
      lines.back() += static_cast<char>(data[i]);
    }
  }
  return lines;
}

void check_arguments(std::vector<std::string> words) {
  CLI::App program("test", "umbrix");
  app::RenderArguments arguments;
  app::add_render_options(program, arguments);
  std::vector<const char*> argv = {"umbrix"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  try {
    program.parse(static_cast<int>(argv.size()), argv.data());
  } catch (const CLI::ParseError& error) {
    promise(error.get_exit_code() == 0 || *error.what() != 0, "a refusal says something");
    return;
  }
  promise(arguments.samples >= 1 && arguments.samples <= 65536, "samples are in range");
  promise(arguments.threads >= 0 && arguments.threads <= 1024, "threads are in range");
  promise(std::isfinite(arguments.write.exposure) && std::isfinite(arguments.fps) && arguments.fps > 0,
          "numbers are finite");
  if (arguments.size) promise(arguments.size->width >= 1 && arguments.size->height >= 1, "the size is not empty");
  if (arguments.tile) promise(arguments.tile->index < arguments.tile->count, "the tile is one of them");
  promise(!std::isnan(arguments.checkpoints.interval + arguments.checkpoints.time_limit), "times are numbers");
  if (arguments.crop) promise(arguments.crop->x >= 0 && arguments.crop->width >= 1, "the part is not empty");
}

void check_frame_list(const std::string& text) {
  std::vector<int> frames;
  if (const Status status = app::parse_frames(text, frames); !status) return;
  promise(!frames.empty() && frames.size() <= 100000, "a list names frames, and not too many");
  const std::set<int> different(frames.begin(), frames.end());
  promise(different.size() == frames.size(), "each frame comes once");
  promise(*different.begin() >= -999999 && *different.rbegin() <= 999999, "frames are in range");
}

void check_pattern(const std::string& path) {
  const bool varies = app::path_of_frame(path, 7) != app::path_of_frame(path, -12);
  promise(varies == (app::frame_places(path) > 0), "frames have names of their own if there is a place for them");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<std::string> lines = split_lines(data, size);
  check_arguments(lines);
  constexpr std::size_t kMostLists = 8;  // a list of the most frames takes a sanitizer half a second
  if (lines.size() > kMostLists) return 0;
  for (const std::string& line : lines) {
    check_frame_list(line);
    check_pattern(line);
  }
  return 0;
}
