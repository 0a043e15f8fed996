// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_code.h"
#include "image_difference.h"
#include "memory_guard.h"
#include "memory_limit.h"
#include "message.h"
#include "standard_streams.h"
#include "strict_number.h"

namespace umbrix::app {
namespace {

using Json = nlohmann::ordered_json;

struct CompareArguments {
  std::string image, reference;
  std::string output;  ///< empty: none
  io::WriteOptions write;
  std::optional<double> fail_above;
  bool json = false;
  std::uint64_t memory_limit = default_memory_limit();
};

std::string json_text(const CompareArguments& a, const ImageDifference& d) {
  Json channels = Json::array();
  for (const ChannelDifference& c : d.channels) {
    channels.push_back(
        {{"name", c.name}, {"rmse", c.rmse}, {"mean_difference", c.mean}, {"max", c.largest}, {"max_at", {c.x, c.y}}});
  }
  Json result = {{"image", a.image}, {"reference", a.reference}};
  if (d.colour) result.update({{"rmse", d.colour->rmse}, {"relmse", d.colour->relmse}});
  result.update({{"pixels", d.pixels},
                 {"different_pixels", d.different},
                 {"not_finite_pixels", d.not_finite},
                 {"channels", channels},
                 {"only_in_image", d.only_in_image},
                 {"only_in_reference", d.only_in_reference}});
  return result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string table(const ImageDifference& d) {
  std::string text;
  if (d.colour) text += fmt::format("RMSE    {:.6g}\nrelMSE  {:.6g}\n", d.colour->rmse, d.colour->relmse);
  const double share = 100 * static_cast<double>(d.different) / static_cast<double>(d.pixels);
  text += fmt::format("pixels  {} of {} differ ({:.4g} %)\n", d.different, d.pixels, share);
  if (d.not_finite > 0) text += fmt::format("        {} of these have values that are not finite\n", d.not_finite);
  for (const ChannelDifference& c : d.channels) {
    text += fmt::format("{:16}RMSE {:<12.6g} mean {:<+12.4g} max {:.6g}", printable(c.name), c.rmse, c.mean, c.largest);
    text += c.largest > 0 ? fmt::format(" at {},{}\n", c.x, c.y) : "\n";
  }
  for (const std::string& name : d.only_in_image) text += fmt::format("{:16}only in the image\n", printable(name));
  for (const std::string& name : d.only_in_reference) {
    text += fmt::format("{:16}only in the reference\n", printable(name));
  }
  return text;
}

Status check_output(const CompareArguments& a) {
  if (a.output.empty()) return {};
  for (const std::string& input : {a.image, a.reference}) {
    std::error_code error;
    if (std::filesystem::equivalent(a.output, input, error)) {
      return {StatusCode::output_failed, fmt::format("{}: is an input of this command", a.output)};
    }
  }
  return io::check_output(a.output, a.write);
}

int run(const CompareArguments& a) {
  limit_memory(a.memory_limit);
  set_phase("comparing images");
  if (Status status = check_output(a); !status) return report_status(status);
  io::Image image, reference;
  if (Status status = io::read_image(a.image, image); !status) return report_status(status);
  if (Status status = io::read_image(a.reference, reference); !status) return report_status(status);
  ImageDifference difference;
  io::Image picture;
  if (Status status = compare_images(image, reference, difference, picture); !status) {
    return report_status({StatusCode::bad_input, fmt::format("{} and {}: {}", a.image, a.reference, status.message())});
  }
  if (!a.output.empty()) {
    if (Status status = io::write_image(a.output, picture, a.write); !status) return report_status(status);
  }
  const Status status = print_result(a.json ? json_text(a, difference) : table(difference));
  if (!status) return report_status(status);
  const bool far = a.fail_above && (difference.largest_rmse() > *a.fail_above || difference.not_finite > 0);
  return far ? kFailed : kComplete;
}

void add_compare_options(CLI::App& command, CompareArguments& a) {
  command.add_option("image", a.image, "EXR, PNG or Radiance HDR; colours are compared as they are stored")
      ->required()
      ->type_name("IMAGE");
  command.add_option("reference", a.reference, "What it should be; relMSE is relative to this one")
      ->required()
      ->type_name("REFERENCE");
  command.add_option("-o,--output", a.output, "Write the differences, without their signs, as .exr or .png")
      ->type_name("FILE");
  add_real(
      command, "--exposure", -64, 64, [&a](double x) { a.write.exposure = static_cast<float>(x); },
      "Stops by which a PNG is brightened [0]");
  add_real(
      command, "--fail-above", 0, 1e30, [&a](double x) { a.fail_above = x; },
      "End with code 1 if a channel's RMSE is above X, or where one image alone is not finite");
  command.add_flag("--json", a.json, "For programs");
  command.add_flag("--overwrite", a.write.overwrite, "Replace a file that exists");
  add_memory_limit_option(command, a.memory_limit);
}

}  // namespace

Command add_compare_command(CLI::App& program) {
  CLI::App* parser = program.add_subcommand("compare", "Tell how far an image is from another, channel by channel");
  const auto arguments = std::make_shared<CompareArguments>();
  add_compare_options(*parser, *arguments);
  return {parser, [arguments] { return run(*arguments); }};
}

}  // namespace umbrix::app
