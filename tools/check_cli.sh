#!/bin/sh
# What a user of the program `isolod` relies on: exit codes, one-line errors that name the place, nothing half written.
#
#   sh tools/check_cli.sh PATH_TO_ISOLOD        ends with `N passed, N failed`
set -u
[ $# -eq 1 ] || { echo "usage: sh tools/check_cli.sh PATH_TO_ISOLOD" >&2; exit 2; }
isolod="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
work="$(mktemp -d)" || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

passed=0
failed=0
ok() {
  passed=$((passed + 1))
  echo "ok  $1"
}
bad() {
  failed=$((failed + 1))
  echo "BAD $1: $2"
  sed 's/^/      /' errors.txt
}

# runs NAME CODE COMMAND...: the command must end with this code.
runs() {
  name="$1" wanted="$2"
  shift 2
  "$@" >output.txt 2>errors.txt </dev/null
  code=$?
  if [ "$code" -eq "$wanted" ]; then ok "$name"; else bad "$name" "exit code $code, not $wanted"; fi
}

# refuses NAME CODE TEXT COMMAND...: ends with this code and exactly one line of error, which holds the text.
refuses() {
  name="$1" wanted="$2" text="$3"
  shift 3
  "$@" >output.txt 2>errors.txt </dev/null
  code=$?
  if [ "$code" -ne "$wanted" ]; then bad "$name" "exit code $code, not $wanted"
  elif [ "$(wc -l <errors.txt)" -ne 1 ]; then bad "$name" "not one line of error"
  elif ! grep -qF -- "$text" errors.txt; then bad "$name" "the error does not say '$text'"
  elif ! grep -q '^isolod: ' errors.txt; then bad "$name" "the error does not begin with the program's name"
  else ok "$name"; fi
}

# holds NAME COMMAND...: the command must succeed.
holds() {
  name="$1"
  shift
  : >errors.txt
  if "$@" >/dev/null 2>errors.txt; then ok "$name"; else bad "$name" "does not hold: $*"; fi
}

no_leftovers() {
  holds "$1" test -z "$(find . -name '*.part')"
}

# --- help and usage
runs "help" 0 "$isolod" --help
holds "help lists exit codes" grep -q budget_too_small output.txt
runs "version" 0 "$isolod" --version
for command in remesh lods info compare make cut validate; do
  runs "help of $command" 0 "$isolod" $command --help
  refuses "$command refuses an unknown option" 2 "--nonsense" "$isolod" $command --nonsense
  refuses "$command wants its file" 2 "$command" "$isolod" $command
done
refuses "unknown command" 2 "remsh" "$isolod" remsh
refuses "near miss is named" 2 "is --vertices meant" "$isolod" remesh in.obj --vertces 100 -o out.obj
refuses "vertices are required" 2 "--vertices N is missing" "$isolod" remesh in.obj -o out.obj
refuses "output is required" 2 "-o OUT is missing" "$isolod" remesh in.obj --vertices 100
refuses "not a number" 2 "--vertices" "$isolod" remesh in.obj --vertices 10k -o out.obj
refuses "negative count" 2 "--vertices" "$isolod" remesh in.obj --vertices -5 -o out.obj
refuses "count too large" 2 "--vertices" "$isolod" remesh in.obj --vertices 99999999999999999999 -o out.obj
refuses "angle out of range" 2 "--features" "$isolod" remesh in.obj --vertices 100 --features 200 -o out.obj
refuses "unknown choice" 2 "paper" "$isolod" remesh in.obj --vertices 100 --weight papre -o out.obj
refuses "given twice" 2 "--weld" "$isolod" remesh in.obj --weld --weld --vertices 100 -o out.obj
refuses "value missing" 2 "--lloyd" "$isolod" remesh in.obj --vertices 100 --lloyd --weld -o out.obj
refuses "two densities" 2 "--gamma" "$isolod" remesh in.obj --vertices 100 --gamma 1 --density d.txt -o out.obj
refuses "word too many" 2 "b.obj" "$isolod" info a.obj b.obj

# --- made shapes
for shape in sphere torus knot bracket head plate lattice; do
  runs "make $shape" 0 "$isolod" make $shape --triangles 3000 -o $shape.off
  runs "validate $shape" 0 "$isolod" validate $shape.off
done
refuses "unknown shape" 2 "sphere" "$isolod" make shpere -o s.obj
runs "make list" 0 "$isolod" make list

# --- cutting: a torus without its upper half has two borders, and every vertex that is left is used
runs "cut" 0 "$isolod" cut torus.off --plane 0,0,1,0 -o half.obj
runs "info on what was cut" 0 "$isolod" info half.obj
holds "two borders" grep -Eq '^boundary loops +2$' output.txt
whole="$(sed -n '2s/^[0-9]* \([0-9]*\).*/\1/p' torus.off)"
holds "half of the triangles" test "$(grep -c '^f ' half.obj)" -eq $((${whole:-0} / 2))
holds "no vertex without a triangle" test "$(sed -n 's/^f //p' half.obj | tr ' ' '\n' | sort -u | wc -l)" -eq "$(grep -c '^v ' half.obj)"
runs "a plane beside the shape" 0 "$isolod" cut torus.off --plane 0,0,1,100 -o all.off
holds "takes nothing away" cmp torus.off all.off
refuses "a plane with three numbers" 2 "A,B,C,D" "$isolod" cut torus.off --plane 0,0,1 -o x.obj
refuses "a plane without direction" 2 "--plane" "$isolod" cut torus.off --plane 0,0,0,1 -o x.obj
refuses "a cut that leaves nothing" 12 "torus.off: " "$isolod" cut torus.off --plane 0,0,1,-100 -o x.obj
holds "writes nothing" test ! -e x.obj

# --- formats: every one gives the same mesh back
for ending in obj off ply stl; do
  runs "make as $ending" 0 "$isolod" make torus --triangles 800 -o again.$ending
  runs "info on $ending" 0 "$isolod" info again.$ending
  runs "compare with $ending" 0 "$isolod" compare again.obj again.$ending
done
refuses "unknown file type" 22 "out.xyz" "$isolod" make torus -o out.xyz
refuses "glb is read only" 25 "out.glb" "$isolod" make torus -o out.glb

# --- files that are not right
refuses "no such file" 21 "absent.obj: " "$isolod" info absent.obj
refuses "no such folder" 21 "absent/out.obj" "$isolod" make torus -o absent/out.obj
refuses "a folder is no file" 21 "." "$isolod" remesh . --vertices 100 -o out.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n' >broken.obj
refuses "the line is named" 23 "broken.obj: line 4" "$isolod" remesh broken.obj --vertices 100 -o out.obj
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n' >short.off
refuses "a short file" 24 "short.off: " "$isolod" remesh short.off --vertices 100 -o out.obj
printf 'v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n' >nan.obj
refuses "the vertex is named" 15 "nan.obj: vertex 2" "$isolod" remesh nan.obj --vertices 100 -o out.obj
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >flat.obj
refuses "nothing with area" 12 "flat.obj: " "$isolod" remesh flat.obj --vertices 100 -o out.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n' >double.obj
runs "validate finds a doubled triangle" 1 "$isolod" validate double.obj
holds "nothing was written" test ! -e out.obj
no_leftovers "nothing is left behind after errors"

# --- remeshing
runs "remesh" 0 "$isolod" remesh torus.off --vertices 700 --report run.json -o result.obj
holds "exactly so many vertices" test "$(grep -c '^v ' result.obj)" -eq 700
holds "the report names a hash" grep -Eq '"result_hash": "[0-9a-f]{16}"' run.json
runs "the report is JSON" 0 python3 -m json.tool run.json
runs "the result is valid" 0 "$isolod" validate result.obj
runs "the result can be compared" 0 "$isolod" compare torus.off result.obj
runs "the same again" 0 "$isolod" remesh torus.off --vertices 700 -o result2.obj
holds "gives the same bytes" cmp result.obj result2.obj
runs "quiet" 0 "$isolod" remesh torus.off --vertices 700 --quiet -o result2.obj
holds "quiet says nothing" test ! -s output.txt -a ! -s errors.txt
runs "no progress where no terminal is" 0 "$isolod" remesh torus.off --vertices 700 -o result2.obj
holds "no progress was written" test ! -s errors.txt
runs "features" 0 "$isolod" remesh bracket.off --vertices 1500 --features 40 -o result.ply
runs "curvature" 0 "$isolod" remesh head.off --vertices 1500 --gamma 1 --smooth 5 -o result.stl
runs "pictures" 0 "$isolod" remesh bracket.off --vertices 1500 --features 40 --pictures drawn/here -o result.ply
holds "pictures are drawn" test -s drawn/here/1_original.svg -a -s drawn/here/5_result.svg
awk 'NR > 2 && NR <= 2 + n { print 1 + $1 * $1 } NR == 2 { n = $1 }' torus.off >density.txt
runs "given density" 0 "$isolod" remesh torus.off --vertices 700 --density density.txt -o result.off

# chosen WORDS KEY VALUE: these options give a result, and the report says what they chose.
chosen() {
  # shellcheck disable=SC2086  # a list of words
  runs "$1" 0 "$isolod" remesh torus.off --vertices 700 --features 40 $1 --report run.json -o result.off
  holds "the report of $1" grep -Eq "\"$2\": \"?$3\"?,?\$" run.json
}
chosen "--paper" calibration paper
chosen "--paper --fluency tree" fluency tree
chosen "--atlas single" atlas single
chosen "--atlas single --no-fall-back" fall_back_to_charts false
for cut in spine loops short-loops greedy; do chosen "--atlas single --cut $cut" fallen_back 0; done
chosen "--fluency strip" fluency strip
refuses "--fluency region" 27 "torus.off: " "$isolod" remesh torus.off --vertices 700 --fluency region -o x.off
chosen "--calibration paper" calibration paper
chosen "--weight paper" weight paper
chosen "--centroids exact" centroids exact
chosen "--keep-seams --lloyd 3" remove_seams false
chosen "--no-auto-smooth --corner 20" smooth_undersampled false
chosen "--fit" fit true

echo 1 >density.txt
refuses "density of another mesh" 23 "density.txt: " "$isolod" remesh torus.off --vertices 700 --density density.txt -o x.off
printf '1\nthree\n' >words.txt
refuses "density that is no number" 23 "words.txt: line 2" "$isolod" remesh torus.off --vertices 700 --density words.txt -o x.off
awk 'NR == 2 { n = $2 } END { for (i = 0; i < 3 * n; ++i) print 1 + i % 3 }' torus.off >density.txt
runs "density of corners" 0 "$isolod" remesh torus.off --vertices 700 --density density.txt -o result.off
echo -1 >>density.txt
sed -i.old 1d density.txt
refuses "density of a corner that is negative" 16 "triangle" "$isolod" remesh torus.off --vertices 700 --density density.txt -o x.off
"$isolod" make cube --triangles 12 -o cube.obj >output.txt 2>errors.txt
sed -n '/^f /{s/^f //p;q;}' cube.obj | awk '{ print "# one edge\n\n" $1 - 1, $2 - 1, "# and no more" }' >edges.txt
runs "feature edges" 0 "$isolod" remesh cube.obj --vertices 300 --feature-edges edges.txt --report run.json -o result.obj
holds "the edge's ends are corners" grep -Eq '"corners": 2,?$' run.json
few="$(sed -n 's/.*"feature_samples": \([0-9]*\).*/\1/p' run.json)"
sed 's/ # and no more/ 3/' edges.txt >denser.txt
runs "feature edges with a density" 0 "$isolod" remesh cube.obj --vertices 300 --feature-edges denser.txt --report run.json -o result.obj
many="$(sed -n 's/.*"feature_samples": \([0-9]*\).*/\1/p' run.json)"
holds "have more samples" test "${many:-0}" -gt "$((2 * ${few:-1000}))"
refuses "an edge of one vertex" 23 "edges.txt: line 4" sh -c "echo 7 >>edges.txt && '$isolod' remesh cube.obj --vertices 300 --feature-edges edges.txt -o x.off"
refuses "an edge to no vertex" 14 "one.txt: line 1" sh -c "echo 0 99999 >one.txt && '$isolod' remesh cube.obj --vertices 300 --feature-edges one.txt -o x.off"
refuses "an edge by name" 23 "one.txt: line 1" sh -c "echo 0 -1 >one.txt && '$isolod' remesh cube.obj --vertices 300 --feature-edges one.txt -o x.off"
refuses "an edge without density" 16 "one.txt: line 1" sh -c "echo 0 1 0 >one.txt && '$isolod' remesh cube.obj --vertices 300 --feature-edges one.txt -o x.off"
refuses "no such list of edges" 21 "none.txt" "$isolod" remesh cube.obj --vertices 300 --feature-edges none.txt -o x.off
"$isolod" make sphere --triangles 5000 -o sphere.off >output.txt 2>errors.txt
"$isolod" cut sphere.off --plane 0,0,1,0.995 -o open.off >output.txt 2>errors.txt
runs "a hole is kept" 0 "$isolod" remesh open.off --vertices 60 -o result.off
runs "info on it" 0 "$isolod" info result.off
holds "with its border" grep -Eq '^boundary loops +1$' output.txt
runs "a hole closes" 0 "$isolod" remesh open.off --vertices 60 --close-boundaries --report run.json -o result.off
holds "the report says so" grep -Eq '"closed_loops": 1,?$' run.json
runs "info on what was closed" 0 "$isolod" info result.off
holds "no border is left" grep -Eq '^boundary loops +0$' output.txt
refuses "too few vertices" 17 "vertices work" "$isolod" remesh bracket.off --vertices 5 --features 40 -o x.off
works="$(sed -n 's/.*: \([0-9]*\) vertices work.*/\1/p' errors.txt)"
runs "the number that is named works" 0 "$isolod" remesh bracket.off --vertices "${works:-0}" --features 40 -o x.off
refuses "too little memory" 18 "--memory" "$isolod" remesh torus.off --vertices 700 --memory 64K -o y.off
refuses "one less does not" 17 "vertices work" "$isolod" remesh bracket.off --vertices $((${works:-1} - 1)) --features 40 -o y.off
holds "a refused run writes nothing" test ! -e y.off
runs "a plan" 0 "$isolod" plan torus.off --vertices 700
planned="$(sed -n 's/^block *//p' output.txt)"
runs "a plan is enough" 0 "$isolod" remesh torus.off --vertices 700 --memory "$planned" -o y.off
runs "a plan for levels" 0 "$isolod" plan torus.off --vertices 700,50
planned="$(sed -n 's/^block *//p' output.txt)"
runs "a plan for levels is enough" 0 "$isolod" lods torus.off --vertices 700,50 --memory "$planned" -o planned.obj
refuses "a plan without vertices" 2 "--vertices" "$isolod" plan torus.off
runs "memory as said" 0 "$isolod" remesh torus.off --vertices 700 --memory 256M --report run.json -o y.off
holds "the block is exactly that" grep -Eq '"block_bytes": 268435456,?$' run.json
refuses "too little memory again" 18 "--memory" "$isolod" remesh torus.off --vertices 700 --memory 200K -o x.off
enough="$(sed -n 's/.*: --memory \([0-9]*\) would do.*/\1/p' errors.txt)"
runs "the memory that is named is enough" 0 "$isolod" remesh torus.off --vertices 700 --memory "${enough:-0}" --report run.json -o x.off
holds "and is the block" grep -Eq "\"block_bytes\": ${enough:-none},?\$" run.json
holds "the result is the same" cmp x.off y.off
used="$(sed -n 's/.*"arena_bytes": \([0-9]*\),*/\1/p' run.json | sort -n | tail -n 1)"
holds "no more of it was used" test "${used:-0}" -gt 0 -a "${used:-0}" -le "${enough:-0}"
refuses "memory of no size" 2 "--memory" "$isolod" remesh torus.off --vertices 700 --memory 0 -o x.off
refuses "memory in no unit" 2 "--memory" "$isolod" remesh torus.off --vertices 700 --memory 3T -o x.off
refuses "validate in too little memory" 18 "torus.off: " "$isolod" validate torus.off --memory 2K
enough="$(sed -n 's/.*: --memory \([0-9]*\) would do.*/\1/p' errors.txt)"
runs "validate in what is named" 0 "$isolod" validate torus.off --memory "${enough:-0}"

# --- hashes: a line "hash  file", the same for the same mesh whatever its file
hash_of() { sed -n 's/^\([0-9a-f]\{16\}\)  [^ ]*$/\1/p' output.txt; }
runs "hash" 0 "$isolod" remesh torus.off --vertices 700 --quiet --hash --report run.json -o y.off
hash="$(hash_of)"
holds "is one line, with the file" test "$(cat output.txt)" = "$hash  y.off"
result_hash="$hash"
holds "is that of the report" grep -q "\"result_hash\": \"${hash:-none}\"" run.json
holds "the report tells the output version" grep -Eq '"output_version": [1-9][0-9]*,' run.json
runs "nothing cut away" 0 "$isolod" cut y.off --plane 0,0,1,100 --hash -o y.ply
holds "is the same hash" test "$(hash_of)" = "$hash"
runs "hash of another result" 0 "$isolod" remesh torus.off --vertices 701 --quiet --hash -o y.off
holds "is another" test "$(hash_of)" != "$hash"
runs "hash of a made shape" 0 "$isolod" make torus --triangles 3000 --hash -o y.obj
hash="$(hash_of)"
runs "hash of the same from its file" 0 "$isolod" cut y.obj --plane 0,0,1,100 --hash -o y.off
holds "is the same hash" test "$(hash_of)" = "$hash"
echo precious >kept.obj
refuses "a failed run" 15 "vertex 2" "$isolod" remesh nan.obj --vertices 100 -o kept.obj
holds "leaves the old file" grep -q precious kept.obj
ln -s real.obj link.obj
runs "through a link" 0 "$isolod" remesh torus.off --vertices 700 --quiet -o link.obj
holds "the link stays" test -L link.obj -a -s real.obj
runs "levels of detail" 0 "$isolod" lods torus.off --vertices 200,700,50 -o level.obj
holds "a line for each" test "$(grep -c '^level-[0-9]*\.obj: [0-9]* vertices, [0-9]* triangles$' output.txt)" -eq 3
holds "and one for all, with the time" grep -Eq '^torus\.off: 3 levels of detail, [0-9.]+ s, ' output.txt
for count in 700 200 50; do
  holds "a file of $count" test "$(grep -c '^v ' level-$count.obj)" -eq $count
  runs "validate it" 0 "$isolod" validate level-$count.obj
done
runs "levels with their hashes" 0 "$isolod" lods torus.off --vertices 200,700,50 --quiet --hash -o level.obj
holds "a line for each level" test "$(grep -c '^[0-9a-f]\{16\}  level-[0-9]*\.obj$' output.txt)" -eq 3 -a "$(wc -l <output.txt)" -eq 3
holds "the finest is the one mesh" grep -qx "$result_hash  level-700.obj" output.txt
runs "one mesh of the finest" 0 "$isolod" remesh torus.off --vertices 700 --quiet -o alone.obj
holds "is the same" cmp alone.obj level-700.obj
mkdir v1.5
runs "levels in a folder with a dot, fitted" 0 "$isolod" lods torus.off --vertices 300,60 --fit --ascii --quiet -o v1.5/fit.ply
holds "are there" test -s v1.5/fit-300.ply -a -s v1.5/fit-60.ply
holds "quiet says nothing" test ! -s output.txt
refuses "a level twice" 2 "200 is given twice" "$isolod" lods torus.off --vertices 200,700,200 -o x.obj
refuses "a list with a gap" 2 "--vertices" "$isolod" lods torus.off --vertices 200,,50 -o x.obj
refuses "levels with seams" 2 "--keep-seams" "$isolod" lods torus.off --vertices 200,50 --keep-seams -o x.obj
refuses "levels of a file type that is none" 22 "x.xyz" "$isolod" lods torus.off --vertices 200,50 -o x.xyz
refuses "a level that is too small" 17 "vertices work" "$isolod" lods torus.off --vertices 700,3 -o few.obj
works="$(sed -n 's/.*: \([0-9]*\) vertices work.*/\1/p' errors.txt)"
holds "no level is written then" test ! -e few-700.obj
runs "the number that is named works for it" 0 "$isolod" lods torus.off --vertices "700,${works:-0}" -o few.obj
refuses "too little memory for levels" 18 "--memory" "$isolod" lods torus.off --vertices 700,50 --memory 64K -o y2.obj
no_leftovers "nothing is left behind"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
