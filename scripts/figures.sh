#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the figures of docs/how_it_works.md, all from the repository's own scenes. Usage: scripts/figures.sh
set -euo pipefail
cd "$(dirname "$0")/.."
umbrix=build/release/apps/umbrix/umbrix bench=build/release/bench/umbrix-bench figures=docs/how_it_works

if [ ! -x $umbrix ] || [ ! -x $bench ]; then
  cmake --preset release && cmake --build --preset release --target umbrix_cli umbrix_bench
fi

render() { "$umbrix" render "$@" --no-mesh-lights --size 400x225 --overwrite -q; }

render scenes/bedroom.glb -o $figures/bedroom.png --spp 16 --filter blackman-harris
for kernel in standard linked auto; do
  render scenes/bedroom.glb --kernel $kernel --heat-map node_tests=$figures/nodes_$kernel.png --heat-max node_tests=200
done
render scenes/forest.glb --setup $figures/forest_walk.json --frames 1-2 --heat-map kernel=$figures/routes_#.png
$bench depth scenes/bedroom.glb --size 256 --svg $figures/lists.svg
