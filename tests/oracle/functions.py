#!/usr/bin/env python3
"""Write tests/data/functions/{real,complex}_edges.tsv: every elementary function where it is hardest.

usage: functions.py [OUT_DIR]      (needs mpmath and numpy; default OUT_DIR: ../data/functions beside this file)

Finite arguments: mpmath with 480 digits. A zero among the arguments is replaced by ±1e-150, so that the sign of a
zero picks the side of a branch cut, and the sign of a vanishing result is that of the limit, as C99 Annex F and G
ask. Infinities and NaN: real functions by the tables of Annex F below, complex ones from the C library through
numpy, with the signs that Annex G leaves open written as `±`. README.md beside this file has the format.
"""
import math
import os
import struct
import sys

import mpmath as mp
import numpy as np

mp.mp.dps = 480
SIDE = mp.mpf(10) ** -150
STEP = mp.mpf(10) ** -200
SMALL, LARGE = mp.mpf(10) ** -60, mp.mpf(10) ** 45
NOTHING = mp.mpf(10) ** -46  # below half the least float32: a zero, also where the cube root of SIDE stands for one
MAX, TINY = mp.mpf(2) ** 128 * (1 - mp.mpf(2) ** -25), mp.mpf(2) ** -126
INF, NAN = math.inf, math.nan


def f32(v):
    """The nearest float32, as a float."""
    return struct.unpack("f", struct.pack("f", v))[0]


def up(v, n=1):
    """The float32 n steps above v > 0."""
    return struct.unpack("f", struct.pack("I", struct.unpack("I", struct.pack("f", v))[0] + n))[0]


def negative(v):
    return math.copysign(1, v) < 0


def smear(v):
    return (-SIDE if negative(v) else SIDE) if v == 0 else mp.mpf(v)


def show(v):
    """A number as 20 digits; an overflow of float32 as an infinity; a smeared zero with its sign."""
    if isinstance(v, str):
        return v
    if isinstance(v, float):
        return "nan" if math.isnan(v) else repr(v)
    if mp.isnan(v):
        return "nan"
    if abs(v) >= MAX:
        return "inf" if v > 0 else "-inf"
    if abs(v) < NOTHING:
        return "-0.0" if v < 0 else "0.0"
    return mp.nstr(v, 20)


def remark(values):
    finite = [v for v in values if not isinstance(v, (str, float)) and mp.isfinite(v)]
    if any(abs(v) >= MAX for v in finite):
        return "overflow"
    return "underflow" if any(NOTHING <= abs(v) < TINY for v in finite) else "-"


def line(*cells):
    return "\t".join(cells) + "\n"


# ------------------------------------------------------------------------------------------------------------------
# Real functions: name -> (function, where it is defined, values at inf, -inf).
everywhere = lambda x: True
sinc = lambda x: mp.sin(x) / x if x else mp.mpf(1)
sinhc = lambda x: mp.sinh(x) / x if x else mp.mpf(1)
exprel = lambda x: mp.expm1(x) / x if x else mp.mpf(1)
cbrt = lambda x: mp.sign(x) * mp.cbrt(abs(x))
pole = lambda x: x < 0 and x == mp.floor(x)
REAL = {
    "exp": (mp.exp, everywhere, INF, 0.0),
    "expm1": (mp.expm1, everywhere, INF, -1.0),
    "exp2": (lambda x: mp.exp(x * mp.log(2)), everywhere, INF, 0.0),
    "log": (mp.log, lambda x: x > 0, INF, NAN),
    "log2": (lambda x: mp.log(x) / mp.log(2), lambda x: x > 0, INF, NAN),
    "log10": (lambda x: mp.log(x) / mp.log(10), lambda x: x > 0, INF, NAN),
    "log1p": (mp.log1p, lambda x: x > -1, INF, NAN),
    "sqrt": (mp.sqrt, lambda x: x >= 0, INF, NAN),
    "cbrt": (cbrt, everywhere, INF, -INF),
    "sin": (mp.sin, everywhere, NAN, NAN),
    "cos": (mp.cos, everywhere, NAN, NAN),
    "tan": (mp.tan, everywhere, NAN, NAN),
    "asin": (mp.asin, lambda x: abs(x) <= 1, NAN, NAN),
    "acos": (mp.acos, lambda x: abs(x) <= 1, NAN, NAN),
    "atan": (mp.atan, everywhere, mp.pi / 2, -mp.pi / 2),
    "sinh": (mp.sinh, everywhere, INF, -INF),
    "cosh": (mp.cosh, everywhere, INF, INF),
    "tanh": (mp.tanh, everywhere, 1.0, -1.0),
    "asinh": (mp.asinh, everywhere, INF, -INF),
    "acosh": (mp.acosh, lambda x: x >= 1, INF, NAN),
    "atanh": (mp.atanh, lambda x: abs(x) < 1, NAN, NAN),
    "abs": (abs, everywhere, INF, INF),
    "gamma": (mp.gamma, lambda x: not pole(x), INF, NAN),
    "digamma": (mp.digamma, lambda x: not pole(x), INF, NAN),
    "sinc": (sinc, everywhere, 0.0, 0.0),
    "sinhc": (sinhc, everywhere, INF, INF),
    "exprel": (exprel, everywhere, INF, 0.0),
    "lgamma": (lambda x: mp.log(abs(mp.gamma(x))), lambda x: not pole(x), INF, INF),
    "trigamma": (lambda x: mp.polygamma(1, x), lambda x: not pole(x), 0.0, NAN),
    "sec": (lambda x: 1 / mp.cos(x), everywhere, NAN, NAN),
    "csc": (lambda x: 1 / mp.sin(x), everywhere, NAN, NAN),
    "sech": (lambda x: 1 / mp.cosh(x), everywhere, 0.0, 0.0),
    "csch": (lambda x: 1 / mp.sinh(x), everywhere, 0.0, -0.0),
    "neg": (lambda x: -x, everywhere, -INF, INF),
    "square": (lambda x: x * x, everywhere, INF, INF),
    "cube": (lambda x: x * x * x, everywhere, INF, -INF),
    "pow7": (lambda x: x**7, everywhere, INF, -INF),
    "inverse": (lambda x: 1 / x, everywhere, 0.0, -0.0),
    "inverse_square": (lambda x: 1 / x**2, everywhere, 0.0, 0.0),
    "conj": (lambda x: x, everywhere, INF, -INF),
    "re": (lambda x: x, everywhere, INF, -INF),
    "im": (lambda x: mp.mpf(0), everywhere, 0.0, 0.0),
    "arg": (lambda x: mp.pi if x < 0 else mp.mpf(0), everywhere, 0.0, mp.pi),
}
# Values that no limit of the function on its domain gives.
AT = {("log1p", -1.0): -INF, ("atanh", 1.0): INF, ("atanh", -1.0): -INF}
for name in ("log", "log2", "log10"):
    AT[name, -0.0] = -INF
