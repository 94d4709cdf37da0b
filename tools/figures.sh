#!/bin/sh
# Draws the figures of the paper that show a result, one SVG each, and prints the stage times beside the paper's.
#
#   sh tools/figures.sh [NUMBER...]      into build/figures; without numbers all of them and the table
#
# The models are those of ../shared/models beside the project where they are there, and made shapes otherwise. What
# looks at the map of a whole surface is drawn with --paper, the paper's own way; the others say in their titles which
# way was taken.
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
round="$(model cgal-rotor_small.off plate 3600)"
anchor="$(model cgal-anchor.off bracket 20000)"
fandisk="$(model cgal-fandisk.off bracket 13000)"
ear="--closeup=-0.25,-0.03,-0.35"
torus="$(model no-file torus 3000)"
eight="$(model cgal-eight.off lattice 6000)"
# The neck is cut off, so that the head is a disk as the paper's is; about 25,000 vertices are left.
head="$out/head-open.obj"
"$isolod" cut "$(model no-file head 52000)" --plane 0,0,-1,1.15 -o "$head" >/dev/null || exit 1
pig="$models/vhacd-pig.off"
if [ ! -e "$pig" ]; then
  # A head without its neck and the tips of its ears has three boundaries.
  pig="$out/head-without-ears.obj"
  "$isolod" cut "$(model no-file head 6000)" --plane 0,0,-1,1.15 -o "$out/cut-1.obj" >/dev/null &&
    "$isolod" cut "$out/cut-1.obj" --plane 0,1,0,0.9 -o "$out/cut-2.obj" >/dev/null &&
    "$isolod" cut "$out/cut-2.obj" --plane 0,-1,0,0.9 -o "$pig" >/dev/null || exit 1
  ear=""
fi
face="--toward 1,-0.8,0.25 --up 0,0,1"
open_fandisk="$fandisk"
if [ -e "$models/cgal-fandisk.off" ]; then
  open_fandisk="$out/fandisk-open.obj"
  "$isolod" cut "$fandisk" --plane 0,1,0,0.2555 -o "$open_fandisk" >/dev/null || exit 1
fi

echo "figures:"
figure 1 "$anchor" --paper --vertices 5000 --features 40
figure 3 "$fandisk" --beside "$round" --features 40
figure 5 "$mushroom"
figure 6 "$torus" --beside "$eight" --paper --vertices 1000
# shellcheck disable=SC2086  # lists of words
{
  figure 8 "$head" --paper --vertices 3000 $face
  figure 9 "$open_fandisk" --paper --vertices 3000 --features 40
  figure 10 "$mushroom" --paper --vertices 400
  figure 11 "$mushroom" --paper --vertices 3000
  figure 12 "$open_fandisk" --paper --vertices 3000 --features 40
  figure 13 "$head" --paper --vertices 50000
  figure 14 "$head" --paper --vertices 50000 $face
  figure 15 "$head" --vertices 30000 $face
  figure 16 "$open_fandisk" --paper --vertices 10000 --features 40 --lloyd 20
  figure 17 "$rotor" --paper --vertices 10000 --features 40
  figure 18 "$pig" --paper --vertices 15000 $ear
  figure 19 "$pig" --vertices 30000 --gamma 3 $ear
  figure 20 "$mushroom" --paper --vertices 3000
}
[ "$wanted" = "  " ] || exit "$((failures > 0))"

# row NAME MODEL VERTICES OPTION...: one row of the table, from the report of a run. The exponent 0 makes the density
# uniform and has the curvature computed all the same.
row() {
  name="$1" model="$2" vertices="$3"
  shift 3
  "$isolod" remesh "$model" --vertices "$vertices" --gamma 0 "$@" --quiet --report "$out/times.json" \
    -o "$out/times.obj" || return
  awk -v model="$name" -v vertices="$vertices" '
    /"name": /    { gsub(/[",]/, ""); name = $2 }
    /"seconds": / { gsub(/[",]/, ""); if (name != "") seconds[name] = $2; name = "" }
    END {
      printf "%-22s %8d %10.2f %10.4f %10.4f %10.4f %10.2f %10.2f\n", model, vertices, seconds["atlas"],
        seconds["density"], seconds["calibrate"], seconds["lines"] + seconds["diffuse"], seconds["charts"],
        seconds["levels"]
    }' "$out/times.json"
}

# published NAME VERTICES FIGURE...: a row of the paper's own figures.
published() {
  printf '%-22s %8s %10s %10s %10s %10s %10s\n' "$@"
}

echo
echo "seconds of each part; the paper's on a Pentium III of 1 GHz, with 100 iterations:"
printf '%-22s %8s %10s %10s %10s %10s %10s %10s\n' model vertices parameters differ. calibrate diffuse Lloyd levels
published "mushroom, published" 3000 "" "" "" 0.3 55
row "mushroom, --paper" "$mushroom" 3000 --paper
row "mushroom, default" "$mushroom" 3000
published "head, published" 50000 7 0.4 0.85 2.8 1560
row "made head, --paper" "$head" 50000 --paper
row "made head, default" "$head" 50000
exit "$((failures > 0))"
