#!/bin/sh
# The board's demo, on an emulated Cortex-M7: a shape of 2,000 vertices to levels of 500 and 125, in 2 MB of static
# memory, without a heap. Says the hashes, the peak, the stack, the instructions and the size of the code.
#
#   sh tools/port/board_demo.sh        ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh
want_build_tools
want_command arm-none-eabi-g++ "gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib libnewlib-arm-none-eabi"
want_command qemu-system-arm qemu-system-arm
install_missing || exit 1
out=build/port
mkdir -p "$out"

# build FOLDER FLAGS [OPTION...]
build() {
  folder="$out/$1"
  flags="$2"
  shift 2
  cmake -S tools/port -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=None -DISOLOD_UNITY=ON "-DCMAKE_CXX_FLAGS_NONE=$flags" "$@" \
    >"$folder.log" 2>&1 && cmake --build "$folder" --target demo >>"$folder.log" 2>&1 && return
  tail "$folder.log"
  exit 1
}
build demo-native -O2
build demo-cortex-m7 -Os "-DCMAKE_TOOLCHAIN_FILE=$PWD/tools/port/cmake/cortex-m7.cmake"

sh "$out/demo-native/run_demo" >"$out/demo-native.out"
# shellcheck disable=SC2046  # a command of several words
timeout 600 $(sed 's/^exec //; s/ -kernel/ -icount shift=0 -kernel/' "$out/demo-cortex-m7/run_demo") \
  </dev/null >"$out/demo-cortex-m7.out" 2>&1
cat "$out/demo-cortex-m7.out"

# Code and constants of the whole program, and of the library's part of it.
text="$(arm-none-eabi-size "$out/demo-cortex-m7/demo" | awk 'NR == 2 { print $1 }')"
echo "code and constants: $text bytes, of which the library's $(arm-none-eabi-nm -S -C "$out/demo-cortex-m7/demo" |
  awk '/isolod::v1::/ && $3 ~ /[tTrRwWvV]/ { n = $2; v = 0
         for (i = 1; i <= length(n); ++i) v = 16 * v + index("0123456789abcdef", substr(n, i, 1)) - 1
         total += v } END { print total }')"

# check NAME CONDITION...
check() {
  name="$1"
  shift
  if "$@"; then
    passed=$((passed + 1))
    echo "ok  $name"
  else
    failed=$((failed + 1))
    echo "BAD $name"
  fi
}
number() {
  sed -n "s/^$1: //p" "$out/demo-cortex-m7.out"
}
grep -E '^hash' "$out/demo-native.out" >"$out/demo-native.hashes"
grep -E '^hash' "$out/demo-cortex-m7.out" >"$out/demo-cortex-m7.hashes"
check "both levels came out" [ "$(number vertices | tr '\n' ' ')" = "500 125 " ]
check "the hashes are those of x86-64" cmp -s "$out/demo-native.hashes" "$out/demo-cortex-m7.hashes"
check "code and constants under 200 KB" [ "${text:-999999}" -lt 204800 ]
check "instructions are counted" [ "$(number instructions)" -gt 1000000 ]

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
