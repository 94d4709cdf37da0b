"""Measures what the paper says its method does and holds the figures against bars. Started by check_paper.sh, which
builds the programs first.

Each part is a function that gives rows. Results are measured by `isolod compare`; the parts themselves by isolod_paper
and isolod_slopes, which look into the library.
"""

import argparse
import csv
import fnmatch
import io
import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
MADE = ["sphere", "torus", "knot", "head", "bracket", "plate", "lattice"]
VERTICES = 10000
NOT_ADMITTED = 27  # the exit code
# Of samples from wishes, over patches of fifty, on average. Samples thrown at random would deviate by 11 %, the mean
# distance of a Poisson number from its expectation: sqrt(2 / (50 pi)).
MOST_DEVIATION = 0.05

SINGLE = ["cgal-rotor_small", "fandisk-open", "cgal-mushroom", "vhacd-pig", "cgal-pig", "gpjs-kitten", "cgal-elephant",
          "made-lattice"]
NO_FALL_BACK = ["cgal-rotor_small", "fandisk-open", "cgal-mushroom", "vhacd-pig"]
# Without the shared models: the made shapes of the same kind.
SINGLE_MADE = ["made-torus", "made-knot", "made-plate", "made-head", "made-lattice"]
CALIBRATED = ["cgal-anchor", "cgal-fandisk", "cgal-joint", "cgal-part", "cgal-pinion", "cgal-rotor_small",
              "cgal-mushroom", "cgal-holes", "made-bracket", "made-plate"]
FOR_CI = ["cgal-rotor_small", "cgal-fandisk", "cgal-mushroom", "cgal-pig", "cgal-joint", "cgal-3torus", "gpjs-kitten",
          "cgal-blobby_3cc", "made-plate", "made-lattice"]


@dataclass
class Model:
    name: str
    path: Path
    original: Path  # what a result is compared with
    options: list


@dataclass
class Row:
    """One line of the table; `good` is None where there is no bar."""
    part: str
    model: str
    what: str
    figure: str
    bar: str = "-"
    good: object = None


def words():
    parser = argparse.ArgumentParser(prog="check_paper.sh", description=__doc__.split("\n")[0])
    parser.add_argument("--build", default="build/program", help="the build folder that holds the programs")
    parser.add_argument("--data", default="../shared", help="folder that holds models/good")
    parser.add_argument("--only", nargs="+", choices=list(PARTS), metavar="PART", help="of " + ", ".join(PARTS))
    parser.add_argument("--models", nargs="+", metavar="NAME", help="only models whose names match (* and ? work)")
    parser.add_argument("--ci", action="store_true", help="a subset of the models")
    parser.add_argument("--out", default="build/paper", help="where results and reports go")
    return parser.parse_args()


