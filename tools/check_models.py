"""Remeshes models and holds the results against the bars. Started by check_models.sh, which builds the program first.

What is asked of which model stands in `plan`; the bars are in check_bars.py. Results are judged by the independent
programs of a folder `referee` (referee.cpp and intersections.cpp, compiled into the build folder) where there is one
beside the project, else by the program's own `compare`.
"""

import argparse
import fnmatch
import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from check_bars import BARS, judge_bad, judge_case, print_table, summarize
from check_density import wished_density

TOP = Path(__file__).resolve().parent.parent
SMOOTH = ["cgal-bunny00", "gpjs-kitten", "gpjs-gargoyle", "made-sphere", "made-torus", "made-knot", "made-head"]
SHARP = ["cgal-fandisk", "cgal-pinion", "cgal-part", "cgal-anchor", "cgal-joint", "cgal-rotor_small", "made-bracket"]
OPEN = ["cgal-mushroom", "cgal-head", "cgal-holes", "cgal-pig", "vhacd-pig", "made-plate"]
CURVED = ["cgal-fandisk", "cgal-elephant", "gpjs-kitten", "made-head"]
MADE = ["sphere", "torus", "knot", "head", "bracket", "plate", "lattice"]
FOR_CI = ["cgal-bunny00", "cgal-fandisk", "cgal-mushroom", "cgal-3torus", "cgal-anchor", "cgal-couplingdown", "cgal-pig",
          "cgal-blobby_3cc", "tri-Duck", "stlm-gearwheel.bin", "made-torus", "made-bracket", "made-head", "made-plate"]


@dataclass
class Case:
    """One remeshing and what is asked of it."""
    model: str
    path: Path
    original: Path  # what the judges compare with
    vertices: int
    options: list
    bars: set
    result: dict = field(default_factory=dict)  # filled by run_case


def words():
    parser = argparse.ArgumentParser(prog="check_models.sh", description=__doc__.split("\n")[0])
    parser.add_argument("--isolod", default="build/program/tools/isolod/isolod", help="the program to check")
    parser.add_argument("--data", default="../shared", help="folder that holds models/good, models/bad and referee")
    parser.add_argument("--models", nargs="+", metavar="NAME", help="only models whose names match (* and ? work)")
    parser.add_argument("--vertices", nargs="+", type=int, metavar="N", help="instead of 1000 5000 10000 20000")
    parser.add_argument("--features", type=float, metavar="DEG", help="for every model, instead of 40 for the sharp ones")
    parser.add_argument("--options", default="", metavar="WORDS", help="further options for every remeshing")
    parser.add_argument("--ci", action="store_true", help="a subset of models and counts, with fewer samples")
    parser.add_argument("--no-bad", action="store_true", help="leave the broken files out")
    parser.add_argument("--only-bad", action="store_true", help="the broken files alone")
    parser.add_argument("--sanitize", metavar="DIR", help="build folder with sanitizers: the broken files run there")
    parser.add_argument("--out", default="build/models", help="where results and reports go")
    parser.add_argument("--no-judge", action="store_true", help="only remesh: no distances, no crossings")
    return parser.parse_args()


def compile_judge(data, out):
    """The independent programs, or None where their sources are not there."""
    programs = {}
    for name in ["referee", "intersections"]:
        source = data / "referee" / (name + ".cpp")
        if not source.exists():
            return None
        program = out / name
        if not program.exists() or program.stat().st_mtime < source.stat().st_mtime:
            compiler = os.environ.get("CXX", "c++")
            subprocess.run([compiler, "-O2", "-std=c++17", "-pthread", str(source), "-o", str(program)], check=True)
        programs[name] = program
    return programs


def find_models(args, out):
    """name -> (file to remesh, file to compare with)."""
    models = {}
    good = Path(args.data) / "models" / "good"
    for path in sorted(good.glob("*")) if good.is_dir() else []:
        twin = Path(args.data) / "models" / "twins" / (path.name + ".off")
        models[path.stem] = (path, twin if twin.exists() else path)
    for shape in MADE:
        path = out / f"made-{shape}.off"
        size = "4000" if shape in ("bracket", "plate", "lattice") else "20000"
        subprocess.run([args.isolod, "make", shape, "--triangles", size, "-o", str(path)], check=True,
                       stdout=subprocess.DEVNULL)
        models[f"made-{shape}"] = (path, path)
    if args.ci:
        models = {name: files for name, files in models.items() if name in FOR_CI}
    if args.models:
        models = {name: files for name, files in models.items() if any(fnmatch.fnmatch(name, m) for m in args.models)}
    return models


def plan(args, models):
    """Every case that is asked for."""
    cases = []
    counts = args.vertices or ([1000, 10000, 20000] if args.ci else [1000, 5000, 10000, 20000])
    for name, (path, original) in models.items():
        # The seams of texture coordinates cut the triangles of a GLB apart; welding joins them, as in its twin.
        more = args.options.split() + (["--weld"] if path.suffix == ".glb" and "--weld" not in args.options else [])
        for vertices in counts:
            bars = {"topology"}
            options = ["--features", str(args.features)] if args.features is not None else []
            if vertices == 10000:
                bars.add("crossings")
                if args.features is None and not args.options:
                    bars |= {"smooth"} if name in SMOOTH else set()
                    bars |= {"boundary"} if name in OPEN else set()
                    bars |= {"time"} if name == "cgal-bunny00" else set()
            cases.append(Case(name, path, original, vertices, options + more, bars))
        if args.features is None and 10000 in counts and name in SHARP:
            cases.append(Case(name, path, original, 10000, ["--features", "40"] + more, {"topology", "sharp", "crossings"}))
        if 10000 in counts and name in CURVED and not args.features:
            for gamma in ["1"] if args.ci else ["1", "2", "2.5"]:
                cases.append(Case(name, path, original, 10000, ["--gamma", gamma, "--smooth", "10"] + more,
                                  {"topology", "density"}))
    return cases


