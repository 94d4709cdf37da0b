#!/bin/sh
# Builds isolod and runs all of its tests, on a fresh Debian machine as anywhere: what is missing is installed first.
#
#   sh tools/test.sh            everything: an optimised build, and one under the address and undefined-behaviour checkers
#   sh tools/test.sh --quick    the optimised build alone
#
# The last line is `N passed, N failed`; the exit code is 0 when none failed.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

quick=no
for word in "$@"; do
  case "$word" in
    --quick) quick=yes ;;
    *) echo "usage: sh tools/test.sh [--quick]" >&2; exit 2 ;;
  esac
done

# run_unit_tests PRESET: adds the cases of one build's test program to $passed and $failed.
run_unit_tests() {
  log="build/$1-tests.log"
  echo "testing: $1"
  "build/$1/tests/isolod_tests" --no-colors=true >"$log" 2>&1
  code=$?
  cases="$(sed -n 's/^.*test cases:[^|]*|\([^|]*\) passed |\([^|]*\) failed.*$/\1 \2/p' "$log" | tail -n 1)"
  if [ -z "$cases" ]; then
    tail -n 60 "$log"
    echo "the test program of $1 did not come to its end (exit code $code)"
    failed=$((failed + 1))
    return
  fi
  # shellcheck disable=SC2086  # two numbers
  set -- $cases
  passed=$((passed + $1))
  failed=$((failed + $2))
  if [ "$code" -ne 0 ]; then
    cat "$log"
    [ "$2" -ne 0 ] || failed=$((failed + 1))
  fi
}

# run_script NAME COMMAND...: adds the closing line of a script.
run_script() {
  log="build/$1.log"
  echo "testing: $1"
  shift
  "$@" >"$log" 2>&1 || grep -v '^ok ' "$log"
  add_counts "$log"
}

test_build() {
  if ! build_preset "$1" isolod_tests isolod_cli isolod_figures; then
    failed=$((failed + 1))
    return
  fi
  run_unit_tests "$1"
  run_script "$1-cli" sh tools/check_cli.sh "build/$1/tools/isolod/isolod"
  run_script "$1-figures" sh tools/check_figures.sh "build/$1/tools/isolod/isolod" \
    "build/$1/tools/figures/isolod_figures"
}

want_build_tools
want_header doctest/doctest.h doctest-dev
want_command python3 python3
install_missing || exit 1

test_build release
[ "$quick" = yes ] || test_build sanitize

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
