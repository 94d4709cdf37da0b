"""Whether the seams of the first mesh still show in the result. Used by check_models.py.

`isolod_seams` compares what lies within two rings of a former seam with the rest, and does the same with seams that the
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


def difference(key, found):
    """What lies near the seams less the rest; of the variations relatively."""
    near, rest = found["near"][key], found["rest"][key]
    return near / rest - 1 if key == "cell_variation" else near - rest


def judge_seams(case, found):
    """Near less rest is held against the bar, and once more after the mean of the same over the shifted seams is taken
    off: what the shape itself does near lines that run as seams run. How far those scatter is the noise of the test."""
    shifted, values, notes = found["shifted"], [], []
    for key, (name, most) in KEYS.items():
        own, others = difference(key, found), sorted(difference(key, s) for s in shifted)
        values.append((name, own, abs(own) <= most))
        values.append(("less shifted", own - mean(others), abs(own - mean(others)) <= most))
        notes.append(f"{name} {others[0]:.4f} to {others[-1]:.4f}")
    chains = sorted(s["longest_chain"] for s in shifted)
    values.append(("chain", found["longest_chain"], found["longest_chain"] <= chains[-1]))
    notes.append(f"chains {chains[0]} to {chains[-1]}")
    notes.append(f"{mean([s['following_edges'] for s in shifted]):.0f} edges follow, here {found['following_edges']}")
    return verdict_of("seams", case, values, "; shifted: " + ", ".join(notes))


def check_seams(args, models, out):
    program = Path(args.isolod).parent.parent / "seams" / "isolod_seams"
    verdicts = []
    for name, options in MODELS.items():
        if name not in models:
            continue
        case = " ".join([name, "10000"] + options)
        if not program.exists():
            verdicts.append(verdict("seams", False, case, f"there is no {program}"))
            continue
        command = [str(program), str(models[name][0]), *options, "--vertices", "10000", "--shifted", "8"]
        run = subprocess.run(command, capture_output=True, text=True)
        if run.returncode == 0:
            (out / f"seams-{name}.json").write_text(run.stdout)
            verdicts.append(judge_seams(case, json.loads(run.stdout)))
        else:
            verdicts.append(verdict("seams", False, case, run.stderr.strip()[-200:] or f"exit code {run.returncode}"))
    return verdicts
