// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "io/gltf_document.h"
#include "io/tinygltf.h"

namespace umbrix::io::detail {

// Optional features of the build, each a library of its own.
#ifdef UMBRIX_READS_MESHOPTIMIZER
inline constexpr bool kReadsMeshopt = true;
#else
inline constexpr bool kReadsMeshopt = false;
#endif
#ifdef UMBRIX_READS_DRACO
inline constexpr bool kReadsDraco = true;
#else
inline constexpr bool kReadsDraco = false;
#endif

inline constexpr const char* kMeshopt = "EXT_meshopt_compression";
inline constexpr const char* kDraco = "KHR_draco_mesh_compression";

/// The object of an extension in `value`; null if it has none.
const nlohmann::json* extension_of(const nlohmann::json& value, const char* name);

/// Whether a buffer has no content of its own: what it would hold is compressed elsewhere.
bool is_placeholder(const nlohmann::json& buffer);

/// The document without what stops a parser that does not know of compression; as it is if there is none.
GltfDocument as_if_plain(GltfDocument document, const nlohmann::json& root);

/// Replaces buffer views that are compressed with EXT_meshopt_compression by what is in them. `root` is the document's
/// JSON, which check_gltf_json passed; `bytes_left` is how much memory may be asked for, and goes down by what was.
/// Throws LoadError.
void decode_meshopt(const nlohmann::json& root, tinygltf::Model& model, std::uint64_t& bytes_left);

/// The same for primitives that are compressed with KHR_draco_mesh_compression: each gets accessors of its own.
void decode_draco(const nlohmann::json& root, tinygltf::Model& model, std::uint64_t& bytes_left);

}  // namespace umbrix::io::detail