class Bench:
    """The programs, the models, and where results go."""

    def __init__(self, args):
        self.args, self.out = args, Path(args.out)
        self.out.mkdir(parents=True, exist_ok=True)
        tools = Path(args.build) / "tools"
        self.isolod, self.paper = tools / "isolod" / "isolod", tools / "paper" / "isolod_paper"
        self.slopes = tools / "slopes" / "isolod_slopes"
        self.models = self.find_models()

    def find_models(self):
        """By name: the shared models, the fandisk without its bottom, the made shapes."""
        models = {}
        good = Path(self.args.data) / "models" / "good"
        for path in sorted(good.glob("*")) if good.is_dir() else []:
            twin = Path(self.args.data) / "models" / "twins" / (path.name + ".off")
            # The seams of texture coordinates cut the triangles of a GLB apart; welding joins them, as in its twin.
            weld = ["--weld"] if path.suffix == ".glb" else []
            models[path.stem] = Model(path.stem, path, twin if twin.exists() else path, weld)
        if "cgal-fandisk" in models:
            path = self.out / "fandisk-open.obj"
            self.call("cut", str(models["cgal-fandisk"].path), "--plane", "0,1,0,0.2555", "-o", str(path))
            models["fandisk-open"] = Model("fandisk-open", path, path, [])
        for shape in MADE:
            path = self.out / f"made-{shape}.off"
            size = "4000" if shape in ("bracket", "plate", "lattice") else "20000"
            self.call("make", shape, "--triangles", size, "-o", str(path))
            models[path.stem] = Model(path.stem, path, path, [])
        return models

    def call(self, *command):
        subprocess.run([str(self.isolod), *command], check=True, stdout=subprocess.DEVNULL)

    def named(self, names):
        """The models of these names that are there and asked for, in order."""
        found = [self.models[name] for name in names if name in self.models]
        if not self.args.models:
            return found
        return [model for model in found if any(fnmatch.fnmatch(model.name, m) for m in self.args.models)]

    def every(self):
        """All models but the open fandisk; a subset for every change."""
        names = [name for name in self.models if name != "fandisk-open"]
        return self.named([name for name in names if name in FOR_CI] if self.args.ci else names)

    def remesh(self, model, tag, options):
        """Exit code, report and file of one remeshing."""
        result, report = self.out / f"{model.name}-{tag}.off", self.out / f"{model.name}-{tag}.json"
        for path in (result, report):
            path.unlink(missing_ok=True)
        command = ["remesh", str(model.path), *model.options, *options, "--quiet", "--report", str(report)]
        run = subprocess.run([str(self.isolod), *command, "-o", str(result)], stderr=subprocess.DEVNULL)
        return run.returncode, json.loads(report.read_text()) if report.exists() else {}, result

    def compare(self, model, result):
        """What `compare` says of a result; features are edges of more than 40 degrees."""
        command = ["compare", str(model.original), str(result), "--samples", "1000", "--json"]
        run = subprocess.run([str(self.isolod), *command], capture_output=True, text=True)
        return json.loads(run.stdout) if run.returncode == 0 else None

    def table(self, program, *command):
        """The CSV that a program prints, as a list of dictionaries; None where it fails."""
        run = subprocess.run([str(program), *map(str, command)], capture_output=True, text=True)
        return list(csv.DictReader(io.StringIO(run.stdout))) if run.returncode == 0 else None


# ---- the three fluencies (section 3.3)

def admits(fluency, row):
    """Whether a surface of this topology has such an order."""
    if fluency == "region":
        return int(row["components"]) == 1 and int(row["genus"]) == 0 and int(row["loops"]) <= 1
    return fluency == "tree" or int(row["most_loops_of_component"]) <= 1


def topology_words(row):
    return f"{row['components']} comp., genus {row['genus']}, {row['loops']} loops"


def judge_fluency(bench, model, row):
    """One whole remeshing in this order, and what the diffusion alone shows."""
    fluency, name = row["fluency"], f"{row['fluency']} at {VERTICES}"
    code, report, _ = bench.remesh(model, fluency, ["--vertices", str(VERTICES), "--fluency", fluency])
    if not admits(fluency, row):
        good = code == NOT_ADMITTED and row["status"] == "not_admitted"
        return [Row("fluencies", model.name, name, topology_words(row), "not admitted, exit code 27", good)]
    exact = code == 0 and report.get("output_vertices") == VERTICES and report.get("fluency") == fluency
    rows = [Row("fluencies", model.name, name, f"V {report.get('output_vertices', 0)}, exit code {code}, "
                f"largest error {report.get('largest_error', 0):.2f}", f"exactly {VERTICES}", exact)]
    if row["status"] != "ok":
        return rows + [Row("fluencies", model.name, name, row["status"], "admitted", False)]
    deviation = float(row["mean_deviation"])
    figure = (f"deviation {100 * deviation:.2f} %, at most {100 * float(row['greatest_deviation']):.1f} %, "
              f"{row['patches']} patches, error {float(row['largest_error']):.2f}, "
              f"growth {100 * float(row['growth']):.1f} %")
    return rows + [Row("fluencies", model.name, name, figure, f"exact sum, mean <= {100 * MOST_DEVIATION:.0f} %",
                       row["exact"] == "1" and deviation <= MOST_DEVIATION)]


