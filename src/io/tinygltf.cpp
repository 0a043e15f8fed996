// SPDX-License-Identifier: Apache-2.0
// The one translation unit that holds tinygltf. Distributions build it with assertions, which end the program on some
// malformed files (tinygltf issue 425); here they are off, and what they would have stopped is checked before.

#ifndef NDEBUG
#define NDEBUG
#endif
#include <fstream>  // its writers, which nothing calls, need it in spite of TINYGLTF_NO_FS
#define TINYGLTF_IMPLEMENTATION
#include "io/tinygltf.h"
