#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the farm templates as a farm would, on this machine: kills a task, damages outputs, runs the job again, and
# compares each frame's bytes with a render in one process.
# Usage: scripts/farm.sh [FRAMES [TILES]]   (default 2 2; a program built before: UMBRIX_PROGRAM)
set -euo pipefail
cd "$(dirname "$0")/.."
frames=${1:-2} tiles=${2:-2}
program=$(realpath "${UMBRIX_PROGRAM:-build/release/apps/umbrix/umbrix}")

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/flight.json" <<'JSON'
{"camera": {"keyframes": [{"frame": 1, "eye": [0, 1, 3.5], "target": [0, 1, 0], "fov_y_degrees": 40},
                          {"frame": 8, "eye": [0.6, 1.2, 3.2]}]}}
JSON
scene=$PWD/scenes/cornell.glb
options=(--setup "$work/flight.json" --size 192x108 --spp 32 --aov depth)

# Tells which process it is, so that this one can be killed and no other.
cat >"$work/umbrix" <<SH
#!/bin/sh
echo \$\$ >"$work/process"
exec "$program" "\$@"
SH
chmod +x "$work/umbrix"

: >"$work/log"
"$program" render "$scene" -o "$work/plain.####.exr" --frames "1-$frames" "${options[@]}" -q

check_frames() {
  for ((frame = 1; frame <= frames; ++frame)); do
    cmp "$(printf "$work/plain.%04d.exr" "$frame")" "$(printf "$1.%04d.exr" "$frame")"
  done
  echo "$1: $frames frames of $tiles tiles, the bytes of one process"
}

# openjd run, with arguments to choose what of the job; its log is shown if it fails and that is not wanted.
job() {
  "$openjd" run apps/umbrix/openjd/render.yaml -p Scene="$scene" -p Output="$work/farm.####.exr" \
    -p Frames="1-$frames" -p Tiles="$tiles" -p Options="${options[*]}" -p Umbrix="$work/umbrix" "$@" >"$work/log" 2>&1
}

# Turns all bits of some bytes in the middle of a file.
damage() {
  python3 - "$1" <<'PY'
import sys
with open(sys.argv[1], 'r+b') as file:
    middle = file.seek(0, 2) // 2
    file.seek(middle)
    bytes_there = file.read(8)
    file.seek(middle)
    file.write(bytes(255 - b for b in bytes_there))
PY
}

try_openjd() {
  "$openjd" check apps/umbrix/openjd/render.yaml

  # A task that is killed soon after its start (tests/faults kills at every time).
  job --step Render --no-run-dependencies -tp Frame=1 -tp Tile=1 &
  task=$!
  until [ -s "$work/process" ]; do sleep 0.01; done
  sleep 0.05
  kill -KILL "$(cat "$work/process")" || true
  if wait "$task" || ls "$work"/farm.0001.tile000* 2>/dev/null; then
    echo "the task was not killed, or its failure was not noticed" >&2
    exit 1
  fi

  run_job() { job --step Merge --run-dependencies || { cat "$work/log"; exit 1; }; }
  run_job
  check_frames "$work/farm"
  damage "$(ls "$work"/farm.0001.tile001*.exr)"
  truncate -s 1000 "$(ls "$work/farm.$(printf %04d "$frames").tile000"*.exr)"
  damage "$work/farm.0001.exr"
  run_job
  check_frames "$work/farm"
  grep -q openjd_progress "$work/log"
}

# Open Job Description's own command line, of the version that the template was tried with.
openjd=$(command -v openjd || true)
if [ -z "$openjd" ]; then
  scripts/install_packages.sh python3-venv
  [ -x build/openjd/bin/openjd ] ||
    { python3 -m venv build/openjd && build/openjd/bin/pip install -q openjd-cli==0.8.0; } || true
  openjd=$(realpath -q build/openjd/bin/openjd || true)
fi
if [ -n "$openjd" ]; then
  try_openjd
else
  echo "openjd cannot be installed here: its template was not tried"
fi

# The Slurm scripts, with a scheduler that does everything at once.
mkdir "$work/slurm"
cat >"$work/slurm/sbatch" <<'SH'
#!/usr/bin/env bash
set -euo pipefail
last=
while [[ $1 == --* ]]; do
  [[ $1 != --array=0-* ]] || last=${1#--array=0-}
  shift
done
for ((i = 0; i <= ${last:-0}; ++i)); do SLURM_ARRAY_TASK_ID=$i "$@" >&2; done
echo 1
SH
printf '#!/bin/sh\nexec "$@"\n' >"$work/slurm/srun"
ln -s "$program" "$work/slurm/umbrix"
chmod +x "$work"/slurm/s*
PATH=$work/slurm:$PATH apps/umbrix/slurm/submit.sh "$scene" "$work/slurm/farm.####.exr" 1 "$frames" "$tiles" \
  "${options[@]}" -q >/dev/null
check_frames "$work/slurm/farm"
