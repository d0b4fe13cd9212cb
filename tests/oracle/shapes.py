#!/usr/bin/env python3
"""Write tests/data/functions/shapes.txt: distances, blends and ramps of the library, with their derivatives.

usage: shapes.py [OUT_FILE]      (needs mpmath and numpy; default OUT_FILE: ../data/functions/shapes.txt beside this file)

The format is that of library.txt (see README.md). Each distance is first compared with the least distance to points of
the surface, searched for by brute force on a parametrisation that does not know the formula.
"""
import os
import random
import sys

import numpy as np

import gallery as g
from gallery import Num, absolute, exp, greatest, least, log1p, mp, plus, sqrt, times
from library import Dual, HALF, clamp, constant, section

QUARTER, EIGHTH = HALF / 2, HALF / 4
C06, C08 = mp.mpf("0.6"), mp.mpf("0.8")


def positive(x):
    return greatest(x, constant(x, 0))


def saturate(x):
    return clamp(x, constant(x, 0), constant(x, 1))


def floor(x):
    return constant(x, mp.floor(x.a.v if isinstance(x, Dual) else x))


def hypot(x, y):
    """√(x² + y²), whose slopes x/r and y/r carry the errors of x and y, too: r may be small after a cancellation."""
    if not isinstance(x, Dual):
        return mp.hypot(x, y)
    a, b = x.a.v, y.a.v
    r = mp.hypot(a, b)
    if not r:
        return x.like(Num(0), [None] * len(x.d))
    bend = (abs(b) * x.a.e + abs(a) * y.a.e) / r**3
    p, q = Num(a / r, abs(b) * bend + 4 * abs(a) / r), Num(b / r, abs(a) * bend + 4 * abs(b) / r)
    error = abs(p.v) * x.a.e + abs(q.v) * y.a.e + r
    return x.like(Num(r, error), [plus(times(s, p), times(t, q)) for s, t in zip(x.d, y.d)])


def hypot3(x, y, z):
    return hypot(hypot(x, y), z)


# ------------------------------------------------------------------------------------------------------------------
# Shapes.
def sphere(x, y, z, r=mp.mpf("1.25")):
    return hypot3(x, y, z) - r


def box3(x, y, z, b=(1, HALF, 2)):
    q = [absolute(v) - w for v, w in zip((x, y, z), b)]
    return hypot3(*map(positive, q)) + least(greatest(greatest(q[0], q[1]), q[2]), constant(x, 0))


def box2(x, y, b=(1, HALF)):
    q = [absolute(v) - w for v, w in zip((x, y), b)]
    return hypot(*map(positive, q)) + least(greatest(*q), constant(x, 0))


def torus(x, y, z, R=mp.mpf("1.5"), r=HALF):
    return hypot(hypot(x, y) - R, z) - r


def cylinder(x, y, z, r=1, h=3 * QUARTER):
    return box2(hypot(x, y), z, (r, h))


def segment(p, a, b):
    d = [v - w for v, w in zip(b, a)]
    q = [v - w for v, w in zip(p, a)]
    l = sum(v * v for v in d)
    t = saturate(sum((v * w for v, w in zip(q[1:], d[1:])), q[0] * d[0]) / l)
    return (hypot if len(p) == 2 else hypot3)(*[v - t * w for v, w in zip(q, d)])


A3, B3 = [mp.mpf(v) for v in ("-1", "0", "0.5")], [mp.mpf(v) for v in ("1", "0.5", "-1")]
A2, B2 = [mp.mpf(v) for v in ("-1", "0.25")], [mp.mpf(v) for v in ("1", "-0.5")]


def cone(x, y, z, r=1, h=2):
    rho = hypot(x, y)
    out = rho - r
    t = saturate((h * z - r * out) / (r * r + h * h))
    side, base = hypot(out + r * t, z - h * t), hypot(positive(out), z)
    inside = constant(x, 0) < z and h * out + r * z < 0
    return (-1 if inside else 1) * least(side, base)


def octahedron(x, y, z, r=mp.mpf("1.5")):
    a, b, c = map(absolute, (x, y, z))
    hi, lo = greatest(greatest(a, b), c), least(least(a, b), c)
    mid = greatest(least(a, b), least(greatest(a, b), c))
    if 2 * lo - mid - hi + r < 0:
        t = clamp((hi - mid + r) / 2, constant(x, 0), constant(x, r))
        return hypot3(hi - t, mid - r + t, lo)
    return (a + b + c - r) / mp.sqrt(3)


def ellipsoid(x, y, z, a=(1, 2, HALF)):
    return (hypot3(x / a[0], y / a[1], z / a[2]) - 1) * min(a)


def refract_x(x, y, z, eta=3 * QUARTER):
    k = 1 - eta * eta * (1 - z * z)
    return eta * x if not k < 0 else constant(x, 0)


def refract_y(x, y, eta=3 * HALF):
    k = 1 - eta * eta * (1 - y * y)
    return constant(x, 0) if k < 0 else eta * y - (eta * y + sqrt(positive(k)))


# ------------------------------------------------------------------------------------------------------------------
# Blends, as lower and upper value.
def ordered(fn):
    return lambda x, y: fn(x, y) if x < y else fn(y, x)


