// SPDX-License-Identifier: Apache-2.0
#pragma once

/// UMBRIX_API marks what a shared build exports; everything else stays hidden.
#if defined(_WIN32)
#define UMBRIX_API
#else
#define UMBRIX_API __attribute__((visibility("default")))
#endif
