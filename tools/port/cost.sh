#!/bin/sh
# What equal bits cost: this library against the same sources with fused instructions, vectorisation and all that this
# machine's processor has. Prints CSV; `other_over_isolod_cpu` below 1 is what is given away.
#
#   sh tools/port/cost.sh FILE [VERTICES]
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh
file="${1:?usage: sh tools/port/cost.sh FILE [VERTICES]}"
want_build_tools
install_missing || exit 1
out=build/port/cost
rm -rf "$out"
mkdir -p "$out/free"
build_program isolod_cli isolod_bench || exit 1

# The free copy: without its guards, its flags, and the check that would refuse to run.
cp -r CMakeLists.txt include src tools "$out/free/"
sed -i -e '/^#pragma [SG]/d' "$out/free/src/base/config.h"
sed -i -e '/check_arithmetic());/d' "$out/free/src/pipeline/remesher.cpp"
sed -i -e 's/-ffp-contract=off -fno-fast-math -fno-math-errno/-march=native -ffp-contract=fast -fno-math-errno/' \
  -e 's/>:-fno-tree-vectorize>/>:-ftree-vectorize>/' "$out/free/CMakeLists.txt"
if ! cmake -S "$out/free" -B "$out/build" -G Ninja -DISOLOD_TESTS=OFF >"$out/build.log" 2>&1 ||
  ! cmake --build "$out/build" -j "$(jobs_here)" --target isolod_cli >>"$out/build.log" 2>&1; then
  tail -n 20 "$out/build.log"
  exit 1
fi
objdump -d "$out/build/libisolod.a" | grep -cE 'vfn?m(add|sub)' | sed 's/^/fused instructions in the free copy: /' >&2
build/program/tools/bench/isolod_bench "$file" --vertices "${2:-10000}" --repeat 9 --isolod "$isolod" \
  --against "$out/build/tools/isolod/isolod remesh {in} --vertices {n} --quiet -o {out}"