def flipped(fn):
    """The maximum of a minimum."""
    return lambda x, y: -fn(-x, -y)


K = HALF
smin_cubic = ordered(lambda lo, hi: lo - K * positive(1 - (hi - lo) / K) ** 3 / 6)
smin_exp = ordered(lambda lo, hi: lo - K * log1p(exp((lo - hi) / K)))
smin_root = ordered(lambda lo, hi: lo - K * (K / (hypot(hi - lo, constant(lo, K)) + (hi - lo))) / 2)


def smootherstep(a, b, x):
    t = saturate((x - a) / (b - a))
    u = 1 - t
    return t * t * t * (u * (6 * u + 3) + 1)


REAL = {
    "remap": ("remap(x, 1, 3, -1, 5)", lambda x: -1 * (1 - (x - 1) / 2) + 5 * ((x - 1) / 2)),
    "smootherstep": ("smootherstep(-1, 2, x)", lambda x: smootherstep(-1, 2, x)),
    "repeat": ("repeat(x, 1.5)", lambda x: x - 3 * HALF * floor(x / (3 * HALF) + HALF)),
    "inversesqrt": ("inversesqrt(x^2 + 1)", lambda x: 1 / sqrt(x * x + 1)),
}
PLANE = {
    "box": ("box((x, y), (1, 0.5))", box2), "box ": ("box((x, y), 0.75)", lambda x, y: box2(x, y, (3 * QUARTER,) * 2)),
    "round_box": ("round_box((x, y), (1, 0.5), 0.25)", lambda x, y: box2(x, y, (1 - QUARTER, HALF - QUARTER)) - QUARTER),
    "segment": ("segment((x, y), (-1, 0.25), (1, -0.5))", lambda x, y: segment((x, y), A2, B2)),
    "segment ": ("segment((x, y), (1, 0.5), (1, 0.5))", lambda x, y: hypot(x - 1, y - HALF)),
    "capsule": ("capsule((x, y), (-1, 0.25), (1, -0.5), 0.25)", lambda x, y: segment((x, y), A2, B2) - QUARTER),
    "circle": ("circle((x, y), 1.25)", lambda x, y: hypot(x, y) - 5 * QUARTER),
    "ring": ("ring((x, y), 1.25, 0.25)", lambda x, y: absolute(hypot(x, y) - 5 * QUARTER) - QUARTER),
    "plane": ("plane((x, y), (0.6, -0.8), 0.5)", lambda x, y: x * C06 - y * C08 - HALF),
    "reflect": ("reflect((x, y), (0.6, -0.8)).y", lambda x, y: y - 2 * (C06 * x - C08 * y) * -C08),
    "refract": ("refract((x, y), (0, 1), 1.5).y", refract_y),
    "faceforward": ("faceforward((x, y), (1, 2), (y, x)).x", lambda x, y: x if y + x * 2 < 0 else -x),
    "smin_cubic": ("smin_cubic(x, y, 0.5)", smin_cubic), "smax_cubic": ("smax_cubic(x, y, 0.5)", flipped(smin_cubic)),
    "smin_exp": ("smin_exp(x, y, 0.5)", smin_exp), "smax_exp": ("smax_exp(x, y, 0.5)", flipped(smin_exp)),
    "smin_root": ("smin_root(x, y, 0.5)", smin_root), "smax_root": ("smax_root(x, y, 0.5)", flipped(smin_root)),
}
SPACE = {
    "sphere": ("sphere((x, y, z), 1.25)", sphere),
    "box": ("box((x, y, z), (1, 0.5, 2))", box3), "box ": ("box((x, y, z), 0.75)", lambda x, y, z: box3(x, y, z, (3 * QUARTER,) * 3)),
    "round_box": ("round_box((x, y, z), (1, 0.5, 2), 0.25)", lambda x, y, z: box3(x, y, z, (1 - QUARTER, HALF - QUARTER, 2 - QUARTER)) - QUARTER),
    "torus": ("torus((x, y, z), 1.5, 0.5)", torus), "cylinder": ("cylinder((x, y, z), 1, 0.75)", cylinder),
    "plane": ("plane((x, y, z), (0.6, 0, 0.8), 0.5)", lambda x, y, z: x * C06 + z * C08 - HALF + 0 * y),
    "segment": ("segment((x, y, z), (-1, 0, 0.5), (1, 0.5, -1))", lambda x, y, z: segment((x, y, z), A3, B3)),
    "capsule": ("capsule((x, y, z), (-1, 0, 0.5), (1, 0.5, -1), 0.25)", lambda x, y, z: segment((x, y, z), A3, B3) - QUARTER),
    "cone": ("cone((x, y, z), 1, 2)", cone), "octahedron": ("octahedron((x, y, z), 1.5)", octahedron),
    "ellipsoid": ("ellipsoid((x, y, z), (1, 2, 0.5))", ellipsoid),
    "reflect": ("reflect((x, y, z), (0.6, 0, 0.8)).x", lambda x, y, z: x - 2 * (C06 * x + C08 * z) * C06 + 0 * y),
    "refract": ("refract((x, y, z), (0, 0, 1), 0.75).x", refract_x),
    "faceforward": ("faceforward((x, y, z), (1, 2, -1), (z, x, y)).y", lambda x, y, z: y if z + 2 * x - y < 0 else -y),
}


