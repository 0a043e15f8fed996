// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace umbrix::bench {

/// The page's style sheet, and its words on how things were measured, as HTML.
extern const char* const kPageStyle;
extern const char* const kMethods;

}  // namespace umbrix::bench
