#!/bin/sh
# One result whatever the compiler, its optimisation and the way of building, on real models: the bits of ten, from those
# native targets of tools/port that differ most. The golden cases, on every target, are tools/port/run.sh.
#
#   sh tools/check_bits.sh [--vertices N] [--models FOLDER]
#
# Where hashes differ, the first stage that differs is named. Ends with `N passed, N failed`.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

vertices=2000
folder=../shared/models/good
while [ $# -gt 0 ]; do
  case "$1" in
    --vertices) vertices="${2:?}"; shift 2 ;;
    --models) folder="${2:?}"; shift 2 ;;
    *) echo "usage: sh tools/check_bits.sh [--vertices N] [--models FOLDER]" >&2; exit 2 ;;
  esac
done

want_build_tools
want_command g++ g++
want_command clang++ clang
install_missing || exit 1
out=build/bits
mkdir -p "$out"

# build NAME COMPILER UNITY FLAGS; in one build of each compiler warnings are errors
build() {
  strict=OFF
  case "$1" in gcc-O2 | x86-64-clang--O0) strict=ON ;; esac
  cmake -S . -B "$out/$1" -G Ninja -DISOLOD_WERROR="$strict" -DISOLOD_TESTS=OFF -DISOLOD_UNITY="$3" -DCMAKE_CXX_COMPILER="$2" \
    -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="$4" >"$out/$1.log" 2>&1 &&
    cmake --build "$out/$1" -j "$(jobs_here)" --target isolod_cli >>"$out/$1.log" 2>&1 && return 0
  grep -vE '^\[[0-9]+/[0-9]+\]' "$out/$1.log" | tail -n 20 | cut -c1-300
  bad "$1 does not build"
  return 1
}

# remesh VARIANT MODEL_FILE OPTIONS RESULT: the result, and its stages as `name hash` lines beside it.
remesh() {
  # shellcheck disable=SC2086  # a list of options
  "$out/$1/tools/isolod/isolod" remesh "$2" --vertices "$vertices" $3 --quiet --report "$4.json" -o "$4.off" 2>"$4.err" ||
    { cat "$4.err"; return 1; }
  awk -F'"' '$2 == "name" { name = $4 } $2 == "hash" { print name, $4 } $2 == "result_hash" { result = $4 }
             END { print "result", result }' "$4.json" >"$4.stages"
}

# same NAME RESULT_A RESULT_B
same() {
  if cmp -s "$2.off" "$3.off" && cmp -s "$2.stages" "$3.stages"; then
    good "$1"
  else
    bad "$1: first difference: $(diff "$2.stages" "$3.stages" | sed -n 's/^> //p' | head -n 1)"
  fi
}

reference=gcc-O2
build "$reference" g++ OFF -O2 || exit 1

# The models: ten, made ones where there are no others. A line: file, options.
made="$out/made"
mkdir -p "$made"
for shape in sphere torus knot bracket head plate lattice; do
  "$out/$reference/tools/isolod/isolod" make "$shape" --triangles 6000 -o "$made/$shape.off" >/dev/null || exit 1
done
{
  echo "$made/torus.off"
  echo "$made/bracket.off --features 40"
  echo "$made/head.off --gamma 1 --smooth 5"
  echo "$made/plate.off --fit"
  echo "$made/lattice.off"
  if [ -e "$folder/cgal-fandisk.off" ]; then
    echo "$folder/cgal-fandisk.off --features 40"
    echo "$folder/cgal-mushroom.off"
    echo "$folder/cgal-blobby_3cc.off"
    echo "$folder/cgal-elephant.off --gamma 2"
    echo "$folder/gpjs-kitten.obj"
  else
    echo "$made/sphere.off"
    echo "$made/knot.off"
    echo "$made/bracket.off"
    echo "$made/torus.off --centroids exact"
    echo "$made/sphere.off --gamma 1"
  fi
} >"$out/models"

# run_all VARIANT RUN: every model, results in a folder of that name.
run_all() {
  mkdir -p "$out/$2"
  number=0
  while read -r model options; do
    number=$((number + 1))
    remesh "$1" "$model" "$options" "$out/$2/$number" || bad "$2: $model $options: no result"
  done <"$out/models"
}

# compare_all RUN
compare_all() {
  number=0
  while read -r model options; do
    number=$((number + 1))
    if [ -e "$out/$1/$number.stages" ] && [ -e "$out/reference/$number.stages" ]; then
      same "$1: $(basename "$model")${options:+ $options}" "$out/reference/$number" "$out/$1/$number"
    fi
  done <"$out/models"
}

rm -rf "${out:?}"/reference "${out:?}"/run-*
run_all "$reference" reference
run_all "$reference" run-again
compare_all run-again

while IFS='|' read -r name _ compiler flags _ <&3; do
  # shellcheck disable=SC2086,SC2116  # takes the spaces off
  name="$(echo $name | tr ' ' '-')" compiler="$(echo $compiler)"
  build "$name" "$compiler" ON "$flags" || continue
  run_all "$name" "run-$name"
  compare_all "run-$name"
done 3<<EOT
$(grep -E '^x86-64 (gcc -O0|gcc -O3 native|clang -O0|clang -O3 native) *[|]' tools/port/targets.txt)
EOT

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
