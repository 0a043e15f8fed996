// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/tinygltf.h"

namespace umbrix::io::detail {

/// What an accessor's values are for; decides the encodings that are allowed (glTF 2.0 sections 3.7.2.1, 3.7.3
/// and 3.11, and KHR_mesh_quantization): `key` are times, translations and scales of animations, `placement` and `turn`
/// those of EXT_mesh_gpu_instancing.
enum class AccessorUse {
  position,
  normal,
  tangent,
  texcoord,
  color,
  joint,
  weight,
  inverse_bind,
  key,
  rotation,
  morph_weight,
  placement,
  turn
};

/// Turns accessors into plain arrays: the only place that touches a file's buffers. Strided, normalised, quantised and
/// sparse forms are decoded; each read is checked against its view and each view against its buffer, before memory is
/// asked for. Throws LoadError that names the accessor.
class AccessorReader {
 public:
  /// `byte_limit`: how much may be decoded in all; an accessor that is asked for again counts again.
  AccessorReader(const tinygltf::Model& model, std::uint64_t byte_limit);

  /// How many elements an accessor has, by its own word.
  std::uint64_t count(int accessor) const;

  /// Elements of N components: 1 to 4, or 16 for matrices.
  template <std::size_t N>
  std::vector<std::array<float, N>> values(int accessor, AccessorUse use);

  std::vector<std::array<float, 3>> vectors(int accessor, AccessorUse use) { return values<3>(accessor, use); }
  std::vector<std::array<float, 2>> texcoords(int accessor) { return values<2>(accessor, AccessorUse::texcoord); }
  std::vector<std::array<float, 4>> tangents(int accessor) { return values<4>(accessor, AccessorUse::tangent); }
  /// Of three or four components; the fourth is 1 where there is none.
  std::vector<std::array<float, 4>> colors(int accessor);

  /// Vertex indices, each below `vertex_count`.
  std::vector<std::uint32_t> indices(int accessor, std::uint64_t vertex_count);

 private:
  struct Bytes;
  struct Encoding;

  const tinygltf::Accessor& accessor_at(int accessor) const;
  Bytes locate(int view, std::uint64_t offset, std::uint64_t count, const Encoding& encoding,
               const std::string& label) const;
  void spend(std::uint64_t elements, std::size_t bytes_each, bool backed, const std::string& label);
  template <std::size_t N>
  void apply_sparse(const tinygltf::Accessor& accessor, const Encoding& encoding, const std::string& label,
                    std::vector<std::array<float, N>>& out) const;

  const tinygltf::Model& model_;
  std::uint64_t bytes_left_;
  std::uint64_t zeros_left_;
  bool quantized_;
};

/// The bytes of a buffer view, such as an image's. Throws LoadError.
std::vector<unsigned char> view_bytes(const tinygltf::Model& model, int view, const std::string& label);

}  // namespace umbrix::io::detail
