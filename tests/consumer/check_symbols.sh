#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A shared library exports its public functions and nothing else: no internals, no instances of other
# libraries' templates. Usage: check_symbols.sh LIBRARY
set -euo pipefail
symbols=$(nm -DC --defined-only "$1" | cut -c20-)
grep -q '^umbrix::Scene::commit(' <<<"$symbols" || { echo "$1 does not export the tracer"; exit 1; }
if grep -vE '^umbrix::' <<<"$symbols" || grep -E 'umbrix::(detail|N_)|::Impl\b' <<<"$symbols"; then
  echo "$1 exports the above, which no public header declares"
  exit 1
fi
