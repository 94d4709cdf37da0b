#!/bin/sh
# The golden cases on every target: builds the library and the golden program for it, runs that, by an emulator where it
# has to, and compares each stage's bits. Installs what a target needs.
#
#   sh tools/port/run.sh [--ci SECONDS] [--table] [TARGET...]      targets as tools/port/targets.txt names them
#
# Without a target: all. --ci: the first five, and others as long as the seconds last. --table: the results of this and
# earlier runs as the README's table. Ends with `N passed, N failed`.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tools/common.sh

seconds=""
table=""
while [ $# -gt 0 ]; do
  case "$1" in
    --ci) seconds="${2:?}"; shift 2 ;;
    --table) table=yes; shift ;;
    -*) echo "usage: sh tools/port/run.sh [--ci SECONDS] [--table] [TARGET...]" >&2; exit 2 ;;
    *) break ;;
  esac
done
out=build/port
mkdir -p "$out"
always=5
export NODE_PATH=/usr/share/nodejs  # where Debian keeps what emscripten needs

# A line of the list into its five columns.
split_target() {
  name="$(trim "$1")" toolchain="$(trim "$2")" compiler="$(trim "$3")" flags="$(trim "$4")" options="$(trim "$5")"
}
trim() {
  # shellcheck disable=SC2086  # takes the spaces off both ends
  set -- $1
  echo "$*"
}

# want_target TOOLCHAIN COMPILER FLAGS: what it needs, and $compiler where the toolchain file names it.
want_target() {
  want_build_tools
  case "$1" in
    native) want_command "$2" "$(case "$2" in clang++) echo clang ;; *) echo g++ ;; esac)" ;;
    aarch64) compiler=aarch64-linux-gnu-g++ ;;
    armhf) compiler=arm-linux-gnueabihf-g++ ;;
    riscv64 | s390x) compiler="$1-linux-gnu-g++" ;;
    cortex-*) compiler=arm-none-eabi-g++ ;;
    mingw) compiler=x86_64-w64-mingw32-g++ ;;
    wasm) compiler=em++ ;;
  esac
  case "$1" in
    aarch64 | riscv64 | s390x) want_command "$compiler" "g++-$1-linux-gnu" ; want_command "qemu-$1" qemu-user ;;
    armhf) want_command "$compiler" g++-arm-linux-gnueabihf; want_command qemu-arm qemu-user ;;
    cortex-*)
      want_command "$compiler" "gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib libnewlib-arm-none-eabi"
      want_command qemu-system-arm qemu-system-arm
      ;;
    mingw) want_command "$compiler" g++-mingw-w64-x86-64; want_command /usr/lib/wine/wine64 wine64 ;;
    wasm) want_command "$compiler" emscripten; want_command node nodejs ;;
  esac
  case "$3" in
    *-m32*) [ -e /usr/lib/gcc/x86_64-linux-gnu/12/32 ] || want_command no-32-bit-libraries g++-12-multilib ;;
    *libc++*) want_header ../lib/llvm-14/include/c++/v1/vector "libc++-dev libc++abi-dev" ;;
  esac
  case "$2 $3" in
    clang*sanitize*) want_header ../lib/llvm-14/lib/clang/14.0.6/lib/linux libclang-rt-14-dev ;;
    clang*flto*) want_command ld.lld lld ;;
  esac
}

# build_target FOLDER: the golden program.
build_target() {
  set -- "$1" -DCMAKE_BUILD_TYPE=None "-DCMAKE_CXX_FLAGS_NONE=$flags"
  folder="$1"
  shift
  case "$toolchain" in
    native) set -- "$@" "-DCMAKE_CXX_COMPILER=$compiler" ;;
    *) set -- "$@" "-DCMAKE_TOOLCHAIN_FILE=$PWD/tools/port/cmake/$toolchain.cmake" ;;
  esac
  case "$compiler $flags" in
    clang*flto*) set -- "$@" -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld -DCMAKE_AR=/usr/bin/llvm-ar -DCMAKE_RANLIB=/usr/bin/llvm-ranlib ;;
  esac
  # shellcheck disable=SC2086  # a list of options
  cmake -S tools/port -B "$folder" -G Ninja -DISOLOD_UNITY=ON "$@" $options >"$folder.log" 2>&1 &&
    cmake --build "$folder" -j "$(jobs_here)" --target golden >>"$folder.log" 2>&1
}

now() { date +%s.%N; }

# run_target: builds and runs one, and leaves a row of the table.
run_target() {
  want_target "$toolchain" "$compiler" "$flags"
  install_missing || { missing_packages=""; echo "BAD $name: cannot be installed"; failed=$((failed + 1)); return; }
  folder="$out/$(echo "$name" | tr ' +' '_p')"
  rm -f "$folder.row"
  if ! build_target "$folder"; then
    grep -vE '^\[[0-9]+/[0-9]+\]' "$folder.log" | tail -n 20 | cut -c1-300
    echo "BAD $name: does not build"
    failed=$((failed + 1))
    return
  fi
  start="$(now)"
  WINEDEBUG=-all WINEPREFIX="$PWD/$out/wine" timeout 600 sh "$folder/run_golden" 2>&1 </dev/null |
    tr -d '\r' >"$folder.out"
  took="$(echo "$start $(now)" | awk '{ printf "%.1f", $2 - $1 }')"
  add_counts "$folder.out"
  cases="$(grep -cE '^ok ' "$folder.out")"
  if grep -qE '^[1-9][0-9]* passed, 0 failed$' "$folder.out"; then
    agree=yes
    echo "ok  $name: $cases results agree, $took s"
  else
    agree=no
    grep -vE '^ok ' "$folder.out" | tail -n 12
    echo "BAD $name"
  fi
  version="$("$compiler" --version | sed -n '1 { s/.*) //; s/.* version //; p }' | grep -oE '[0-9]+(\.[0-9]+)*' | head -n 1)"
  echo "| $name | $(echo "$compiler" | sed 's/-g++$/ g++/') $version | \`$flags\` | $agree | $took |" >"$folder.row"
}

# is_wanted NAME: among the arguments, if there are any.
is_wanted() {
  wanted="$1"
  shift
  [ $# -gt 0 ] || return 0
  for word in "$@"; do
    [ "$word" != "$wanted" ] || return 0
  done
  return 1
}

begun="$(date +%s)"
number=0
left_out=""
targets="$(grep -v '^#' tools/port/targets.txt)"
while IFS='|' read -r a b c d e <&3; do
  split_target "$a" "$b" "$c" "$d" "$e"
  number=$((number + 1))
  is_wanted "$name" "$@" || continue
  if [ -n "$seconds" ] && [ "$number" -gt "$always" ] && [ $(($(date +%s) - begun)) -ge "$seconds" ]; then
    left_out="$left_out, $name"
    continue
  fi
  run_target
done 3<<EOT
$targets
EOT
[ -z "$left_out" ] || echo "no time left for: ${left_out#, }"

if [ -n "$table" ]; then
  echo "| target | compiler | flags | golden hashes agree | seconds |"
  echo "|---|---|---|---|---|"
  while IFS='|' read -r a b <&3; do
    row="$out/$(trim "$a" | tr ' +' '_p').row"
    [ ! -e "$row" ] || cat "$row"
  done 3<<EOT
$targets
EOT
fi

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
