#!/usr/bin/env python3
"""Write tests/data/calculus/curvature.tsv: curvatures of level surfaces and level lines.

usage: curvature.py [OUT_FILE]      (needs mpmath; default OUT_FILE: ../data/calculus/curvature.tsv beside this file)

The surface f = const through a point is written as a graph z(x, y), found by Newton's method in 120 digits; its
derivatives are symmetric differences of that graph with Richardson extrapolation, and the curvatures come from its
first and second fundamental form. Nothing of it shares a formula with the compiler, which uses the derivatives of f.
H is positive where the surface bends away from the gradient: 1/r for the sphere |p| - r. A line is the graph y(x).
"""
import os
import random
import sys

from mpmath import mp, mpf

mp.dps = 120

SURFACES = {
    "x² + y² + z²": lambda x, y, z: x * x + y * y + z * z,
    "|(x, y, z)|": lambda x, y, z: mp.sqrt(x * x + y * y + z * z),
    "hypot(x, z) + 0 y": lambda x, y, z: mp.hypot(x, z),
    "(|(x, y)| - 2)² + z²": lambda x, y, z: (mp.hypot(x, y) - 2) ** 2 + z * z,
    "cos(x) + cos(y) + cos(z)": lambda x, y, z: mp.cos(x) + mp.cos(y) + mp.cos(z),
    "sin(x) cos(y) + sin(y) cos(z) + sin(z) cos(x)": lambda x, y, z: mp.sin(x) * mp.cos(y)
    + mp.sin(y) * mp.cos(z)
    + mp.sin(z) * mp.cos(x),
    "x² y + z³ - exp(x z/4)": lambda x, y, z: x * x * y + z ** 3 - mp.exp(x * z / 4),
    "x² - y² + z": lambda x, y, z: x * x - y * y + z,
}
LINES = {
    "x² + y²": lambda x, y: x * x + y * y,
    "-hypot(x, y)": lambda x, y: -mp.hypot(x, y),
    "sin(x) cos(2y)": lambda x, y: mp.sin(x) * mp.cos(2 * y),
    "x³ + y³ - x y": lambda x, y: x ** 3 + y ** 3 - x * y,
}
STEP = mpf(10) ** -20


def slope(f, t):
    """Derivative of f at t by symmetric differences, extrapolated twice."""
    first = [(f(t + h) - f(t - h)) / (2 * h) for h in (STEP, STEP / 2, STEP / 4)]
    second = [(4 * b - a) / 3 for a, b in zip(first, first[1:])]
    return (16 * second[1] - second[0]) / 15


def bend(f, t):
    """Second derivative, by symmetric differences, extrapolated twice."""
    first = [(f(t + h) - 2 * f(t) + f(t - h)) / h ** 2 for h in (STEP, STEP / 2, STEP / 4)]
    second = [(4 * b - a) / 3 for a, b in zip(first, first[1:])]
    return (16 * second[1] - second[0]) / 15


def graph(f, start):
    """The root of f near to start, by Newton's method with a numerical slope."""
    t = start
    for _ in range(60):
        step = f(t) / ((f(t + STEP ** 2) - f(t - STEP ** 2)) / (2 * STEP ** 2))
        t -= step
        if abs(step) < mpf(10) ** -110:
            return t
    return t


def surface(f, p):
    x, y, z = p
    level = f(x, y, z)
    at = lambda u, v: graph(lambda w: f(u, v, w) - level, z)
    zx, zy = slope(lambda u: at(u, y), x), slope(lambda v: at(x, v), y)
    zxx, zyy = bend(lambda u: at(u, y), x), bend(lambda v: at(x, v), y)
    diagonal = bend(lambda t: at(x + t, y + t), mpf(0))
    zxy = (diagonal - zxx - zyy) / 2
    E, F, G = 1 + zx ** 2, zx * zy, 1 + zy ** 2
    W = mp.sqrt(1 + zx ** 2 + zy ** 2)
    L, M, N = zxx / W, zxy / W, zyy / W
    up = mp.sign(f(x, y, z + STEP) - level)
    mean = -up * (E * N - 2 * F * M + G * L) / (2 * (E * G - F ** 2))
    return mean, (L * N - M ** 2) / (E * G - F ** 2)


def line(f, p):
    x, y = p
    level = f(x, y)
    at = lambda u: graph(lambda v: f(u, v) - level, y)
    up = mp.sign(f(x, y + STEP) - level)
    return -up * bend(at, x) / (1 + slope(at, x) ** 2) ** mpf(1.5)


def points(rng, f, dimension, count):
    """Points that are float32 numbers, where the graph is not steep."""
    out = []
    while len(out) < count:
        p = [mpf(round(rng.uniform(-2.5, 2.5) * 4096)) / 4096 for _ in range(dimension)]
        rise = (f(*p[:-1], p[-1] + STEP) - f(*p)) / STEP
        side = [(f(*p[:k], p[k] + STEP, *p[k + 1:]) - f(*p)) / STEP for k in range(dimension - 1)]
        if abs(rise) > mpf(1) / 8 and all(abs(s) < 8 * abs(rise) for s in side):
            out.append(p)
    return out


def shown(value):
    return mp.nstr(value, 20, min_fixed=0, max_fixed=0) if abs(value) > mpf(10) ** -40 else "0"


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "../data/calculus/curvature.tsv")
    rng = random.Random(20260)
    with open(path, "w", encoding="utf-8", newline="\n") as out:
        out.write("# curvatures of level sets, by tests/oracle/curvature.py\n")
        out.write("# formula\tx\ty\tz\tmean\tgaussian\n")
        for text, f in SURFACES.items():
            for p in points(rng, f, 3, 12):
                mean, gaussian = surface(f, p)
                row = [text] + [repr(float(c)) for c in p] + [shown(mean), shown(gaussian)]
                out.write("\t".join(row) + "\n")
        for text, f in LINES.items():
            for p in points(rng, f, 2, 12):
                row = [text] + [repr(float(c)) for c in p] + ["-", shown(line(f, p)), "-"]
                out.write("\t".join(row) + "\n")


if __name__ == "__main__":
    main()
