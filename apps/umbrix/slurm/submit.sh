#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders frames in tiles as a Slurm array and merges them when all are done.
# Usage: submit.sh SCENE OUT.####.exr FIRST LAST TILES [options of 'umbrix render']
# Partition, account, time and the like: as SBATCH_* variables (sbatch(1)). Submitted again, it renders what is missing.
set -euo pipefail
if [ $# -lt 5 ]; then
  sed -n 's/^# \(Usage: .*\)/\1/p' "$0" >&2
  exit 2
fi
output=$2 first=$3 last=$4 tiles=$5
here=$(cd "$(dirname "$0")" && pwd)

# TERM comes a minute before the end of the time, and at preemption: the tile keeps a checkpoint.
array=$(sbatch --parsable --job-name=umbrix --cpus-per-task="${CPUS:-8}" --signal=TERM@60 --requeue \
  --array=0-$(((last - first + 1) * tiles - 1)) "$here/render_tile.sh" "$@")
sbatch --job-name=umbrix-merge --dependency=afterok:"$array" "$here/merge.sh" "$output" "$first-$last" "$tiles"
