#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# One tile of one frame, by the number of the array's task; submit.sh submits it.
set -euo pipefail
scene=$1 output=$2 first=$3 tiles=$5
shift 5
frame=$((first + SLURM_ARRAY_TASK_ID / tiles))
tile=$((SLURM_ARRAY_TASK_ID % tiles))
exec srun umbrix render "$scene" -o "$output" --frames="$frame" --tile "$tile/$tiles" \
  --resume --checkpoint 5m --create-dir --progress lines "$@"
