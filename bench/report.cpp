// SPDX-License-Identifier: Apache-2.0
#include "report.h"

#include <fmt/core.h>
#include <time.h>

#include <algorithm>
#include <filesystem>

#include "umbrix/io/image_file.h"

namespace umbrix::bench {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

ExitCode fail(const Status& status) {
  fmt::print(stderr, "umbrix-bench: {}\n", status.message());
  switch (status.code()) {
    case StatusCode::invalid_argument:
      return kUsage;
    case StatusCode::bad_input:
      return kBadInput;
    case StatusCode::output_failed:
      return kOutputFailed;
    default:
      return kFailed;
  }
}

ExitCode write_json(const std::string& path, const nlohmann::json& report) {
  if (path.empty()) return kDone;
  const Status status = io::write_text(path, report.dump(1) + "\n", true);
  return status ? kDone : fail(status);
}

std::string chart_path(const std::string& path, const std::string& scene, std::size_t scene_count) {
  if (scene_count == 1) return path;
  std::filesystem::path result(path);
  result.replace_filename(fmt::format("{}-{}{}", result.stem().string(), scene, result.extension().string()));
  return result.string();
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

double wall_seconds() { return seconds_of(CLOCK_MONOTONIC); }

}  // namespace umbrix::bench
