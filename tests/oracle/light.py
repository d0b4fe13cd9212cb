#!/usr/bin/env python3
"""Write tests/data/functions/light.txt: light in media, with its derivatives.

usage: light.py [OUT_FILE]      (needs mpmath; default OUT_FILE: ../data/functions/light.txt beside this file)

The format is that of library.txt (see README.md). The airlight of a point light is by the exponential integral of mpmath,
which is first compared with quadrature of the integral that it is said to be.
"""
import os
import random
import sys

import gallery as g
from gallery import Dual, Num, exp, mp
from library import HALF, constant, section
from shapes import hypot3

expm1 = g.function(mp.expm1, mp.exp, mp.exp)
QUARTER = HALF / 2


def rel(x):
    """(eˣ - 1)/x"""
    return mp.expm1(x) / x if x else mp.mpf(1)


def rel1(x):
    return (mp.exp(x) - rel(x)) / x if x else HALF


def rel2(x):
    return (mp.exp(x) - 2 * rel1(x)) / x if x else mp.mpf(1) / 3


exprel = g.function(rel, rel1, rel2)


def value(x):
    return x.a.v if isinstance(x, Dual) else x


def mean_transmittance(a, b):
    return exp(-a) * exprel(a - b) if value(a) < value(b) else exp(-b) * exprel(b - a)


def scattered(depth, a, b):
    return depth * mean_transmittance(a, b + depth)


def henyey_greenstein(c, asymmetry):
    size = abs(asymmetry)
    s = (1 - size) ** 2 + 2 * size * (1 - (-c if asymmetry < 0 else c))
    return (1 - size) * (1 + size) / (4 * mp.pi * (s * g.sqrt(s)))


def fog_depth(p, q, k):
    lift = lambda c: constant(next(v for v in (*p, *q) if isinstance(v, Dual)), c) if any(isinstance(v, Dual) for v in (*p, *q)) else mp.mpf(c)
    p, q = [v if isinstance(v, Dual) else lift(v) for v in p], [v if isinstance(v, Dual) else lift(v) for v in q]
    x, y = -k * p[2], -k * q[2]
    mean = exp(x) * exprel(y - x) if value(y) < value(x) else exp(y) * exprel(x - y)
    return hypot3(*[b - a for a, b in zip(p, q)]) * mean


def beam(t0, length, h, sigma):
    """∫ exp(-σ (t - t0 + r))/r² dt over the length from t0, r² = t² + h², by E₁."""
    h = max(h, mp.mpf(10) ** -150)
    t1 = t0 + length
    if not sigma:
        return (mp.atan(t1 / h) - mp.atan(t0 / h)) / h
    end = lambda t: (mp.expj(-sigma * h) * mp.e1(sigma * mp.mpc(t + mp.hypot(t, h), -h))).imag
    return 2 / h * mp.exp(sigma * t0) * (end(t0) - end(t1))


def airlight(d, a, b, light, sigma):
    """From the eye at 0."""
    size = mp.sqrt(sum(c * c for c in d))
    n = [c / size for c in d]
    middle = sum(p * q for p, q in zip(light, n))
    h = mp.sqrt(sum((p - middle * q) ** 2 for p, q in zip(light, n)))
    # what the square of the largest number on the way is, with that of a derivative
    Num(sigma**2 * (size * max(abs(a), abs(b)) + mp.sqrt(sum(c * c for c in light))) ** 3)
    return mp.exp(-sigma * size * a) * beam(size * a - middle, size * (b - a), h, sigma)


def whole(f):
    """A function whose derivatives are differences of 480 digits. Its value is a difference of two parts, neither more than
    six times it, and of some roundings; so are the derivatives."""

    def call(*args):
        if not isinstance(args[0], Dual):
            return f(*args)
        at = [x.a.v for x in args]
        slope = lambda k, p: g.difference(f, p, k)
        slopes = [slope(k, at) for k in range(len(at))]

        def moved(k):
            """How far errors of the arguments move a derivative, by second differences."""
            with mp.workdps(60):
                steps = [mp.mpf(10) ** -15 * max(abs(x), 1) for x in at]
                total = mp.mpf(0)
                for j, x in enumerate(at):
                    corner = lambda s, t: f(*[v + s * (i == j) * steps[j] + t * (i == k) * steps[k] for i, v in enumerate(at)])
                    bend = corner(1, 1) - corner(1, -1) - corner(-1, 1) + corner(-1, -1)
                    total += max(abs(x), mp.mpf(1) / 16) * abs(bend) / (4 * steps[j] * steps[k])
                return total

        v = f(*at)
        error = 8 * (abs(v) + sum(abs(x * s) for x, s in zip(at, slopes)))
        tangents = [Num(s, 8 * (abs(s) + moved(k))) for k, s in enumerate(slopes)]
        return args[0].like(Num(v, error), tangents)

    return call


