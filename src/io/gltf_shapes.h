// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "io/accessor.h"
#include "io/shape.h"

namespace umbrix::io::detail {

/// The morph targets and joints of a primitive whose positions and normals are those of `mesh`; null if it has none.
/// Throws LoadError.
std::shared_ptr<Shape> read_shape(const tinygltf::Primitive& primitive, const Mesh& mesh, AccessorReader& reader,
                                  const std::string& label);

}  // namespace umbrix::io::detail