COMMON = [0.0, 2.0**-149, 2.0**-126, 1e-30, 1e-10, 1e-4, 0.5, 1.0, up(1.0), 1 - 2.0**-24, 2.0, 10.0, 1e10, 1e20, 3e38]
HALF_PI, PI = f32(math.pi / 2), f32(math.pi)
EXTRA = {
    "exp": [88.72283, 88.72284, -87.33654, -87.4, -103.9, -104.1], "expm1": [88.72283, 88.73, -17.5, -88.0],
    "exp2": [127.0, 128.0, -126.0, -127.0, -149.0, 0.1, 23.5], "log1p": [-1.0, -1 + 2.0**-24, -0.5],
    "sin": [PI, 2 * PI, 11.0 * PI, 355.0], "cos": [HALF_PI, 3 * HALF_PI, 11.0], "tan": [HALF_PI, up(HALF_PI), 3 * HALF_PI, PI],
    "sec": [HALF_PI, 3 * HALF_PI, PI], "csc": [HALF_PI, PI, 11.0 * PI, 355.0], "sech": [86.0, 89.5, 9.0], "csch": [86.0, 89.5, 9.0],
    "sinh": [88.72283, 89.4, 89.5], "cosh": [88.72283, 89.4, 89.5], "tanh": [9.0, 20.0, 89.0], "cbrt": [27.0, 8.0],
    "asin": [-1 + 2.0**-24], "acos": [-1 + 2.0**-24], "acosh": [up(1.0, 4), 1.5], "atanh": [-1 + 2.0**-24],
    "gamma": [-0.5, -1.0, -2.0, up(1.0), -1 - 2.0**-23, -1 + 2.0**-24, 5.0, 34.0, 35.0, 35.1, -33.5, -40.5],
    "lgamma": [-0.5, -1.0, -2.0, -1 - 2.0**-23, up(1.0), 3.0, 35.0, -3.5, -2.4570248, 1e-3],
    "trigamma": [-0.5, -1.0, -2.0, -1 - 2.0**-23, 0.1, 5.0, 35.0, -3.5],
    "cube": [-2.0, 7e12, -7e12], "pow7": [-2.0, 1.5, 3e5], "inverse": [3.0, -7.0], "inverse_square": [3.0, -7.0],
    "digamma": [-0.5, -1.0, -2.0, -1 - 2.0**-23, f32(1.4616321449683622), up(1.4616321), 5.0], "sinc": [PI, f32(4.4934095), 2 * PI],
    "sinhc": [0.99, 1.01, 19.9, 20.1, 88.72283, 89.5, 92.0, 94.5], "exprel": [-0.99, 0.99, 19.9, 20.1, -17.5, -88.0, 88.73, 92.0, 93.5],
}


