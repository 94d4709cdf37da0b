# shellcheck shell=sh
# What the scripts share. Sourced with `. tools/common.sh` from the project's top folder, in any POSIX shell.

missing_packages=""

# want_command COMMAND PACKAGE: the Debian package is needed where the command is not there.
want_command() {
  command -v "$1" >/dev/null 2>&1 || missing_packages="$missing_packages $2"
}

# want_header HEADER PACKAGE
want_header() {
  for folder in /usr/include /usr/local/include; do
    [ -e "$folder/$1" ] && return 0
  done
  missing_packages="$missing_packages $2"
}

want_build_tools() {
  want_command c++ g++
  want_command cmake cmake
  want_command ninja ninja-build
}

# Installs what was found missing, and nothing else. Asks for nothing.
install_missing() {
  [ -n "$missing_packages" ] || return 0
  if ! command -v apt-get >/dev/null 2>&1; then
    echo "please install what these Debian packages hold:$missing_packages" >&2
    return 1
  fi
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null 2>&1; then
      echo "please run as root: apt-get install$missing_packages" >&2
      return 1
    fi
    as_root="sudo"
  fi
  echo "installing:$missing_packages"
  # shellcheck disable=SC2086  # both are lists of words
  {
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing_packages \
      >/dev/null 2>&1 ||
      { $as_root apt-get update -qq &&
        $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing_packages; }
  } || return 1
  missing_packages=""
}

# How many things to compile at a time.
jobs_here() {
  nproc 2>/dev/null || echo 2
}

# build_preset PRESET TARGET...: configures and builds; the log is shown only where that fails.
build_preset() {
  preset="$1"
  shift
  mkdir -p build
  echo "building: $preset"
  if ! cmake --preset "$preset" >"build/$preset.log" 2>&1 ||
    ! cmake --build "build/$preset" -j "$(jobs_here)" --target "$@" >>"build/$preset.log" 2>&1; then
    tail -n 60 "build/$preset.log" >&2
    echo "the build failed; all of it is in build/$preset.log" >&2
    return 1
  fi
}

# build_program [TARGET...]: the optimised program alone, without tests, as $isolod; or these targets.
build_program() {
  [ $# -gt 0 ] || set -- isolod_cli
  mkdir -p build
  echo "building: the program"
  if ! cmake -S . -B build/program -G Ninja -DISOLOD_TESTS=OFF >build/program.log 2>&1 ||
    ! cmake --build build/program -j "$(jobs_here)" --target "$@" >>build/program.log 2>&1; then
    tail -n 60 build/program.log >&2
    echo "the build failed; all of it is in build/program.log" >&2
    return 1
  fi
  # shellcheck disable=SC2034  # for whoever sources this
  isolod=build/program/tools/isolod/isolod
}

# good NAME, bad NAME: one thing that was checked.
passed=0
failed=0
good() {
  passed=$((passed + 1))
  echo "ok  $1"
}
bad() {
  failed=$((failed + 1))
  echo "BAD $1"
}

# no_findings NAME FILE: good where the file of findings is empty.
no_findings() {
  if [ -s "$2" ]; then
    bad "$1"
    sed 's/^/      /' "$2"
  else
    good "$1"
  fi
}

# add_counts FILE: adds the last line `N passed, N failed` of a log to $passed and $failed; without one, a failure.
add_counts() {
  line="$(grep -E '^[0-9]+ passed, [0-9]+ failed$' "$1" | tail -n 1)"
  if [ -z "$line" ]; then
    failed=$((failed + 1))
    return
  fi
  # shellcheck disable=SC2086  # the line is a list of words
  set -- $line
  passed=$((passed + $1))
  failed=$((failed + $3))
}
