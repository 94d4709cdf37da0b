"""One remeshing and what is measured of it. Used by check_models.py."""

import json
import os
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

from check_bars import judge_case
from check_density import graded_density, read_mesh, wished_density, write_density
from check_peer import peer_remesh


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


def option(case, name):
    """The word behind an option of the case, or None."""
    return case.options[case.options.index(name) + 1] if name in case.options else None


def wished(case):
    """What the case's options wish for at each vertex of the original."""
    if option(case, "--density") == "graded":
        return graded_density(case.original)
    if option(case, "--gamma"):
        return wished_density(case.original, float(option(case, "--gamma")), int(option(case, "--smooth")))
    return [1.0] * len(read_mesh(case.original)[0])


def remesh(args, case, stem, vertices):
    report = stem.with_suffix(".json")
    result = stem.with_suffix(".off")
    for path in (report, result):
        path.unlink(missing_ok=True)
    options = list(case.options)
    if "graded" in options:
        options[options.index("graded")] = str(stem.with_suffix(".density.txt"))
        write_density(stem.with_suffix(".density.txt"), wished(case))
    command = [args.isolod, "remesh", str(case.path), "--vertices", str(vertices), *options, "--quiet",
               "--report", str(report), "-o", str(result)]
    code, errors, seconds = run_limited(command, 600)
    return {"code": code, "errors": errors.strip(), "wall": seconds, "report": read_json(report), "file": result,
            "command": " ".join(command)}


def compare(args, pair, *options):
    """What the program's own `compare` says, or nothing where it fails."""
    run = subprocess.run([args.isolod, "compare", *map(str, pair), *options, "--json"], capture_output=True, text=True)
    return json.loads(run.stdout) if run.returncode == 0 else {}


def judged(args, judge, pair, *options):
    """What the independent judge says, or `compare` where there is none."""
    if not judge:
        return compare(args, pair, *options)
    words = ["--sharp" if word == "--features" else word for word in options]
    run = subprocess.run([judge["referee"], *map(str, pair), "--compact", *words], capture_output=True, text=True)
    return json.loads(run.stdout) if run.returncode == 0 else {}


def measure(args, judge, case, found, known, out):
    """What the judges say of one result; `known` remembers the originals' crossings and the other program's results."""
    # 180: no edge is sharper, so only boundaries are lines.
    sharp = option(case, "--features") or ("180" if "boundary" in case.bars else "40")
    samples = "100000" if args.ci and "near" not in case.bars else "500000"
    pair = (case.original, found["file"])
    found["judged"] = judged(args, judge, pair, "--features", sharp, "--samples", samples)
    if {"sharp", "boundary", "density", "even", "small", "mass"} & case.bars:
        words = ["--features", sharp, "--samples", "1000", "--small"]
        if {"density", "mass"} & case.bars:
            density = found["file"].with_suffix(".density.txt")
            write_density(density, wished(case))
            words += ["--density", str(density)]
        found["own"] = compare(args, pair, *words)
    if "crossings" in case.bars:
        measure_crossings(args, judge, case, found, known)
    if "near" in case.bars and case.model != "cgal-fandisk" and known["peer"]:
        other = peer_remesh(known["peer"], case.original, case.vertices, out)
        found["peer"] = judged(args, judge, (case.original, other), "--samples", samples) if other else {}


def measure_crossings(args, judge, case, found, known):
    """How many pairs cross and what they are, by compare, which is exact; and what the independent program counts.

    The independent program decides in rounded doubles: of triangles in one oblique plane it counts some that do not even
    touch. Its numbers are shown where they differ, and not judged.
    """
    pair = [str(case.original), str(found["file"])]
    if "own" not in found:
        found["own"] = compare(args, pair, "--samples", "1000")
    found["kinds"] = found["own"].get("compare", {})
    if judge:
        count = lambda path: int(subprocess.run([judge["intersections"], path], capture_output=True, text=True).stdout)
        if case.model not in known:
            known[case.model] = count(pair[0])
        found["rounded"] = (known[case.model], count(pair[1]))


def listed_triangles(path):
    """The lines of an OFF file's triangles."""
    lines = path.read_text().splitlines()
    return lines[2 + int(lines[1].split()[0]):]


def measure_unfitted(args, judge, case, stem, found, out):
    """The same without fitting: what the judges say of it, and whether it has the same triangles."""
    options = [o for o in case.options if o != "--fit"]
    plain = Case(case.model, case.path, case.original, case.vertices, options, {"topology"})
    unfitted = remesh(args, plain, stem.with_name(stem.name + "-unfitted"), case.vertices)
    if unfitted["code"] == 0:
        measure(args, judge, plain, unfitted, {}, out)
        unfitted["same_triangles"] = listed_triangles(unfitted["file"]) == listed_triangles(found["file"])
    found["unfitted"] = unfitted


def run_case(args, judge, case, out, known):
    tag = "-".join([case.model, str(case.vertices)] + [o.lstrip("-") for o in case.options])
    stem = out / tag.replace("/", "_").replace(".", "_")
    found = remesh(args, case, stem, case.vertices)
    if found["report"].get("status") == "budget_too_small":
        found["named"] = found["report"].get("status_value")
        found["retry"] = remesh(args, case, stem.with_name(stem.name + "-named"), found["named"])["code"]
    if found["code"] == 0 and not args.no_judge:
        measure(args, judge, case, found, known, out)
        if "fit" in case.bars:
            measure_unfitted(args, judge, case, stem, found, out)
    case.result = found
    return judge_case(case)
