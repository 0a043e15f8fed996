// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "gltf_text.h"

namespace umbrix::io::testing {

/// Loading fails with `code`, in one plain line that names the file and `fault`, and leaves nothing behind.
void expect_refused(const std::string& path, StatusCode code, const std::string& fault, const LoadLimits& limits = {});

/// A way to break a file that loads (one_triangle), and what is then said.
struct Fault {
  const char* name;
  std::function<void(Gltf&)> make;
  const char* message;
  StatusCode code = StatusCode::bad_input;
};

/// expect_refused for the broken file as .gltf and as .glb.
void expect_refused(const Fault& fault);

}  // namespace umbrix::io::testing
