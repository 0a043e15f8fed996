#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds and runs the tests of one sanitizer. Usage: scripts/sanitize.sh address|thread [CTEST OPTION...]
#   address   faults in memory and undefined behaviour, all tests (also the second half of scripts/test.sh)
#   thread    data races in the library; the renderer's one parallel loop is oneTBB's, which distributions do not
#             instrument
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

kind=${1:-}
shift || true
case $kind in
  address) preset=asan targets=(all) tests=() ;;
  thread)
    preset=tsan
    targets=(umbrix_core_tests umbrix_index_tests umbrix_frame_tests)
    tests=(-L '^(core|index|frame)$')
    ;;
  *)
    sed -n '3,$ s/^# \?//p' "$0" | head -n 5 >&2
    exit 2
    ;;
esac

scripts/install_packages.sh g++ cmake ninja-build pkg-config ccache libtbb-dev libhwy-dev libglm-dev libboost-dev \
  libfmt-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libxxhash-dev \
  libmeshoptimizer-dev libdraco-dev libopenimageio-dev openimageio-tools libembree-dev \
  libgtest-dev
cmake --preset "$preset" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
cmake --build --preset "$preset" -j "$(nproc)" --target "${targets[@]}"
UMBRIX_SCENES_DIR=none ctest --preset "$preset" -j "$(nproc)" --no-tests=error "${tests[@]}" "$@"
