// SPDX-License-Identifier: Apache-2.0
#include "gltf_text.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace umbrix::io::testing {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
  static int number = 0;
  folder_ = fs::temp_directory_path() / ("umbrix-io-" + std::to_string(::getpid()) + "-" + std::to_string(number++));
  fs::create_directories(folder_);
}

TempFolder::~TempFolder() {
  std::error_code error;
  fs::permissions(folder_, fs::perms::owner_all, error);
  fs::remove_all(folder_, error);
}

std::string TempFolder::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
  return path(name);
}

std::vector<std::string> TempFolder::names() const {
  std::vector<std::string> out;
  for (const auto& entry : fs::directory_iterator(folder_)) out.push_back(entry.path().filename().string());
  std::sort(out.begin(), out.end());
  return out;
}

std::string base64(const std::string& bytes) {
  static const char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned int group = 0;
    for (std::size_t b = 0; b < 3; ++b) {
      group = group << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
    }
    for (std::size_t d = 0; d < 4; ++d) {
      out += i + d > bytes.size() ? '=' : kDigits[group >> (18 - 6 * d) & 63];
    }
  }
  return out;
}

int Gltf::view(const std::string& bytes, int stride) {
  nlohmann::json view = {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}};
  if (stride > 0) view["byteStride"] = stride;
  json["bufferViews"].push_back(view);
  bin += bytes;
  bin.resize((bin.size() + 3) / 4 * 4);
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int Gltf::accessor(const std::string& bytes, int component_type, std::size_t count, const char* type, int stride) {
  const int number = view(bytes, stride);
  json["accessors"].push_back(
      {{"bufferView", number}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return static_cast<int>(json["accessors"].size()) - 1;
}

int Gltf::floats3(const std::vector<float>& xyz) { return accessor(bytes_of(xyz), 5126, xyz.size() / 3, "VEC3"); }

int Gltf::indices(const std::vector<std::uint16_t>& values) {
  return accessor(bytes_of(values), 5123, values.size(), "SCALAR");
}

int Gltf::mesh(const nlohmann::json& primitive) {
  json["meshes"].push_back({{"primitives", nlohmann::json::array({primitive})}});
  return static_cast<int>(json["meshes"].size()) - 1;
}

void Gltf::animate(std::size_t animation, int node, const std::string& path, const std::vector<float>& times,
                   const std::vector<float>& values, const std::string& interpolation) {
  const int input = accessor(bytes_of(times), 5126, times.size(), "SCALAR");
  const int output = path == "rotation" ? accessor(bytes_of(values), 5126, values.size() / 4, "VEC4") : floats3(values);
  nlohmann::json& to = json["animations"][animation];
  const std::size_t sampler = to["samplers"].size();
  to["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  to["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
}

int Gltf::root(const nlohmann::json& node) {
  json["nodes"].push_back(node);
  const int number = static_cast<int>(json["nodes"].size()) - 1;
  json["scenes"][0]["nodes"].push_back(number);
  return number;
}

nlohmann::json Gltf::with_buffers(const nlohmann::json& first) const {
  nlohmann::json out = json;
  out["buffers"] = nlohmann::json::array({first});
  if (placeholder_bytes > 0) {
    out["buffers"].push_back(
        {{"byteLength", placeholder_bytes}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  }
  return out;
}

std::string Gltf::text() const {
  if (bin.empty()) return json.dump();
  return with_buffers({{"byteLength", bin.size()}, {"uri", "data:application/octet-stream;base64," + base64(bin)}})
      .dump();
}

std::string Gltf::glb() const {
  const nlohmann::json out = with_buffers({{"byteLength", bin.size()}});
  std::string text = out.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string padded = bin;
  padded.resize((bin.size() + 3) / 4 * 4);
  const auto u32 = [](std::size_t n) { return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)}); };
  return "glTF" + u32(2) + u32(28 + text.size() + padded.size()) + u32(text.size()) + "JSON" + text +
         u32(padded.size()) + std::string("BIN\0", 4) + padded;
}

Gltf one_triangle() {
  Gltf g;
  const int positions = g.floats3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const int mesh = g.mesh({{"attributes", {{"POSITION", positions}}}, {"indices", g.indices({0, 1, 2})}});
  g.root({{"mesh", mesh}, {"name", "only"}});
  return g;
}

}  // namespace umbrix::io::testing
