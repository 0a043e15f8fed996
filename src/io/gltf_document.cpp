// SPDX-License-Identifier: Apache-2.0
#include "io/gltf_document.h"

#include <cstring>
#include <limits>

#include "io/input_file.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinChunk = 0x004E4942;
constexpr int kDeepestJson = 64;

std::uint32_t little_endian(const unsigned char* p) {
  return static_cast<std::uint32_t>(p[0]) | static_cast<std::uint32_t>(p[1]) << 8 |
         static_cast<std::uint32_t>(p[2]) << 16 | static_cast<std::uint32_t>(p[3]) << 24;
}

// Walks the chunks of a GLB: JSON first, then at most one BIN, then kinds that readers skip.
std::string_view find_glb_json(const std::vector<unsigned char>& bytes) {
  const std::uint64_t size = bytes.size();
  if (size < 20) bad_input("the .glb is cut off: {} bytes", size);
  if (const std::uint32_t version = little_endian(&bytes[4]); version != 2) {
    bad_input("glTF version {} is not supported, only 2", version);
  }
  if (const std::uint32_t length = little_endian(&bytes[8]); length != size) {
    bad_input("the .glb header says {} bytes, the file has {}", length, size);
  }
  std::string_view json;
  std::uint64_t offset = 12;
  for (std::uint64_t chunk = 0; offset < size; ++chunk) {
    if (size - offset < 8) bad_input("the header of .glb chunk {} is cut off", chunk);
    const std::uint32_t length = little_endian(&bytes[offset]);
    const std::uint32_t type = little_endian(&bytes[offset + 4]);
    offset += 8;
    if (length > size - offset) bad_input(".glb chunk {} says {} bytes, {} are left", chunk, length, size - offset);
    if (length % 4 != 0) bad_input(".glb chunk {} has a length of {}, not a multiple of 4", chunk, length);
    if ((type == kJsonChunk) != (chunk == 0) || (type == kBinChunk && chunk != 1)) {
      bad_input(".glb chunk {} has the wrong type; there must be one JSON chunk, then at most one BIN", chunk);
    }
    if (chunk == 0) json = {reinterpret_cast<const char*>(&bytes[offset - 1]) + 1, length};
    offset += length;
  }
  if (json.empty()) bad_input("the .glb has an empty JSON chunk");
  return json;
}

}  // namespace

GltfDocument read_gltf_document(const std::string& path, const LoadLimits& limits) {
  GltfDocument document;
  document.bytes = read_file(path, limits.file_bytes);
  // tinygltf counts in 32 bits, as the .glb header does.
  if (document.bytes.size() > std::numeric_limits<std::uint32_t>::max()) {
    over_limit("is larger than 4 GiB; keep large buffers in .bin files beside a .gltf");
  }
  document.binary = document.bytes.size() >= 4 && std::memcmp(document.bytes.data(), "glTF", 4) == 0;
  document.json = document.binary
                      ? find_glb_json(document.bytes)
                      : std::string_view(reinterpret_cast<const char*>(document.bytes.data()), document.bytes.size());
  return document;
}

nlohmann::json parse_json(std::string_view text, const LoadLimits& limits) {
  using Event = nlohmann::json::parse_event_t;
  if (text.size() > limits.json_bytes) {
    over_limit("the JSON has {} bytes, the limit is {}; keep large buffers in .bin files or a .glb", text.size(),
               limits.json_bytes);
  }
  std::uint64_t values = 0;
  const auto keep_bounds = [&](int depth, Event event, nlohmann::json&) {
    if (depth > kDeepestJson) bad_input("the JSON is nested more than {} deep", kDeepestJson);
    const bool begins = event == Event::object_start || event == Event::array_start || event == Event::value;
    if (begins && ++values > limits.json_values) {
      over_limit("the JSON has more than {} values, which is the limit", limits.json_values);
    }
    return true;
  };
  try {
    return nlohmann::json::parse(text.begin(), text.end(), keep_bounds);
  } catch (const nlohmann::json::exception& e) {
    const std::string_view what = e.what();
    // "[json.exception.parse_error.101] parse error at ..."
    bad_input("is not JSON: {}", one_line(what.substr(what.find(']') + 2)));
  }
}

}  // namespace umbrix::io::detail