def one_sided(fn, defined, x):
    """fn'(x) from the sides on which fn is defined; None where there is none."""
    h = STEP * max(abs(x), mp.mpf(10) ** -10)
    inside = lambda t: defined(t)
    found = [(fn(x + s * h) - fn(x)) / (s * h) for s in (1, -1) if inside(x + s * h)]
    if not found or any(abs(d) > mp.mpf(10) ** 40 * (1 + abs(fn(x))) for d in found):
        return mp.inf if found and all(d > LARGE for d in found) else -mp.inf if found and all(d < -LARGE for d in found) else None
    if len(found) == 2 and abs(found[0] - found[1]) > SMALL * (abs(found[0]) + abs(found[1])) + mp.mpf(10) ** -100:
        return None
    return sum(found) / len(found)


def real_row(name, x):
    fn, defined, at_inf, at_minus_inf = REAL[name]
    if math.isnan(x) or math.isinf(x):
        value = 0.0 if name == "im" else NAN if math.isnan(x) else at_inf if x > 0 else at_minus_inf
        return value, "-", "special"
    key = (name, x) if x else (name, -0.0 if negative(x) else 0.0)
    if key in AT and (x or negative(x)):
        return AT[key], "-", "pole"
    if name == "lgamma" and x == 0:
        return INF, "-", "pole"
    if name == "sqrt" and x == 0:
        return x, "-" if negative(x) else "inf", "-"
    z = smear(x)
    if not defined(z):
        at_pole = {"gamma": NAN, "digamma": NAN, "lgamma": INF, "trigamma": INF}
        return at_pole.get(name, NAN), "-", "pole" if name in at_pole else "domain"
    value = fn(z)
    if abs(value) > LARGE and x == 0 or (name.startswith("log") and x == 0 and name != "log1p"):
        return (INF if value > 0 else -INF), "-", "pole"
    slope = one_sided(fn, defined, z)
    if name in ("abs", "arg") and x == 0:
        slope = None
    return value, "-" if slope is None else "inf" if slope > LARGE else "-inf" if slope < -LARGE else slope, remark([value])


STEPS = {
    "floor": (math.floor, "0.0"), "ceil": (math.ceil, "0.0"), "trunc": (math.trunc, "0.0"),
    "round": (lambda x: math.copysign(math.floor(abs(x) + 0.5), x), "0.0"), "sign": (lambda x: (x > 0) - (x < 0), "0.0"),
    "fract": (lambda x: mp.mpf(x) - math.floor(x), "1.0"),
}
STEP_POINTS = [0.0, 2.0**-126, 1e-9, 0.25, 0.5, 0.75, 1 - 2.0**-24, 1.0, 1.5, 2.0, 2.5, 8388607.5, 16777216.0, 1e10, 3e38]


def step_rows(name):
    fn, slope = STEPS[name]
    for x in [s * p for p in map(f32, STEP_POINTS) for s in (1, -1)]:
        value = fn(x)
        jump = name in ("floor", "ceil", "fract") and x == math.floor(x) or name == "trunc" and x and x == math.floor(x) or name == "sign" and x == 0 or name == "round" and abs(x) % 1 == 0.5
        if name not in ("fract", "sign") and value == 0:
            value = math.copysign(0.0, x)
        notes = "tie" if name == "round" and jump else "below-one" if name == "fract" and f32(float(value)) == 1.0 else "-"
        yield x, mp.mpf(value) if value else float(value), "-" if jump else slope, notes
    for x in (INF, -INF, NAN):
        value = NAN if math.isnan(x) or name == "fract" else math.copysign(1.0, x) if name == "sign" else x
        yield x, value, "-", "special"


