#!/bin/sh
# Whether isolod_figures still draws: small figures from made shapes, well-formed, with all of their panels.
#
#   sh tools/check_figures.sh PATH_TO_ISOLOD PATH_TO_ISOLOD_FIGURES        ends with `N passed, N failed`
set -u
[ $# -eq 2 ] || { echo "usage: sh tools/check_figures.sh PATH_TO_ISOLOD PATH_TO_ISOLOD_FIGURES" >&2; exit 2; }
isolod="$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
figures="$(cd "$(dirname "$2")" && pwd)/$(basename "$2")"
work="$(mktemp -d)" || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

passed=0
failed=0
# holds NAME COMMAND...: the command must succeed.
holds() {
  name="$1"
  shift
  if "$@" >output.txt 2>&1; then
    passed=$((passed + 1))
    echo "ok  $name"
  else
    failed=$((failed + 1))
    echo "BAD $name: does not hold: $*"
    sed 's/^/      /' output.txt
  fi
}

# panels FILE COUNT: the file is well-formed, and so many panels in it hold something drawn.
cat >panels.py <<'END'
import sys
import xml.etree.ElementTree as tree

svg = "{http://www.w3.org/2000/svg}"
found = [box for box in tree.parse(sys.argv[1]).getroot().iter(svg + "svg") if box.find(svg + "path") is not None]
found = [box for box in found if box.find(svg + "svg") is None]
print(len(found), "panels")
sys.exit(len(found) != int(sys.argv[2]))
END

# draws NUMBER PANELS ARGUMENT...
draws() {
  number="$1" wanted="$2"
  shift 2
  holds "figure $number is drawn" "$figures" "$number" "$@" -o "$number.svg"
  holds "figure $number has $wanted panels" python3 panels.py "$number.svg" "$wanted"
}

holds "a half sphere" "$isolod" make sphere --triangles 500 -o sphere.obj
holds "without its lower half" "$isolod" cut sphere.obj --plane 0,0,-1,0 -o half.obj
holds "a torus" "$isolod" make torus --triangles 500 -o torus.obj
holds "a lattice" "$isolod" make lattice --triangles 1500 -o lattice.obj
holds "a bracket" "$isolod" make bracket --triangles 600 -o bracket.obj

holds "help names every figure" sh -c '[ "$("$0" --help | grep -Ec "^ +[0-9]+  ")" -eq 17 ]' "$figures"
draws 5 6 half.obj
draws 6 8 torus.obj --beside lattice.obj --paper --vertices 150
draws 11 10 half.obj --paper --vertices 150
draws 14 2 torus.obj --vertices 150
draws 16 7 bracket.obj --vertices 600 --features 40 --lloyd 3
draws 17 6 torus.obj --paper --vertices 150 --lloyd 3
draws 18 5 half.obj --paper --vertices 150 --lloyd 3

"$figures" 11 half.obj --paper --vertices 150 -o again.svg
holds "the same again gives the same bytes" cmp 11.svg again.svg
"$figures" 2 half.obj -o 2.svg >output.txt 2>&1
holds "there is no figure 2" test $? -eq 2 -a ! -e 2.svg

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
