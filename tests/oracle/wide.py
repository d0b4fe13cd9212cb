#!/usr/bin/env python3
"""Write tests/data/functions/wide.tsv: functions at arguments that have more bits than a float32.

usage: wide.py [OUT]      (needs mpmath and numpy; default OUT: ../data/functions/wide.tsv beside this file)

Every argument is the exact sum of two float32, the lower one below half an ulp of the upper one, so that a pair of
float32 and a float64 both hold it. Its lower half must matter: the tables of float32 arguments cannot see a function
that ignores it. References have 25 digits, from mpmath with 480; the functions are those of functions.py.
"""
import math
import os
import random
import sys

import mpmath as mp

from functions import COMPLEX, REAL, SLOW, STEP, f32

EACH = 16
EACH_REAL = 60
NAMES = [n for n in REAL if n not in ("abs", "re", "im", "conj", "arg", "neg")]
COMPLEX_NAMES = {
    **{n: f for n, f in COMPLEX.items() if n not in ("exp2", "log2", "log10", "cbrt", "sinc")},
    **SLOW, "square": lambda z: z * z, "pow7": lambda z: z**7, "inverse": lambda z: 1 / z,
}
# What has no complex derivative: the value, and the derivatives by z and by its conjugate (Wirtinger).
PARTS = {
    "abs": lambda z: (abs(z), mp.conj(z) / (2 * abs(z)), z / (2 * abs(z))),
    "arg": lambda z: (mp.arg(z), 1 / (2 * mp.j * z), -1 / (2 * mp.j * mp.conj(z))),
    "re": lambda z: (z.real, mp.mpc(0.5), mp.mpc(0.5)),
    "im": lambda z: (z.imag, -mp.j / 2, mp.j / 2),
    "conj": lambda z: (mp.conj(z), mp.mpc(0), mp.mpc(1)),
}
PAIRS = {
    "add": lambda x, y: x + y, "sub": lambda x, y: x - y, "mul": lambda x, y: x * y, "div": lambda x, y: x / y,
    "hypot": mp.hypot, "atan2": mp.atan2, "pow": lambda x, y: mp.power(abs(x), y),
}


def widened(rng, size):
    """A number of 49 bits beside `size`: the sum of a float32 and a multiple of 2^-48 of it."""
    high = f32(size)
    if high == 0:
        return high
    exponent = math.frexp(high)[1] - 1
    return high + math.ldexp(rng.randrange(-(2**23) + 1, 2**23), exponent - 48)


def pair(rng, kind):
    sign = rng.choice((1, -1))
    size = (2.0 ** rng.uniform(-20, 20), rng.uniform(0, 8), rng.randrange(9) / 2 + 2.0 ** rng.uniform(-24, -1) / 2)[kind]
    return widened(rng, sign * size)


def offset(rng, least=-40, most=-2):
    return rng.choice((1, -1)) * 2.0 ** rng.uniform(least, most)


def beside(rng, x, y):
    """Close to x + i y: from 2^-2 to 2^-40 of it in each direction."""
    return widened(rng, x + offset(rng)), widened(rng, y + offset(rng))


def on_circle(rng):
    """|z| = 1 but for 2^-4 to 2^-45."""
    angle, radius = rng.uniform(-3.2, 3.2), 1 + offset(rng, -45, -4)
    return widened(rng, radius * math.cos(angle)), widened(rng, radius * math.sin(angle))


def on_shifted_circle(rng):
    """|1 + z| = 1 likewise, in 46 bits after the point."""
    x, y = on_circle(rng)
    return math.ldexp(round(math.ldexp(x - 1, 46)), -46), y


def beside_cut(rng):
    """Left or right on the real axis, 2^-4 to 2^-60 from it."""
    return widened(rng, rng.choice((1, -1)) * rng.uniform(0.5, 9)), widened(rng, offset(rng, -60, -4))


def far(rng):
    return tuple(widened(rng, rng.choice((1, -1)) * 2.0 ** rng.uniform(10, 60)) for _ in range(2))


def tiny(rng):
    return tuple(widened(rng, rng.choice((1, -1)) * 2.0 ** rng.uniform(-60, -10)) for _ in range(2))


def at_quarter_turn(rng):
    """Beside a zero or pole of the waves."""
    return widened(rng, rng.randrange(-40, 40) * math.pi / 2 + offset(rng)), widened(rng, offset(rng))


def many_turns(rng):
    return widened(rng, rng.choice((1, -1)) * 2.0 ** rng.uniform(8, 45)), widened(rng, rng.uniform(-8, 8))


def steep(rng):
    return widened(rng, rng.uniform(-8, 8)), widened(rng, rng.choice((1, -1)) * rng.uniform(15, 80))


def beside_gamma_pole(rng):
    return beside(rng, -rng.randrange(12), 0.0)


def left(rng):
    return widened(rng, -rng.uniform(0, 25)), widened(rng, rng.uniform(-12, 12))


def right(rng):
    return widened(rng, rng.uniform(0, 28)), widened(rng, rng.uniform(-30, 30))


def turned(place):
    """The same turned by a quarter: x + i y becomes -y + i x."""
    def other(rng):
        x, y = place(rng)
        return -y, x
    return other


