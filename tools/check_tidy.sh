#!/bin/sh
# clang-tidy over the library and the tools, by the checks of .clang-tidy: names, likely mistakes, needless copies.
#
#   sh tools/check_tidy.sh [FILE...]        all of src/, include/ and tools/, or the files given
#
# Each file, header or source, passes where nothing was found in it. Ends with `N passed, N failed`.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

for file in "$@"; do
  case "$file" in
    -*) echo "usage: sh tools/check_tidy.sh [FILE...]" >&2; exit 2 ;;
  esac
  [ -e "$file" ] || { echo "$file: no such file" >&2; exit 2; }
done

want_build_tools
want_command clang-tidy clang-tidy
install_missing || exit 1
out=build/tidy
rm -rf "$out/found"
mkdir -p "$out/found"

# The database of how each file is compiled; nothing is built.
if ! cmake -S . -B "$out/database" -G Ninja -DISOLOD_TESTS=OFF -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$out/cmake.log" 2>&1; then
  cat "$out/cmake.log" >&2
  exit 1
fi

# Headers are looked at through the sources that include them. The unity file only includes the others; what is built for
# other machines is a project of its own.
if [ $# -gt 0 ]; then
  printf '%s\n' "$@" | sort -u
else
  find src include tools \( -name '*.h' -o -name '*.cpp' \) ! -path src/isolod.cpp ! -path 'tools/port/*' | sort
fi >"$out/files"
grep '\.cpp$' "$out/files" >"$out/sources"

echo "$(clang-tidy --version | sed -n 's/.*version \([0-9.]*\).*/clang-tidy \1/p'), $(wc -l <"$out/sources") sources"
# A compiler whose default is C++17 gets no option for it in the database; clang may have another default.
# shellcheck disable=SC2016  # for the inner shell
xargs -n 1 -P "$(jobs_here)" sh -c '
  name="$(echo "$2" | tr / _)"
  clang-tidy -p "$1/database" --quiet --extra-arg-before=-std=c++17 --warnings-as-errors="*" "$2" \
    >"$1/found/$name.out" 2>"$1/found/$name.err" && exit 0
  # What it could not say of a place in a file is a finding in the source.
  grep -q ": error: " "$1/found/$name.out" || { echo "$2: clang-tidy failed"; tail -n 5 "$1/found/$name.err"; } >"$1/found/$name.bad"
  exit 0
' tidy "$out" <"$out/sources"

# Findings as `file:line:column: ...` from the top folder, once each however many sources include the header.
here="$(pwd -P)/"
cat "$out/found"/*.out | awk -v here="$here" '
  index($0, here) == 1 { $0 = substr($0, length(here) + 1) }
  /: (error|warning): / && !seen[$0]++' | sort >"$out/findings"

while read -r file; do
  name="$(echo "$file" | tr / _)"
  awk -v file="$file:" 'index($0, file) == 1' "$out/findings" >"$out/of_file"
  [ ! -e "$out/found/$name.bad" ] || cat "$out/found/$name.bad" >>"$out/of_file"
  if [ -s "$out/of_file" ]; then
    failed=$((failed + 1))
    echo "BAD $file"
    sed 's/^/      /' "$out/of_file"
  else
    passed=$((passed + 1))
    echo "ok  $file"
  fi
done <"$out/files"

# A finding in a file that is not in the list must not be lost.
awk 'NR == FNR { listed[$0] = 1; next } { split($0, part, ":") } !(part[1] in listed)' "$out/files" "$out/findings" \
  >"$out/elsewhere"
if [ -s "$out/elsewhere" ]; then
  failed=$((failed + 1))
  echo "BAD elsewhere"
  sed 's/^/      /' "$out/elsewhere"
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
