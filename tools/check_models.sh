#!/bin/sh
# Remeshes real and made models and has every result judged by other programs than the one that made it.
#
#   sh tools/check_models.sh                 every model, every bar: hours
#   sh tools/check_models.sh --ci            a subset for every change
#   sh tools/check_models.sh --only even     one row: quality, seams, budgets ... (--help lists them)
#   sh tools/check_models.sh --help          the choices: models, vertex counts, options
#
# Prints a table, then what passed and failed for each bar; the last line is `N passed, N failed`.
set -u
cd "$(dirname "$0")/.." || exit 1
. tools/common.sh

want_build_tools
want_command python3 python3
install_missing || exit 1
case " $* " in
  *" --isolod "* | *" --help "* | *" -h "*) ;;
  *)
    build_program isolod_cli isolod_seams || exit 1
    set -- --isolod "$isolod" "$@"
    ;;
esac
exec python3 -B tools/check_models.py "$@"
