"""CGAL's isotropic remeshing of the same file, for the distances to compare with. Used by check_case.py.

A small program beside the project drives it (peers/cgal_iso.cpp: cgal_iso IN.obj OUT.obj EDGE_LENGTH ITERATIONS PROTECT
SHARP_ANGLE); it is compiled where CGAL's headers are found. Without it nothing is compared.
"""

import os
import subprocess
from math import sqrt
from pathlib import Path

from check_density import cross, dot, minus, read_mesh


def find_peer(args, out):
    """The program, or None with a line that says why nothing is compared."""
    source = Path(args.data) / "peers" / "cgal_iso.cpp"
    program = Path(args.peer) if args.peer else out / "cgal_iso"
    if not program.exists() and not args.peer and source.exists():
        command = [os.environ.get("CXX", "c++"), "-O3", "-DNDEBUG", "-std=c++17", str(source), "-o", str(program)]
        subprocess.run(command + ["-lgmp", "-lmpfr"], stderr=subprocess.DEVNULL)
    if program.exists():
        return program.resolve()
    print("CGAL's program cannot be had here (--peer PATH): no distances are compared with it")
    return None


def write_obj(path, positions, triangles):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in positions]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n")


def count_vertices(path):
    with open(path) as file:
        return sum(line.startswith("v ") for line in file)


def peer_remesh(program, original, vertices, out):
    """The other program's result of nearly so many vertices: the edge length is corrected up to eight times, until they
    are within 0.3 %, and the nearest is taken. None where the program fails."""
    source, result, best = (out / f"{original.stem}-peer{ending}.obj" for ending in ("-in", "-try", ""))
    positions, triangles = read_mesh(original)
    write_obj(source, positions, triangles)
    area = 0.0
    for a, b, c in triangles:
        normal = cross(minus(positions[b], positions[a]), minus(positions[c], positions[a]))
        area += sqrt(dot(normal, normal)) / 2
    length, off = 1.1 * sqrt(2 * area / (sqrt(3) * vertices)), None
    for _ in range(8):
        command = [str(program), str(source), str(result), repr(length), "10", "0", "180"]
        if subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode != 0:
            return None
        found = count_vertices(result)
        if off is None or abs(found - vertices) < off:
            off = abs(found - vertices)
            result.replace(best)
        if off <= 0.003 * vertices:
            break
        length *= sqrt(found / vertices)
    return best
