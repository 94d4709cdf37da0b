"""Whether the seams of the first mesh still show in the result. Used by check_models.py.

`isolod_seams` compares what lies within two rings of a former seam with the rest, and with what lies beside seams that the
result never had: those of other atlases of the same surface (tools/seams says how they are made).
"""

import json
import subprocess
from pathlib import Path

from check_bars import verdict, verdict_of

MODELS = {"cgal-bunny00": [], "gpjs-kitten": [], "cgal-elephant": [], "cgal-fandisk": ["--features", "40"]}
KEYS = {"q_mean": ("Q mean", 0.003), "valence_6": ("valence 6", 1.0), "cell_variation": ("cells", 0.1)}


def mean(values):
    return sum(values) / len(values)


def difference(key, near, other):
    """Between two groups; of the variations the relative one."""
    return near[key] / other[key] - 1 if key == "cell_variation" else near[key] - other[key]


def judge_seams(case, found):
    shifted = found["shifted"]
    average = {key: mean([s["near"][key] for s in shifted]) for key in KEYS}
    values = []
    for key, (name, most) in KEYS.items():
        for words, other in (("rest", found["rest"]), ("shifted", average)):
            apart = difference(key, found["near"], other)
            values.append((f"{name} - {words}", apart, abs(apart) <= most))
    chains = sorted(s["longest_chain"] for s in shifted)
    values.append(("chain", found["longest_chain"], found["longest_chain"] <= chains[-1]))
    note = f"; along shifted seams {chains[0]} to {chains[-1]}; {found['following_edges']} edges follow, along shifted " \
           f"seams {mean([s['following_edges'] for s in shifted]):.0f}"
    return verdict_of("seams", case, values, note)


def check_seams(args, models, out):
    program = Path(args.isolod).parent.parent / "seams" / "isolod_seams"
    verdicts = []
    for name, options in MODELS.items():
        if name not in models:
            continue
        command = [str(program), str(models[name][0]), *options, *args.options.split()]
        run = subprocess.run(command + ["--shifted", "8"], capture_output=True, text=True)
        case = " ".join([name, "10000"] + options)
        if run.returncode == 0:
            (out / f"seams-{name}.json").write_text(run.stdout)
            verdicts.append(judge_seams(case, json.loads(run.stdout)))
        else:
            verdicts.append(verdict("seams", False, case, run.stderr.strip()[-200:] or f"exit code {run.returncode}"))
    return verdicts
