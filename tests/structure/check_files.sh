#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every source file names its licence in the first two lines and is short enough to hold one idea.
set -euo pipefail
find include src apps bench scenes tests cmake scripts .ci CMakeLists.txt -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.sh' -o -name '*.cmake' -o -name '*.in' -o -name CMakeLists.txt -o -path .ci/run \) |
  sort | xargs awk '
FNR == 1 { files++; licensed[FILENAME] = 0 }
FNR <= 2 && /SPDX-License-Identifier: Apache-2\.0$/ { licensed[FILENAME] = 1 }
FNR == 401 { print FILENAME ": over 400 lines"; bad++ }
END {
  for (file in licensed) if (!licensed[file]) { print file ": no SPDX line at the top"; bad++ }
  if (files == 0) { print "found no files to check"; bad++ }
  exit bad > 0
}'
