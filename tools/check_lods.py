"""Several levels of detail from one run: each exact and valid, and what they cost beside separate runs. Used by
check_models.py."""

import resource

from check_bars import verdict, verdict_of
from check_budgets import Budgets
from check_case import run_limited

COUNTS = [20000, 5000, 1250, 300]
MODELS = {"cgal-bunny00": [], "cgal-fandisk": ["--features", "40"], "cgal-mushroom": []}
TIMED = "cgal-bunny00"
MOST_TIME = 0.6


def processor_seconds(command):
    """What a program took of the processor, so that a busy machine changes little; it must end well."""
    def spent():
        used = resource.getrusage(resource.RUSAGE_CHILDREN)
        return used.ru_utime + used.ru_stime

    before = spent()
    code, errors, _ = run_limited(command, 600)
    if code != 0:
        raise RuntimeError(f"exit code {code}: {errors.strip()[-200:]}")
    return spent() - before


class Chain:
    """A model with its options, remeshed to all counts at once and to each alone."""

    def __init__(self, args, name, files, options, out):
        self.path, self.stem = files[0], out / f"lods-{name}"
        self.isolod, self.options = args.isolod, options + args.options.split()
        self.judge = Budgets(args, name, files, out)

    def command(self, word, vertices, result):
        return [self.isolod, word, str(self.path), "--vertices", vertices, *self.options, "--quiet", "-o", str(result)]

    def level(self, vertices):
        return self.stem.with_name(f"{self.stem.name}-{vertices}.off")

    def at_once(self):
        for vertices in COUNTS:
            self.level(vertices).unlink(missing_ok=True)
        return processor_seconds(self.command("lods", ",".join(map(str, COUNTS)), self.stem.with_suffix(".off")))

    def one_by_one(self):
        alone = self.stem.with_name(self.stem.name + "-alone.off")
        return [processor_seconds(self.command("remesh", str(vertices), alone)) for vertices in COUNTS]

    def faults(self):
        found = {vertices: self.judge.look_at(self.level(vertices), vertices)[1] for vertices in COUNTS}
        return [f"{vertices}: {what}" for vertices, what in found.items() if what]


def judge_chain(args, name, chain):
    case = " ".join([name, *chain.options])
    at_once = [chain.at_once()]
    faults = chain.faults()
    verdicts = [verdict("lods", not faults, case, "; ".join(faults) or f"{', '.join(map(str, COUNTS))} exact", True)]
    if name != TIMED:
        return verdicts
    alone = [chain.one_by_one()]
    for _ in range(0 if args.ci else 6):  # in turn, so that all meet the same machine; the least of each run counts
        at_once.append(chain.at_once())
        alone.append(chain.one_by_one())
    together, apart = min(at_once), sum(min(times) for times in zip(*alone))
    share = together / apart
    note = f": {together:.2f} s at once, {apart:.2f} s one by one" + (", not judged" if args.ci else "")
    return verdicts + [verdict_of("lods", case, [("share of the time", share, args.ci or share <= MOST_TIME)], note)]


def check_lods(args, models, out):
    verdicts = []
    for name, options in MODELS.items():
        if name not in models:
            continue
        try:
            verdicts += judge_chain(args, name, Chain(args, name, models[name], options, out))
        except RuntimeError as failure:
            verdicts.append(verdict("lods", False, name, str(failure)))
    return verdicts
