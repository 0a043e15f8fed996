#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Measures run time against error and makes the page of it. Usage: scripts/accuracy.sh FOLDER SETUP SCENE...
# FOLDER receives index.html and its charts. FLIP is on the page if Python has the packages flip-evaluator and numpy.
# UMBRIX_ACCURACY: more options of `umbrix-bench error`.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 3 ] || { sed -n '3,5s/^# //p' "$0" >&2; exit 2; }
folder=$1 setup=$2
shift 2
bench=build/release/bench/umbrix-bench
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# shellcheck disable=SC2086  # the options are several words
"$bench" error "$@" --setup "$setup" --keep-images "$work" --json "$work/error.json" ${UMBRIX_ACCURACY:-}
if python3 -c 'import flip_evaluator, numpy' 2> /dev/null; then
  python3 bench/error/flip.py "$work" "$work/error.json"
else
  echo "no FLIP: Python has not both flip-evaluator and numpy" >&2
fi
"$bench" error --from "$work/error.json" --out "$folder"
