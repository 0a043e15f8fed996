// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::testing {

/// A folder of its own for each test, removed afterwards.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& bytes) const;
  std::vector<std::string> names() const;

 private:
  std::filesystem::path folder_;
};

/// Bytes of values, one after the other.
template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string base64(const std::string& bytes);

/// A .gltf under construction. Each add returns the index of what it added.
struct Gltf {
  nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
  std::string bin;
  std::size_t placeholder_bytes = 0;  ///< of a second buffer that EXT_meshopt_compression stands in for

  int view(const std::string& bytes, int stride = 0);
  int accessor(const std::string& bytes, int component_type, std::size_t count, const char* type, int stride = 0);
  int floats3(const std::vector<float>& xyz);
  int indices(const std::vector<std::uint16_t>& values);
  /// A mesh of one primitive.
  int mesh(const nlohmann::json& primitive);
  /// A key at each of `times` for a node's "translation", "rotation" or "scale", in `animation`.
  void animate(std::size_t animation, int node, const std::string& path, const std::vector<float>& times,
               const std::vector<float>& values, const std::string& interpolation = "LINEAR");
  /// A root node of scene 0.
  int root(const nlohmann::json& node);

  std::string text() const;  ///< with the buffer as a data URI
  std::string glb() const;

 private:
  nlohmann::json with_buffers(const nlohmann::json& first) const;
};

/// Three corners of a unit right triangle, placed by one node.
Gltf one_triangle();

}  // namespace umbrix::io::testing
