#!/bin/sh
# Every way to have the library in a program of one's own, each with a small program that remeshes a mesh and compares the
# hash with that of the command line. The programs and projects are in tests/vendor/.
#
#   sh tools/check_vendor.sh        ends with `N passed, N failed`
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

[ $# -eq 0 ] || { echo "usage: sh tools/check_vendor.sh" >&2; exit 2; }
want_build_tools
want_command g++ g++
want_command gcc gcc
want_command clang++ clang
want_command pkg-config pkg-config
want_command python3 python3
install_missing || exit 1
here="$(pwd)"
out="$here/build/vendor"
ways="$here/tests/vendor"
rm -rf "$out"
mkdir -p "$out"

# --- what all have to give: the result of the ordinary build
build_program || exit 1
mesh="$here/tests/golden/sphere_40.off"
hash="$("$isolod" remesh "$mesh" --vertices 60 --quiet --hash -o "$out/result.off" | cut -d ' ' -f 1)"
case "$hash" in
  ????????????????) echo "wished: $hash" ;;
  *) echo "the command line gave no hash" >&2; exit 1 ;;
esac
wrong="0000000000000000"

# step NAME COMMAND...: a step on the way; its output is shown only where it fails.
step() {
  name="$1"
  shift
  "$@" >"$out/step.log" 2>&1 && return 0
  bad "$name: $*"
  tail -n 30 "$out/step.log" | cut -c1-300
  return 1
}

# proves NAME COMMAND...: gives the wished hash, and does not take another for it.
proves() {
  name="$1"
  shift
  step "$name" "$@" "$mesh" "$hash" || return 1
  if "$@" "$mesh" "$wrong" >/dev/null 2>&1; then bad "$name: takes any hash"; else good "$name"; fi
}

# empty NAME FILE: nothing was found.
empty() {
  if [ -s "$2" ]; then
    bad "$1"
    head -n 20 "$2" | sed 's/^/      /'
  else
    good "$1"
  fi
}

# project NAME WAY OPTIONS...: configures and builds a project of tests/vendor.
project() {
  name="$1" way="$2"
  shift 2
  step "$name" cmake -S "$ways/$way" -B "$out/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" &&
    step "$name" cmake --build "$out/$name" -j "$(jobs_here)"
}

# own_flags NAME: the library's flags stay with the library.
own_flags() {
  grep '"command".*/tests/vendor/' "$out/$1/compile_commands.json" |
    grep -E -- '-ffp-contract|-fno-math-errno|-fno-exceptions|-fno-rtti|-fvisibility|-Wshadow' >"$out/found"
  empty "$1: the program keeps its own flags" "$out/found"
}

# --- inside the build of a program
for way in add_subdirectory fetch_content; do
  project "$way" "$way" -DISOLOD_FOLDER="$here" -DISOLOD_UNITY=ON &&
    proves "$way" "$out/$way/program" && own_flags "$way"
done

# --- installed: the tree is moved before it is used
major="$(sed -n 's/^#define ISOLOD_VERSION_MAJOR //p' include/isolod/version.h)"
minor="$(sed -n 's/^#define ISOLOD_VERSION_MINOR //p' include/isolod/version.h)"
step "shared library" cmake -S . -B "$out/shared" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
  -DISOLOD_UNITY=ON -DISOLOD_WERROR=ON && step "shared library" cmake --build "$out/shared" -j "$(jobs_here)"
for kind in static shared; do
  folder="$out/shared"
  [ "$kind" = shared ] || folder=build/program
  step "install $kind" cmake --install "$folder" --prefix "$out/first-$kind" || continue
  mv "$out/first-$kind" "$out/tree-$kind"
  project "find_package-$kind" find_package -DCMAKE_PREFIX_PATH="$out/tree-$kind" -DISOLOD_WANTED="$major.$minor" &&
    proves "find_package, $kind" "$out/find_package-$kind/program" && own_flags "find_package-$kind"
  project "find_package-c-$kind" c99 -DCMAKE_PREFIX_PATH="$out/tree-$kind" -DISOLOD_WANTED="$major.$minor" &&
    proves "find_package from C alone, $kind" "$out/find_package-c-$kind/program"
  export PKG_CONFIG_PATH="$out/tree-$kind/lib/pkgconfig"
  # shellcheck disable=SC2046  # lists of flags
  step "pkg-config, $kind" g++ -std=c++17 -O1 -Wall -Wextra -Werror -DVENDOR_WITH_IO "$ways/main.cpp" \
    -o "$out/pkg-config-$kind" -Wl,-rpath,"$out/tree-$kind/lib" $(pkg-config --cflags --libs isolod-io) &&
    proves "pkg-config, $kind" "$out/pkg-config-$kind"
  for compiler in gcc clang; do
    # The C compiler links it: nothing of C++ is needed.
    # shellcheck disable=SC2046
    step "C99, $kind, $compiler" $compiler -std=c99 -O1 -Wall -Wextra -Wconversion -Wshadow -pedantic -Werror \
      "$ways/c99/main.c" -o "$out/c99-$kind-$compiler" -Wl,-rpath,"$out/tree-$kind/lib" \
      $(pkg-config --cflags --libs isolod) && proves "C99, $kind, $compiler" "$out/c99-$kind-$compiler"
  done
