#!/usr/bin/env python3
"""Write tests/data/functions/noise.txt and hash.tsv: hash, noise and what is made of it, with derivatives.

usage: noise.py [OUT_DIR]      (needs mpmath and numpy; default OUT_DIR: ../data/functions beside this file)

The hash is done in Python's integers, the choice of slopes by shifts and masks of its 24 bits, the nearest points by
looking at 7 cells along each axis. noise.txt has the format of library.txt (see README.md); the rows of hash.tsv are four
coordinates and 2^24 times the hash.

Before, the greatest values of gradient noise are bounded: those of the blend when each corner has the slope that is worst
for the point; see `bound`.
"""
import itertools
import math
import os
import random
import struct
import sys

import numpy as np

import gallery as g
from gallery import Num, f32, mp
from library import Dual, section
from shapes import absolute, hypot, hypot3, least

MASK = 0xFFFFFFFF


def word(v):
    """PCG-RXS-M-XS-32: one step and the output function."""
    s = (v * 747796405 + 2891336453) & MASK
    w = (((s >> ((s >> 28) + 4)) ^ s) * 277803737) & MASK
    return (w >> 22) ^ w


def coordinate(x):
    whole = math.floor(x)
    return whole & MASK if abs(whole) < 2**31 else struct.unpack("I", struct.pack("f", float(x)))[0]


def bits(*point):
    """The 24 bits of the hash of a point."""
    inner = 0
    for x in reversed([*point, 0, 0, 0, 0][:4]):
        inner = word((coordinate(x) + inner) & MASK)
    return inner >> 8


def plain(x):
    return x.a.v if isinstance(x, Dual) else x


def number(like, v):
    """An exact constant."""
    return like.like(Num(v, 0), [None] * len(like.d)) if isinstance(like, Dual) else mp.mpmathify(v)


# ------------------------------------------------------------------------------------------------------------------
# Slopes.
A = mp.sqrt(2) - 1
AXES2 = [(1, A), (A, 1)]


def slope(h, n):
    """The slope that 24 bits pick."""
    if n == 1:
        return [mp.mpf(2 * h - 2**24) / 2**24]
    if n == 2:
        u, v = AXES2[h >> 23]
        r = (h >> 20) & 7  # eighths of the rest
        return [u if r < 4 else -u, v if 2 <= r < 6 and (h & 0x7FFFFF) != 1 << 21 else -v]
    if n == 3:
        k = 3 * (h >> 12)
        axis, r = k >> 12, k & 4095
        free = [1 if r < 2048 else -1, 1 if 1024 < r < 3072 else -1]
    else:
        axis, r = h >> 22, h & 0x3FFFFF
        away = abs(r - 2**21)
        free = [1 if r < 2**21 else -1, 1 if away < 2**20 else -1, 1 if abs(away - 2**20) < 2**19 else -1]
    return free[:axis] + [0] + free[axis:]


def fade(t):
    u = 1 - t
    return t * t * t * (u * (6 * u + 3) + 1)


def blended(values, s):
    """Values by corner, the first coordinate running fastest."""
    for w in s:
        values = [a + w * (b - a) for a, b in zip(values[::2], values[1::2])]
    return values[0]


def corners(n):
    return [c[::-1] for c in itertools.product((0, 1), repeat=n)]


SCALE = {1: mp.mpf(2), 2: mp.mpf("1.39"), 3: mp.mpf("0.96"), 4: mp.mpf("0.64")}


def noise(p, seed=0):
    n = len(p)
    i = [mp.floor(plain(x)) for x in p]
    t = [x - c for x, c in zip(p, i)]
    values = []
    for corner in corners(n):
        lattice = [a + b for a, b in zip(i, corner)]
        at = lattice if n == 4 else [*lattice, *[0] * (3 - n), seed]
        terms = [number(x, v) * (x - c if c else x) if v not in (1, -1) else v * (x - c if c else x) for v, x, c in zip(slope(bits(*at), n), t, corner) if v]
        values.append(sum(terms[1:], terms[0]) if terms else number(t[0], 0))
    return SCALE[n] * blended(values, [fade(x) for x in t])


def value_noise(*p):
    i = [mp.floor(plain(x)) for x in p]
    values = [number(p[0], mp.mpf(bits(*[a + b for a, b in zip(i, c)])) / 2**24) for c in corners(len(p))]
    return blended(values, [fade(x - c) for x, c in zip(p, i)])


def hashed(*p):
    return number(p[0], mp.mpf(bits(*map(plain, p))) / 2**24)


