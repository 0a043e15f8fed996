#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the fault tests (tests/faults) at full counts and prints a table. Usage: scripts/faults.sh [RUNS]   (default 200:
# what docs/reliability.md shows; other counts scale with it). UMBRIX_SCENES_DIR names the folder of large scenes.
set -euo pipefail
cd "$(dirname "$0")/.."
export UMBRIX_FAULT_RUNS=${1:-200}

[ -d build/release ] || cmake --preset release
cmake --build --preset release --target umbrix_allocation_tests umbrix_fault_tests

log=build/release/faults.log
code=0
for tests in umbrix_allocation_tests umbrix_fault_tests; do
  "build/release/tests/faults/$tests" || code=1
done > "$log" 2>&1

printf '%s, commit %s, %s, %s cores, Linux %s\n\n' "$(date +%F)" "$(git rev-parse --short HEAD)" \
  "$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo | head -1)" "$(nproc)" "$(uname -r)"
echo '| fault | runs | failures | p50 ms | p99 ms | |'
echo '|---|---:|---:|---:|---:|---|'
sed -n 's/^fault-row //p' "$log"
[ "$code" -eq 0 ] || { echo; grep -A6 -E 'Failure$|FAILED' "$log"; }
exit "$code"
