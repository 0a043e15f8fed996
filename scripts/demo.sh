#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds Umbrix and renders scenes/atrium.glb to out/atrium.exr and out/atrium.png.
set -euo pipefail
cd "$(dirname "$0")/.."

# openimageio-tools: OpenImageIO's CMake files insist on its programs.
scripts/install_packages.sh g++ cmake ninja-build pkg-config libtbb-dev libhwy-dev libglm-dev libboost-dev \
  libfmt-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libxxhash-dev \
  libmeshoptimizer-dev libdraco-dev libopenimageio-dev openimageio-tools

launcher=$(command -v ccache || true)
cmake --preset release -DUMBRIX_TESTS=OFF -DUMBRIX_BENCH=OFF -B build/demo -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher"
cmake --build build/demo --target umbrix_cli

build/demo/apps/umbrix/umbrix render scenes/atrium.glb -o out/atrium.exr -o out/atrium.png \
  --size 1280x720 --spp 16 --create-dir --overwrite
