// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_compression.h"

#include <algorithm>

namespace umbrix::io::detail {
namespace {

// In a .glb, after the header and that of the first chunk.
constexpr std::size_t kJsonOffset = 20;

void append_u32(std::size_t n, std::vector<unsigned char>& out) {
  for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<unsigned char>(n >> shift & 0xFF));
}

// The same .glb around another JSON.
std::vector<unsigned char> rebuilt_glb(const GltfDocument& document, const std::string& json) {
  const unsigned char *begin = document.bytes.data(), *end = begin + document.bytes.size();
  const unsigned char* rest = begin + kJsonOffset + document.json.size();
  const std::size_t padded = (json.size() + 3) / 4 * 4;
  const std::size_t bytes = kJsonOffset + padded + static_cast<std::size_t>(end - rest);
  std::vector<unsigned char> out;
  out.reserve(bytes);
  out.assign(begin, begin + 8);  // magic and version
  append_u32(bytes, out);
  append_u32(padded, out);
  out.insert(out.end(), begin + kJsonOffset - 4, begin + kJsonOffset);  // the chunk's type
  out.insert(out.end(), json.begin(), json.end());
  out.resize(kJsonOffset + padded, ' ');
  out.insert(out.end(), rest, end);
  return out;
}

// tinygltf wants to read each buffer.
bool replace_placeholders(nlohmann::json& root) {
  bool found = false;
  if (!root.contains("buffers")) return false;
  for (nlohmann::json& buffer : root.at("buffers")) {
    if (!is_placeholder(buffer)) continue;
    buffer = {{"byteLength", 1}, {"uri", "placeholder"}};
    found = true;
  }
  return found;
}

// It also wants indices to lie in a view, which those in Draco's data do not.
bool drop_compressed_indices(nlohmann::json& root) {
  bool found = false;
  if (!kReadsDraco || !root.contains("meshes")) return false;
  for (nlohmann::json& mesh : root.at("meshes")) {
    if (!mesh.contains("primitives")) continue;
    for (nlohmann::json& primitive : mesh.at("primitives")) {
      if (extension_of(primitive, kDraco)) found |= primitive.erase("indices") > 0;
    }
  }
  return found;
}

}  // namespace

const nlohmann::json* extension_of(const nlohmann::json& value, const char* name) {
  const auto extensions = value.find("extensions");
  if (extensions == value.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

bool is_placeholder(const nlohmann::json& buffer) {
  const nlohmann::json* extension = kReadsMeshopt ? extension_of(buffer, kMeshopt) : nullptr;
  return extension && extension->value("fallback", false);
}

GltfDocument as_if_plain(GltfDocument document, const nlohmann::json& root) {
  nlohmann::json changed = root;
  const bool has_placeholders = replace_placeholders(changed);
  if (!drop_compressed_indices(changed) && !has_placeholders) return document;
  const std::string json = changed.dump();
  GltfDocument out;
  out.binary = document.binary;
  out.bytes = document.binary ? rebuilt_glb(document, json) : std::vector<unsigned char>(json.begin(), json.end());
  out.json = {reinterpret_cast<const char*>(out.bytes.data()) + (out.binary ? kJsonOffset : 0), json.size()};
  return out;
}

}  // namespace umbrix::io::detail
