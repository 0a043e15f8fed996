#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs components of a build into an empty prefix and compares the list of files with the manifest.
# Usage: check_manifest.sh MANIFEST LIBDIR BUILD PREFIX static|shared COMPONENT...
set -euo pipefail
manifest=$1 libdir=$2 build=$3 prefix=$4 kind=$5
shift 5

rm -rf "$prefix"
pattern=
for component; do
  cmake --install "$build" --prefix "$prefix" --component "umbrix_$component" >/dev/null
  pattern+="${pattern:+|}$component|$component-$kind"
done

# A manifest line is "COMPONENT PATH" or "COMPONENT-KIND PATH"; LIBDIR stands for lib, lib64, ..., CONFIG for the build type.
expected=$(awk -v wanted="^($pattern)$" -v libdir="$libdir" '$1 ~ wanted {sub("^LIBDIR", libdir, $2); print $2}' "$manifest")
diff <(sort <<<"$expected") <(cd "$prefix" && find . ! -type d -printf '%P\n' | sed 's/-targets-[a-z]*\.cmake$/-targets-CONFIG.cmake/' | sort) ||
  { echo "installed files (>) differ from $manifest (<)"; exit 1; }
