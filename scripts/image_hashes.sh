#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders scenes with everything that must not change a picture: two compilers, each instruction set, 1 to 7 threads and
# each kernel, and compares the bytes of the images. Prints a line for each scene, compiler and instruction set; fails
# if a scene has more than one image. Usage: scripts/image_hashes.sh [SCENE.glb...]   (default: scenes/*.glb, and two of
# UMBRIX_SCENES_DIR, with its lights, if it is there)
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

scripts/install_packages.sh g++ clang-14 cmake ninja-build pkg-config ccache libtbb-dev libhwy-dev libglm-dev \
  libboost-dev libfmt-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libopenimageio-dev openimageio-tools
for preset in release clang; do
  cmake --preset "$preset" -B "build/hashes-$preset" -DUMBRIX_TESTS=OFF -DUMBRIX_BENCH=OFF \
    -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >/dev/null
  cmake --build "build/hashes-$preset" --target umbrix_cli -j "$(nproc)" | tail -n 1
done

large=${UMBRIX_SCENES_DIR:-../shared/scenes}
scenes=("$@")
if [ ${#scenes[@]} -eq 0 ]; then
  scenes=(scenes/*.glb)
  for name in sponza_dabrovic conference_room_only; do
    if [ -f "$large/$name.glb" ]; then scenes+=("$large/$name.glb"); fi
  done
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints the hash of one picture, all channels that show the scene. hash_of PROGRAM SCENE OPTION...
hash_of() {
  local program=$1 scene=$2
  shift 2
  if [ -f "${scene%/*}/scenes.json" ]; then set -- --setup "${scene%/*}/scenes.json" "$@"; fi
  "$program" render "$scene" -o "$work/image.exr" --overwrite --quiet --float --build-quality fast \
    --size 192x108 --spp 4 --aov normal,depth,albedo,shadow "$@"
  sha256sum "$work/image.exr" | cut -c -16
}

printf '%-24s %-8s %-8s %-16s %s\n' scene compiler simd image runs
result=0
for scene in "${scenes[@]}"; do
  for preset in release clang; do
    program=build/hashes-$preset/apps/umbrix/umbrix
    for simd in $("$program" kernels | sed -n 's/^SIMD targets, best first: //p'); do
      threads=0
      : >"$work/here"
      for kernel in auto auto auto auto auto auto $("$program" kernels | sed '/^$/,$d' | cut -d ' ' -f 1 | grep -vx brute); do
        threads=$((threads % 7 + 1))  # the first seven runs are 'auto' with 1 to 7, the others take their turns
        hash_of "$program" "$scene" --simd "$simd" --threads "$threads" --kernel "$kernel" >>"$work/here"
      done
      runs=$(wc -l <"$work/here")
      sort -u "$work/here" | while read -r hash; do
        printf '%-24s %-8s %-8s %s %s\n' "$(basename "$scene" .glb)" "${preset/release/gcc}" "$simd" "$hash" "$runs"
      done
      cat "$work/here" >>"$work/all"
    done
  done
  if [ "$(sort -u "$work/all" | wc -l)" -ne 1 ]; then
    echo "$(basename "$scene"): the pictures differ" >&2
    result=1
  fi
  : >"$work/all"
done
exit $result
