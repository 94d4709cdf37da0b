"""main.py LIBRARY.so FILE.off HASH: the C interface from Python, by ctypes alone."""

import ctypes as c
import sys


class Mesh(c.Structure):
    _fields_ = [("struct_size", c.c_uint32), ("position_type", c.c_int32), ("positions", c.c_void_p),
                ("vertex_count", c.c_size_t), ("position_stride", c.c_size_t), ("indices", c.c_void_p),
                ("triangle_count", c.c_size_t), ("index_type", c.c_int32), ("reserved", c.c_uint32),
                ("vertex_density", c.c_void_p), ("corner_density", c.c_void_p), ("tagged_edges", c.c_void_p),
                ("tagged_edge_count", c.c_size_t), ("tagged_edge_density", c.c_void_p),
                ("triangle_materials", c.c_void_p)]


class Options(c.Structure):
    _fields_ = [("struct_size", c.c_uint32), ("vertex_count", c.c_uint32), ("feature_angle", c.c_double),
                ("corner_angle", c.c_double), ("density", c.c_int32), ("reserved", c.c_int32), ("gamma", c.c_double)]
    # The rest keep their defaults: a caller that knows fewer members is an older one to the library.


Progress = c.CFUNCTYPE(c.c_int32, c.c_void_p, c.c_char_p, c.c_double)


class Work(c.Structure):
    _fields_ = [("struct_size", c.c_uint32), ("reserved", c.c_uint32), ("block", c.c_void_p),
                ("block_bytes", c.c_size_t), ("progress", Progress), ("progress_context", c.c_void_p)]


class Output(c.Structure):
    _fields_ = [("positions", c.c_void_p), ("vertex_capacity", c.c_size_t), ("triangles", c.c_void_p),
                ("triangle_capacity", c.c_size_t), ("vertex_count", c.c_size_t), ("triangle_count", c.c_size_t),
                ("hash", c.c_uint64)]


def read_off(path):
    words = open(path).read().split("#")[0].split()
    vertices, triangles = int(words[1]), int(words[2])
    numbers = words[4:]
    corners = numbers[3 * vertices:3 * vertices + 4 * triangles]
    return ((c.c_double * (3 * vertices))(*map(float, numbers[:3 * vertices])),
            (c.c_uint32 * (3 * triangles))(*(int(w) for k, w in enumerate(corners) if k % 4)))


def init(function, struct):
    if function(c.byref(struct), c.c_size_t(c.sizeof(struct))) != 0:
        sys.exit("a struct was refused")
    return struct


def main(library, path, wished):
    isolod = c.CDLL(library)
    isolod.isolod_required_memory.restype = c.c_size_t
    isolod.isolod_status_message.restype = c.c_char_p
    positions, triangles = read_off(path)
    stages = []
    mesh, options = init(isolod.isolod_mesh_init, Mesh()), init(isolod.isolod_options_init, Options())
    work = init(isolod.isolod_work_init, Work())
    mesh.positions, mesh.vertex_count = c.addressof(positions), len(positions) // 3
    mesh.indices, mesh.triangle_count = c.addressof(triangles), len(triangles) // 3
    options.vertex_count = 60
    size = isolod.isolod_required_memory(c.c_size_t(mesh.vertex_count), c.c_size_t(mesh.triangle_count),
                                         c.byref(options))
    block = (c.c_ubyte * size)()
    work.block, work.block_bytes = c.addressof(block), size
    work.progress = Progress(lambda context, stage, share: stages.append(stage) or 1)
    xyz, corners = (c.c_double * 180)(), (c.c_uint32 * 360)()
    output = Output(c.addressof(xyz), 60, c.addressof(corners), 120)
    status = isolod.isolod_remesh(c.byref(mesh), c.byref(options), c.byref(work), c.byref(output), None)
    if status != 0:
        sys.exit(isolod.isolod_status_message(status).decode())
    if output.vertex_count != 60 or not stages or max(corners[:3 * output.triangle_count]) != 59:
        sys.exit("not the mesh that was asked for")
    if f"{output.hash:016x}" != wished:
        sys.exit(f"another hash: {output.hash:016x}")
    print(f"ok: {wished}")


main(*sys.argv[1:])