# ------------------------------------------------------------------------------------------------------------------
# Cells.
def point(h, n):
    if n == 1:
        return [mp.mpf(h) / 2**24]
    if n == 2:
        return [mp.mpf(h >> 12) / 2**12, mp.mpf(h & 4095) / 2**12]
    return [mp.mpf((h >> k) & 255) / 256 for k in (16, 8, 0)]


def nearest(p):
    """The two nearest points of the cells, as offsets from p; the cells are 7 along each axis."""
    n = len(p)
    middle = [math.floor(plain(x)) for x in p]
    found = []
    for cell in itertools.product(range(-3, 4), repeat=n):
        c = [a + b for a, b in zip(middle, cell)]
        feature = [a + b for a, b in zip(c, point(bits(*c, *[0] * (3 - n), -1), n))]
        found.append((float(sum((mp.mpf(f) - plain(x)) ** 2 for f, x in zip(feature, p))), feature))
    found.sort()
    # twins at a distance that float64 cannot tell apart: by all digits
    twins = [f for d, f in found[:4]]
    twins.sort(key=lambda f: sum((v - plain(x)) ** 2 for v, x in zip(f, p)))
    return twins[:2]


def length(q):
    return absolute(q[0]) if len(q) == 1 else (hypot if len(q) == 2 else hypot3)(*q)


def seen(p, feature):
    """The offset of a point as the formula has it: both from a corner nearby."""
    corner = [mp.floor(plain(x) + mp.mpf(1) / 2) for x in p]
    return [number(x, f - c) - (x - c) for x, f, c in zip(p, feature, corner)]


def cellular(*p):
    return length(seen(p, nearest(p)[0]))


def cellular_border(*p):
    first, second = nearest(p)
    return length(seen(p, second)) - length(seen(p, first))


# ------------------------------------------------------------------------------------------------------------------
# Octaves.
def turn(q):
    c = lambda v: mp.mpf(v) / 100
    if len(q) == 1:
        return q
    x, y = q[:2]
    if len(q) == 2:
        return [c(80) * x - c(60) * y, c(60) * x + c(80) * y]
    z = q[2]
    return [c(80) * x - c(60) * y, c(48) * x + c(64) * y - c(60) * z, c(36) * x + c(48) * y + c(80) * z]


MOVED = [mp.mpf(v) / 100 for v in (37, 71, 19)]


def octaves(p, count, lacunarity, gain, fn):
    q, a, s, t = list(p), mp.mpf(1), None, mp.mpf(0)
    for k in range(min(math.ceil(count), 16)):
        weight = min(count - k, 1) * a
        term = weight * fn(noise(q, k))
        s, t = term if s is None else s + term, t + abs(weight)
        q = [lacunarity * x + o for x, o in zip(turn(q), MOVED)]
        a *= gain
    return s / t


def fbm(p, count=5, lacunarity=2, gain=mp.mpf("0.5")):
    return octaves(p, count, lacunarity, gain, lambda v: v)


def turbulence(p, count=5, lacunarity=2, gain=mp.mpf("0.5")):
    return octaves(p, count, lacunarity, gain, absolute)


def beside_a_kink(p):
    """Whether the first octave nearly vanishes, so that its sign is lost in float32: on one side of an integer."""
    return 0 < abs(noise(list(map(mp.mpf, p)))) < 1e-6


H34 = mp.mpf("0.75")
REAL = {
    "hash": ("hash(x)", hashed), "noise": ("noise(x)", lambda x: noise([x])), "value_noise": ("value_noise(x)", value_noise),
    "cellular": ("cellular(x)", cellular), "fbm": ("fbm(x)", lambda x: fbm([x])), "turbulence": ("turbulence(x)", lambda x: turbulence([x])),
    "fbm ": ("fbm(x, 2.5, 3, 0.75)", lambda x: fbm([x], mp.mpf("2.5"), 3, H34)),
}
PLANE = {
    "hash": ("hash((x, y))", hashed), "noise": ("noise((x, y))", lambda x, y: noise([x, y])), "noise ": ("noise(x, y)", lambda x, y: noise([x, y])),
    "value_noise": ("value_noise((x, y))", value_noise), "cellular": ("cellular((x, y))", cellular),
    "cellular_border": ("cellular_border((x, y))", cellular_border), "fbm": ("fbm((x, y))", lambda x, y: fbm([x, y])),
    "turbulence": ("turbulence((x, y), 3.25)", lambda x, y: turbulence([x, y], mp.mpf("3.25"))),
}
SPACE = {
    "hash": ("hash(x, y, z, y)", lambda x, y, z: hashed(x, y, z, y)), "hash ": ("hash((x, y, z))", hashed), "noise": ("noise((x, y, z))", lambda x, y, z: noise([x, y, z])),
    "noise ": ("noise(vec4(x, y, z, y))", lambda x, y, z: noise([x, y, z, y])),
    "value_noise": ("value_noise((x, y, z))", value_noise), "cellular": ("cellular((x, y, z))", cellular),
    "cellular_border": ("cellular_border((x, y, z))", cellular_border), "fbm": ("fbm((x, y, z))", lambda x, y, z: fbm([x, y, z])),
    "turbulence": ("turbulence((x, y, z), 2, 3, 0.75)", lambda x, y, z: turbulence([x, y, z], 2, 3, H34)),
}