def write_real(out):
    with open(os.path.join(out, "real_edges.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# edges of the real functions; written by tests/oracle/functions.py\n")
        fh.write("# " + line("function", "x", "y", "value", "dx", "dy", "notes"))
        for name in REAL:
            xs = [s * x for x in COMMON for s in (1, -1)] + EXTRA.get(name, []) + [INF, -INF, NAN]
            for x in dict((repr(f32(x)), f32(x)) for x in xs).values():
                value, slope, notes = real_row(name, x)
                fh.write(line(name, show(x), "-", show(value), show(slope), "-", notes))
        for name in STEPS:
            for x, value, slope, notes in step_rows(name):
                fh.write(line(name, show(x), "-", show(value), slope, "-", notes))
        for name, rows in (("hypot", hypot_rows()), ("atan2", atan2_rows()), ("pow", pow_rows()), ("mod", mod_rows()), *((n, arithmetic_rows(n)) for n in ARITHMETIC), ("min", min_rows(min)), ("max", min_rows(max))):
            for x, y, value, dx, dy, notes in rows:
                fh.write(line(name, show(f32(x)), show(f32(y)), show(value), show(dx), show(dy), notes))


def hypot_rows():
    for x, y in [(3.0, 4.0), (-3.0, 4.0), (1e20, 1e20), (3e38, 1e20), (3e38, 3e38), (1e-30, 1e-30), (2.0**-126, 2.0**-126), (2.0**-149, 0.0), (1.0, 1e-20), (-1.0, 0.0), (0.0, -2.0)]:
        a, b = mp.mpf(f32(x)), mp.mpf(f32(y))
        r = mp.hypot(a, b)
        yield x, y, r, a / r, b / r, remark([r])
    for x, y in [(0.0, 0.0), (-0.0, 0.0), (-0.0, -0.0)]:
        yield x, y, 0.0, "-", "-", "kink"
    for x, y in [(INF, 1.0), (-INF, 1.0), (1.0, -INF), (INF, NAN), (NAN, -INF), (INF, INF)]:
        yield x, y, INF, "-", "-", "special"
    for x, y in [(NAN, 1.0), (0.0, NAN), (NAN, NAN)]:
        yield x, y, NAN, "-", "-", "special"


def atan2_rows():
    """atan2(x, y): x is the ordinate here, as the first argument."""
    for y, x in [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0), (1e-30, -1.0), (-1e-30, -1.0), (3e38, 3e38), (-3e38, 1e-30), (2.0**-126, 2.0**-126), (1e20, 1e-20), (1e-20, 1e20), (2.0**-149, 3e38)]:
        a, b = mp.mpf(f32(y)), mp.mpf(f32(x))
        q = a * a + b * b
        v = mp.atan2(a, b)
        yield y, x, v, b / q, -a / q, remark([v])
    for y, x in [(0.0, 1.0), (-0.0, 1.0), (0.0, -1.0), (-0.0, -1.0), (1.0, 0.0), (1.0, -0.0), (-1.0, 0.0), (-1.0, -0.0)]:
        v = mp.atan2(smear(y), smear(x))
        cut = y == 0 and x < 0
        yield y, x, v, (mp.mpf(1) / x if y == 0 else 0.0), (mp.mpf(-1) / y if x == 0 else 0.0), "cut" if cut else "-"
    for y in (0.0, -0.0):
        for x in (0.0, -0.0):
            yield y, x, math.copysign(0.0, y) if not negative(x) else mp.pi * math.copysign(1, y), "-", "-", "pole"
    for y, x in [(INF, 1.0), (-INF, 1.0), (INF, INF), (INF, -INF), (-INF, INF), (-INF, -INF), (1.0, INF), (-1.0, INF), (1.0, -INF), (-1.0, -INF), (0.0, INF), (-0.0, -INF)]:
        quarter = {(True, False): mp.pi / 2, (True, True): mp.pi / 4 if x > 0 else 3 * mp.pi / 4, (False, True): 0.0 if x > 0 else +mp.pi}
        v = quarter[math.isinf(y), math.isinf(x)]
        yield y, x, (math.copysign(0.0, y) if v == 0 else v * math.copysign(1, y)), "-", "-", "special"
    for y, x in [(NAN, 1.0), (1.0, NAN), (NAN, NAN), (NAN, INF)]:
        yield y, x, NAN, "-", "-", "special"


def pow_rows():
    for x, y in [(2.0, 10.0), (2.0, -3.0), (2.0, 0.5), (10.0, 38.0), (10.0, 39.0), (10.0, -37.0), (10.0, -44.0), (up(1.0), 1e7), (1 - 2.0**-24, 1e9), (1e-30, 1.25), (3e38, 1.0), (3e38, -1.0), (3e38, 0.5), (2.0**-149, 0.5), (1.0, 1e20), (1.0, 3e38), (2.0, 1e10), (0.5, 1e10), (7.0, 0.0), (1.0, 0.0)]:
        a, b = mp.mpf(f32(x)), mp.mpf(f32(y))
        v = mp.power(a, b) if abs(b) < 1e30 else mp.mpf(1)
        yield x, y, v, b * v / a, v * mp.log(a), remark([v])
    for x, y in [(-2.0, 3.0), (-2.0, 2.0), (-2.0, -1.0), (-2.0, -2.0), (-1.0, 16777216.0), (-1.0, 16777215.0), (-1.5, 7.0), (-10.0, 39.0), (-3.0, 0.0), (-3e38, 1.0)]:
        a, b = mp.mpf(f32(x)), mp.mpf(f32(y))
        v = mp.power(a, int(b))
        yield x, y, v, (b * mp.power(a, int(b) - 1) if b else 0.0), "-", remark([v])
    for x, y in [(-2.0, 0.5), (-1e-30, 1.5), (-3e38, 0.25)]:
        yield x, y, NAN, "-", "-", "domain"
    for x, y, v, dx, dy in [
        (0.0, 0.0, 1.0, "0.0", "-"), (-0.0, 0.0, 1.0, "0.0", "-"), (0.0, 1.0, 0.0, "1.0", "0.0"), (-0.0, 1.0, -0.0, "1.0", "-"),
        (0.0, 2.0, 0.0, "0.0", "0.0"), (-0.0, 2.0, 0.0, "-0.0", "-"), (-0.0, 3.0, -0.0, "0.0", "-"), (0.0, 3.0, 0.0, "0.0", "0.0"),
        (0.0, 0.5, 0.0, "inf", "0.0"), (-0.0, 0.5, 0.0, "-", "-"), (0.0, 1.5, 0.0, "0.0", "0.0"),
    ]:
        yield x, y, v, dx, dy, "-"
    for x, y, v in [(0.0, -1.0, INF), (-0.0, -1.0, -INF), (0.0, -2.0, INF), (-0.0, -2.0, INF), (0.0, -0.5, INF), (-0.0, -0.5, INF)]:
        yield x, y, v, "-", "-", "pole"
    specials = [
        (0.0, INF, 0.0), (0.0, -INF, INF), (0.5, INF, 0.0), (0.5, -INF, INF), (2.0, INF, INF), (2.0, -INF, 0.0), (1.0, INF, 1.0), (-1.0, INF, 1.0),
        (-1.0, -INF, 1.0), (INF, 2.0, INF), (INF, -2.0, 0.0), (-INF, 3.0, -INF), (-INF, 2.0, INF), (-INF, -3.0, -0.0), (-INF, -2.0, 0.0),
        (INF, 0.0, 1.0), (-INF, 0.0, 1.0), (NAN, 0.0, 1.0), (1.0, NAN, 1.0), (NAN, 1.0, NAN), (2.0, NAN, NAN), (NAN, NAN, NAN),
    ]
    for x, y, v in specials:
        assert repr(v) == repr(math.pow(x, y)), (x, y, v)
        yield x, y, v, "-", "-", "special"


