#!/bin/sh
# Shows what isolod does, on a fresh Debian machine as anywhere: installs what is missing, builds, makes two shapes,
# remeshes both to 10,000 vertices, and leaves meshes, reports and pictures in build/demo.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

want_build_tools
install_missing || exit 1
build_program || exit 1
out=build/demo
mkdir -p "$out"

# demo SHAPE TRIANGLES OPTION...
demo() {
  shape="$1"
  triangles="$2"
  shift 2
  echo
  echo "$shape:"
  "$isolod" make "$shape" --triangles "$triangles" -o "$out/$shape.obj" || exit
  "$isolod" remesh "$out/$shape.obj" --vertices 10000 "$@" --report "$out/$shape-10000.json" \
    --pictures "$out/$shape" -o "$out/$shape-10000.obj" || exit
  "$isolod" compare "$out/$shape.obj" "$out/$shape-10000.obj" || exit
}

demo bracket 4000 --features 40
demo head 40000

echo
echo "All of it is in $(pwd)/$out:"
for file in "$out"/*.obj "$out"/*.json "$out"/*/*.svg; do
  [ ! -e "$file" ] || echo "  $file"
done
