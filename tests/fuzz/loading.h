// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "umbrix/io/scene_file.h"

namespace umbrix::fuzz {

/// A refusal is bad_input or resource_limit, in one line that a terminal may show.
void check_refusal(const Status& status);

/// A camera that came out of a file: numbers finite, and so at all times.
void check_camera(const io::Camera& camera);
void check_light(const io::Light& light);

/// Loads a scene file and checks all that the interface promises of it, or of the refusal. `strict`: with small limits,
/// which keep a fuzzer fast.
void check_loading(const std::string& path, bool strict);

}  // namespace umbrix::fuzz