def fluencies(bench):
    few = {"tree": [], "region": [], "strip": []}
    for model in bench.every():
        command = ["fluencies", model.path, *model.options, "--features", 0]
        table = bench.table(bench.paper, *command, "--vertices", VERTICES)
        if not table:
            yield Row("fluencies", model.name, "isolod_paper", "fails", "runs", False)
        for row in table or []:
            yield from judge_fluency(bench, model, row)
        coarse = bench.table(bench.paper, *command, "--vertices", 1000)
        for row in coarse or []:
            if row["status"] == "ok" and int(row["patches"]) > 0:
                few[row["fluency"]].append((float(row["mean_deviation"]), model.name))
    for fluency, values in few.items():
        if values:
            mean = sum(value for value, _ in values) / len(values)
            yield Row("fluencies", f"{len(values)} models", f"{fluency} at 1000",
                      f"mean deviation {100 * mean:.2f} %; greatest {100 * max(values)[0]:.2f} % on {max(values)[1]}")


# ---- one chart a component, with the paper's calibration and weights (sections 4.1 and 4.2)

def same_topology(compared):
    a, b = compared["original"], compared["remeshed"]
    return all(a[key] == b[key] for key in ("genus", "boundary_loops", "components"))


def is_manifold(mesh):
    return all(mesh[key] for key in ("edge_manifold", "vertex_manifold", "consistently_oriented"))


def single(bench):
    for model in bench.named(SINGLE if "cgal-rotor_small" in bench.models else SINGLE_MADE):
        options = ["--paper", "--features", "40", "--vertices", str(VERTICES)]
        code, report, result = bench.remesh(model, "single", options)
        compared = bench.compare(model, result) if code == 0 else None
        if compared is None:
            yield Row("single", model.name, "--paper", f"exit code {code}, {report.get('status')}", "runs", False)
            continue
        mesh = compared["remeshed"]
        topology = f"genus {mesh['genus']}, {mesh['boundary_loops']} loops"
        yield Row("single", model.name, "vertices", str(mesh["vertices"]), f"exactly {VERTICES}",
                  mesh["vertices"] == VERTICES)
        yield Row("single", model.name, "topology", topology, "manifold, as the input's",
                  is_manifold(mesh) and same_topology(compared))
        yield Row("single", model.name, "Q mean", f"{mesh['q_mean']:.4f}", ">= 0.88", mesh["q_mean"] >= 0.88)
        bound = model.name in NO_FALL_BACK
        yield Row("single", model.name, "fallen back", f"{report['fallen_back']} of {report['components']} components, "
                  f"{report['seam_samples']} seam samples", "none" if bound else "-",
                  report["fallen_back"] == 0 if bound else None)


# ---- cut graphs (section 4.1)

def cut_rows(name, plain, weighted):
    for row, metric in ((plain, "plain lengths"), (weighted, f"features at {weighted['feature_factor']}")):
        cut, loops = float(row["default"]), float(row["loops_total"])
        figure = (f"{cut / loops:.3f} of the loops; spine {float(row['spine']) / loops:.2f}, union "
                  f"{float(row['loops_union']) / loops:.2f}, shortened {float(row['shortened_union']) / loops:.2f} "
                  f"({float(row['shortened_total']) / loops:.2f}), greedy {float(row['greedy']) / loops:.2f}")
        yield Row("cuts", name, f"length, {metric}", figure, "<= 1.1", cut <= 1.1 * loops)
        figure = (f"{row['loops_multiplicity']} and {row['shortened_multiplicity']} at most, schema of "
                  f"{row['loops_schema_edges']} and {row['shortened_schema_edges']} edges")
        yield Row("cuts", name, f"passes, {metric}", figure)
    before, after = float(plain["default_share_on_features"]), float(weighted["default_share_on_features"])
    features, cut = float(plain["length_of_features"]), float(plain["default_length"])
    figure = f"{100 * before:.1f} % without, {100 * after:.1f} % with the factor"
    if features <= 0:
        yield Row("cuts", name, "on features", "no features")
    elif before < 1 and features >= cut:
        yield Row("cuts", name, "on features", figure, "more", after > before)
    else:
        yield Row("cuts", name, "on features", figure + "; few features", "no less", after >= before)