def near_light(x, y, z):
    return airlight((1, HALF, -QUARTER), HALF, mp.mpf(3), (x, y, z), 3 * QUARTER)


def in_fog(x, y, z):
    return airlight((0, 0, 2), mp.mpf(0), x * x, (HALF, 0, y), z * z)


REAL = {
    "transmittance": ("transmittance(x)", lambda x: exp(-x)), "opacity": ("opacity(x)", lambda x: -expm1(-x)),
    "mean_transmittance": ("mean_transmittance(x, 0.5)", lambda x: mean_transmittance(x, constant(x, HALF))),
}
PLANE = {
    "mean_transmittance": ("mean_transmittance(x, y)", mean_transmittance),
    "henyey_greenstein": ("henyey_greenstein(cos(x), 0.75) + 0 y", lambda x, y: henyey_greenstein(g.cos(x), 3 * QUARTER) + 0 * y),
    "henyey_greenstein ": ("henyey_greenstein(sin(x) / 2, -0.5) + 0 y", lambda x, y: henyey_greenstein(g.sin(x) / 2, -HALF) + 0 * y),
}
SPACE = {
    "scattered": ("scattered(x, y, z)", scattered),
    "fog_depth": ("fog_depth((1, 0, 0.5), (x, y, z), 1.5)", lambda x, y, z: fog_depth((1, 0, HALF), (x, y, z), 3 * HALF)),
    "airlight": ("airlight((0, 0, 0), (1, 0.5, -0.25), 0.5, 3, (x, y, z), 0.75)", whole(near_light)),
    "airlight ": ("airlight((0, 0, 0), (0, 0, 2), 0, x^2, (0.5, 0, y), z^2)", whole(in_fog)),
}


def check():
    """The form by E₁ against quadrature of 30 digits."""
    rng = random.Random("airlight")
    worst = 0
    for _ in range(40):
        t0, length, h, sigma = rng.uniform(-4, 4), 10 ** rng.uniform(-3, 1), 10 ** rng.uniform(-2, 1), 10 ** rng.uniform(-3, 1)
        t0, length, h, sigma = map(mp.mpf, (t0, length, h, sigma))
        found = beam(t0, length, h, sigma)
        with mp.workdps(30):
            inner = [t for t in (-h, mp.mpf(0), h) if t0 < t < t0 + length]
            f = lambda t: mp.exp(-sigma * (t - t0 + mp.hypot(t, h))) / (t * t + h * h)
            cuts = [t0, *inner, t0 + length]
            cuts = [a + (b - a) * k / 8 for a, b in zip(cuts, cuts[1:]) for k in range(8)] + [cuts[-1]]
            wanted = mp.quad(f, cuts)
        worst = max(worst, abs(found / wanted - 1))
    assert worst < mp.mpf(10) ** -20, worst
    print(f"airlight: within {mp.nstr(worst, 2)} of quadrature", file=sys.stderr)


def main():
    check()
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "light.txt")
    with open(out, "w", encoding="utf-8") as fh:
        for table, names in ((REAL, "x"), (PLANE, "xy"), (SPACE, "xyz")):
            slopes = [f"d{n}" for n in names]
            columns = [*names, "f", *slopes, "condition", "scale_f", *(f"scale_{d}" for d in slopes), "notes"]
            for name, (formula, f) in table.items():
                rng = random.Random(f"{name} {formula}")
                special = [(0.5,) * len(names), tuple((1.0, -1.0, 2.0)[: len(names)]), (0.0,) * len(names)]
                section(fh, name, ", ".join(names), formula, f, g.points(rng, len(names), 3, special), columns)


if __name__ == "__main__":
    main()
