#!/bin/sh
# No fused multiply-add in the compiled library, though the processor has it and the vendor's flags ask for it: the
# disassembly of the archive and of the unity build holds none.
#
#   sh tools/port/check_fma.sh        ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh
want_build_tools
want_command g++ g++
want_command clang++ clang
install_missing || exit 1
out=build/port/fma
mkdir -p "$out"

# x86, AArch64 and RISC-V, 32-bit ARM, z/Architecture
fused='[[:space:]](vfn?m(add|sub)(add|sub)?[0-9a-z]*|fn?m(add|sub)(\.d|\.s)?|fml[as]|vfn?m[as](\.f(32|64))?|m[as][de]br?)[[:space:]]'

# fused_in FILE OBJDUMP
fused_in() {
  "$2" -d "$1" | grep -cE "$fused"
}

verdict() {
  if [ "$2" = yes ]; then
    passed=$((passed + 1))
    echo "ok  $1"
  else
    failed=$((failed + 1))
    echo "BAD $1"
  fi
}

printf 'double f(double a, double b, double c) { return a * b + c; }\n' >"$out/sample.cpp"

# look NAME COMPILER OBJDUMP FLAGS: the unity build has none; the sample, compiled alike, has one.
look() {
  # shellcheck disable=SC2086  # a list of flags
  if ! $2 -std=c++17 $4 -c "$out/sample.cpp" -o "$out/sample.o" ||
    ! $2 -std=c++17 $4 -Iinclude -Isrc -c src/isolod.cpp -o "$out/unity.o"; then
    verdict "$1 compiles" no
    return
  fi
  verdict "$1: found where it is" "$([ "$(fused_in "$out/sample.o" "$3")" -gt 0 ] && echo yes)"
  count="$(fused_in "$out/unity.o" "$3")"
  verdict "$1: $count fused instructions in the unity build" "$([ "$count" -eq 0 ] && echo yes)"
}

cmake -S . -B "$out/archive" -G Ninja -DCMAKE_BUILD_TYPE=Release -DISOLOD_TESTS=OFF -DISOLOD_TOOLS=OFF \
  -DCMAKE_CXX_COMPILER=g++ -DCMAKE_CXX_FLAGS=-march=haswell >"$out/log" 2>&1 &&
  cmake --build "$out/archive" -j "$(jobs_here)" >>"$out/log" 2>&1 || tail "$out/log"
count="$(fused_in "$out/archive/libisolod.a" objdump)"
verdict "g++ haswell: $count fused instructions in the archive" \
  "$([ -s "$out/archive/libisolod.a" ] && [ "$count" -eq 0 ] && echo yes)"

while IFS='|' read -r name compiler objdump flags <&3; do
  if command -v "$compiler" >/dev/null 2>&1; then
    look "$name" "$compiler" "$objdump" "$flags"
  else
    echo "--  $name: no $compiler here"
  fi
done 3<<EOT
g++ haswell|g++|objdump|-O3 -march=haswell -ffp-contract=fast
g++ avx512|g++|objdump|-O3 -march=skylake-avx512 -ffp-contract=fast
clang++ haswell|clang++|objdump|-O3 -march=haswell -ffp-contract=fast
clang++ avx512|clang++|objdump|-O3 -march=skylake-avx512 -ffp-contract=fast
aarch64|aarch64-linux-gnu-g++|aarch64-linux-gnu-objdump|-O3 -ffp-contract=fast
armhf cortex-a72|arm-linux-gnueabihf-g++|arm-linux-gnueabihf-objdump|-O3 -mcpu=cortex-a72 -ffp-contract=fast
cortex-m7|arm-none-eabi-g++|arm-none-eabi-objdump|-O2 -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard
EOT

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
