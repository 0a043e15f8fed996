#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders the gallery of docs/gallery.md: our own scenes, and those of a folder of well-known ones that are not part of
# this repository, as far as they are there. Usage: scripts/gallery.sh [FOLDER]   (UMBRIX_SCENES_DIR, or ../shared/scenes)
# UMBRIX_GALLERY: more options of `umbrix render`, such as "--spp 4" for a quick look.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=${1:-${UMBRIX_SCENES_DIR:-../shared/scenes}}

[ -x build/release/apps/umbrix/umbrix ] || { cmake --preset release && cmake --build --preset release --target umbrix_cli; }

picture() {  # scene, name, more options
  local scene=$1 name=$2
  shift 2
  # shellcheck disable=SC2086  # the options are several words
  build/release/apps/umbrix/umbrix render "$scene" -o "docs/gallery/$name.png" --overwrite -q --size 640x360 \
    --filter blackman-harris --tonemap agx "$@" ${UMBRIX_GALLERY:-}
  echo "docs/gallery/$name.png"
}

for name in sponza_crytek bedroom japanese_garden classroom; do
  scene=$folder/$name.glb
  if [ -f "$scene" ]; then picture "$scene" "$name" --setup docs/gallery/views.json --spp 32 --bounces 4; fi
done
picture scenes/cornell.glb cornell --spp 64 --bounces 6