def mod_rows():
    for x, y in [(5.0, 3.0), (-5.0, 3.0), (5.0, -3.0), (-5.0, -3.0), (5.5, 2.0), (-1e-9, 1.0), (1e10, 3.0), (1e20, 7.0), (3e38, 7.0), (1e10, 0.1), (0.5, 3e38), (-0.5, 3e38), (2.0**-126, 1.0)]:
        a, b = mp.mpf(f32(x)), mp.mpf(f32(y))
        n = mp.floor(a / b)
        v = a - b * n
        top = abs(f32(float(v))) == abs(f32(y))
        yield x, y, v, "1.0", -n if n else 0.0, "below-divisor" if top else remark([v])
    for x, y in [(6.0, 3.0), (-6.0, 3.0), (6.0, -3.0), (0.0, 3.0), (3e38, 1.0)]:
        yield x, y, math.copysign(0.0, y), "-", "-", "jump"
    for x, y in [(1.0, 0.0), (0.0, 0.0), (INF, 1.0), (NAN, 1.0), (1.0, NAN)]:
        yield x, y, NAN, "-", "-", "special" if x - x != 0 or y != y else "domain"


def ieee(divide, x, y):
    """x / y of Python floats as IEEE 754 has it, where `divide`, else x * y."""
    if not divide:
        return x * y
    if y == 0:
        return NAN if x == 0 or math.isnan(x) else math.copysign(INF, x) * math.copysign(1, y)
    return x / y


# name -> (function, its partial derivatives, IEEE 754 on floats)
ARITHMETIC = {
    "add": (lambda x, y: x + y, lambda x, y: (mp.mpf(1), mp.mpf(1)), lambda x, y: x + y),
    "sub": (lambda x, y: x - y, lambda x, y: (mp.mpf(1), mp.mpf(-1)), lambda x, y: x - y),
    "mul": (lambda x, y: x * y, lambda x, y: (y, x), lambda x, y: ieee(False, x, y)),
    "div": (lambda x, y: x / y, lambda x, y: (1 / y, -x / y**2), lambda x, y: ieee(True, x, y)),
}


def arithmetic_rows(name):
    fn, slopes, on_floats = ARITHMETIC[name]
    points = [0.0, -0.0, 1.0, -1.0, f32(0.1), 3.0, -7.0, up(1.0), 1e-30, -1e20, 3e38, 2.0**-126, INF, -INF, NAN]
    for x in map(f32, points):
        for y in map(f32, points):
            if not (math.isfinite(x) and math.isfinite(y)):
                yield x, y, on_floats(x, y), "-", "-", "special"
            elif name == "div" and y == 0 or x == 0 or y == 0:
                slope = slopes(mp.mpf(x), mp.mpf(y)) if name != "div" or y else ("-", "-")
                yield x, y, on_floats(x, y), *slope, "pole" if name == "div" and y == 0 else "-"
            else:
                value = fn(mp.mpf(x), mp.mpf(y))
                dx, dy = slopes(mp.mpf(x), mp.mpf(y))
                yield x, y, value if value else 0.0, dx, dy, remark([value])


def min_rows(fn):
    for x, y in [(1.0, 2.0), (2.0, 1.0), (-1.0, 1.0), (-3e38, 3e38), (2.0**-126, 1e-30)]:
        v = fn(f32(x), f32(y))
        first = v == f32(x)
        yield x, y, v, "1.0" if first else "0.0", "0.0" if first else "1.0", "-"
    for x, y in [(1.0, 1.0), (-2.0, -2.0)]:
        yield x, y, x, "-", "-", "kink"
    for x, y in [(INF, 1.0), (1.0, -INF), (-INF, INF)]:
        yield x, y, fn(x, y), "-", "-", "special"


