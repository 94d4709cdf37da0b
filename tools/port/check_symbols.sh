#!/bin/sh
# What the compiled library asks of a system: memory copies, and nothing else. No heap, exceptions, type information,
# printing, locale or threads; and it keeps no state. Of the archive and of the unity build.
#
#   sh tools/port/check_symbols.sh        ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh
want_build_tools
want_command g++ g++
want_command clang++ clang
install_missing || exit 1
out=build/port/symbols
mkdir -p "$out"

# asked_of FILE: what an object or archive refers to and does not define itself.
asked_of() {
  nm "$1" | awk 'NF == 2 && $1 == "U" { wanted[$2] = 1 } NF == 3 { defined[$3] = 1 }
                 END { for (name in wanted) if (!(name in defined)) print name }' | sort
}

# Memory copies; the table that position-independent code goes by; a distribution's guard of the stack; a root where it
# is not compiled into an instruction.
allowed='^(memcpy|memmove|memset|memcmp|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail|sqrt)$'

look_at() {
  if [ ! -s "$2" ]; then
    echo "there is no $2" >"$out/found"
  else
    asked_of "$2" | grep -vE "$allowed" >"$out/found"
  fi
  no_findings "$1 asks for nothing but memory copies" "$out/found"
  nm -C "$2" 2>/dev/null | grep -E '^[0-9a-f]+ [bBdDcCsS] ' >"$out/found"
  no_findings "$1 keeps no state" "$out/found"
}

# The look itself must find what it is for.
cat >"$out/sample.cpp" <<'EOT'
#include <cstdio>
#include <thread>
int calls = 0;
int f(int n) { try { std::printf("%d", *new int(n)); std::thread([] {}).join(); throw ++calls; } catch (int) { return 1; } }
EOT
g++ -std=c++17 -c "$out/sample.cpp" -o "$out/sample.o"
asked_of "$out/sample.o" | grep -vE "$allowed" >"$out/found"
for symbol in _Znwm printf __cxa_throw _ZTIi __gxx_personality_v0 _ZNSt6thread; do
  grep -q "$symbol" "$out/found" || echo "$symbol is not found where it is" >>"$out/missed"
done
nm "$out/sample.o" | grep -qE ' [bB] calls$' || echo "a variable is not found" >>"$out/missed"
touch "$out/missed"
no_findings "a heap, exceptions, printing, threads and state are found where they are" "$out/missed"
rm -f "$out/missed"

cmake -S . -B "$out/archive" -G Ninja -DCMAKE_BUILD_TYPE=Release -DISOLOD_TESTS=OFF -DISOLOD_TOOLS=OFF \
  -DCMAKE_CXX_FLAGS=-fno-pie >"$out/log" 2>&1 &&
  cmake --build "$out/archive" -j "$(jobs_here)" >>"$out/log" 2>&1 || tail "$out/log"
look_at "the archive" "$out/archive/libisolod.a"

while IFS='|' read -r compiler flags <&3; do
  # shellcheck disable=SC2086  # a list of flags
  $compiler -std=c++17 -fno-pie $flags -Iinclude -Isrc -c src/isolod.cpp -o "$out/unity.o" || rm -f "$out/unity.o"
  look_at "the unity build, $compiler $flags," "$out/unity.o"
done 3<<EOT
g++|-O2 -fno-exceptions -fno-rtti -fno-math-errno
clang++|-O2 -fno-exceptions -fno-rtti
g++|-O1 -fno-exceptions -fno-rtti
g++|-O0 -fno-exceptions -fno-rtti
EOT

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
