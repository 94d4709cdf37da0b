#!/usr/bin/env python3
"""Writes src/base/elementary_tables.h and tests/elementary_table.inc. Needs mpmath; run once, from the repository's root."""
import math
import random
import struct

from mpmath import mp, mpf

mp.prec = 400


def nearest(x):
    """The double nearest to x, ties to even, subnormals included."""
    sign, man, exp, _ = mpf(x)._mpf_
    man = int(man)
    if man == 0:
        return 0.0
    if exp >= 0:
        value = float(man << exp) if exp + man.bit_length() <= 1024 else math.inf
    else:
        try:
            value = man / (1 << -exp)
        except OverflowError:
            value = math.inf
    return -value if sign else value


def parts(x, head_bits=53):
    head = nearest(x)
    if head_bits < 53 and head != 0:
        m, e = math.frexp(head)
        head = math.ldexp(math.floor(math.ldexp(m, head_bits)), e - head_bits)
    return head, nearest(mpf(x) - mpf(head))


def literal(x):
    text = float(x).hex()
    mantissa, exponent = text.split("p")
    mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
    return "0" if x == 0 else f"{mantissa}p{int(exponent)}"


def row(x, head_bits=53):
    head, tail = parts(x, head_bits)
    return "{%s, %s}" % (literal(head), literal(tail))


def table(name, comment, values):
    rows = [row(v) for v in values]
    text = f"/// {comment}\nconstexpr Parts {name}[{len(rows)}] = {{\n"
    for i in range(0, len(rows), 2):
        text += "    " + ", ".join(rows[i:i + 2]) + ",\n"
    return text + "};\n\n"


def write_source():
    out = """// Constants of the elementary functions, each as two doubles. Written by tests/support/elementary_tables.py (mpmath).
#pragma once

#include "base/error_free.h"

namespace isolod {
inline namespace v1 {

"""
    out += f"constexpr Parts pi_parts = {row(mp.pi)};\n"
    out += f"constexpr Parts half_pi_parts = {row(mp.pi / 2)};\n\n"
    out += "/// ln 2, its head cut to 42 bits: a product with an exponent is exact.\n"
    out += f"constexpr Parts ln2_parts = {row(mp.ln(2), 42)};\n\n"
    out += "/// ln 2 / 32, its head cut to 36 bits: a product with a 17-bit integer is exact.\n"
    out += f"constexpr Parts ln2_32nd_parts = {row(mp.ln(2) / 32, 36)};\n"
    out += f"constexpr double per_ln2_32nd = {literal(nearest(32 / mp.ln(2)))};\n\n"
    out += table("exp2_parts", "2^(i/32)", [mpf(2)**(mpf(i) / 32) for i in range(32)])
    out += table("log_parts", "ln(128 / (i + 90)): the logarithm of the reciprocal of (i + 90) / 128",
                 [mp.ln(mpf(128) / (i + 90)) for i in range(93)])
    out += table("atan_parts", "atan(i/64)", [mp.atan(mpf(i) / 64) for i in range(65)])
    out += "}  // namespace v1\n}  // namespace isolod\n"
    open("src/base/elementary_tables.h", "w").write(out)


def bits(x):
    return "0x%016x" % struct.unpack("<Q", struct.pack("<d", x))[0]


def float_of(pattern):
    return struct.unpack("<d", struct.pack("<Q", pattern))[0]


def near(rng, x, ulps):
    return float_of(struct.unpack("<Q", struct.pack("<d", x))[0] + rng.randint(-ulps, ulps))


