"""Remeshes models and holds the results against the bars. Started by check_models.sh, which builds the program first.

What is asked of which model stands in check_plan.py, the bars in check_bars.py. Results are judged by the independent
programs of a folder `referee` (referee.cpp and intersections.cpp, compiled into the build folder) where there is one
beside the project, else by the program's own `compare`.
"""

import argparse
import fnmatch
import json
import os
import subprocess
import sys
from pathlib import Path

from check_bars import BARS, judge_bad, print_table, summarize
from check_budgets import check_budgets, check_counts
from check_case import compile_judge, run_case, run_limited
from check_lods import check_lods
from check_peer import find_peer
from check_plan import FOR_CI, MADE, ROWS, make_size, plan
from check_seams import check_seams

TOP = Path(__file__).resolve().parent.parent


def words():
    parser = argparse.ArgumentParser(prog="check_models.sh", description=__doc__.split("\n")[0])
    parser.add_argument("--isolod", default="build/program/tools/isolod/isolod", help="the program to check")
    parser.add_argument("--data", default="../shared", help="folder that holds models/good, models/bad and referee")
    parser.add_argument("--models", nargs="+", metavar="NAME", help="only models whose names match (* and ? work)")
    parser.add_argument("--vertices", nargs="+", type=int, metavar="N", help="instead of 1000 5000 10000 20000")
    parser.add_argument("--features", type=float, metavar="DEG", help="for every model, instead of 40 for the sharp ones")
    parser.add_argument("--options", default="", metavar="WORDS", help="further options for every remeshing")
    parser.add_argument("--only", nargs="+", choices=list(ROWS), metavar="ROW",
                        help="of " + "; ".join(f"{row}: {text}" for row, text in ROWS.items()))
    parser.add_argument("--peer", metavar="PATH", help="the program that drives CGAL, if it is not in the folder peers")
    parser.add_argument("--ci", action="store_true", help="a subset of models and counts, with fewer samples")
    parser.add_argument("--no-bad", action="store_true", help="leave the broken files out")
    parser.add_argument("--only-bad", action="store_true", help="the broken files alone")
    parser.add_argument("--sanitize", metavar="DIR", help="build folder with sanitizers: the broken files run there")
    parser.add_argument("--out", default="build/models", help="where results and reports go")
    parser.add_argument("--no-judge", action="store_true", help="only remesh: no distances, no crossings")
    return parser.parse_args()


def find_models(args, out):
    """name -> (file to remesh, file to compare with)."""
    models = {}
    good = Path(args.data) / "models" / "good"
    for path in sorted(good.glob("*")) if good.is_dir() else []:
        twin = Path(args.data) / "models" / "twins" / (path.name + ".off")
        models[path.stem] = (path, twin if twin.exists() else path)
    for shape in MADE:
        path = out / f"made-{shape}.off"
        subprocess.run([args.isolod, "make", shape, "--triangles", make_size(shape), "-o", str(path)], check=True,
                       stdout=subprocess.DEVNULL)
        models[f"made-{shape}"] = (path, path)
    if args.ci:
        models = {name: files for name, files in models.items() if name in FOR_CI}
    if args.models:
        models = {name: files for name, files in models.items() if any(fnmatch.fnmatch(name, m) for m in args.models)}
    return models


def run_bad(args, judge, path, out):
    """One broken file: a clean error or a repaired result, soon and in little memory."""
    program = str(Path(args.sanitize) / "tools" / "isolod" / "isolod") if args.sanitize else args.isolod
    result = out / ("bad-" + path.name + ".off")
    result.unlink(missing_ok=True)
    limit = 120 if args.sanitize else 20
    # GNU time is not everywhere: the peak is asked of the system by a small program between.
    watch = ("import os, resource, subprocess, sys; code = subprocess.call(sys.argv[1:]); "
             "print('peak-kb', resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, file=sys.stderr); "
             "sys.exit(code if code >= 0 else 128 - code)")
    command = [sys.executable, "-c", watch, program, "remesh", str(path), "--vertices", "500", "--quiet", "-o", str(result)]
    code, errors, seconds = run_limited(command, limit)
    lines = errors.strip().splitlines()
    peak = int(lines.pop().split()[1]) * 1024 if lines and lines[-1].startswith("peak-kb") else 0
    found = {"model": path.name, "code": code, "errors": lines, "seconds": seconds, "peak": peak,
             "size": path.stat().st_size, "sanitized": bool(args.sanitize), "judged": {}}
    if code == 0:
        if judge:
            run = subprocess.run([judge["referee"], "--stats", str(result), "--compact"], capture_output=True, text=True)
            found["judged"] = json.loads(run.stdout).get("original", {}) if run.returncode == 0 else {}
        else:
            run = subprocess.run([args.isolod, "info", str(result), "--json"], capture_output=True, text=True)
            found["judged"] = json.loads(run.stdout).get("mesh", {}) if run.returncode == 0 else {}
    return found, judge_bad(found)


def run_cases(args, judge, cases, out):
    verdicts, known = [], {"peer": find_peer(args, out) if any("near" in case.bars for case in cases) else None}
    for number, case in enumerate(cases, 1):
        if sys.stderr.isatty():
            print(f"\r\033[K{number}/{len(cases)} {case.model} {case.vertices}", end="", file=sys.stderr, flush=True)
        verdicts += run_case(args, judge, case, out, known)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    print_table(cases)
    return verdicts


def run_bad_files(args, judge, out):
    verdicts = []
    print("\nbroken files")
    for path in sorted((Path(args.data) / "models" / "bad").glob("*")):
        found, more = run_bad(args, judge, path, out)
        first = found["errors"][0] if found["errors"] else "repaired" if found["code"] == 0 else ""
        print(f"  {found['code']!s:>5} {found['seconds']:6.2f} s {found['peak'] / 1048576:7.1f} MB  {path.name}: {first[:90]}")
        verdicts += more
    return verdicts


def main():
    os.chdir(TOP)
    args = words()
    wanted = set(args.only or (["bad"] if args.only_bad else ROWS))
    if args.ci and not args.only:
        wanted.discard("seams")  # as MISSED_YET
    out = Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    judge = compile_judge(Path(args.data), out)
    if judge is None:
        print("no referee beside the project: results are measured by the program's own compare")
    models = find_models(args, out) if wanted != {"bad"} else {}
    verdicts = []
    cases = plan(args, models, wanted)
    if cases:
        verdicts += run_cases(args, judge, cases, out)
    rows = {"seams": check_seams, "budgets": check_budgets, "counts": check_counts, "lods": check_lods}
    for row, check in rows.items():
        if row in wanted:
            verdicts += check(args, models, out)
    if "bad" in wanted and not args.no_bad and (not args.models or args.only):
        verdicts += run_bad_files(args, judge, out)
    return summarize(verdicts, BARS)


if __name__ == "__main__":
    sys.exit(main())
