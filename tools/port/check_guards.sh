#!/bin/sh
# Builds that would compute other bits. What the compiler tells of does not compile, and the message says what to change;
# what it does not tell of is found by self_test when the program runs.
#
#   sh tools/port/check_guards.sh        ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh
want_build_tools
want_command g++ g++
want_command clang++ clang
install_missing || exit 1
out=build/port/guards
rm -rf "$out"
mkdir -p "$out"

good() {
  passed=$((passed + 1))
  echo "ok  $1"
}
bad() {
  failed=$((failed + 1))
  echo "BAD $1"
}

# refused COMPILER FLAGS REMEDY
refused() {
  # shellcheck disable=SC2086  # a list of flags
  if "$1" -std=c++17 $2 -Iinclude -Isrc -fsyntax-only src/base/check_arithmetic.cpp 2>"$out/message"; then
    bad "$1 $2 compiles"
  elif grep -F 'isolod: ' "$out/message" | grep -qF -e "$3"; then
    good "$1 $2 does not compile, and the message names $3"
  else
    bad "$1 $2 does not compile, but no message names $3"
    head -n 5 "$out/message"
  fi
}

for compiler in g++ clang++; do
  refused "$compiler" -ffast-math -ffast-math
  refused "$compiler" -Ofast -Ofast
  refused "$compiler" "-O2 -ffinite-math-only" -ffinite-math-only
done
refused g++ -funsafe-math-optimizations -funsafe-math-optimizations
refused g++ -freciprocal-math -freciprocal-math
refused g++ -mfpmath=387 "-msse2 -mfpmath=sse"

# The rest is tried on copies whose guards are taken out, by a program that names the fault it finds.
mkdir -p "$out/bare/src"
cp -r include "$out/bare/"
cp -r src/base "$out/bare/src/"
sed -i -e '/^#error/d' -e '/^static_assert(FLT_EVAL_METHOD/d' -e '/^#pragma [SG]/d' "$out/bare/src/base/config.h"
cat >"$out/main.cpp" <<'EOT'
#include <cstdio>

#include "isolod/self_test.h"

int main() {
  const auto fault = [](isolod::TestedMode mode) {
    return isolod::name(static_cast<isolod::ArithmeticFault>(isolod::self_test(mode).value));
  };
  std::printf("%s %s\n", fault(isolod::TestedMode::as_found), fault(isolod::TestedMode::as_in_calls));
}
EOT

# found NAME FOLDER WANTED RUN COMPILER FLAGS [LINK_FLAGS]: what self_test says, in the thread's mode and in calls.
found() {
  objects=""
  for source in "$2/src/base/check_arithmetic.cpp" "$2/src/base/environment.cpp" "$2/src/base/fail.cpp" "$out/main.cpp"; do
    object="$out/$(basename "$source").o"
    # shellcheck disable=SC2086  # lists of flags
    $5 -std=c++17 $6 -I"$2/include" -I"$2/src" -c "$source" -o "$object" || { bad "$1: does not compile"; return; }
    objects="$objects $object"
  done
  # shellcheck disable=SC2086
  $5 $6 ${7:-} $objects -o "$out/program" || { bad "$1: does not link"; return; }
  said="$($4 "$out/program")"
  if [ "$said" = "$3" ]; then good "$1: $said"; else bad "$1: $said instead of $3"; fi
}

found "g++, nothing wrong" . "none none" "" g++ -O2
found "g++, guards at work against contraction" . "none none" "" g++ "-O3 -march=native -ffp-contract=fast"
found "g++, denormals flushed by the start of the program" . "flush_to_zero none" "" g++ -O2 -ffast-math
found "without guards, g++ reassociates" "$out/bare" "reassociation reassociation" "" g++ \
  "-O2 -fassociative-math -fno-signed-zeros -fno-trapping-math"
found "without guards, clang++ reassociates" "$out/bare" "reassociation reassociation" "" clang++ "-O2 -ffast-math -fhonor-nans"
found "without guards, x87 keeps more bits" "$out/bare" "excess_precision excess_precision" "" g++ "-O2 -mfpmath=387"
if grep -qw fma /proc/cpuinfo; then
  found "without guards, g++ contracts" "$out/bare" "contraction contraction" "" g++ "-O2 -mfma"
  found "clang++ contracts against the pragma, and is found out" . "contraction contraction" "" clang++ \
    "-O2 -mfma -ffp-contract=fast"
fi
if command -v aarch64-linux-gnu-g++ >/dev/null 2>&1 && command -v qemu-aarch64 >/dev/null 2>&1; then
  found "aarch64, guards at work" . "none none" qemu-aarch64 aarch64-linux-gnu-g++ -O3 -static
  found "without guards, aarch64 contracts" "$out/bare" "contraction contraction" qemu-aarch64 aarch64-linux-gnu-g++ -O2 \
    -static
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
