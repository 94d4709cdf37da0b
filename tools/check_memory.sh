#!/bin/sh
# Checks that runs keep to their memory plans: never more than planned, the plan at most twice what is written, and with
# every smaller block tried a clean failure that names a size that works.
#
#   sh tools/check_memory.sh [--models DIR]   every model of a folder, and made shapes under many options
#   sh tools/check_memory.sh --ci             the made shapes alone, with fewer sizes
#
# The last line is `N passed, N failed`; the exit code is 0 when none failed.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

models=../shared/models/good
ci=no
while [ $# -gt 0 ]; do
  case "$1" in
    --ci) ci=yes ;;
    --models) shift; models="$1" ;;
    *) echo "usage: sh tools/check_memory.sh [--ci] [--models DIR]" >&2; exit 2 ;;
  esac
  shift
done

want_build_tools
install_missing || exit 1
build_program isolod_cli isolod_memory || exit 1
memory=build/program/tools/memory/isolod_memory
work=build/memory
mkdir -p "$work"

# check FILE WORD...: one mesh under some options.
check() {
  case_name="$*"
  if line="$("$memory" "$@" --quiet 2>&1)"; then
    passed=$((passed + 1))
    echo "ok   $case_name: $line"
  else
    failed=$((failed + 1))
    echo "FAIL $case_name"
    echo "$line"
  fi
}

# shape NAME TRIANGLES
shape() {
  "$isolod" make "$1" --triangles "$2" -o "$work/$1-$2.obj" >/dev/null || exit 1
  made="$work/$1-$2.obj"
}

many=300
few=100
[ "$ci" = no ] || many=60 few=25

shape sphere 1280 && check "$made" --vertices 300 --sizes "$many"
shape sphere 20 && check "$made" --vertices 2000 --sizes "$few"
shape head 3000 && check "$made" --vertices 700 --gamma 1.5 --sizes "$few"
check "$made" --vertices 2600,600,120 --sizes "$few"
check "$made" --vertices 500 --atlas single --sizes "$few"
shape bracket 1500 && check "$made" --vertices 600 --features 40 --sizes "$many"
check "$made" --vertices 600 --features 40 --fit --sizes "$few"
check "$made" --vertices 600 --features 40 --paper --sizes "$few"
shape lattice 2000 && check "$made" --vertices 1500 --sizes "$few"
shape plate3 900 && check "$made" --vertices 80 --close-boundaries --sizes "$few"
shape cylinder_open 900 && check "$made" --vertices 200 --keep-seams --centroids exact --sizes "$few"

if [ "$ci" = no ]; then
  for file in "$models"/*; do
    check "$file" --vertices 600 --sizes "$few"
    check "$file" --vertices 2000 --features 40 --gamma 1.5 --sizes 20
    check "$file" --vertices 12000 --sizes 0
  done
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
