#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# docs/features.md names each file of tests/scenes/features and no other; each extension that src/io supports is in it,
# and used by one of the files.
set -euo pipefail
page=docs/features.md folder=tests/scenes/features
named=$(grep -oE '`[A-Za-z ]+\.(gltf|glb)`' "$page" | tr -d '`' | sort)
there=$(find "$folder" -name '*.gltf' -o -name '*.glb' | sed 's|.*/||' | sort)
[ "$named" = "$there" ] || { diff <(echo "$named") <(echo "$there") | sed "s|^[<>]|$page and $folder differ: &|"; exit 1; }

extensions=$({ sed -n '/kSupported\[\]/,/;/p' src/io/gltf_json_rules.cpp; cat src/io/gltf_compression.h; } |
  grep -oE '"(KHR|EXT)_[a-z_]+"' | tr -d '"' | sort -u)
[ "$(wc -l <<<"$extensions")" -ge 10 ] || { echo "found too few extensions in src/io"; exit 1; }
bad=0
for extension in $extensions; do
  grep -q "^| .*\`$extension\`" "$page" || { echo "$page: $extension is in no table"; bad=1; }
  grep -rq "\"$extension\"" "$folder" || { echo "$folder: no file uses $extension"; bad=1; }
done
exit $bad