branches = [lambda rng: beside(rng, rng.choice((1.0, -1.0)), 0.0), beside_cut, on_circle, far, tiny]
waves = [at_quarter_turn, many_turns, steep, tiny, turned(steep)]
gammas = [beside_gamma_pole, left, right]
# Where each is hardest, beside the random places of all: places that are visited one after another.
PLACES = {
    **dict.fromkeys(("log", "sqrt", "inverse", "square", "pow7", *PARTS), [on_circle, beside_cut, far, tiny, lambda rng: beside(rng, 1.0, 0.0)]),
    "log1p": [tiny, lambda rng: beside(rng, -1.0, 0.0), beside_cut, far, on_shifted_circle],
    **dict.fromkeys(("asin", "acos", "acosh", "atanh"), branches), **dict.fromkeys(("asinh", "atan"), [turned(p) for p in branches]),
    **dict.fromkeys(("sin", "cos", "tan", "sec", "csc"), waves), **dict.fromkeys(("sinh", "cosh", "tanh", "sech", "csch"), [turned(p) for p in waves]),
    **dict.fromkeys(("exp", "expm1"), [turned(at_quarter_turn), turned(many_turns), steep, turned(steep), tiny]),
    **dict.fromkeys(SLOW, gammas),
}
VISITS = 40


def text(v):
    return mp.nstr(v, 25) if abs(v) > mp.mpf(10) ** -46 else "0.0"


def slope(fn, x, h):
    return (fn(x + h) - fn(x - h)) / (2 * h)


def row(name, domain, args, value, slopes):
    assert all(f32(x) + f32(x - f32(x)) == x for x in args), args
    return "\t".join([name, domain, " ".join(map(repr, args)), " ".join(map(text, value)), " ".join(map(text, slopes))]) + "\n"


def rows():
    rng = random.Random(4)
    reach = lambda v: all(mp.mpf(10) ** -36 < abs(x) < mp.mpf(10) ** 36 for x in v)
    for name in NAMES:
        fn, defined = REAL[name][:2]
        count = 0
        while count < EACH_REAL:
            x = pair(rng, count % 3)
            if x == 0 or not defined(mp.mpf(x)):
                continue
            found = [fn(mp.mpf(x))], [slope(fn, mp.mpf(x), STEP)]
            if reach(found[0] + found[1]):
                yield row(name, "real", [x], *found)
            count += 1
    for name in ("gamma", "lgamma", "digamma", "trigamma"):
        fn = REAL[name][0]
        centres = [0.0, -1.0, -2.0, -5.0, -11.0, 1.0, 2.0, 1.4616321449683623, -0.504083008264455, 0.5]
        spans = [(0, 34), (-25, 0), (34, 100), (-1e6, -25)]
        for k in range(VISITS):
            x = widened(rng, centres[k % 10] + offset(rng) if k % 5 < 3 else rng.uniform(*spans[k % 4]))
            found = [fn(mp.mpf(x))], [slope(fn, mp.mpf(x), STEP)]
            if reach(found[0] + found[1]):
                yield row(name, "real", [x], *found)
    for name, fn in PAIRS.items():
        for k in range(EACH_REAL):
            x, y = pair(rng, k % 3), pair(rng, 1)
            x = abs(x) if name == "pow" else x
            a, b = mp.mpf(x), mp.mpf(y)
            found = [fn(a, b)], [slope(lambda t: fn(t, b), a, STEP), slope(lambda t: fn(a, t), b, STEP)]
            if reach(found[0] + found[1]):
                yield row(name, "real", [x, y], *found)
    for name, fn in {**COMPLEX_NAMES, **PARTS}.items():
        ordinary = [(pair(rng, k % 3), pair(rng, k % 3)) for k in range(EACH)]
        hard = [PLACES[name][k % len(PLACES[name])](rng) for k in range(VISITS)]
        for x, y in ordinary + hard:
            z = mp.mpc(x, y)
            if name in PARTS:
                v, *slopes = fn(z)
                if reach([abs(v)]):
                    yield row(name, "complex", [x, y], [v.real, v.imag], [t for d in slopes for t in (d.real, d.imag)])
                continue
            v, d = fn(z), slope(fn, z, STEP * max(1, abs(z)))
            if reach([v.real, v.imag]) and reach([abs(d)]):
                yield row(name, "complex", [x, y], [v.real, v.imag], [d.real, d.imag])
    for name, fn in (("mul", lambda z, w: z * w), ("div", lambda z, w: z / w), ("pow", mp.power)):
        for z, w in couples(name, rng):
            a, b = mp.mpc(*z), mp.mpc(*w)
            v, d = fn(a, b), slope(lambda t: fn(t, b), a, STEP)
            if reach([v.real, v.imag]) and reach([abs(d)]):
                yield row(name, "complex", [*z, *w], [v.real, v.imag], [d.real, d.imag])


def couples(name, rng):
    for k in range(EACH):
        yield (pair(rng, k % 3), pair(rng, k % 3)), (pair(rng, 1), pair(rng, 1))
    for k in range(VISITS):
        x, y = pair(rng, 1), pair(rng, 1)
        if name == "pow":  # close to the unit circle, to large powers; beside the cut; real exponents
            z = (on_circle, beside_cut, right)[k % 3](rng)
            w = (widened(rng, rng.uniform(-240, 240)), widened(rng, rng.uniform(-20, 20))) if k % 3 == 0 else (pair(rng, 1), 0.0)
            yield z, w
        else:  # a part of the result cancels: to w = ±i z̄ (1 + 2^-k) and ±z̄ in products, without the bar in quotients
            u, v = ((y, x), (x, -y))[k % 2]
            if name == "div":
                v = -v
            yield (x, y), (widened(rng, u * (1 + offset(rng, -46, -2))), v)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "wide.tsv")
    with open(out, "w", encoding="utf-8") as fh:
        fh.write("# arguments of more bits than float32; written by tests/oracle/wide.py\n")
        fh.write("# function\tdomain\targuments\tvalue\tderivative\n")
        fh.writelines(rows())


if __name__ == "__main__":
    main()
