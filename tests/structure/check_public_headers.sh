#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A public header compiles alone, in plain C++17 and without a warning.
set -euo pipefail
headers=$(cd include && find umbrix -name '*.h' | sort)
[ -n "$headers" ]
for header in $headers; do
  printf '#include <%s>\n' "$header" | "${CXX:-c++}" -x c++ -std=c++17 -fsyntax-only -Iinclude \
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wold-style-cast -Werror -
done
