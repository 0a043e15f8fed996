#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds with warnings as errors and runs all tests; then checks format, builds again with sanitizers and runs the
# tests again, and lints. Usage: scripts/test.sh [--quick]   (--quick: the first part only)
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
jobs=$(nproc)
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1  # checkouts of the same sources share what they compiled

# openimageio-tools: OpenImageIO's CMake files insist on its programs. chromium: a test looks at a page with it.
scripts/install_packages.sh g++ cmake ninja-build pkg-config ccache clang-format-14 clang-tidy-14 \
  libtbb-dev libhwy-dev libglm-dev libboost-dev libfmt-dev libcli11-dev nlohmann-json3-dev \
  libtinygltf-dev libxxhash-dev \
  libmeshoptimizer-dev libdraco-dev libopenimageio-dev openimageio-tools libembree-dev libgtest-dev librsvg2-dev chromium

# Configures, builds and tests a preset; keeps ctest's summary for the last lines of the log.
summaries=()
check_preset() {
  local preset=$1
  shift
  cmake --preset "$preset" -DUMBRIX_WERROR=ON -DCMAKE_CXX_COMPILER_LAUNCHER=ccache "$@"
  cmake --build --preset "$preset" -j "$jobs"
  ctest --test-dir "build/$preset" -j "$jobs" --output-on-failure --no-tests=error 2>&1 | tee "build/$preset/ctest.log"
  summaries+=("$preset: $(grep 'tests passed' "build/$preset/ctest.log")")
}

check_preset release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON
scripts/farm.sh

if [ "$quick" != --quick ]; then
  mapfile -t sources < <(find apps bench include scenes src tests -name '*.cpp' -o -name '*.h' | sort)
  clang-format-14 --dry-run --Werror "${sources[@]}"

  # Sanitizers look for faults in the code, not in the answers: fewer judged rays (tests/oracle), no large scenes.
  UMBRIX_SCENES_DIR=none check_preset asan

  # One instruction set: all are compiled from the same sources.
  printf '%s\n' "${sources[@]}" | grep '^src/.*cpp$' |
    xargs -P "$jobs" -n 1 clang-tidy-14 -quiet -p build/release --extra-arg=-DHWY_COMPILE_ONLY_STATIC \
    2> >(grep -v 'warnings\? generated' >&2)
fi

printf '%s\n' "${summaries[@]}"