# ------------------------------------------------------------------------------------------------------------------
# Brute force: patches (u, v) in the unit square -> points of the surface, and whether a point lies inside.
def circle_at(u):
    return np.cos(2 * np.pi * u), np.sin(2 * np.pi * u)


def faces(b):
    """The rectangles of a box."""
    out = []
    for axis in range(3):
        for side in (-1, 1):
            def face(u, v, axis=axis, side=side):
                free = iter((2 * u - 1, 2 * v - 1))
                return [side * b[k] + 0 * u if k == axis else next(free) * b[k] for k in range(3)]
            out.append(face)
    return out


def round_patches(profile):
    """Surfaces of revolution about z: v -> (radius, height)."""
    def patch(u, v, curve):
        c, s = circle_at(u)
        rho, z = curve(v)
        return [rho * c, rho * s, z + 0 * u]
    return [lambda u, v, curve=curve: patch(u, v, curve) for curve in profile]


def line(a, b):
    return lambda t: tuple(p + t * (q - p) for p, q in zip(a, b))


def triangles(r):
    return [lambda u, v, s=s: [s[0] * r * u * (1 - v), s[1] * r * u * v, s[2] * r * (1 - u)] for s in np.ndindex(2, 2, 2) for s in [[2 * k - 1 for k in s]]]


def l(p):
    return np.sqrt(sum(c * c for c in p))


SURFACES = {
    "sphere": (round_patches([lambda v: (1.25 * np.sin(np.pi * v), 1.25 * np.cos(np.pi * v))]), lambda p: l(p) < 1.25),
    "box": (faces((1, 0.5, 2)), lambda p: abs(p[0]) < 1 and abs(p[1]) < 0.5 and abs(p[2]) < 2),
    "torus": (round_patches([lambda v: (1.5 + 0.5 * np.cos(2 * np.pi * v), 0.5 * np.sin(2 * np.pi * v))]), lambda p: (l(p[:2]) - 1.5) ** 2 + p[2] ** 2 < 0.25),
    "cylinder": (round_patches([line((1, -0.75), (1, 0.75)), line((0, 0.75), (1, 0.75)), line((0, -0.75), (1, -0.75))]), lambda p: l(p[:2]) < 1 and abs(p[2]) < 0.75),
    "cone": (round_patches([line((1, 0), (0, 2)), line((0, 0), (1, 0))]), lambda p: 0 < p[2] < 2 * (1 - l(p[:2]))),
    "octahedron": (triangles(1.5), lambda p: sum(map(abs, p)) < 1.5),
    "segment": ([lambda u, v: [a + u * (b - a) for a, b in zip((-1, 0, 0.5), (1, 0.5, -1))]], lambda p: False),
    "ellipsoid": (round_patches([lambda v: (np.sin(np.pi * v), np.cos(np.pi * v))]), lambda p: l((p[0], p[1] / 2, p[2] * 2)) < 1),
}


def nearest(patches, p):
    """The least distance from p to the patches: a grid, then finer and finer grids about its best points."""
    best = np.inf
    for patch in patches:
        u, v = np.meshgrid(np.linspace(0, 1, 81), np.linspace(0, 1, 81))
        d = l([a - b for a, b in zip(patch(u, v), p)])
        for place in np.argsort(d, axis=None)[:4]:
            cu, cv, width = u.flat[place], v.flat[place], 1 / 40
            for _ in range(24):
                uu, vv = np.meshgrid(np.clip(cu + np.linspace(-width, width, 9), 0, 1), np.clip(cv + np.linspace(-width, width, 9), 0, 1))
                e = l([a - b for a, b in zip(patch(uu, vv), p)])
                at = e.argmin()
                cu, cv, width = uu.flat[at], vv.flat[at], width / 2
            best = min(best, e.min())
    return best


def check():
    rng = random.Random("shapes")
    for name, (patches, inside) in SURFACES.items():
        f = SPACE[name][1]
        worst = 0
        for _ in range(40):
            p = [rng.uniform(-2.5, 2.5) if rng.random() < 0.7 else rng.uniform(-0.7, 0.7) for _ in range(3)]
            sign = -1 if inside(p) else 1
            if name == "ellipsoid":  # stretched: the patch is that of the unit sphere
                patches = [lambda u, v, q=SURFACES[name][0][0]: [c * a for c, a in zip(q(u, v), (1, 2, 0.5))]]
            found, value = sign * nearest(patches, p), float(f(*map(mp.mpf, p)))
            if name == "ellipsoid":
                assert abs(value) <= abs(found) + 1e-9 and value * found > 0, (name, p, value, found)
            else:
                worst = max(worst, abs(found - value))
                assert abs(found - value) < 1e-6, (name, p, value, found)
        print(f"{name}: within {worst:.1e} of brute force", file=sys.stderr)


def main():
    check()
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "shapes.txt")
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