done
if cmake -S "$ways/find_package" -B "$out/too-new" -DCMAKE_PREFIX_PATH="$out/tree-static" \
  -DISOLOD_WANTED="$((major + 1)).0" >"$out/step.log" 2>&1; then
  bad "find_package of a later major version finds this one"
else
  good "find_package refuses another major version"
fi
proves "Python's ctypes" python3 "$ways/python/main.py" "$out/tree-shared/lib/libisolod.so"

# shows LIBRARY HEADER...: exactly the functions that these headers mark are exported, found by name.
shows() {
  library="$out/tree-shared/lib/$1"
  shift
  sed -n 's/^.*ISOLOD_API \([^(]*\)(.*$/\1/p' "$@" | sed 's/.*[ *&]//' | sort -u >"$out/marked"
  nm -D --defined-only "$library" | awk '{ print $3 }' | sed 's/@.*//' >"$out/symbols"
  c++filt <"$out/symbols" | sed 's/(.*//; s/.*:://' | sort -u >"$out/exported"
  diff "$out/marked" "$out/exported" >"$out/found"
  empty "$(basename "$library") shows its $(wc -l <"$out/symbols") public symbols and no others" "$out/found"
}
set --
for header in include/isolod/*.h; do
  case "$header" in */io.h | */api.h) ;; *) set -- "$@" "$header" ;; esac
done
shows libisolod.so "$@"
shows libisolod_io.so include/isolod/io.h

# --- one file: src/isolod.cpp with the headers of include/ and src/, under the flags of another project
copied="$out/copied"
mkdir -p "$copied"
cp -r include src "$copied"
rm -rf "$copied/src/io"
strict="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Werror -fno-exceptions -fno-rtti -fvisibility=hidden -fPIC"
while read -r compiler standard level; do
  name="one-file-$compiler-$standard"
  # shellcheck disable=SC2086  # a list of flags
  step "$name" "$compiler" "-std=$standard" "$level" $strict -I"$copied/include" -I"$copied/src" -c \
    "$copied/src/isolod.cpp" -o "$out/$name.o" &&
    step "$name" "$compiler" "-std=$standard" "$level" $strict -I"$copied/include" "$ways/main.cpp" "$out/$name.o" \
      -o "$out/$name" && proves "one file, $compiler, $standard, $level" "$out/$name"
done <<EOT
g++ c++17 -O2
g++ c++20 -O1
g++ c++2b -O0
clang++ c++17 -O0
clang++ c++20 -O1
clang++ c++2b -O2
EOT
step "hidden" g++ -shared "$out/one-file-g++-c++17.o" -o "$out/libgame.so"
nm -D --defined-only "$out/libgame.so" >"$out/found"
empty "a shared library that holds the one file shows nothing of it" "$out/found"

# --- two versions in one program: another namespace in C++, another prefix in C
other="$out/other"
mkdir -p "$other"
cp -r include src "$other"
find "$other" -type f -exec sed -i 's/inline namespace v1 {/inline namespace v2 {/; s/isolod::v1::/isolod::v2::/g' {} +
sed -i 's/^#define ISOLOD_OUTPUT_VERSION .*/#define ISOLOD_OUTPUT_VERSION 1000/' "$other/include/isolod/version.h"
sed -i 's/0x243f6a8885a308d3U/0x13198a2e03707344U/' "$other/src/base/hash.h"
for copy in first second; do
  root="$copied" prefix=""
  [ "$copy" = first ] || { root="$other" prefix="-DISOLOD_C_PREFIX=second_"; }
  # shellcheck disable=SC2086
  step "two versions" g++ -std=c++17 -O1 $prefix -I"$root/include" -I"$root/src" -c "$root/src/isolod.cpp" \
    -o "$out/$copy.o" &&
    step "two versions" g++ -std=c++17 -O1 $prefix -DCOPY=$copy -I"$root/include" -c "$ways/two_versions/copy.cpp" \
      -o "$out/copy-$copy.o"
done
step "two versions" g++ -std=c++17 -O1 "$ways/two_versions/main.cpp" "$out/first.o" "$out/second.o" \
  "$out/copy-first.o" "$out/copy-second.o" -o "$out/two-versions" && proves "two versions" "$out/two-versions"
for copy in first second; do nm -g --defined-only "$out/$copy.o" | awk '{ print $3 }' | sort -u >"$out/$copy.symbols"; done
# The C++ run time's own mark of exceptions, in a build with them, is shared by all.
comm -12 "$out/first.symbols" "$out/second.symbols" | grep -v '^DW\.ref\.' >"$out/found"
empty "two versions share no symbol" "$out/found"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