# ------------------------------------------------------------------------------------------------------------------
# Complex functions.
j = mp.j
CACOSH = lambda z: mp.log(z + mp.sqrt(z + 1) * mp.sqrt(z - 1))
COMPLEX = {
    "exp": mp.exp, "expm1": lambda z: mp.exp(z) - 1, "exp2": lambda z: mp.exp(z * mp.log(2)),
    "log": mp.log, "log2": lambda z: mp.log(z) / mp.log(2), "log10": lambda z: mp.log(z) / mp.log(10), "log1p": lambda z: mp.log(1 + z),
    "sqrt": mp.sqrt, "cbrt": lambda z: mp.exp(mp.log(z) / 3),
    "sin": mp.sin, "cos": mp.cos, "tan": mp.tan, "asin": mp.asin, "acos": mp.acos, "atan": mp.atan,
    "sinh": mp.sinh, "cosh": mp.cosh, "tanh": mp.tanh, "asinh": mp.asinh, "acosh": CACOSH, "atanh": mp.atanh,
    "sinc": lambda z: mp.sin(z) / z, "sinhc": lambda z: mp.sinh(z) / z, "exprel": lambda z: mp.expm1(z) / z,
    "sec": lambda z: 1 / mp.cos(z), "csc": lambda z: 1 / mp.sin(z), "sech": lambda z: 1 / mp.cosh(z), "csch": lambda z: 1 / mp.sinh(z),
}
SLOW = {"gamma": mp.gamma, "digamma": mp.digamma, "trigamma": lambda z: mp.polygamma(1, z)}
HUGE = {"log", "log2", "log10", "log1p", "sqrt", "cbrt", "asin", "acos", "atan", "asinh", "acosh", "atanh"}
CUTS = {
    "log": lambda x, y: y == 0 and x < 0, "log1p": lambda x, y: y == 0 and x < -1, "asin": lambda x, y: y == 0 and abs(x) > 1,
    "atan": lambda x, y: x == 0 and abs(y) > 1, "asinh": lambda x, y: x == 0 and abs(y) > 1, "acosh": lambda x, y: y == 0 and x < 1,
    "atanh": lambda x, y: y == 0 and abs(x) > 1,
}
for name in ("log2", "log10", "sqrt", "cbrt"):
    CUTS[name] = CUTS["log"]
CUTS["acos"] = CUTS["asin"]
GRID = [0.0, 0.5, 1.0, 2.0]
HARD = [
    (0.6, 0.8), (-1.0, 1e-4), (-1.0, -1e-4), (1.0, 1e-10), (-1.0, 1e-10), (1e-10, 1.0), (1e-10, -1.0), (1e-20, 2.0), (-1e-20, 2.0),
    (1.0, 100.0), (1.0, -100.0), (50.0, 1.0), (-50.0, 1.0), (1e-30, 1e-30), (2.0**-126, 2.0**-126), (2.0**-126, 0.0), (0.0, 2.0**-126),
    (2.0**-140, -(2.0**-140)), (1e-4, -1e-4), (3.1415927, 1e-6), (1.5707964, 1e-6), (1e-6, 3.1415927), (1e-6, 1.5707964), (-7.0, 1e-30),
    (88.8, 0.5), (89.5, 0.5), (100.0, 2.0), (0.5, 89.5), (1.0, up(1.0)), (up(1.0), 1e-20), (1 - 2.0**-24, 1e-20),
]
FAR = [(1e10, 1.0), (1.0, 1e10), (-1e10, 0.0), (-1e10, -0.0), (1e20, 1e20), (-1e20, 1e20), (1e20, -1e-20), (3e38, 1.0), (1.0, 3e38), (-3e38, -3e38), (3e38, 3e38), (0.0, 3e38), (-3e38, -0.0)]
WIDE = [(1e10, 1.0), (-0.5, 1e10), (1e10, -0.5), (1e20, 1.0), (1.0, -1e20), (3e38, 0.5), (0.5, 3e38), (-3e38, 0.5)]


def complex_points(name):
    both = lambda v: (v, -v)
    pts = [(a, b) for x in GRID for y in GRID for a in both(x) for b in both(y)]
    pts += HARD + (FAR if name in HUGE else WIDE)
    if name in ("csc", "csch"):  # an infinite complex number has no direction
        pts = [(x, y) for x, y in pts if max(abs(x), abs(y)) > 1e-37]
    return dict((repr((f32(a), f32(b))), (f32(a), f32(b))) for a, b in pts).values()


def singular(name, x, y):
    """Values at logarithmic singularities, by Annex G."""
    turn = lambda scale: (math.copysign(0.0, y) if not negative(x) else mp.pi / scale * math.copysign(1, y))
    if name in ("log", "log2", "log10") and x == 0 and y == 0:
        return -INF, turn({"log": 1, "log2": mp.log(2), "log10": mp.log(10)}[name])
    if name == "log1p" and x == -1 and y == 0:
        return -INF, math.copysign(0.0, y)
    if name == "atanh" and abs(x) == 1 and y == 0:
        return math.copysign(INF, x), math.copysign(0.0, y)
    if name == "atan" and x == 0 and abs(y) == 1:
        return math.copysign(0.0, x), math.copysign(INF, y)
    return None


