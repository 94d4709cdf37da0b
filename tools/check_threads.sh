#!/bin/sh
# The caller's threads: the same bits for any number of them, and no data race, by a build under the thread checker.
#
#   sh tools/check_threads.sh [--speed FILE]      ends with `N passed, N failed`
#
# --speed: instead, what two threads gain over one on that file, at three numbers of vertices; medians of five runs each,
# taken in turn.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh
want_build_tools
install_missing || exit 1

if [ "${1:-}" = --speed ]; then
  file="${2:?}"
  build_program isolod_cli isolod_bench || exit 1
  header=""
  for vertices in 5000 10000 40000; do
    # shellcheck disable=SC2086  # one word or none
    build/program/tools/bench/isolod_bench "$file" --vertices "$vertices" --isolod "$isolod" --repeat 5 $header \
      --against "$isolod remesh {in} --vertices {n} --quiet --threads 2 -o {out}"
    header=--no-header
  done
  exit
fi

out=build/threads
mkdir -p "$out"
echo "building: the program under the thread checker"
if ! cmake -S . -B "$out/build" -G Ninja -DISOLOD_TESTS=OFF -DISOLOD_UNITY=ON -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_CXX_FLAGS="-O1 -g -fsanitize=thread" >"$out/build.log" 2>&1 ||
  ! cmake --build "$out/build" -j "$(jobs_here)" --target isolod_cli >>"$out/build.log" 2>&1; then
  tail -n 40 "$out/build.log"
  exit 1
fi
isolod="$out/build/tools/isolod/isolod"

# The checker itself must find a race.
cat >"$out/race.cpp" <<'EOT'
#include <thread>
int main() {
  int n = 0;
  std::thread other([&] { ++n; });
  ++n;
  other.join();
  return n - 2;
}
EOT
c++ -O1 -g -fsanitize=thread -pthread "$out/race.cpp" -o "$out/race"
if "$out/race" >"$out/race.log" 2>&1 || ! grep -q 'data race' "$out/race.log"; then
  bad "a race is found"
else
  good "a race is found"
fi

# hash_of SHAPE THREADS OPTIONS: prints it; what the checker says is in $out/run.log.
hash_of() {
  # shellcheck disable=SC2086  # a list of options
  "$isolod" remesh "$out/$1.obj" --vertices 3000 $3 --threads "$2" --hash --quiet -o "$out/result.obj" 2>"$out/run.log" |
    sed 's/ .*//'
}

while read -r shape options; do
  "$isolod" make "$shape" --triangles 4000 -o "$out/$shape.obj" >/dev/null
  alone="$(hash_of "$shape" 1 "$options")"
  for threads in 2 3 8; do
    found="$(hash_of "$shape" "$threads" "$options")"
    if [ -s "$out/run.log" ]; then
      bad "$shape $options, $threads threads"
      head -n 30 "$out/run.log"
    elif [ "${#alone}" -eq 16 ] && [ "$found" = "$alone" ]; then
      good "$shape $options, $threads threads: $found"
    else
      bad "$shape $options: $found with $threads threads, $alone with one"
    fi
  done
done <<'EOT'
head
bracket --features 30
torus --gamma 1
plate --fit
EOT
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