# ------------------------------------------------------------------------------------------------------------------
# Range.
def worst(t, steepest):
    """The blend at the points t of the cell when each corner has the worst slope for the point."""
    s = t**3 * (t * (6 * t - 15) + 10)
    total = 0
    for corner in itertools.product((0, 1), repeat=len(t)):
        weight, offset = 1, []
        for k, c in enumerate(corner):
            weight = weight * (s[k] if c else 1 - s[k])
            offset.append(abs(t[k] - c))
        total = total + weight * steepest(np.array(offset))
    return total


def bound(n, steepest, most):
    """Shows by branch and bound that the blend stays below `most`; the greatest value that was met.

    Along one axis the blend changes by no more than 15/8, the greatest slope of the quintic, times the greatest difference
    of the values at both ends, plus the greatest component of a slope, 1. The values are at most that of the farthest
    corner, so the difference is below their greatest sum. By symmetry an eighth of the cell is enough.
    """
    lipschitz = n * (15 / 8 * steepest(np.ones((n, 1)))[0] + 1)
    boxes, half, met = np.full((n, 1), 0.25), 0.25, 0.0
    while boxes.shape[1]:
        values = worst(boxes, steepest)
        met = max(met, values.max())
        assert met < most, (n, met, most)
        boxes, half = boxes[:, values + lipschitz * half >= most], half / 2
        assert boxes.shape[1] < 3e6, (n, half, boxes.shape)
        steps = itertools.product((-half, half), repeat=n)
        boxes = np.concatenate([boxes + np.array(s)[:, None] for s in steps], axis=1)
    return met


STEEPEST = {
    2: lambda d: d.max(0) + float(A) * d.min(0),
    3: lambda d: d.sum(0) - d.min(0),
}


def points(rng, n):
    """Random ones near and far, to 2^20, and points of the lattice and beside it."""
    pts = g.points(rng, n, 3, [(0.5,) * n, (1.0, -1.0, 2.0)[:n], (0.0,) * n, (-0.25, 7.5, 3.125)[:n]])
    far = lambda: f32(rng.uniform(-1, 1) * 2.0 ** rng.uniform(3, 20))
    return pts + [tuple(far() for _ in range(n)) for _ in range(20)]


def main():
    for n, steepest in STEEPEST.items():
        met = bound(n, steepest, float(1 / SCALE[n]))
        print(f"noise in {n} dimensions: below {float(SCALE[n]) * met:.6f} and below 1", file=sys.stderr)
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions")
    rng = random.Random("hash")
    with open(os.path.join(out, "hash.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# 2^24 hash(x, y, z, w); written by tests/oracle/noise.py\n# x\ty\tz\tw\tbits\n")
        size = lambda: rng.choice([3, 100, 2.0**20, 2.0**31, 2.0**40, 1e30])
        for _ in range(200):
            p = [f32(rng.uniform(-1, 1) * size()) for _ in range(4)]
            fh.write("\t".join([*map(repr, p), str(bits(*p))]) + "\n")
    with open(os.path.join(out, "noise.txt"), "w", encoding="utf-8") as fh:
        for table, names in ((REAL, "x"), (PLANE, "xy"), (SPACE, "xyz")):
            slopes = [f"d{n}" for n in names]
            columns = [*names, "f", *slopes, "condition", "scale_f", *(f"scale_{d}" for d in slopes), "notes"]
            for name, (formula, f) in table.items():
                rng = random.Random(f"{name} {formula}")
                pts = points(rng, len(names))
                if "cellular" in name:  # farther, float32 has no neighbours of every integer
                    pts = [p for p in pts if max(map(abs, p)) < 2**22]
                if name == "turbulence":
                    pts = [p for p in pts if not beside_a_kink(p)]
                section(fh, name, ", ".join(names), formula, f, pts, columns)
                print(formula, file=sys.stderr)


if __name__ == "__main__":
    main()
