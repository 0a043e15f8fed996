#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures which lines and branches of src/ the tests run: a table by folder, and each file as HTML in build/coverage.
# Tests that are about other compilers, installed trees or large scenes are left out, and hard cases take fewer rays.
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
jobs=$(nproc)

scripts/install_packages.sh g++ cmake ninja-build pkg-config ccache gcovr libtbb-dev libhwy-dev libglm-dev \
  libboost-dev libfmt-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libxxhash-dev \
  libmeshoptimizer-dev libdraco-dev libopenimageio-dev openimageio-tools \
  libembree-dev libgtest-dev
cmake --preset coverage -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
cmake --build --preset coverage -j "$jobs"

build=build/coverage-run
find "$build" -name '*.gcda' -delete
UMBRIX_TEST_RAYS=400 UMBRIX_SCENES_DIR=none ctest --preset coverage -j "$jobs" -LE 'consumer|structure|embree' \
  --no-tests=error --quiet

mkdir -p build/coverage
gcovr --root . --filter 'src/' -j "$jobs" --exclude-throw-branches --exclude-unreachable-branches \
  --html-details build/coverage/index.html --csv build/coverage/files.csv "$build"

# Columns: file, lines, lines run, share, branches, branches run, ...
awk -F, '
  NR > 1 {
    folder = $1
    sub(/^"?/, "", folder)
    sub(/\/[^\/]*$/, "", folder)
    for (part = 2; part <= 6; ++part) sum[folder, part] += $part
    for (part = 2; part <= 6; ++part) sum["all", part] += $part
    folders[folder]
  }
  function row(name) {
    return sprintf("%-24s %8d %7.1f %% %8d %7.1f %%", name, sum[name, 2], 100 * sum[name, 3] / (sum[name, 2] + !sum[name, 2]),
           sum[name, 5], 100 * sum[name, 6] / (sum[name, 5] + !sum[name, 5]))
  }
  END {
    printf "%-24s %8s %9s %8s %9s\n", "folder", "lines", "run", "branches", "taken"
    for (folder in folders) print row(folder) | "sort"
    close("sort")
    print row("all")
  }' build/coverage/files.csv
echo "files: build/coverage/index.html"
