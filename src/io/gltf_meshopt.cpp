// SPDX-License-Identifier: Apache-2.0
// EXT_meshopt_compression. The library checks the data, and asserts the sizes that are checked here.

#include <meshoptimizer.h>

#include <limits>

#include "io/gltf_compression.h"
#include "io/load_error.h"

namespace umbrix::io::detail {
namespace {

using nlohmann::json;

// What one compressed view says of itself.
struct CompressedView {
  std::string label;
  std::string mode, filter;
  std::uint64_t stride = 0, count = 0;
  const unsigned char* data = nullptr;
  std::uint64_t bytes = 0;

  std::uint64_t decoded_bytes() const { return stride * count; }
};

// The schema's rules (section "JSON schema updates" of the extension).
void check_layout(const CompressedView& view) {
  const bool vertices = view.mode == "ATTRIBUTES";
  if (!vertices && view.mode != "TRIANGLES" && view.mode != "INDICES") {
    bad_input("{}: mode '{}' is none of ATTRIBUTES, TRIANGLES, INDICES", view.label, printable(view.mode, 32));
  }
  const bool fits =
      vertices ? view.stride > 0 && view.stride <= 256 && view.stride % 4 == 0 : view.stride == 2 || view.stride == 4;
  if (!fits) bad_input("{}: byteStride {} does not fit mode {}", view.label, view.stride, view.mode);
  if (view.mode == "TRIANGLES" && view.count % 3 != 0) {
    bad_input("{}: {} indices are no whole number of triangles", view.label, view.count);
  }
  if (view.filter == "NONE") return;
  const bool known = view.filter == "OCTAHEDRAL"   ? view.stride == 4 || view.stride == 8
                     : view.filter == "QUATERNION" ? view.stride == 8
                                                   : view.filter == "EXPONENTIAL";
  if (!vertices || !known) {
    bad_input("{}: filter '{}' does not fit mode {} and byteStride {}", view.label, printable(view.filter, 32),
              view.mode, view.stride);
  }
}

// Before memory is asked for. At best, two bits stand for sixteen bytes, and the last vertex is stored as it is.
void check_size(const CompressedView& view, std::uint64_t bytes_left) {
  constexpr std::uint64_t kMostPerByte = 64, kLargestStride = 256;
  const std::uint64_t most = (view.bytes + kLargestStride) * kMostPerByte;
  if (view.count > most / view.stride) {
    bad_input("{}: {} bytes cannot hold {} elements of {} bytes", view.label, view.bytes, view.count, view.stride);
  }
  if (view.decoded_bytes() > bytes_left) {
    over_limit("{}: {} elements of {} bytes, {} bytes are left of the limit", view.label, view.count, view.stride,
               bytes_left);
  }
}

CompressedView find_view(const json& extension, const tinygltf::Model& model, std::size_t number) {
  CompressedView view;
  view.label = fmt::format("bufferViews[{}].extensions.{}", number, kMeshopt);
  view.mode = extension.at("mode").get<std::string>();
  view.filter = extension.value("filter", std::string("NONE"));
  view.stride = extension.at("byteStride").get<std::uint64_t>();
  view.count = extension.at("count").get<std::uint64_t>();
  view.bytes = extension.at("byteLength").get<std::uint64_t>();
  const std::uint64_t offset = extension.value("byteOffset", std::uint64_t{0});
  const std::vector<unsigned char>& buffer = model.buffers.at(extension.at("buffer").get<std::size_t>()).data;
  if (offset > buffer.size() || view.bytes > buffer.size() - offset) {
    bad_input("{}: bytes {} to {} lie beyond its buffer of {} bytes", view.label, offset, offset + view.bytes,
              buffer.size());
  }
  view.data = buffer.data() + offset;
  return view;
}

std::vector<unsigned char> decoded(const CompressedView& view) {
  std::vector<unsigned char> out(view.decoded_bytes());
  using Decode = int (*)(void*, std::size_t, std::size_t, const unsigned char*, std::size_t);
  const Decode decode = view.mode == "ATTRIBUTES"  ? Decode{meshopt_decodeVertexBuffer}
                        : view.mode == "TRIANGLES" ? Decode{meshopt_decodeIndexBuffer}
                                                   : Decode{meshopt_decodeIndexSequence};
  if (!out.empty() && decode(out.data(), view.count, view.stride, view.data, view.bytes) != 0) {
    bad_input("{}: the compressed data is damaged", view.label);
  }
  const auto filter = view.filter == "OCTAHEDRAL"   ? meshopt_decodeFilterOct
                      : view.filter == "QUATERNION" ? meshopt_decodeFilterQuat
                                                    : meshopt_decodeFilterExp;
  if (view.filter != "NONE" && !out.empty()) filter(out.data(), view.count, view.stride);
  return out;
}

}  // namespace

void decode_meshopt(const json& root, tinygltf::Model& model, std::uint64_t& bytes_left) {
  if (!root.contains("bufferViews")) return;
  std::size_t number = 0;
  for (const json& element : root.at("bufferViews")) {
    if (const json* extension = extension_of(element, kMeshopt)) {
      const CompressedView view = find_view(*extension, model, number);
      check_layout(view);
      check_size(view, bytes_left);
      if (const auto bytes = element.at("byteLength").get<std::uint64_t>(); bytes != view.decoded_bytes()) {
        bad_input("{}: {} elements of {} bytes are not the {} of the view", view.label, view.count, view.stride, bytes);
      }
      bytes_left -= view.decoded_bytes();
      tinygltf::BufferView& target = model.bufferViews.at(number);
      target.buffer = static_cast<int>(model.buffers.size());
      target.byteOffset = 0;
      target.byteLength = view.decoded_bytes();
      tinygltf::Buffer buffer;
      buffer.data = decoded(view);
      model.buffers.push_back(std::move(buffer));
    }
    ++number;
  }
}

}  // namespace umbrix::io::detail
