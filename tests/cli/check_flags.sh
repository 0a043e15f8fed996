#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every flag that --help shows is used by a test of the program. Usage: check_flags.sh PROGRAM TESTS_FOLDER
set -euo pipefail
program=$1 tests=$2
untested=0 checked=0
for command in '' render merge compare info kernels; do
  for flag in $("$program" $command --help | grep -oE '^ +(-[a-zA-Z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+' | sort -u); do
    checked=$((checked + 1))
    grep -rqE --include='*.cpp' "\"$flag[\"=]" "$tests/cli" "$tests/faults" && continue
    echo "umbrix $command $flag: no test uses it"
    untested=$((untested + 1))
  done
done
echo "$checked flags"
[ "$checked" -gt 40 ] && [ "$untested" -eq 0 ]
