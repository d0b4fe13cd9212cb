#!/usr/bin/env python3
"""Write tests/data/functions/second.tsv: second derivatives of every operation, where they are hardest.

usage: second.py [OUT_DIR]      (needs mpmath and numpy; default OUT_DIR: ../data/functions beside this file)

Symmetric second differences of the functions in functions.py, and of those below, with 520 digits and a relative step
of 1e-200; of the gamma family the relations of DLMF 5.2.2 and 5.15.1 between mpmath's own functions. A zero among the
arguments stands for ±1e-150, as in functions.py. README.md beside this file has the format.
"""
import math
import os
import random
import sys

import mpmath as mp

import functions as base
from functions import INF, f32, negative, show, smear, up

mp.mp.dps = 520
j = mp.j
STEP = mp.mpf(10) ** -200
MAX, LARGE = base.MAX, mp.mpf(10) ** 45
inverse = lambda f: lambda z: 1 / f(z)
MORE = {name: inverse(f) for name, f in (("sec", mp.cos), ("csc", mp.sin), ("sech", mp.cosh), ("csch", mp.sinh))}

REAL = {name: row[:2] for name, row in base.REAL.items() if name not in ("re", "im", "conj", "arg", "neg", "pow7")}
REAL.update({name: (f, lambda x: True) for name, f in MORE.items()})
REAL.update({"pow7": (lambda x: x**7, lambda x: True)})
COMPLEX = {name: base.COMPLEX[name] for name in "exp log sqrt sin cos tan asin acos atan sinh cosh tanh asinh acosh atanh".split()}
COMPLEX.update(MORE)
COMPLEX.update({"square": lambda z: z * z, "pow7": lambda z: z**7, "inverse": lambda z: 1 / z})
COMPLEX.update({name: base.COMPLEX[name] for name in ("expm1", "log1p", "sinc", "sinhc", "exprel")})
psi = mp.polygamma
# by relations, because differences of mpmath's gamma functions take long
GAMMA = {
    "gamma": lambda z: mp.gamma(z) * (psi(0, z) ** 2 + psi(1, z)),
    "lgamma": lambda z: psi(1, z),
    "digamma": lambda z: psi(2, z),
    "trigamma": lambda z: psi(3, z),
}
GAMMA_VALUES = {"gamma": mp.gamma, "lgamma": mp.loggamma, "digamma": mp.digamma, "trigamma": lambda z: psi(1, z)}
SIZES = [0.0, 1e-30, 1e-10, 1e-4, 0.01, 0.25, 0.5, 1.0, up(1.0), 1 - 2.0**-24, 1.5, 2.0, 3.0, 7.0, 10.0, 40.0, 46.0, 88.0, 90.0, 1e3, 1e10, 1e19, 1e20, 1e30]
NEAR = {
    "sinc": [0.9999, 1.0001, 2.0815759, 5.9403697, 4.4934095, 0.05, 0.4], "asin": [0.999, -0.999], "acos": [0.999], "atanh": [0.999, -0.9],
    "acosh": [up(1.0, 8), 1.001, 100.0], "gamma": [-0.5, -1.5, -2.5, -3.25, -10.3, 30.0, 1.4616321, -33.4], "sech": [0.8813736, 89.0, 87.0, -100.0],
    "csch": [89.0, 87.0, -100.0, 1e-12], "sec": [1.5707964, 4.712389, 3.1415927], "csc": [3.1415927, 1.5707964], "tan": [1.5707964, 3.1415927],
    "tanh": [9.0, 20.0, 44.0, 60.0, -89.0, 100.0], "digamma": [-0.5, -1.5, -2.25, -7.9, 5.0], "trigamma": [-0.5, -1.5, -2.25, -7.9, 5.0], "lgamma": [-0.5, -1.5, -2.25, 5.0],
    "log1p": [-0.99, -1 + 2.0**-24, -0.5], "expm1": [-20.0, 80.0],
    "sinhc": [0.9999, 1.0001, 0.05, 20.5, 89.5, 92.0], "exprel": [0.9999, 1.0001, -0.9999, -1.0001, 0.05, -40.0, 89.0, 92.0],
}
SLOPE_LIMIT = mp.mpf(10) ** 37


def spread(name, reals):
    """Random float32 numbers, the same on every run."""
    source = random.Random("second " + name)
    sign = lambda: source.choice((1, -1))
    sizes = [10 ** source.uniform(-12, 12) for _ in range(20)] + [8 * source.random() for _ in range(25)]
    sizes += [source.randrange(9) / 2 + 2.0 ** (-20 * source.random()) / 2 for _ in range(10)]
    sizes = [f32(sign() * v) for v in sizes]
    if reals:
        return sizes
    others = sizes[:]
    source.shuffle(others)
    return list(zip(sizes, others))


def step(v):
    return STEP * max(abs(v), mp.mpf(10) ** -10)


def second(f, z):
    """f″(z), and whether f or f′ is beyond float32."""
    h = step(z)
    below, here, above = f(z - h), f(z), f(z + h)
    slope = (above - below) / (2 * h)
    return (above - 2 * here + below) / h**2, max(abs(here), abs(slope)) >= SLOPE_LIMIT