def complex_row(name, fn, x, y):
    at = singular(name, x, y)
    if at:
        return at, None, "pole"
    z = mp.mpc(smear(x), smear(y))
    value = fn(z)
    h = STEP * max(abs(z), mp.mpf(10) ** -10)
    slopes = [(fn(z + s) - fn(z - s)) / (2 * s) for s in (h, h * j)]
    same = abs(slopes[0] - slopes[1]) <= SMALL * abs(slopes[0]) + mp.mpf(10) ** -100
    slope = slopes[0] if same and (abs(slopes[0]) < LARGE) else None
    notes = "cut" if name in CUTS and CUTS[name](x, y) else remark([value.real, value.imag])
    return (value.real, value.imag), slope, notes


def base_specials():
    """Annex G for the seven functions from which the circular ones follow, and those that stand alone."""
    n = {"exp": np.exp, "log": np.log, "sqrt": np.sqrt, "acos": np.arccos, "acosh": np.arccosh, "asinh": np.arcsinh, "atanh": np.arctanh, "cosh": np.cosh, "sinh": np.sinh, "tanh": np.tanh}
    return {k: (lambda x, y, f=f: f(np.complex128(complex(x, y)))) for k, f in n.items()}


def open_signs(name, x, y):
    """Which components (re, im) have a sign that Annex G leaves open."""
    inf, nan = math.isinf, math.isnan
    if name == "acos":
        return (False, inf(x) and nan(y))
    if name == "asinh":
        return (nan(x) and inf(y), False)
    if name == "atanh":
        return (nan(x) and inf(y), False)
    if name == "cosh":
        return (inf(x) and inf(y), x == 0 or (nan(x) and y == 0))
    if name == "sinh":
        return (x == 0 or (inf(x) and (inf(y) or nan(y))), False)
    if name == "tanh":
        return (False, inf(x) and (inf(y) or nan(y)))
    if name == "exp":
        return (inf(x) and (inf(y) or nan(y)), x == -INF and (inf(y) or nan(y)))
    if name == "sqrt":
        return (False, x == -INF and nan(y))
    return (False, False)


def special(name, x, y, base):
    """(re, im) as text for an argument with an infinity or NaN; None where the standards disagree."""
    turned = {"sin": "sinh", "cos": "cosh", "tan": "tanh", "asin": "asinh", "atan": "atanh"}
    if name in turned:
        got = special(turned[name], -y, x, base)  # f(z) = -i F(i z), and cos z = cosh(i z)
        if got is None or name == "cos":
            return got
        re, im = got
        return im, flip(re)
    if x == 0 and (name == "tanh" or name == "acosh" and math.isnan(y)):
        return None  # C99 and C17 disagree
    with np.errstate(all="ignore"):
        w = base[name](x, y)
    cells = []
    for v, free in zip((float(w.real), float(w.imag)), open_signs(name, x, y)):
        exact = {math.pi: mp.pi, math.pi / 2: mp.pi / 2, math.pi / 4: mp.pi / 4, 3 * math.pi / 4: 3 * mp.pi / 4}
        t = show(v if abs(v) not in exact else exact[abs(v)] * math.copysign(1, v)) if not (math.isfinite(v) and v not in (0, 1, -1) and abs(v) not in exact) else None
        if t is None:
            raise AssertionError((name, x, y, w))
        cells.append("±" + t.lstrip("-") if free and t != "nan" else t)
    return tuple(cells)


def flip(t):
    return t if t == "nan" or t.startswith("±") else t[1:] if t.startswith("-") else "-" + t


