#!/usr/bin/env python3
"""Write tests/data/functions/wide.tsv: functions at arguments that have more bits than a float32.

usage: wide.py [OUT]      (needs mpmath and numpy; default OUT: ../data/functions/wide.tsv beside this file)

Every argument is the exact sum of two float32, the lower one below half an ulp of the upper one, so that a pair of
float32 and a float64 both hold it. Its lower half must matter: the tables of float32 arguments cannot see a function
that ignores it. References have 25 digits, from mpmath with 480; the functions are those of functions.py.
"""
import os
import random
import sys

import mpmath as mp

from functions import COMPLEX, REAL, SLOW, STEP, f32

EACH = 16
NAMES = [n for n in REAL if n not in ("abs", "re", "im", "conj", "arg", "neg")]
COMPLEX_NAMES = {
    **{n: f for n, f in COMPLEX.items() if n not in ("expm1", "exp2", "log2", "log10", "log1p", "cbrt", "sinc")},
    **SLOW, "square": lambda z: z * z, "pow7": lambda z: z**7, "inverse": lambda z: 1 / z,
}
PAIRS = {
    "add": lambda x, y: x + y, "sub": lambda x, y: x - y, "mul": lambda x, y: x * y, "div": lambda x, y: x / y,
    "hypot": mp.hypot, "atan2": mp.atan2, "pow": lambda x, y: mp.power(abs(x), y),
}


def pair(rng, kind):
    sign = rng.choice((1, -1))
    size = (2.0 ** rng.uniform(-20, 20), rng.uniform(0, 8), rng.randrange(9) / 2 + 2.0 ** rng.uniform(-24, -1) / 2)[kind]
    high = f32(sign * size)
    low = f32(high * 2.0**-25 * rng.uniform(-1, 1))
    return high + low


def text(v):
    return mp.nstr(v, 25) if abs(v) > mp.mpf(10) ** -46 else "0.0"


def slope(fn, x, h):
    return (fn(x + h) - fn(x - h)) / (2 * h)


def row(name, domain, args, value, slopes):
    return "\t".join([name, domain, " ".join(map(repr, args)), " ".join(map(text, value)), " ".join(map(text, slopes))]) + "\n"


def rows():
    rng = random.Random(4)
    reach = lambda v: all(mp.mpf(10) ** -30 < abs(x) < mp.mpf(10) ** 30 for x in v)
    for name in NAMES:
        fn, defined = REAL[name][:2]
        count = 0
        while count < EACH:
            x = pair(rng, count % 3)
            if x == 0 or not defined(mp.mpf(x)):
                continue
            found = [fn(mp.mpf(x))], [slope(fn, mp.mpf(x), STEP)]
            if reach(found[0] + found[1]):
                yield row(name, "real", [x], *found)
            count += 1
    for name, fn in PAIRS.items():
        for k in range(EACH):
            x, y = pair(rng, k % 3), pair(rng, 1)
            x = abs(x) if name == "pow" else x
            a, b = mp.mpf(x), mp.mpf(y)
            found = [fn(a, b)], [slope(lambda t: fn(t, b), a, STEP), slope(lambda t: fn(a, t), b, STEP)]
            if reach(found[0] + found[1]):
                yield row(name, "real", [x, y], *found)
    for name, fn in COMPLEX_NAMES.items():
        for k in range(EACH):
            x, y = pair(rng, k % 3), pair(rng, k % 3)
            z = mp.mpc(x, y)
            v, d = fn(z), slope(fn, z, STEP)
            if reach([v.real, v.imag]) and reach([abs(d)]):
                yield row(name, "complex", [x, y], [v.real, v.imag], [d.real, d.imag])
    for name, fn in (("mul", lambda z, w: z * w), ("div", lambda z, w: z / w), ("pow", mp.power)):
        for k in range(EACH):
            z, w = (pair(rng, k % 3), pair(rng, k % 3)), (pair(rng, 1), pair(rng, 1))
            a, b = mp.mpc(*z), mp.mpc(*w)
            v, d = fn(a, b), slope(lambda t: fn(t, b), a, STEP)
            if reach([v.real, v.imag]) and reach([abs(d)]):
                yield row(name, "complex", [*z, *w], [v.real, v.imag], [d.real, d.imag])


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "wide.tsv")
    with open(out, "w", encoding="utf-8") as fh:
        fh.write("# arguments of more bits than float32; written by tests/oracle/wide.py\n")
        fh.write("# function\tdomain\targuments\tvalue\tderivative\n")
        fh.writelines(rows())


if __name__ == "__main__":
    main()
