// SPDX-License-Identifier: Apache-2.0
// Each file of tests/scenes/features, rendered by the program, shows what glTF's text says (docs/features.md).
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "feature_cases.h"
#include "program.h"
#include "umbrix/io/image_file.h"

namespace umbrix::app {

std::vector<Probe> squares(const std::vector<Color>& colors, double tolerance, double y) {
  std::vector<Probe> out;
  double x = 0;
  for (const Color& color : colors) {
    out.push_back({x + 0.2, y + 0.7, color, tolerance});
    out.push_back({x + 0.7, y + 0.2, color, tolerance});
    ++x;
  }
  return out;
}

std::vector<Probe> operator+(std::vector<Probe> one, const std::vector<Probe>& other) {
  one.insert(one.end(), other.begin(), other.end());
  return one;
}

// What a failed test is about.
void PrintTo(const FeatureCase& one, std::ostream* out) { *out << one.file; }

namespace {

constexpr int kPixels = 16;  // to a unit of the scene

std::vector<FeatureCase> all_cases() {
  std::vector<FeatureCase> out;
  for (const auto cases : {geometry_cases, material_cases, texture_cases, view_cases, motion_cases}) {
    for (FeatureCase& one : cases()) out.push_back(std::move(one));
  }
  return out;
}

std::string feature_file(const std::string& name) { return UMBRIX_FEATURES_DIR "/" + name; }

/// The mean over the pixels whose centres are within the probe's square; at least that of the place itself.
Color seen(const io::Image& image, const Probe& probe) {
  const auto pixel = [](double place) { return static_cast<int>(std::floor(place * kPixels)); };
  const double below = image.height / static_cast<double>(kPixels) - probe.y, half = probe.side / 2;
  Color sum{};
  int count = 0;
  if (pixel(below - half) < 0 || pixel(below + half) >= image.height || pixel(probe.x - half) < 0 ||
      pixel(probe.x + half) >= image.width) {
    ADD_FAILURE() << "the picture does not show this place";
    return sum;
  }
  for (int y = pixel(below - half); y <= pixel(below + half); ++y) {
    for (int x = pixel(probe.x - half); x <= pixel(probe.x + half); ++x, ++count) {
      for (std::size_t c = 0; c < 3; ++c) {
        const auto name = std::string(1, "RGB"[c]);
        const auto channel = std::find(image.channels.begin(), image.channels.end(), name) - image.channels.begin();
        const auto at = static_cast<std::size_t>(y * image.width + x) * image.channels.size();
        sum[c] += static_cast<double>(image.pixels[at + static_cast<std::size_t>(channel)]);
      }
    }
  }
  for (double& value : sum) value /= count;
  return sum;
}

class Features : public ProgramTest, public testing::WithParamInterface<FeatureCase> {
 protected:
  Outcome render() {
    const FeatureCase& one = GetParam();
    const std::string size = std::to_string(one.width * kPixels) + "x" + std::to_string(one.height * kPixels);
    std::vector<std::string> arguments = {"render",     feature_file(one.file),
                                          "-o",         path("out.exr"),
                                          "--size",     size,
                                          "--float",    "-v",
                                          "--progress", "none",
                                          "-j",         "1"};
    arguments.insert(arguments.end(), one.arguments.begin(), one.arguments.end());
    return run(arguments);
  }
};

/// The lines that begin with the program's name; what follows is a summary.
std::string remarks(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    if (text.compare(begin, 7, "umbrix:") == 0) out += text.substr(begin, end - begin);
    begin = end;
  }
  return out;
}

bool is_read(const std::string& reader) {
  return reader.empty() || std::string("," UMBRIX_READERS ",").find("," + reader + ",") != std::string::npos;
}

TEST_P(Features, AreSeen) {
  const FeatureCase& one = GetParam();
  const Outcome outcome = render();
  if (!is_read(one.reader)) {
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("not supported by this build"), std::string::npos) << outcome.err;
    return;
  }
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(remarks(outcome.err), one.ignored);
  io::Image image;
  ASSERT_TRUE(io::read_image(path("out.exr"), image).ok());
  for (const Probe& probe : one.probes) {
    const Color color = seen(image, probe);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(color[c], probe.color[c], probe.tolerance)
          << "at " << probe.x << ", " << probe.y << ", channel " << c;
    }
  }
}

std::string name_of(const testing::TestParamInfo<FeatureCase>& info) {
  std::string name = info.param.file;
  for (const std::string& argument : info.param.arguments) name += argument;
  name.erase(std::remove_if(name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }), name.end());
  return name;
}

INSTANTIATE_TEST_SUITE_P(Khronos, Features, testing::ValuesIn(all_cases()), name_of);

TEST(FeatureFiles, EachHasACase) {
  std::set<std::string> tested, there;
  for (const FeatureCase& one : all_cases()) tested.insert(one.file);
  for (const auto& entry : std::filesystem::directory_iterator(UMBRIX_FEATURES_DIR)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") there.insert(entry.path().filename().string());
  }
  EXPECT_EQ(tested, there);
}

}  // namespace
}  // namespace umbrix::app
