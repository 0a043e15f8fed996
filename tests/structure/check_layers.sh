#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Dependencies point one way (docs/architecture.md). Each layer below lists the layers its files may include and
# the outside libraries it may use; anything else is printed and fails the check.
set -euo pipefail

# layer      may include                         outside libraries (first folder or file of the include)
rules='
public       public                              -
public_io    public,public_io                    -
core         public,core                         tbb,glm,boost,hwy
tree         public,core,tree                    tbb,glm,boost,hwy
index        public,core,tree,index              tbb,glm,boost,hwy
kernels      public,core,tree,index,kernels      tbb,glm,boost,hwy
frame        public,core,tree,index,kernels,frame  tbb,glm,boost,hwy
scene        public,core,tree,index,kernels,frame,scene  tbb,glm,boost,hwy
io           public,public_io,io                 tiny_gltf.h,tinygltf,OpenImageIO,nlohmann,fmt,glm,tbb,xxhash.h,draco,meshoptimizer.h,stb_image.h,stb_image_write.h
render       public,public_io,render             tbb,glm,fmt,nlohmann
apps         public,public_io,render,apps        CLI,fmt,nlohmann,tbb,glm
bench        public,public_io,render,bench,core,tree,index,kernels  CLI,fmt,nlohmann,tbb,glm,hwy,embree3,embree4,boost,cairo.h,librsvg
'

find include src apps bench -name '*.h' -o -name '*.cpp' | sort | xargs awk -v rules="$rules" '
# The layer a path belongs to, whether it is a file of the repository or the text of an #include.
function layer_of(path) {
  sub(/^src\//, "", path)
  if (path ~ /^(include\/)?umbrix\/io\//) return "public_io"
  if (path ~ /^(include\/)?umbrix\//) return "public"
  if (path ~ /^(scene|version)[a-z_]*\.(cpp|h)$/) return "scene"
  sub(/\/.*/, "", path)
  return path
}
# Whether a name that names no layer is a file beside the one that includes it, or above it.
function is_near(file, name,    line, found) {
  while (!found && sub(/\/[^\/]*$/, "", file)) {
    found = (getline line < (file "/" name)) >= 0
    close(file "/" name)
  }
  return found
}
BEGIN {
  count = split(rules, rows, "\n")
  for (i = 1; i <= count; i++) {
    if (split(rows[i], row) != 3) continue
    known[row[1]] = 1
    n = split(row[2], names, ",")
    for (j = 1; j <= n; j++) inside[row[1], names[j]] = 1
    n = split(row[3], names, ",")
    for (j = 1; j <= n; j++) outside[row[1], names[j]] = 1
  }
}
FNR == 1 {
  layer = layer_of(FILENAME)
  files++
  if (!(layer in known)) { print FILENAME ": belongs to no layer"; bad++ }
}
/^[ \t]*#[ \t]*include[ \t]*["<]/ {
  name = $0
  sub(/^[^"<]*["<]/, "", name)
  sub(/[">].*/, "", name)
  if (name !~ /[\/.]/) next  # the C++ standard library
  if (layer !~ /^public/ && name ~ /^(immintrin|xmmintrin|unistd|fcntl|semaphore|signal|sched|time|malloc)\.h$|^sys\//) next  # the system
  includes++
  wanted = layer_of(name)
  if (wanted in known) allowed = (layer, wanted) in inside
  else allowed = (layer, wanted) in outside || is_near(FILENAME, name)
  if (!allowed) { print FILENAME ":" FNR ": " layer " must not include " name; bad++ }
}
END {
  if (files == 0 || includes == 0) { print "found no files to check"; bad++ }
  exit bad > 0
}'
