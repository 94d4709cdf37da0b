#!/usr/bin/env python3
"""The largest chain of stack frames below any public call, from gcc's own call graph of the unity build.

    python3 tools/port/check_stack.py        the machine's own g++, and arm-none-eabi-g++ where it is there

A call through a pointer counts as the deepest function that nothing calls by name; a call through a pointer inside of
that is one of the caller's hooks, whose stack is the caller's. Recursion and frames of unknown size are failures. Ends
with `N passed, N failed`.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile

MOST_BYTES = 32 << 10
COMMON = "-std=c++17 -fno-exceptions -fno-rtti -ffp-contract=off -fno-math-errno -Iinclude -Isrc"
BOARD = "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard"
BUILDS = [
    ("g++ -O2", "g++", "-O2"),
    ("g++ -O0", "g++", "-O0"),
    ("cortex-m7 -O2", "arm-none-eabi-g++", BOARD + " -O2"),
    ("cortex-m7 -Os", "arm-none-eabi-g++", BOARD + " -Os"),
]
INDIRECT = "__indirect_call"


class Graph:
    """Frames by function, and who calls whom."""

    def __init__(self, text):
        self.frame, self.calls, self.label, self.unbounded = {}, {}, {}, []
        for title, label in re.findall(r'^node: \{ title: "([^"]*)" label: "([^"]*)"', text, re.M):
            size = re.search(r"\\n(\d+) bytes \(([^)]*)\)", label)
            self.frame[title] = int(size.group(1)) if size else 0
            self.label[title] = label.split("\\n")[0]
            if size and size.group(2) not in ("static", "dynamic,bounded"):
                self.unbounded.append(self.label[title])
        for source, target in re.findall(r'^edge: \{ sourcename: "([^"]*)" targetname: "([^"]*)"', text, re.M):
            self.calls.setdefault(source, set()).add(target)
        called = {t for source, targets in self.calls.items() for t in targets if t != source}
        self.roots = [f for f in self.frame if f not in called]
        self.cycles, self.known = [], {}

    def depth(self, function, hooks, path=()):
        """Bytes of the deepest chain from this function on, and the chain. `hooks`: pointers lead to the caller."""
        if (function, hooks) in path:
            self.cycles.append(self.label.get(function, function))
            return 0, ()
        if (function, hooks) in self.known:
            return self.known[function, hooks]
        best = (0, ())
        for target in sorted(self.calls.get(function, ())):
            if target == INDIRECT:
                below = (0, ()) if hooks else max(self.depth(r, True, path + ((function, hooks),)) for r in self.roots)
            else:
                below = self.depth(target, hooks, path + ((function, hooks),))
            best = max(best, below)
        result = (self.frame.get(function, 0) + best[0], (function,) + best[1])
        self.known[function, hooks] = result
        return result


def judge(name, compiler, flags):
    """The faults of one build as a list, after its deepest chain is printed."""
    with tempfile.TemporaryDirectory() as folder:
        command = [compiler, *flags.split(), *COMMON.split(), "-fcallgraph-info=su", "-c", "src/isolod.cpp"]
        subprocess.run([*command, "-o", os.path.join(folder, "isolod.o")], check=True)
        with open(os.path.join(folder, "isolod.ci"), encoding="utf-8") as file:
            graph = Graph(file.read())
    if len(graph.frame) < 100:
        return ["no call graph"]
    deepest, chain = max(graph.depth(root, False) for root in graph.roots)
    print(f"{name}: {deepest} bytes in {len(chain)} frames; the largest of them:")
    for function in sorted(chain, key=lambda f: -graph.frame.get(f, 0))[:4]:
        print(f"  {graph.frame.get(function, 0):6d}  {graph.label.get(function, function)[:100]}")
    faults = [f"recursion through {f}" for f in sorted(set(graph.cycles))]
    faults += [f"a frame of unknown size: {f}" for f in graph.unbounded]
    if deepest > MOST_BYTES:
        faults.append(f"{deepest} bytes, more than {MOST_BYTES}")
    return faults


def main():
    os.chdir(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
    passed = failed = 0
    for name, compiler, flags in BUILDS:
        if shutil.which(compiler) is None:
            print(f"--  {name}: no {compiler} here")
            continue
        faults = judge(name, compiler, flags)
        passed, failed = passed + (not faults), failed + bool(faults)
        print(f"BAD {name}: " + "; ".join(faults) if faults else f"ok  {name}")
    print(f"{passed} passed, {failed} failed")
    return 0 if failed == 0 and passed > 0 else 1


if __name__ == "__main__":
    sys.exit(main())
