// SPDX-License-Identifier: Apache-2.0
#include "judge/regressions.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace umbrix::judge {
namespace {

std::string numbers(const float* values, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += fmt::format(" {:a}", values[i]);
  return text;
}

// Exactly `count` floats and nothing else.
bool read_numbers(std::istringstream& line, float* out, std::size_t count) {
  std::string word;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(line >> word)) return false;
    char* end = nullptr;
    out[i] = std::strtof(word.c_str(), &end);  // streams do not read hexadecimal floats
    if (end != word.c_str() + word.size()) return false;
  }
  return !(line >> word);
}

// What is wrong with a line, or nothing.
std::string take_line(const std::string& text, std::vector<Regression>& out) {
  std::istringstream line(text.substr(0, text.find('#')));
  std::string keyword;
  if (!(line >> keyword)) return "";
  if (keyword == "case") {
    out.emplace_back();
    std::getline(line >> std::ws, out.back().name);
    return "";
  }
  if (out.empty()) return "expected 'case' first";
  if (keyword == "triangle") {
    float v[9];
    if (!read_numbers(line, v, 9)) return "a triangle needs nine numbers";
    oracle::Triangle& triangle = out.back().triangles.emplace_back();
    std::memcpy(triangle.v, v, sizeof v);
    return "";
  }
  if (keyword != "ray") return "expected 'case', 'triangle' or 'ray', not '" + keyword + "'";
  float v[8];
  if (!read_numbers(line, v, 8)) return "a ray needs eight numbers";
  static_assert(sizeof(Ray) == sizeof v);
  std::memcpy(&out.back().ray, v, sizeof v);
  return "";
}

}  // namespace

Status read_file(const std::string& path, std::string& out) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) return {StatusCode::bad_input, path + ": " + std::strerror(errno)};
  out = text.str();
  return {};
}

std::string to_text(const Regression& regression) {
  std::string text = "case " + regression.name + "\n";
  for (const oracle::Triangle& t : regression.triangles) text += "triangle" + numbers(t.v[0], 9) + "\n";
  float ray[8];
  std::memcpy(ray, &regression.ray, sizeof ray);
  return text + "ray" + numbers(ray, 8) + "\n";
}

Status read_regressions(const std::string& path, std::vector<Regression>& out) {
  std::string text;
  if (Status status = read_file(path, text); !status) return status;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    const std::string wrong = take_line(line, out);
    if (!wrong.empty()) return {StatusCode::bad_input, fmt::format("{}:{}: {}", path, number, wrong)};
  }
  return {};
}

}  // namespace umbrix::judge