def write_complex(out):
    base = base_specials()
    with open(os.path.join(out, "complex_edges.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# edges of the complex functions; written by tests/oracle/functions.py\n")
        fh.write("# " + line("function", "z.re", "z.im", "w.re", "w.im", "f.re", "f.im", "d.re", "d.im", "notes"))

        def emit(name, x, y, value, slope, notes, w=("-", "-")):
            if w[0] != "-":  # the sign of a zero depends on how a product is formed
                value = ["±0.0" if abs(v) < NOTHING else v for v in value]
            d = ("-", "-") if slope is None else (show(slope.real), show(slope.imag))
            fh.write(line(name, show(x), show(y), *w, show(value[0]), show(value[1]), *d, notes))

        for name, fn in COMPLEX.items():
            for x, y in complex_points(name):
                emit(name, x, y, *complex_row(name, fn, x, y))
            if name in base or name in ("sin", "cos", "tan", "asin", "atan"):
                points = [0.0, -0.0, 1.0, -1.0, INF, -INF, NAN]
                for x in points:
                    for y in points:
                        if math.isfinite(x) and math.isfinite(y):
                            continue
                        got = special(name, x, y, base)
                        if got:
                            emit(name, x, y, got, None, "special")
        for name, fn in SLOW.items():
            for x, y in [(0.5, 0.5), (1.0, 1e-6), (2.0, -3.0), (-0.5, 1e-4), (-1.0, 1e-4), (-1.0, -1e-6), (-5.0, 1e-3), (1e-6, 1e-6), (-7.5, 0.5), (5.0, 0.0), (5.0, -0.0), (0.5, 20.0), (0.5, -40.0), (30.0, 1.0), (-20.5, 3.0), (1e-30, -1e-30)]:
                emit(name, f32(x), f32(y), *complex_row(name, fn, f32(x), f32(y)))
        write_simple(emit)
        write_pairs(emit)


def write_simple(emit):
    pts = [(0.6, 0.8), (3.0, 4.0), (-3.0, 4.0), (-1.0, 0.0), (-1.0, -0.0), (1.0, -0.0), (0.0, 2.0), (-0.0, -2.0), (1e20, 1e20), (1e-30, -1e-30), (3e38, 3e38), (-3e38, 1e-30), (2.0**-126, 2.0**-126), (0.0, 0.0), (-0.0, 0.0), (-0.0, -0.0), (INF, 1.0), (-INF, -1.0), (-INF, INF), (NAN, 1.0), (NAN, INF), (0.0, -INF)]
    for x, y in [(f32(a), f32(b)) for a, b in pts]:
        finite = math.isfinite(x) and math.isfinite(y)
        note = "-" if finite else "special"
        zero = "0.0"
        size = mp.hypot(x, y) if finite and (x or y) else math.hypot(x, y)
        turn = mp.atan2(smear(y), smear(x)) if finite and x and y else math.atan2(y, x)
        if isinstance(turn, float) and not math.isnan(turn) and turn:
            turn = mp.mpf(round(turn / math.pi * 4)) * mp.pi / 4
        emit("abs", x, y, (size, zero), None, note if isinstance(size, float) else remark([size]))
        emit("arg", x, y, (turn, zero), None, "cut" if y == 0 and x < 0 else note)
        emit("re", x, y, (x, zero), None, note)
        emit("im", x, y, (y, zero), None, note)
        emit("conj", x, y, (x, -y), None, note)
    for z, w in [((2.0, 0.0), (3.0, 0.0)), ((-1.0, 0.0), (0.5, 0.0)), ((-1.0, -0.0), (0.5, 0.0)), ((0.0, 1.0), (0.0, 1.0)), ((-2.0, 1e-6), (2.0, 0.0)), ((0.5, -2.0), (-3.0, 0.0)), ((1.0, 1.0), (0.5, -0.25)), ((1e10, 1e10), (2.0, 0.0)), ((1e20, -1e20), (-1.5, 0.0)), ((1e-20, 1e-20), (0.5, 0.0)), ((2.0, 3.0), (20.0, 0.0)), ((2.0, 3.0), (0.0, 20.0))]:
        a, b = mp.mpc(smear(f32(z[0])), smear(f32(z[1]))), mp.mpc(f32(w[0]), f32(w[1]))
        power = lambda t, b=b: mp.exp(b * mp.log(t))
        h = STEP * abs(a)
        slope = (power(a + h) - power(a - h)) / (2 * h)
        v = power(a)
        emit("pow", f32(z[0]), f32(z[1]), (v.real, v.imag), slope, "cut" if z[1] == 0 and z[0] < 0 else remark([v.real, v.imag]), (show(f32(w[0])), show(f32(w[1]))))


PAIRS = [
    ((2.0, 3.0), (-1.0, 0.5)), ((1e20, 1e20), (1e10, -1e10)), ((1e30, 1e30), (1e30, 1e30)), ((1e-30, 1e-30), (1e-30, -1e-30)),
    ((3e38, 3e38), (3e38, 3e38)), ((1.0, up(1.0)), (up(1.0), 1.0)), ((0.1, 0.3), (0.3, 0.1)), ((0.1, -0.3), (-0.3, 0.1)),
    ((5.0, 1e-10), (1e-10, 5.0)), ((1e-20, 7.0), (3.0, 1e20)), ((0.0, 2.0), (3.0, 4.0)), ((2.0, -0.0), (0.0, -5.0)), ((1e38, 1.0), (0.25, 1e-38)),
    ((0.70710677, 0.70710677), (0.70710677, -0.70710677)), ((16777215.0, 16777213.0), (16777213.0, 16777215.0)),
]


def write_pairs(emit):
    for name, fn, slope in (("mul", lambda z, w: z * w, lambda z, w: w), ("div", lambda z, w: z / w, lambda z, w: 1 / w)):
        for z, w in PAIRS:
            z, w = tuple(map(f32, z)), tuple(map(f32, w))
            v = fn(mp.mpc(*map(smear, z)), mp.mpc(*map(smear, w)))
            d = slope(mp.mpc(*map(smear, z)), mp.mpc(*map(smear, w)))
            emit(name, *z, (v.real, v.imag), d, remark([v.real, v.imag]), tuple(map(show, w)))


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions")
    os.makedirs(out, exist_ok=True)
    write_real(out)
    write_complex(out)


if __name__ == "__main__":
    main()
