"""Which models are remeshed how, and what is asked of each. Used by check_models.py."""

from check_bars import ROUGHER
from check_case import Case

SMOOTH = ["cgal-bunny00", "gpjs-kitten", "gpjs-gargoyle", "made-sphere", "made-torus", "made-knot", "made-head"]
SHARP = ["cgal-fandisk", "cgal-pinion", "cgal-part", "cgal-anchor", "cgal-joint", "cgal-rotor_small", "cgal-knot2",
         "made-bracket"]
OPEN = ["cgal-mushroom", "cgal-head", "cgal-holes", "cgal-pig", "vhacd-pig", "made-plate"]
FITTED = ["cgal-fandisk", "cgal-bunny00", "gpjs-gargoyle"]
CURVED = ["cgal-fandisk", "cgal-elephant", "gpjs-kitten", "made-head"]
BESIDE_PEER = ["cgal-bunny00", "gpjs-kitten", "gpjs-gargoyle"]
WEIGHED = ["made-sphere", "made-head", "made-plate"]
HANDLES = ["made-lattice10", "made-lattice50", "made-lattice150", "made-spheres500", "made-tube200", "made-plate400"]
MADE = ["sphere", "torus", "knot", "head", "bracket", "plate", "lattice"] + [name[5:] for name in HANDLES]
FOR_CI = ["cgal-bunny00", "cgal-fandisk", "cgal-mushroom", "cgal-3torus", "cgal-anchor", "cgal-couplingdown", "cgal-pig",
          "cgal-blobby_3cc", "tri-Duck", "stlm-gearwheel.bin", "made-torus", "made-bracket", "made-head", "made-plate",
          "made-sphere", "made-lattice10", "made-plate400"]

# Bars that are not met yet: model, bar. The whole check shows them as missed; that of every change leaves them out, with
# the row "seams", so that it tells what got worse.
MISSED_YET = {("cgal-fandisk", "near"), ("made-plate", "mass")}

ROWS = {
    "models": "every model at several counts",
    "even": "closed models: quality, valences, cells, small angles",
    "small": "small triangles of models with sharp lines",
    "near": "distances, beside CGAL's",
    "fit": "vertices placed where the distance is least",
    "mass": "the cells' masses and the density that was wished",
    "handles": "many handles, holes, components; a thin tube",
    "seams": "whether the seams of the first mesh show",
    "budgets": "every count from 1 to 300",
    "counts": "20 counts up to four times the input's",
    "lods": "several levels of detail at once",
    "bad": "broken files",
}
OF_MODELS = {"topology", "smooth", "crossings", "sharp", "boundary", "density", "arena", "time"}


def make_size(shape):
    return "4000" if shape in ("bracket", "plate", "lattice") else "20000"


def bars_by_default(args, name):
    """What a model has to show at 10,000 vertices without options."""
    bars = {"topology", "crossings"}
    for bar, names in {"smooth": SMOOTH, "even": SMOOTH + ROUGHER, "boundary": OPEN, "near": BESIDE_PEER,
                       "mass": WEIGHED, "arena": ["cgal-bunny00"], "time": [] if args.ci else ["cgal-bunny00"]}.items():
        bars |= {bar} if name in names else set()
    return bars


def special_cases(args, name, files, more):
    """At 10,000 vertices with options of their own."""
    def case(options, bars):
        return Case(name, *files, 10000, options + more, {"topology"} | bars)

    if args.features is None and name in SHARP:
        near = {"near"} if name == "cgal-fandisk" else set()
        yield case(["--features", "40"], {"sharp", "crossings", "small"} | near)
    if name in CURVED and not args.features:
        for gamma in ["1"] if args.ci else ["1", "2", "2.5"]:
            yield case(["--gamma", gamma, "--smooth", "10"], {"density"})
    if name in WEIGHED and args.features is None:
        yield case(["--gamma", "1.5", "--smooth", "10"], {"mass"})
        yield case(["--density", "graded"], {"mass"})


def all_cases(args, models):
    counts = args.vertices or ([1000, 10000, 20000] if args.ci else [1000, 5000, 10000, 20000])
    for name, files in models.items():
        # The seams of texture coordinates cut the triangles of a GLB apart; welding joins them, as in its twin.
        more = args.options.split() + (["--weld"] if files[0].suffix == ".glb" and "--weld" not in args.options else [])
        options = ["--features", str(args.features)] if args.features is not None else []
        if name in HANDLES:
            yield Case(name, *files, 20000, options + more, {"handles"})
            continue
        for vertices in counts:
            bars = {"topology"} if vertices != 10000 else {"topology", "crossings"}
            if vertices == 10000 and not options and not args.options:
                bars = bars_by_default(args, name)
            yield Case(name, *files, vertices, options + more, bars)
        if name in FITTED and args.features is None:
            sharp = ["--features", "40"] if name in SHARP else []
            for vertices in [v for v in counts if v in (1000, 10000)]:
                yield Case(name, *files, vertices, ["--fit"] + sharp + more,
                           {"topology", "fit"} | ({"sharp"} if sharp else set()))
        if 10000 in counts:
            yield from special_cases(args, name, files, more)


def plan(args, models, wanted):
    """Every case that is asked for. Its topology is looked at in any case."""
    asked = wanted | (OF_MODELS if "models" in wanted else set())
    cases = [case for case in all_cases(args, models) if case.bars & asked]
    for case in cases:
        case.bars = case.bars & asked | {"topology"}
        if args.ci:
            case.bars -= {bar for model, bar in MISSED_YET if model == case.model}
    return cases
