// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "io/gltf_document.h"
#include "io/tinygltf.h"

namespace umbrix::io::detail {

/// Parses a document that check_gltf_json passed, with tinygltf. `root` is the document's JSON. Buffers come from the
/// document, from data URIs, or from files in the folder of `path` (or anywhere, if the limits allow it); images are
/// neither read nor decoded; those in data URIs are in Image::image. Throws LoadError.
tinygltf::Model parse_gltf(const std::string& path, const GltfDocument& document, const nlohmann::json& root,
                           const LoadLimits& limits);

/// The path of a file that a scene file names by a URI (see path_beside). Throws LoadError.
std::string uri_path(const std::string& scene_path, const std::string& uri, const std::string& label,
                     const LoadLimits& limits);

}  // namespace umbrix::io::detail