def run_limited(command, seconds):
    """Exit code (negative: signal, None: out of time), standard error, seconds, greatest resident size in bytes."""
    start = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, start_new_session=True) as process:
        timed_out = False
        try:
            _, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            timed_out = True
            os.killpg(process.pid, signal.SIGKILL)
            _, errors = process.communicate()
    return None if timed_out else process.returncode, errors.decode(errors="replace"), time.monotonic() - start


def read_json(path):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def remesh(args, case, stem, vertices):
    report = stem.with_suffix(".json")
    result = stem.with_suffix(".off")
    for path in (report, result):
        path.unlink(missing_ok=True)
    command = [args.isolod, "remesh", str(case.path), "--vertices", str(vertices), *case.options, "--quiet",
               "--report", str(report), "-o", str(result)]
    code, errors, seconds = run_limited(command, 600)
    return {"code": code, "errors": errors.strip(), "wall": seconds, "report": read_json(report), "file": result,
            "command": " ".join(command)}


def option(case, name):
    """The word behind an option of the case, or None."""
    return case.options[case.options.index(name) + 1] if name in case.options else None


def measure(args, judge, case, found, known):
    """What the judges say of one result; `known` remembers the originals' crossings."""
    # 180: no edge is sharper, so only boundaries are lines.
    sharp = option(case, "--features") or ("180" if "boundary" in case.bars else "40")
    samples = "100000" if args.ci else "500000"
    pair = [str(case.original), str(found["file"])]
    if judge:
        run = subprocess.run([judge["referee"], *pair, "--compact", "--sharp", sharp, "--samples", samples],
                             capture_output=True, text=True)
        found["judged"] = json.loads(run.stdout) if run.returncode == 0 else {}
    if not judge or {"sharp", "boundary", "density"} & case.bars:
        command = [args.isolod, "compare", *pair, "--features", sharp, "--samples", samples, "--json"]
        if "density" in case.bars:
            wished = wished_density(case.original, float(option(case, "--gamma")), int(option(case, "--smooth")))
            density = found["file"].with_suffix(".density.txt")
            density.write_text("\n".join(map(repr, wished)) + "\n")
            command += ["--density", str(density)]
        run = subprocess.run(command, capture_output=True, text=True)
        found["own"] = json.loads(run.stdout) if run.returncode == 0 else {}
        found.setdefault("judged", found["own"])
    if "crossings" in case.bars:
        measure_crossings(args, judge, case, found, known)


def measure_crossings(args, judge, case, found, known):
    """How many pairs cross and what they are, by compare, which is exact; and what the independent program counts.

    The independent program decides in rounded doubles: of triangles in one oblique plane it counts some that do not even
    touch. Its numbers are shown where they differ, and not judged.
    """
    pair = [str(case.original), str(found["file"])]
    if "own" not in found:
        run = subprocess.run([args.isolod, "compare", *pair, "--samples", "1000", "--json"], capture_output=True, text=True)
        found["own"] = json.loads(run.stdout) if run.returncode == 0 else {}
    found["kinds"] = found["own"].get("compare", {})
    if judge:
        count = lambda path: int(subprocess.run([judge["intersections"], path], capture_output=True, text=True).stdout)
        if case.model not in known:
            known[case.model] = count(pair[0])
        found["rounded"] = (known[case.model], count(pair[1]))


def run_case(args, judge, case, out, known):
    tag = "-".join([case.model, str(case.vertices)] + [o.lstrip("-") for o in case.options])
    stem = out / tag.replace("/", "_").replace(".", "_")
    found = remesh(args, case, stem, case.vertices)
    if found["report"].get("status") == "budget_too_small":
        found["named"] = found["report"].get("status_value")
        found["retry"] = remesh(args, case, stem.with_name(stem.name + "-named"), found["named"])["code"]
    if found["code"] == 0 and not args.no_judge:
        measure(args, judge, case, found, known)
    case.result = found
    return judge_case(case)


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


def main():
    os.chdir(TOP)
    args = words()
    out = Path(args.out)
    out.mkdir(parents=True, exist_ok=True)
    judge = compile_judge(Path(args.data), out)
    if judge is None:
        print("no referee beside the project: results are measured by the program's own compare")
    cases = [] if args.only_bad else plan(args, find_models(args, out))
    verdicts, known = [], {}
    for number, case in enumerate(cases, 1):
        if sys.stderr.isatty():
            print(f"\r\033[K{number}/{len(cases)} {case.model} {case.vertices}", end="", file=sys.stderr, flush=True)
        verdicts += run_case(args, judge, case, out, known)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    print_table(cases)
    bad = Path(args.data) / "models" / "bad"
    if bad.is_dir() and not args.no_bad and not args.models:
        print("\nbroken files")
        for path in sorted(bad.glob("*")):
            found, more = run_bad(args, judge, path, out)
            first = found["errors"][0] if found["errors"] else "repaired" if found["code"] == 0 else ""
            print(f"  {found['code']!s:>5} {found['seconds']:6.2f} s {found['peak'] / 1048576:7.1f} MB  {path.name}: {first[:90]}")
            verdicts += more
    return summarize(verdicts, BARS)


if __name__ == "__main__":
    sys.exit(main())
