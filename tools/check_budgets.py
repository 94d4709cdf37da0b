"""Every count of vertices from the least on: an exact and valid mesh, or a refusal that names a number that works.
Used by check_models.py."""

import json
import subprocess
import sys

from check_bars import verdict
from check_case import compare, read_json, run_limited

MODELS = ["made-sphere", "made-torus", "cgal-eight", "cgal-pinion", "cgal-holes", "cgal-blobby_3cc"]
NONE = ["isolated_vertices", "degenerate_triangles", "degenerate_index_triangles", "duplicate_faces"]
ALWAYS = ["edge_manifold", "vertex_manifold", "consistently_oriented"]
KEPT = ["genus", "boundary_loops", "components"]


def ceiling(mesh, corners):
    """So many vertices must be enough: 4 a component, 9 with a handle, 7 + 4 g with g > 1 of them, 3 a loop, the
    corners. With several components as if one had all the handles, which is no less than the sum."""
    genus = mesh["genus"]
    return (4 if genus == 0 else 9 if genus == 1 else 7 + 4 * genus) + 4 * (mesh["components"] - 1) + \
        3 * mesh["boundary_loops"] + corners


class Budgets:
    """One model remeshed to many counts; each is run once."""

    def __init__(self, args, name, files, out):
        self.args, self.name, (self.path, original) = args, name, files
        self.stem = out / f"budget-{name.replace('.', '_')}"
        self.options = args.options.split() + (["--weld"] if self.path.suffix == ".glb" else [])
        self.known = {}
        # 180: without --features only boundaries are lines.
        whole = compare(args, (original, original), "--features", "180", "--samples", "1000")
        self.mesh, self.ceiling = whole["original"], ceiling(whole["original"], whole["compare"]["corners"])

    def run(self, vertices):
        """("exact", ""), ("refused", the number named) or ("wrong", why)."""
        if vertices not in self.known:
            self.known[vertices] = self.try_count(vertices)
        return self.known[vertices]

    def try_count(self, vertices):
        result, report = self.stem.with_suffix(".off"), self.stem.with_suffix(".json")
        for path in (result, report):
            path.unlink(missing_ok=True)
        command = [self.args.isolod, "remesh", str(self.path), "--vertices", str(vertices), "--quiet", *self.options]
        code, errors, _ = run_limited([*command, "--report", str(report), "-o", str(result)], 600)
        said = read_json(report)
        if code != 0 and said.get("status") == "budget_too_small" and not result.exists():
            return "refused", said["status_value"]
        if code != 0:
            return "wrong", f"exit code {code}: {errors.strip()[-120:]}"
        return self.look_at(result, vertices)

    def look_at(self, result, vertices):
        run = subprocess.run([self.args.isolod, "info", str(result), "--json"], capture_output=True, text=True)
        if run.returncode != 0:
            return "wrong", "the result cannot be read"
        mesh = json.loads(run.stdout)["mesh"]
        wrong = [f"{key} {mesh[key]}" for key in NONE if mesh[key] != 0]
        wrong += [f"not {key}" for key in ALWAYS if not mesh[key]]
        wrong += [f"{key} {mesh[key]}" for key in KEPT if mesh[key] != self.mesh[key]]
        wrong += [f"{mesh['vertices']} vertices"] if mesh["vertices"] != vertices else []
        return ("wrong", ", ".join(wrong)) if wrong else ("exact", "")

    def fault(self, vertices):
        """What is wrong with this count, or ""."""
        how, what = self.run(vertices)
        if how != "refused":
            return what
        if vertices >= self.ceiling:
            return f"refused ({what} named), though {self.ceiling} must do"
        if not vertices < what:
            return f"refused, but {what} named"
        if self.run(what)[0] != "exact":
            return f"{what} named, which is {self.run(what)}"
        if self.run(what - 1)[0] != "refused":
            return f"{what} named, but {what - 1} works"
        return ""


def judge(bar, budgets, counts):
    """One verdict on a model; the figures are the least count that works and what the faults are."""
    faults = []
    for number, vertices in enumerate(counts, 1):
        if sys.stderr.isatty():
            print(f"\r\033[K{budgets.name} {number}/{len(counts)}", end="", file=sys.stderr, flush=True)
        what = budgets.fault(vertices)
        faults += [f"{vertices}: {what}"] if what else []
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    works = [v for v in sorted(budgets.known) if budgets.known[v][0] == "exact"]
    least = f"{works[0]} is the least that works, the ceiling {budgets.ceiling}" if works else "none works"
    words = [f"{len(counts)} counts from {counts[0]} to {counts[-1]}, {least}"] + faults[:6]
    words += [f"{len(faults)} faults in all"] if len(faults) > 6 else []
    return verdict(bar, not faults, budgets.name, "; ".join(words), True)


def check_budgets(args, models, out):
    """Every count on a few models; for every change some of them."""
    counts = [*range(1, 33), 50, 100, 300] if args.ci else [*range(1, 301)]
    names = [name for name in MODELS if name in models]
    return [judge("budgets", Budgets(args, name, models[name], out), counts) for name in names]


def check_counts(args, models, out):
    """Counts on every model, evenly spread in their logarithms; the last is four times the input's."""
    verdicts = []
    steps = 3 if args.ci else 20
    for name, files in models.items():
        budgets = Budgets(args, name, files, out)
        if args.ci and budgets.mesh["vertices"] > 2000:
            continue
        most, least = 4 * budgets.mesh["vertices"], min(50, budgets.mesh["vertices"])
        counts = [round(least * (most / least) ** (i / (steps - 1))) for i in range(steps)]
        verdicts.append(judge("counts", budgets, counts))
    return verdicts
