"""The density that was wished for, computed apart from the library. Used by check_models.py.

For `--gamma G --smooth N`: mean curvature after Meyer, Desbrun, Schroeder and Barr (2003): the normal component of half
the cotangent sum over the mixed area, free of scale by the diagonal, held in [1, 256], to the power gamma; then N
averagings over faces by area.
Only for models without kept lines, where a vertex has one value.
"""

from math import dist, sqrt


def read_mesh(path):
    """Positions and triangles of an OFF or OBJ file of plain polygons."""
    positions, faces = [], []
    with open(path) as file:
        if str(path).endswith(".obj"):
            for line in file:
                word = line.split()
                if word and word[0] == "v":
                    positions.append(tuple(map(float, word[1:4])))
                elif word and word[0] == "f":
                    faces.append([int(w.split("/")[0]) - 1 for w in word[1:]])
        else:
            numbers = iter([w for line in file for w in line.split("#")[0].split()][1:])
            vertex_count, face_count, _ = (int(next(numbers)) for _ in range(3))
            positions = [tuple(float(next(numbers)) for _ in range(3)) for _ in range(vertex_count)]
            faces = [[int(next(numbers)) for _ in range(int(next(numbers)))] for _ in range(face_count)]
    return positions, [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def curvatures(positions, triangles):
    """The absolute mean curvature of each vertex; 0 where it has no triangles."""
    laplace = [[0.0] * 3 for _ in positions]
    normal = [[0.0] * 3 for _ in positions]
    mixed = [0.0] * len(positions)
    for triangle in triangles:
        p = [positions[v] for v in triangle]
        face_normal = cross(minus(p[1], p[0]), minus(p[2], p[0]))
        double_area = sqrt(dot(face_normal, face_normal))
        if double_area == 0:
            continue
        cosine = [dot(minus(p[(k + 1) % 3], p[k]), minus(p[(k + 2) % 3], p[k])) for k in range(3)]
        for k in range(3):
            v, a, b = triangle[k], (k + 1) % 3, (k + 2) % 3
            for i in range(3):  # the angle opposite to each of the two edges weighs it
                laplace[v][i] += (cosine[b] * (p[a][i] - p[k][i]) + cosine[a] * (p[b][i] - p[k][i])) / (2 * double_area)
                normal[v][i] += face_normal[i]
            if cosine[k] < 0:
                mixed[v] += double_area / 4
            elif cosine[a] < 0 or cosine[b] < 0:
                mixed[v] += double_area / 8
            else:
                mixed[v] += (cosine[b] * dist(p[a], p[k]) ** 2 + cosine[a] * dist(p[b], p[k]) ** 2) / (8 * double_area)
    result = []
    for part, direction, area in zip(laplace, normal, mixed):
        scale = sqrt(dot(direction, direction)) * area
        result.append(abs(dot(part, direction)) / (2 * scale) if scale > 0 else 0.0)
    return result


def smooth(values, triangles, areas):
    mass, area = [0.0] * len(values), [0.0] * len(values)
    for triangle, weight in zip(triangles, areas):
        mean = (values[triangle[0]] + values[triangle[1]] + values[triangle[2]]) / 3
        for v in triangle:
            mass[v] += weight * mean
            area[v] += weight
    return [m / a if a > 0 else value for m, a, value in zip(mass, area, values)]


def wished_density(path, gamma, passes):
    """One number for each vertex of the file."""
    positions, triangles = read_mesh(path)
    used = [positions[v] for v in {v for t in triangles for v in t}]
    bounds = box(used)
    diagonal = dist(bounds[:3], bounds[3:])
    values = [min(256.0, max(1.0, diagonal * c)) ** gamma for c in curvatures(positions, triangles)]
    areas = []
    for a, b, c in triangles:
        n = cross(minus(positions[b], positions[a]), minus(positions[c], positions[a]))
        areas.append(sqrt(dot(n, n)) / 2)
    for _ in range(passes):
        values = smooth(values, triangles, areas)
    return values


def box(positions):
    return [pick(p[i] for p in positions) for pick in (min, max) for i in range(3)]


def graded_density(path, ratio=16):
    """Grows by this ratio from one end of the model to the other, evenly in its logarithm, along its longest side."""
    positions, _ = read_mesh(path)
    bounds = box(positions)
    sides = [bounds[3 + i] - bounds[i] for i in range(3)]
    axis = next(i for i in range(3) if sides[i] >= 0.999 * max(sides))
    return [ratio ** ((p[axis] - bounds[axis]) / sides[axis]) for p in positions]


def write_density(path, values):
    path.write_text("\n".join(map(repr, values)) + "\n")
