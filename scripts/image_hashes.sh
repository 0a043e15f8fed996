#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders scenes with everything that must not change a picture: two compilers, each instruction set, 1 to 7 threads and
# each kernel, and compares all pixels. Prints a line for each scene, compiler and instruction set; fails if a scene has
# more than one picture. Usage: scripts/image_hashes.sh [SCENE.glb...]   (default: scenes/*.glb, and two of
# UMBRIX_SCENES_DIR, with its lights, if it is there)
set -euo pipefail
cd "$(dirname "$0")/.."
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1

scripts/install_packages.sh g++ clang-14 cmake ninja-build pkg-config ccache libtbb-dev libhwy-dev libglm-dev \
  libboost-dev libfmt-dev libcli11-dev nlohmann-json3-dev libtinygltf-dev libxxhash-dev \
  libmeshoptimizer-dev libdraco-dev libopenimageio-dev openimageio-tools \
  libembree-dev libgtest-dev
for preset in release clang; do
  cmake --preset "$preset" -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >/dev/null
  cmake --build --preset "$preset" --target umbrix_picture_hashes -j "$(nproc)" | tail -n 1
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
printf '%-24s %-8s %-8s %-16s %s\n' scene compiler simd picture renders
result=0
for scene in "${scenes[@]}"; do
  name=$(basename "$scene" .glb)
  setup=()
  if [ -f "${scene%/*}/scenes.json" ]; then setup=("${scene%/*}/scenes.json"); fi
  for preset in release clang; do
    "build/$preset/tests/render/umbrix_picture_hashes" "$scene" "${setup[@]}" >"$work/$preset"
    awk -v scene="$name" -v compiler="${preset/release/gcc}" '
      !(($1, $4) in renders) { order[++count] = $1 SUBSEP $4 }
      { ++renders[$1, $4] }
      END {
        for (i = 1; i <= count; ++i) {
          split(order[i], word, SUBSEP)
          printf "%-24s %-8s %-8s %s %d\n", scene, compiler, word[1], word[2], renders[order[i]]
        }
      }' "$work/$preset"
  done
  if [ "$(cut -d ' ' -f 4 "$work/release" "$work/clang" | sort -u | wc -l)" -ne 1 ]; then
    echo "$name: the pictures differ" >&2
    result=1
  fi
done
exit $result