def write_tests():
    rng = random.Random(1)
    anything = lambda: float_of(rng.randrange(1, 0x7ff0000000000000))
    out = "// Arguments and correctly rounded results as bits. Written by tests/support/elementary_tables.py (mpmath).\n"

    def emit(name, rows):
        nonlocal out
        width = len(rows[0])
        kind = {2: "UnaryRow", 3: "BinaryRow"}[width]
        out += f"const {kind} {name}[] = {{\n"
        per_line = 3 if width == 2 else 2
        cells = ["{" + ", ".join(bits(v) for v in r) + "}" for r in rows]
        for i in range(0, len(cells), per_line):
            out += "    " + ", ".join(cells[i:i + per_line]) + ",\n"
        out += "};\n"

    # exponential
    xs = [0.0, 1.0, -1.0, 0.5, 709.782712893384, -708.3964185322641, -745.1332191019411, 5e-324, -5e-324, 1e-17, -1e-17]
    xs += [rng.uniform(-1, 1) for _ in range(70)] + [rng.uniform(-708, 709) for _ in range(70)]
    xs += [rng.uniform(-745, -708) for _ in range(25)] + [rng.uniform(-1, 1) * 2.0**rng.randint(-40, 0) for _ in range(25)]
    xs += [near(rng, nearest((i + mpf(1) / 2) * mp.ln(2) / 32), 2) for i in rng.sample(range(32000), 19)]
    emit("exponential_rows", [(x, nearest(mp.exp(mpf(x)))) for x in xs])
    # logarithm
    xs = [1.0, 2.0, 0.5, 10.0, 5e-324, 2.2250738585072014e-308, 1.7976931348623157e308, 1 + 2.0**-52, 1 - 2.0**-53]
    xs += [anything() for _ in range(60)] + [rng.uniform(0.5, 2) for _ in range(60)]
    xs += [1 + rng.uniform(-1, 1) * 2.0**rng.randint(-50, -6) for _ in range(50)]
    xs += [near(rng, nearest(mpf(128) / (i + 0.5)), 2) for i in rng.sample(range(91, 181), 16)]
    xs += [float_of(rng.randrange(1, 1 << 52)) for _ in range(16)]
    emit("logarithm_rows", [(x, nearest(mp.ln(mpf(x)))) for x in xs])
    # arc cosine
    xs = [0.0, 1.0, -1.0, 0.5, -0.5, 5e-324, 1 - 2.0**-53, -1 + 2.0**-53, 1e-20, nearest(1 / mp.sqrt(2))]
    xs += [rng.uniform(-1, 1) for _ in range(120)] + [1 - 2.0**rng.uniform(-53, -2) for _ in range(40)]
    xs += [2.0**rng.uniform(-53, -2) - 1 for _ in range(40)] + [rng.uniform(-1, 1) * 2.0**rng.randint(-60, 0) for _ in range(20)]
    emit("arc_cosine_rows", [(x, nearest(mp.acos(mpf(x)))) for x in xs])
    # arc tangent
    rows = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (5e-324, 5e-324), (1.7e308, 1.7e308), (1.0, 1e-300), (1e-300, 1.0),
            (5e-324, -1.0), (1e-310, 3.0), (3.0, 1e-310), (1.7e308, 1e-10), (5e-324, 1e-320), (1e-320, -5e-324)]
    sign = lambda: rng.choice((-1, 1))
    rows += [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(110)]
    for _ in range(60):
        x = 2.0**rng.uniform(-30, 30)
        rows.append((sign() * x * 2.0**rng.uniform(-60, 60), sign() * x))
    rows += [(sign() * anything(), sign() * anything()) for _ in range(20)]
    for _ in range(30):
        x = rng.uniform(1, 2)
        rows.append((near(rng, x * (rng.randrange(64) + 0.5) / 64, 2), x))
    emit("arc_tangent2_rows", [(y, x, nearest(mp.atan2(mpf(y), mpf(x)))) for y, x in rows])
    # power
    rows = [(2.0, 0.5), (10.0, 308.0), (10.0, -320.0), (1 + 2.0**-52, 2.0**58), (1 - 2.0**-53, -2.0**60), (5e-324, 0.5),
            (1.7e308, -1.0), (2.0, -1074.0), (3.0, 1e-300), (0.1, 3.0), (7.0, 0.0), (5e-324, 1.0)]
    rows += [(2.0**rng.uniform(-20, 20), rng.uniform(-4, 4)) for _ in range(90)]
    rows += [(rng.uniform(0.5, 2), rng.uniform(-600, 600)) for _ in range(50)]
    for _ in range(60):
        x = anything()
        y = float(rng.uniform(-708, 709) / mp.ln(mpf(x)))
        rows.append((x, y))
    for _ in range(20):
        x = 1 + rng.uniform(-1, 1) * 2.0**rng.randint(-30, -3)
        y = float(rng.uniform(-745, 709) / mp.ln(mpf(x)))
        rows.append((x, y))
    emit("power_rows", [(x, y, nearest(mp.exp(mpf(y) * mp.ln(mpf(x))))) for x, y in rows])
    open("tests/elementary_table.inc", "w").write(out)


if __name__ == "__main__":
    write_source()
    write_tests()
