#!/bin/sh
# Draws the figures of the paper that show a result, one SVG each, and prints the stage times beside the paper's.
#
#   sh tools/figures.sh [NUMBER...]      into build/figures; without numbers all of them and the table
#
# The models are those of ../shared/models beside the project where they are there, and made shapes otherwise.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

want_build_tools
install_missing || exit 1
build_program isolod_cli isolod_figures || exit 1
figures=build/program/tools/figures/isolod_figures
out=build/figures
models=../shared/models/good
mkdir -p "$out"

# model FILE SHAPE TRIANGLES: the path of a shared model, or of a made shape that stands in for it.
model() {
  if [ -e "$models/$1" ]; then
    echo "$models/$1"
    return
  fi
  made="$out/$2-$3.obj"
  [ -e "$made" ] || "$isolod" make "$2" --triangles "$3" -o "$made" >/dev/null || exit 1
  echo "$made"
}

wanted=" $* "
failures=0

# figure NUMBER OPTION...: draws it unless others were asked for.
figure() {
  number="$1"
  shift
  case "$wanted" in
  "  " | *" $number "*) ;;
  *) return ;;
  esac
  file="$out/figure_$(printf %02d "$number").svg"
  if "$figures" "$number" "$@" -o "$file"; then
    echo "  $file"
  else
    failures=$((failures + 1))
  fi
}

mushroom="$(model cgal-mushroom.off head 4600)"
rotor="$(model cgal-rotor_small.off torus 4800)"
pig="$(model vhacd-pig.off plate 3600)"
anchor="$(model cgal-anchor.off bracket 20000)"
fandisk="$(model cgal-fandisk.off bracket 13000)"
ear=""
[ ! -e "$models/vhacd-pig.off" ] || ear="--closeup=-0.25,-0.03,-0.35"
torus="$(model no-file torus 3000)"
head="$(model no-file head 50000)"
open_fandisk="$fandisk"
if [ -e "$models/cgal-fandisk.off" ]; then
  open_fandisk="$out/fandisk-open.obj"
  "$isolod" cut "$fandisk" --plane 0,1,0,0.2555 -o "$open_fandisk" >/dev/null || exit 1
fi

echo "figures:"
figure 1 "$anchor" --vertices 5000 --features 40
figure 3 "$fandisk" --beside "$rotor" --features 40
figure 5 "$mushroom"
figure 6 "$torus" --vertices 1000
figure 8 "$head" --vertices 3000
figure 9 "$open_fandisk" --vertices 3000 --features 40
figure 10 "$mushroom" --vertices 400
figure 11 "$mushroom" --vertices 3000
figure 12 "$open_fandisk" --vertices 3000 --features 40
figure 13 "$head" --vertices 25000 --lloyd 100
figure 14 "$head" --vertices 50000
figure 15 "$head" --vertices 30000
figure 16 "$open_fandisk" --vertices 10000 --features 40 --lloyd 20
figure 17 "$rotor" --vertices 10000 --features 40
# shellcheck disable=SC2086  # one word or none
figure 18 "$pig" --vertices 15000 $ear
# shellcheck disable=SC2086
figure 19 "$pig" --vertices 30000 --gamma 3 $ear
figure 20 "$mushroom" --vertices 3000
[ "$wanted" = "  " ] || exit "$((failures > 0))"

# row NAME MODEL VERTICES: one row of the table, from the report of a run with 100 iterations. The exponent 0 makes the
# density uniform and has the curvature computed all the same.
row() {
  "$isolod" remesh "$2" --vertices "$3" --gamma 0 --lloyd 100 --quiet --report "$out/times.json" -o "$out/times.obj" || return
  awk -v model="$1" -v vertices="$3" '
    /"name": /    { gsub(/[",]/, ""); name = $2 }
    /"seconds": / { gsub(/[",]/, ""); if (name != "") seconds[name] = $2; name = "" }
    END {
      printf "%-22s %8d %10.2f %10.3f %10.4f %10.4f %10.2f\n", model, vertices, seconds["atlas"], seconds["density"],
        seconds["calibrate"], seconds["lines"] + seconds["diffuse"], seconds["charts"] + seconds["levels"]
    }' "$out/times.json"
}

echo
echo "seconds of each part, 100 iterations of Lloyd in the first mesh:"
printf '%-22s %8s %10s %10s %10s %10s %10s\n' model vertices parameters differ. calibrate diffuse Lloyd
row mushroom "$mushroom" 3000
row mushroom "$mushroom" 25000
row "made head, 25,000" "$head" 25000
row "made head, 25,000" "$head" 50000
printf '%-22s %8s %10s %10s %10s %10s %10s\n' 'paper (1 GHz P. III)' 50000 7 0.4 0.85 2.8 1560
exit "$((failures > 0))"
