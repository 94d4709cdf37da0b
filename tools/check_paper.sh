#!/bin/sh
# Measures what the paper says its method does, a row for each figure: the three fluencies, one chart a component, cut
# graphs, the weights of the centroids, the calibration.
#
#   sh tools/check_paper.sh                 every model, every row
#   sh tools/check_paper.sh --ci            a subset for every change
#   sh tools/check_paper.sh --help          the choices: parts, models
#
# The models are those of ../shared/models beside the project where they are there, and made shapes. A row holds ok or
# BAD, the model, what was measured, and its bar; a row without ok or BAD has no bar. The last line is `N passed, N
# failed`.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

want_build_tools
want_command python3 python3
install_missing || exit 1
programs=build/program
case " $* " in
  *" --build "* | *" --help "* | *" -h "*) ;;
  *)
    targets="isolod_cli isolod_paper"
    [ ! -e tools/slopes/CMakeLists.txt ] || targets="$targets isolod_slopes"
    # shellcheck disable=SC2086  # a list of words
    build_program $targets || exit 1
    set -- --build "$programs" "$@"
    ;;
esac
exec python3 -B tools/check_paper.py "$@"
