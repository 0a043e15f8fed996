// SPDX-License-Identifier: Apache-2.0
#pragma once

/// tinygltf, built by us without what a hostile file could reach: no file system, no name expansion, no image decoder.
/// What it needs comes through callbacks (gltf_parse.cpp).
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>