def partials(f, point):
    """Second partial derivatives of f in the order xx, xy, …, yy, …, and whether f or a slope is beyond float32."""
    steps = [step(v) for v in point]
    def at(*moves):
        moved = list(point)
        for k, s in moves:
            moved[k] = moved[k] + s * steps[k]
        return f(*moved)
    here, out = at(), []
    slopes = [(at((k, 1)) - at((k, -1))) / (2 * steps[k]) for k in range(len(point))]
    for a in range(len(point)):
        for b in range(a, len(point)):
            if a == b:
                out.append((at((a, 1)) - 2 * here + at((a, -1))) / steps[a] ** 2)
            else:
                corners = at((a, 1), (b, 1)) - at((a, 1), (b, -1)) - at((a, -1), (b, 1)) + at((a, -1), (b, -1))
                out.append(corners / (4 * steps[a] * steps[b]))
    return out, max(map(abs, [here, *slopes])) >= SLOPE_LIMIT


def cells(values):
    return " ".join(show(mp.mpf(v)) for v in values)


def inside(defined, z):
    """z, or the nearest point on the side on which the function is defined; None where it is on neither."""
    h = 2 * step(z)
    if defined(z - h) and defined(z + h):
        return z
    for moved in (z + base.SIDE, z - base.SIDE):
        if defined(moved - h) and defined(moved + h):
            return moved
    return None


def real_rows(name):
    for x in dict.fromkeys([s * f32(v) for v in SIZES for s in (1, -1)] + [f32(v) for v in NEAR.get(name, [])] + spread(name, True)):
        if name == "abs" and x == 0:
            continue
        if name in GAMMA:
            if x <= 0 and x == math.floor(x) or abs(x) > 1e10:
                continue
            z = mp.mpf(x)
            if abs(GAMMA_VALUES[name](z)) < SLOPE_LIMIT:
                yield [x], [GAMMA[name](z).real]
            continue
        f, defined = REAL[name]
        z = inside(defined, smear(x))
        if z is None or x == 0 and negative(x) and name in ("sqrt", "log", "log2", "log10"):
            continue
        value, beyond = second(f, z)
        if not beyond or x in (0, 1) and name in ("sqrt", "cbrt", "log", "log2", "log10", "acosh", "asin"):
            yield [x], [value]


def complex_rows(name):
    points = list(base.complex_points(name if name in base.COMPLEX else "tan"))
    points += [(46.0, 1.0), (1.0, 46.0), (-30.0, 0.25), (0.3, -60.0), (1e-3, 2e-3), (1e-8, -1e-8), (0.0, 1e-5), (1.0, 1e-5), (1e-5, 1.0)]
    for x, y in dict.fromkeys([tuple(map(f32, p)) for p in points] + spread(name, False)):
        if max(abs(x), abs(y)) > 1e19 or max(abs(x), abs(y)) < 1e-35:
            continue
        if (abs(x) == 1 and y == 0) or (abs(y) == 1 and x == 0):
            continue  # branch points, and poles
        if name == "pow7" and max(abs(x), abs(y)) < 1e-7:
            continue  # the fifth power is below float32
        if name in GAMMA:
            if y == 0 or abs(x) + abs(y) > 50:
                continue
            z = mp.mpc(x, y)
            if abs(GAMMA_VALUES[name](z)) < SLOPE_LIMIT:
                value = GAMMA[name](z)
                if max(abs(value.real), abs(value.imag)) >= MAX:
                    continue  # an infinite complex number has no direction
                yield [x, y], [value.real, value.imag]
            continue
        value, beyond = second(COMPLEX[name], mp.mpc(smear(x), smear(y)))
        if not beyond:
            yield [x, y], [value.real, value.imag]


def pairs(name):
    sizes = [1e-20, 1e-6, 0.5, 1.0, 3.0, 1e10]
    grid = [(s * f32(a), t * f32(b)) for a in sizes for b in sizes for s in (1, -1) for t in (1, -1)]
    if name in ("atan2", "hypot", "pow"):
        grid += [(f32(v), z) for v in sizes for z in (0.0, -0.0)] + [(0.0, f32(v)) for v in sizes] + [(-0.0, -f32(v)) for v in sizes]
    grid += [(f32(0.0), b) for b in (2.0, 3.0, 1.5, 2.5, 4.5)] + [(a, b) for a in (2.0, -1.5, -3.0, 1e-10) for b in (0.0, 1.0, 2.0, 3.0, -1.0, -2.0)]
    return dict.fromkeys(grid + [(a, b) for a, b in spread(name, False)])


BINARY = {
    "add": lambda x, y: x + y, "sub": lambda x, y: x - y, "mul": lambda x, y: x * y, "div": lambda x, y: x / y,
    "hypot": lambda x, y: mp.sqrt(x * x + y * y), "atan2": mp.atan2, "pow": lambda x, y: mp.exp(y * mp.log(x)),
    "min": min, "max": max, "mod": lambda x, y: x - y * mp.floor(x / y),
}


