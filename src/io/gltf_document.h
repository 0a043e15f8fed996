// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "umbrix/io/scene_file.h"

namespace umbrix::io::detail {

/// A scene file's bytes and where its JSON is. The container (glTF 2.0 section 4.4, GLB) has been checked.
struct GltfDocument {
  std::vector<unsigned char> bytes;
  bool binary = false;  ///< .glb
  std::string_view json;

  GltfDocument() = default;
  GltfDocument(GltfDocument&&) = default;
  GltfDocument& operator=(GltfDocument&&) = default;
};

/// Reads `path`; .gltf and .glb are told apart by the first bytes. Throws LoadError.
GltfDocument read_gltf_document(const std::string& path, const LoadLimits& limits);

/// Parses JSON with bounds on nesting, on its length and on the number of its values, which cost many times the memory
/// of their text. Throws LoadError.
nlohmann::json parse_json(std::string_view text, const LoadLimits& limits = {});

/// Extensions that are read, and so may be required.
bool is_supported_extension(std::string_view name);

/// Checks what tinygltf takes on trust: that members have the right type and length, that every index names something
/// that exists, that views lie within their buffers, that the file requires nothing we do not have, and that its lists
/// are within the limits. Throws LoadError that names the member.
void check_gltf_json(const nlohmann::json& root, const LoadLimits& limits);

}  // namespace umbrix::io::detail
