#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs each fuzz target of tests/fuzz for SECONDS, one after the other, from the kept corpus and what earlier runs
# found; then minimises the corpus and prints a table over all runs so far. Fails if an input broke a promise: it is then
# in build/fuzz/run/crashes. Usage: scripts/fuzz.sh [SECONDS] [--keep]   (60; --keep: into tests/fuzz/corpus)
# UMBRIX_FUZZ_TARGETS names some of the targets; 0 seconds only minimise and count.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
keep=${2:-}
read -ra targets <<<"${UMBRIX_FUZZ_TARGETS:-gltf_text gltf_binary gltf_values setup_file image_file arguments exact_answers}"
programs=build/fuzz/tests/fuzz
run=build/fuzz/run

scripts/install_packages.sh clang-14 libclang-rt-14-dev
cmake --preset fuzz >build/fuzz.configure.log 2>&1 || { cat build/fuzz.configure.log; exit 1; }
cmake --build --preset fuzz

options_of() {  # target
  case $1 in
    gltf_text | gltf_binary) echo -max_len=4096 -dict=tests/fuzz/gltf.dict ;;
    setup_file) echo -max_len=2048 -dict=tests/fuzz/setup.dict ;;
    arguments) echo -max_len=512 -dict=tests/fuzz/arguments.dict ;;
    image_file) echo -max_len=8192 -detect_leaks=0 ;;  # docs/fuzzing.md
    *) echo -max_len=1024 ;;
  esac
}

# What a target starts from, if this is its first run here.
prepare() {  # target
  [ ! -d "$run/corpus/$1" ] || return 0
  mkdir -p "$run/corpus/$1"
  cp "$run/seeds/$1"/* "$run/corpus/$1"
  tar -xzf "tests/fuzz/corpus/$1.tar.gz" -C "$run/corpus/$1"
  if [ -d "tests/fuzz/regressions/$1" ]; then cp "tests/fuzz/regressions/$1"/* "$run/corpus/$1"; fi
}

# Appends to the target's log; libFuzzer ends with an error if an input broke a promise.
fuzz() {  # target
  local status=0 options
  read -ra options <<<"$(options_of "$1")"
  TIMEFORMAT='cpu_seconds: %U %S'
  { time "$programs/fuzz_$1" "$run/corpus/$1" "${options[@]}" -max_total_time="$seconds" -rss_limit_mb=1024 \
    -timeout=5 -print_final_stats=1 -artifact_prefix="$run/crashes/$1-" || status=1; } >>"$run/logs/$1.log" 2>&1
  return $status
}

# Few inputs that reach every edge that the corpus reaches, how often does not matter.
minimise() {  # target
  rm -rf "$run/minimal/$1"
  mkdir -p "$run/minimal/$1"
  "$programs/fuzz_$1" -merge=1 -use_counters=0 -rss_limit_mb=1024 -timeout=20 "$run/minimal/$1" "$run/corpus/$1" >"$run/logs/$1.merge.log" 2>&1
  tar -C "$run/minimal/$1" --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cf - . | gzip -9n >"$run/$1.tar.gz"
  [ "$keep" != --keep ] || cp "$run/$1.tar.gz" "tests/fuzz/corpus/$1.tar.gz"
}

table_row() {  # target
  awk -v target="$1" -v inputs="$(find "$run/minimal/$1" -type f | wc -l)" -v bytes="$(stat -c %s "$run/$1.tar.gz")" \
    -v edges="$(grep -o 'cov: [0-9]*' "$run/logs/$1.merge.log" | tail -n 1 | cut -c 6-)" '
    /^stat::number_of_executed_units:/ { executions += $2 }
    /^cpu_seconds:/ { cpu += $2 + $3 }
    END { printf "| %s | %d | %.0f | %.0f | %d | %d | %d |\n", target, executions, (cpu > 0 ? executions / cpu : 0), cpu, inputs, bytes, edges }
  ' "$run/logs/$1.log"
}

mkdir -p "$run"/{corpus,logs,crashes,minimal}
"$programs/umbrix_fuzz_seeds" "$run/seeds" scenes/*.glb tests/scenes/features/*.gltf
failed=0
for target in "${targets[@]}"; do
  prepare "$target"
  touch "$run/logs/$target.log"
  if [ "$seconds" -gt 0 ] && ! fuzz "$target"; then
    failed=1
    grep -E -m 3 'broken promise|ERROR: |runtime error' "$run/logs/$target.log" || true
  fi
  minimise "$target"
done

echo "| target | executions | executions/CPU s | CPU s | inputs kept | their bytes, packed | edges |"
echo "|---|---|---|---|---|---|---|"
for target in "${targets[@]}"; do table_row "$target"; done
ls "$run/crashes"
exit $failed