def binary_rows(name):
    for x, y in pairs(name):
        if name == "pow":
            yield from pow_rows(x, y)
            continue
        if x == 0 and (y == 0 or name not in ("atan2", "hypot")) or y == 0 and name in ("div", "mod", "min", "max"):
            continue
        if name in ("min", "max") and x == y or name == "mod" and (abs(x / y) > 1e30 or x / y == math.floor(x / y)):
            continue
        values, beyond = partials(BINARY[name], (smear(x), smear(y)))
        if not beyond:
            yield [x, y], values


def pow_rows(x, y):
    """Of a negative base, and of 0, only the derivatives by the base, and only where they are finite."""
    a, b = mp.mpf(x), mp.mpf(y)
    if x <= 0:
        if y != math.floor(y) and (x < 0 or y <= 2) or abs(y) > 100:
            return
        falling = b * (b - 1)
        if x == 0:
            if y in (0, 1) or y >= 2:
                yield [x, y], [falling if y == 2 else mp.mpf(0), "-", "-"]
            return
        if abs(a) > 1e-12 and max(abs(a**y), abs(b * a ** (y - 1))) < SLOPE_LIMIT:
            yield [x, y], [falling * a ** (y - 2), "-", "-"]
        return
    values, beyond = partials(BINARY["pow"], (a, b))
    if not beyond and max(abs(v) for v in [a ** (b - 2), *values]) < SLOPE_LIMIT and abs(y * mp.log(a)) < 80:
        yield [x, y], values


def triples():
    source = random.Random("second hypot3")
    sizes = [0.0, 1e-10, 1e-4, 0.5, 1.0, -2.0, 1e8]
    points = [(a, b, c) for a in sizes for b in sizes for c in (1e-10, 0.0, -3.0)]
    points += [tuple(source.uniform(-4, 4) for _ in range(3)) for _ in range(30)]
    for point in points:
        point = [f32(v) for v in point]
        if any(point):
            yield point, partials(lambda x, y, z: mp.sqrt(x * x + y * y + z * z), [smear(v) for v in point])[0]


COMPLEX_PAIRS = [
    ((2.0, 0.0), (3.0, 0.0)), ((2.0, 1.0), (0.5, 0.0)), ((-1.5, 0.5), (0.5, -0.25)), ((0.3, -0.7), (2.5, 1.0)), ((-2.0, 0.0), (0.5, 0.25)),
    ((-2.0, -0.0), (0.5, 0.25)), ((1e-4, 2e-4), (1.5, 0.5)), ((100.0, -30.0), (-1.25, 0.5)), ((1.0, 1.0), (1.0, 1.0)), ((0.6, 0.8), (4.0, -3.0)),
    ((-0.5, 1e-6), (-2.0, 1.0)), ((3.0, 4.0), (0.1, 0.2)), ((1.0, 2.0), (-0.5, 3.0)), ((0.25, 0.125), (2.0, -2.0)), ((-7.0, 3.0), (1.5, 0.0)),
]
COMPLEX_BINARY = {"mul": lambda z, w: z * w, "div": lambda z, w: z / w, "pow": lambda z, w: mp.exp(w * mp.log(z))}


def complex_binary_rows(name):
    for z, w in COMPLEX_PAIRS:
        z, w = tuple(map(f32, z)), tuple(map(f32, w))
        point = [mp.mpc(*map(smear, z)), mp.mpc(*map(smear, w))]
        values, _ = partials(COMPLEX_BINARY[name], point)
        yield [*z, *w], [part for v in values for part in (v.real, v.imag)]


def wirtinger(rows):
    """∂²/∂z², and ∂²/∂z∂z̄, from the real second derivatives."""
    for args, (xx, xy, yy) in rows:
        yield args, [(xx - yy) / 4, -xy / 2, (xx + yy) / 4]


def write(fh, name, domain, rows):
    for args, values in rows:
        text = " ".join(v if isinstance(v, str) else show(v) for v in values)
        fh.write("\t".join([name, domain, " ".join(map(repr, args)), text]) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions")
    with open(os.path.join(out, "second.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# second derivatives; written by tests/oracle/second.py\n# function\tdomain\targuments\tvalues\n")
        for name in REAL:
            write(fh, name, "real", real_rows(name))
        for name in BINARY:
            write(fh, name, "real", binary_rows(name))
        write(fh, "length", "real", triples())
        for name in [*COMPLEX, "gamma", "digamma", "trigamma"]:
            write(fh, name, "complex", complex_rows(name))
        for name in COMPLEX_BINARY:
            write(fh, name, "complex", complex_binary_rows(name))
        turned = lambda x, y: mp.atan2(y, x)
        plane = [(x, y) for x, y in pairs("hypot") if (x or y)]
        for name, f in (("abs", BINARY["hypot"]), ("arg", turned)):
            # on the cut of arg, the sign of the zero is that of the side
            rows = [([x, y], partials(f, (smear(x), smear(y)))[0]) for x, y in plane]
            write(fh, name, "plane", rows)
            write(fh, name, "wirtinger", wirtinger(rows))


if __name__ == "__main__":
    main()
