#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds a program with what pkg-config says about an installed umbrix, and runs it.
# Usage: check_pkg_config.sh COMPILER SOURCE LIBRARY_FOLDER static|shared
set -euo pipefail
compiler=$1 source=$2 libraries=$3 kind=$4
export PKG_CONFIG_PATH=$libraries/pkgconfig

# A user of the shared library must not need the packages that only a static link needs.
if [ "$kind" = static ]; then flags=$(pkg-config --static --cflags --libs umbrix); else
  flags=$(PKG_CONFIG_LIBDIR=$libraries/pkgconfig pkg-config --cflags --libs umbrix)
fi
program=$libraries/pkg_config_consumer
trap 'rm -f "$program"' EXIT
# shellcheck disable=SC2086  # the flags are words
"$compiler" -std=c++17 "$source" -o "$program" $flags -Wl,-rpath,"$libraries"
"$program"