def cuts(bench):
    for model in bench.every():
        table = bench.table(bench.paper, "cuts", model.path, *model.options, "--vertices", VERTICES)
        if table is None:
            yield Row("cuts", model.name, "isolod_paper", "fails", "runs", False)
        elif len(table) == 2:
            yield from cut_rows(model.name + f" (g {table[0]['genus']})", *table)


# ---- the weights of the centroids (section 4.4)

def judge_curve(chart, curve):
    """`curve`: our slope and the paper's, by iteration. Both begin with the same samples, a little off 1; where the
    paper's curve then passes through 1 on its way down it is nearer for a moment."""
    last = max(curve)
    start = abs(curve[0]["ours"] - 1)
    farther = [i for i, at in curve.items() if i > 0 and abs(at["ours"] - 1) > abs(at["paper"] - 1)]
    beyond = [i for i in farther if abs(curve[i]["ours"] - 1) > start]
    figure = f"{curve[last]['ours']:.3f}, the paper's {curve[last]['paper']:.3f}; "
    figure += f"as near to 1 or nearer at {last - len(farther)} of {last}"
    if farther:
        worst = max(abs(curve[i]["ours"] - 1) for i in farther)
        figure += f", not from {min(farther)} to {max(farther)}, there {worst:.4f} off at most"
    return Row("slopes", chart, f"slope at iteration {last}", figure,
               f"never farther from 1 than the paper's, but within {start:.4f}, where both began", not beyond)


def slopes(bench):
    """Slope of log(realised density) over log(wished), after each iteration, with both weights."""
    if not bench.slopes.exists():
        return
    table = bench.table(bench.slopes, bench.out / "slopes.svg")
    if not table:
        yield Row("slopes", "isolod_slopes", "all charts", "fails", "runs", False)
    charts = {}
    for row in table or []:
        at = charts.setdefault(row["chart"], {}).setdefault(int(row["iteration"]), {})
        at["paper" if row["weight"] == "d" else "ours"] = float(row["slope"])
    for chart, curve in charts.items():
        yield judge_curve(chart, curve)


# ---- the calibration (section 3.2)

def calibration(bench):
    names = [name for name in CALIBRATED if not bench.args.ci or name in FOR_CI]
    for model in bench.named(names):
        found = {}
        for kind in ("corrected", "paper"):
            options = ["--vertices", str(VERTICES), "--features", "40", "--calibration", kind]
            code, _, result = bench.remesh(model, kind, options)
            compared = bench.compare(model, result) if code == 0 else None
            found[kind] = compared["compare"] if compared else {"density_beside_lines": 0, "density_on_lines": 0}
        ours, paper = found["corrected"], found["paper"]
        figure = (f"{ours['density_beside_lines']:.4f} of the density elsewhere; "
                  f"paper's {paper['density_beside_lines']:.4f}")
        yield Row("calibration", model.name, "within two rings of lines", figure, "0.97 to 1.03",
                  abs(ours["density_beside_lines"] - 1) <= 0.03)
        yield Row("calibration", model.name, "on lines alone",
                  f"{ours['density_on_lines']:.4f}; paper's {paper['density_on_lines']:.4f}")


PARTS = {"fluencies": fluencies, "single": single, "cuts": cuts, "slopes": slopes, "calibration": calibration}


def print_row(row):
    verdict = "   " if row.good is None else "ok " if row.good else "BAD"
    bar = "" if row.good is None else f"  [{row.bar}]"
    print(f"{verdict} {row.model:24} {row.what:26} {row.figure}{bar}", flush=True)


def main():
    os.chdir(TOP)
    args = words()
    bench = Bench(args)
    passed = failed = 0
    for part in args.only or PARTS:
        start = time.monotonic()
        print(f"{part}:")
        for row in PARTS[part](bench):
            print_row(row)
            passed += row.good is True
            failed += row.good is False
        print(f"    {time.monotonic() - start:.0f} s\n")
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
