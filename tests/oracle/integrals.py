#!/usr/bin/env python3
"""Write tests/data/functions/integral_{edges,complex,wide,families,second}.tsv: the building blocks of ray integrals.

usage: integrals.py [OUT_DIR]      (needs mpmath; default OUT_DIR: ../data/functions beside this file)

The first three have the formats of real_edges.tsv, complex_edges.tsv and wide.tsv, for what has a name in the language. In `families`,
`family order arguments value derivative`, are all members of the families. Everything by definition, with 60 digits and more:
integrals by their closed forms or by mpmath's quadrature, derivatives by those of the integrand.
"""
import math
import os
import random
import struct
import sys

import mpmath as mp

mp.mp.dps = 80
INF, NAN = math.inf, math.nan
MAX, TINY, NOTHING = mp.mpf(2) ** 128 * (1 - mp.mpf(2) ** -25), mp.mpf(2) ** -126, mp.mpf(10) ** -46


def f32(v):
    return struct.unpack("f", struct.pack("f", v))[0]


def up(v, n=1):
    return struct.unpack("f", struct.pack("I", struct.unpack("I", struct.pack("f", v))[0] + n))[0]


# ---- definitions -------------------------------------------------------------------------------------------------
def moment(b, z):
    """∫₀¹ s^(b-1)/(1 + z s²) ds, by the hypergeometric series of DLMF 15.6.1 or its transformation 15.8.1."""
    with mp.workdps(120):
        return mp.hyp2f1(1, mp.mpf(b) / 2, mp.mpf(b) / 2 + 1, -z) / b


def atan_quotient(n, z):
    return moment(2 * n + 1, z)


def atan_quotient_slope(n, z):
    """-∫ s^(2n+2)/(1 + z s²)² ds"""
    with mp.workdps(120):
        b = 2 * n + 3
        return -mp.hyp2f1(2, mp.mpf(b) / 2, mp.mpf(b) / 2 + 1, -z) / b


def atan2_quotient(p, x):
    """∫ du/(u² + p) from x to infinity"""
    with mp.workdps(160):
        if p > 0:
            return mp.atan2(mp.sqrt(p), x) / mp.sqrt(p)
        if p == 0:
            return 1 / x
        q = mp.sqrt(-p)
        return mp.log((x + q) / (x - q)) / (2 * q)


def atan2_quotient_slopes(p, x):
    with mp.workdps(240):
        p, x = mp.mpf(p), mp.mpf(x)
        if p == 0:
            return -1 / (3 * x**3), -1 / x**2
        w = atan2_quotient(p, x)
        return -(w - x / (x * x + p)) / (2 * p), -1 / (x * x + p)


def log1prel(n, x):
    """∫₀¹ sⁿ/(1 + x s)^(n+1) ds"""
    with mp.workdps(120):
        return mp.hyp2f1(n + 1, n + 1, n + 2, -x) / (n + 1)


def spherical_j(n, x):
    with mp.workdps(120):
        if x == 0:
            return mp.mpf(n == 0)
        s = mp.sign(x) ** n
        x = abs(x)
        return s * mp.sqrt(mp.pi / (2 * x)) * mp.besselj(n + mp.mpf(1) / 2, x)


def spherical_i(n, x):
    """e^-|x| iₙ(x)"""
    with mp.workdps(120):
        if x == 0:
            return mp.mpf(n == 0)
        s = mp.sign(x) ** n
        x = abs(x)
        if x > 1e6:
            return s * sum((-1) ** k * mp.fac(n + k) / mp.fac(k) / mp.fac(n - k) / (2 * x) ** k for k in range(n + 1)) / (2 * x)
        return s * mp.exp(-x) * mp.sqrt(mp.pi / (2 * x)) * mp.besseli(n + mp.mpf(1) / 2, x)


def repeated(n, x):
    """e^(x²) iⁿerfc x (DLMF 7.18.10, by the parabolic cylinder function or its asymptotic series far out)"""
    with mp.workdps(200):
        if x > 60:
            total, term = mp.mpf(0), mp.mpf(1)
            for k in range(60):  # DLMF 7.18.14
                total += (-1) ** k * mp.fac(2 * k + n) / mp.fac(k) / (2 * x) ** (2 * k)
            return 2 / mp.sqrt(mp.pi) / mp.fac(n) / (2 * x) ** (n + 1) * total
        if n == 0:
            return mp.exp(x * x) * mp.erfc(x)
        with mp.workdps(300):
            value, last = mp.exp(x * x) * mp.erfc(x), 2 / mp.sqrt(mp.pi)
            for k in range(n):
                value, last = (last - 2 * x * value) / (2 * (k + 1)), value
            return value


def erfc(x):
    with mp.workdps(200):
        return mp.erfc(x)


def mass(c, w):
    with mp.workdps(600):
        c, w = mp.mpf(c), mp.mpf(w)
        a, b = c - w, c + w
        if a > 0 and b > 0 or a < 0 and b < 0:
            s = 1 if a > 0 else -1
            return mp.sqrt(mp.pi) / 2 * s * (mp.erfc(s * a) - mp.erfc(s * b))
        return mp.sqrt(mp.pi) / 2 * (mp.erf(b) - mp.erf(a))


def mass_slopes(c, w):
    with mp.workdps(400):
        far, near = mp.exp(-(mp.mpf(c) + w) ** 2), mp.exp(-(mp.mpf(c) - w) ** 2)
        return far - near, far + near


def scaled_mass(c, w):
    with mp.workdps(400):
        m = max(abs(mp.mpf(c)) - abs(mp.mpf(w)), 0)
        if m > 2000 or abs(c) > 2000:
            a, b = abs(mp.mpf(c)) - abs(w), abs(mp.mpf(c)) + abs(w)
            if 4 * abs(mp.mpf(c) * w) < mp.mpf(10) ** -30:
                return 2 * mp.mpf(w)
            return mp.sign(w) * mp.sqrt(mp.pi) / 2 * (repeated(0, a) - mp.exp(-4 * abs(mp.mpf(c) * w)) * repeated(0, b))
        return mass(c, w) * mp.exp(m * m)


def scaled_mass_slopes(c, w):
    """With m the distance from 0 the mass is multiplied by e^(m²), whose derivative is 2 m sign(c) by c, -2 m sign(w) by w."""
    with mp.workdps(600):
        c, w = mp.mpf(c), mp.mpf(w)
        m = abs(c) - abs(w)
        if m <= 0:
            return mass_slopes(c, w)
        value, fall = scaled_mass(c, w), mp.exp(-4 * abs(c * w))
        return mp.sign(c * w) * (fall - 1) + 2 * m * mp.sign(c) * value, 1 + fall - 2 * m * mp.sign(w) * value


def log1pexp(x):
    return mp.log1p(mp.exp(x)) if x < 300 else x + mp.exp(-x)


def sigmoid(x):
    return 1 / (1 + mp.exp(-x)) if x > -1e4 else mp.exp(x) if x > -1e6 else mp.mpf(0)


bell = lambda x: mp.exp(-x * x) if abs(x) < 1e3 else mp.mpf(0)
ROOT = 2 / mp.sqrt(mp.pi)
# name -> (value, slope, defined, at infinity, at minus infinity)
REAL = {
    "atanq": (lambda x: atan_quotient(0, x), lambda x: atan_quotient_slope(0, x), lambda x: x > -1, 0.0, NAN),
    "log1prel": (lambda x: log1prel(0, x), lambda x: -log1prel(1, x), lambda x: x > -1, 0.0, NAN),
    "log1pexp": (log1pexp, sigmoid, lambda x: True, INF, 0.0),
    "erf": (mp.erf, lambda x: ROOT * bell(x), lambda x: True, 1.0, -1.0),
    "erfc": (lambda x: erfc(x) if x < 1e3 else mp.mpf(0), lambda x: -ROOT * bell(x), lambda x: True, 0.0, 2.0),
    "erfcx": (lambda x: repeated(0, x) if x > -1e3 else mp.inf, lambda x: -2 * repeated(1, x) if x > -1e3 else -mp.inf, lambda x: True, 0.0, INF),
}
PAIRS = {
    "atan2q": (atan2_quotient, atan2_quotient_slopes),
    "gaussmass": (mass, mass_slopes),
    "gaussmassx": (scaled_mass, scaled_mass_slopes),
}
COMMON = [0.0, 2.0**-149, 2.0**-126, 1e-30, 1e-10, 1e-4, 0.1, 0.25, 0.5, 1.0, up(1.0), 1 - 2.0**-24, 2.0, 10.0, 1e10, 1e20, 3e38]
EXTRA = {
    "atanq": [-1 + 2.0**-24, -1 + 2.0**-12, -0.9, -0.89, -0.3, 0.49, 0.51, 2.99, 3.01, 100.0, 1e5, -2.0],
    "log1prel": [-1 + 2.0**-24, -1 + 2.0**-12, -0.9, -0.75, -0.3, 1e-9, 9.0, 9.1, 3.0, 1e5, -2.0],
    "log1pexp": [88.0, 89.0, -87.0, -88.5, -100.0, -104.0, -17.0, 17.0, 5.0, -5.0],
    "erf": [0.99, 1.01, 3.0, 3.9, 4.0, 9.0, 13.0], "erfc": [0.49, 0.51, 3.0, 5.0, 9.0, 9.19, 9.2, 9.5, 10.05, 10.2, -3.0, -5.0],
    "erfcx": [0.99, 1.01, 1.5, 3.0, 4.0, 5.0, 30.0, 1e3, 1e8, -3.0, -5.0, -9.0, -9.3, -9.4, -9.5, -13.0],
}


def show(v):
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
    return mp.nstr(v, 22)


def remark(v):
    if isinstance(v, float) or not mp.isfinite(v) or abs(v) >= MAX:
        return "overflow"
    return "underflow" if NOTHING <= abs(v) < TINY else "-"


def edge_rows():
    for name, (value, slope, defined, far, near) in REAL.items():
        xs = [s * f32(x) for x in COMMON for s in (1, -1)] + list(map(f32, EXTRA[name])) + [INF, -INF, NAN]
        for x in dict((repr(x), x) for x in xs).values():
            if not math.isfinite(x):
                yield name, x, "-", NAN if math.isnan(x) else far if x > 0 else near, "-", "-", "special"
            elif x == -1 and not defined(x):
                yield name, x, "-", INF, "-", "-", "pole"
            elif not defined(x):
                yield name, x, "-", NAN, "-", "-", "domain"
            elif x == 0 and name == "erf":
                yield name, x, "-", x, ROOT, "-", "-"
            else:
                v = value(mp.mpf(x))
                yield name, x, "-", v, slope(mp.mpf(x)), "-", remark(v)
    for c, w in [(0.0, 0.0), (0.0, -0.0), (3.0, 0.0), (-3.0, -0.0)]:
        for name in ("gaussmass", "gaussmassx"):
            yield name, c, w, w, "-", "-", "-"
    for name, points in (("gaussmass", mass_points()), ("gaussmassx", mass_points()), ("atan2q", angle_points())):
        value, slopes = PAIRS[name]
        for x, y in dict.fromkeys((f32(a), f32(b)) for a, b in points):
            v = value(mp.mpf(x), mp.mpf(y))
            d = slopes(mp.mpf(x), mp.mpf(y))
            yield name, x, y, v, *d, remark(v)
    for name in ("gaussmass", "gaussmassx"):
        for c, w, v in [(0.0, INF, mp.sqrt(mp.pi)), (3.0, -INF, -mp.sqrt(mp.pi)), (INF, 2.0, 0.0), (-INF, 1.0, 0.0)]:
            yield name, c, w, v, "-", "-", "special"
        for c, w in [(NAN, 1.0), (1.0, NAN), (NAN, NAN)]:
            yield name, c, w, NAN, "-", "-", "special"
    for p, x, v in [(1.0, INF, 0.0), (-1.0, INF, 0.0), (INF, 1.0, 0.0), (INF, -1.0, 0.0), (4.0, -INF, mp.pi / 2), (NAN, 1.0, NAN), (1.0, NAN, NAN), (-INF, 1.0, NAN)]:
        yield "atan2q", p, x, v, "-", "-", "special"
    for p, x, v in [(0.0, 0.0, INF), (0.0, -1.0, INF), (-0.0, -2.0, INF), (-1.0, 1.0, INF), (-4.0, 2.0, INF), (-1.0, 0.5, NAN), (-1.0, -2.0, NAN), (-1.0, 0.0, NAN)]:
        yield "atan2q", p, x, v, "-", "-", "pole" if v == INF else "domain"


def mass_points():
    for c in [0.0, 1e-30, 1e-4, 0.3, 1.0, -1.0, 2.5, 5.0, -8.0, 9.0, 12.0]:
        for w in [1e-30, 1e-7, 1e-3, 0.1, 0.49, 1.0, 1.7, 2.5, 4.999, 8.0, 30.0]:
            yield c, w
            yield -c, -w
    yield from [(30.0, 1e-3), (1000.0, 1e-3), (1e10, 1e-12), (1e3, 900.0), (1e10, 1.0), (1e20, 1e10)]


def angle_points():
    for x in [1e-10, 1e-3, 0.5, 1.0, 3.0, 1e4, 1e18]:
        for z in [0.0, 1e-30, 1e-7, 1e-3, 0.1, 0.49, 0.51, 0.99, 1.9, 2.1, 10.0, 1e6]:
            yield f32(x) * x * z, x
            if 0 < z < 1:
                yield -f32(x) * x * z, x
    for p in [1e-20, 1e-6, 0.1, 1.0, 4.0, 1e10]:
        for x in [0.0, -1e-10, -1e-3, -0.5, -1.0, -3.0, -1e4, -1e15]:
            yield p, x
    yield from [(-(1 - 2.0**-24), 1.0), (-(1 - 2.0**-12), 1.0), (-4 * (1 - 2.0**-23), 2.0), (1e-30, 1e-20), (3e38, 1e19), (1e38, -1e19), (1.0, 1e30), (-1.0, 1e30)]


def widened(rng, size):
    high = f32(size)
    if high == 0:
        return high
    return high + math.ldexp(rng.randrange(-(2**23) + 1, 2**23), math.frexp(high)[1] - 49)


def wide_rows():
    rng = random.Random(7)
    reach = lambda v: all(mp.mpf(10) ** -30 < abs(x) < mp.mpf(10) ** 30 for x in v)
    for name, (value, slope, defined, *_) in REAL.items():
        count = 0
        while count < 60:
            size = (2.0 ** rng.uniform(-20, 20), rng.uniform(0, 8), 2.0 ** rng.uniform(-3, 3))[count % 3] * rng.choice((1, -1))
            if name in ("atanq", "log1prel") and count % 4 == 0:
                size = -1 + 2.0 ** rng.uniform(-12, 0)
            x = widened(rng, size)
            if x == 0 or not defined(mp.mpf(x)) or name == "erfcx" and x < -5 or name == "erfc" and x > 8:
                continue
            v, d = value(mp.mpf(x)), slope(mp.mpf(x))
            count += 1
            if reach([v, d]):
                yield name, [x], [v], [d]
    for name, (value, slopes) in PAIRS.items():
        for k in range(90):
            if name == "atan2q":
                x = widened(rng, rng.choice((1, -1)) * 2.0 ** rng.uniform(-6, 6))
                p = widened(rng, x * x * 2.0 ** rng.uniform(-12, 6)) if k % 3 or x < 0 else widened(rng, -x * x * rng.uniform(0, 0.999))
                args = [p, x]
            else:
                c = widened(rng, rng.choice((1, -1)) * rng.uniform(0, 6))
                args = [c, widened(rng, 2.0 ** rng.uniform(-12, 3) if k % 3 else abs(c) * (1 + rng.choice((1, -1)) * 2.0 ** rng.uniform(-9, -1)))]
            v, d = value(*map(mp.mpf, args)), slopes(*map(mp.mpf, args))
            if reach([v, *d]):
                yield name, args, [v], list(d)


SIDE = mp.mpf(10) ** -150
smear = lambda v: (-SIDE if math.copysign(1, v) < 0 else SIDE) if v == 0 else mp.mpf(v)


def complex_log1prel(z):
    with mp.workdps(400):
        value = mp.log(1 + z) / z
        return value, (1 / (1 + z) - value) / z


def complex_rows():
    both = lambda v: (v, -v)
    grid = [(a, b) for x in (0.0, 0.5, 1.0, 2.0) for y in (0.0, 0.5, 1.0, 2.0) for a in both(x) for b in both(y)]
    hard = [(-1.0, 1e-4), (-1.0, -1e-10), (-1 + 2.0**-24, 1e-20), (1e-10, 1e-10), (1e-20, -1e-30), (1e-4, -1e-4), (-0.9, 0.3), (-1.6, 0.8),
            (-0.4, 0.8), (-7.0, 1e-30), (-7.0, 0.0), (-7.0, -0.0), (1e-3, 1e-20), (3e-3, 3e-3), (-0.75, 0.0), (9.0, -0.0), (0.1, 4.0), (-2.1, -3.0)]
    far = [(1e10, 1.0), (1.0, 1e10), (-1e10, 0.0), (1e20, 1e20), (-1e20, 1e15), (3e35, 1.0), (0.0, -3e35)]
    for x, y in dict((repr((f32(a), f32(b))), (f32(a), f32(b))) for a, b in grid + hard + far).values():
        if (x, y) == (-1.0, 0.0):
            yield x, y, INF, -y, None, "pole"
            continue
        value, slope = complex_log1prel(mp.mpc(smear(x), smear(y)))
        yield x, y, value.real, value.imag, slope, "cut" if y == 0 and x < -1 else remark(value.real)


def complex_wide_rows():
    rng = random.Random(11)
    places = (
        lambda: (rng.uniform(-4, 4), rng.uniform(-4, 4)), lambda: (2.0 ** rng.uniform(-20, 0) * rng.choice((1, -1)), 2.0 ** rng.uniform(-20, 0)),
        lambda: (-1 + 2.0 ** rng.uniform(-12, -1) * rng.choice((1, -1)), 2.0 ** rng.uniform(-12, -1)), lambda: (rng.uniform(-9, -1), 2.0 ** rng.uniform(-40, -4)),
        lambda: (2.0 ** rng.uniform(3, 30), -(2.0 ** rng.uniform(3, 30))),
    )
    for k in range(60):
        x, y = (widened(rng, v) for v in places[k % 5]())
        yield "log1prel", (x, y), *complex_log1prel(mp.mpc(x, y))


def family_rows():
    rng = random.Random(9)
    around = lambda *xs: [s * x * (1 + e) for x in xs for e in (-1e-3, 1e-3) for s in (1, -1)]
    for n in range(7):
        for z in [0.0, 1e-30, -1e-9, 1e-4, *around(0.1, 0.25, 0.5, 0.9), -0.999, -1 + 2.0**-24, 1.0, 1.99, 2.01, *around(3.0), 10.0, 1e3, 1e8] + [rng.uniform(-1, 4) for _ in range(20)]:
            z = f32(z)
            if z > -1:
                yield "atanq", n, [z], atan_quotient(n, mp.mpf(z)), atan_quotient_slope(n, mp.mpf(z))
    for n in range(6):
        for x in [0.0, 1e-30, -1e-9, 1e-4, *around(0.1, 0.5), -0.74, -0.76, -0.999, -1 + 2.0**-24, 1.0, *around(9.0), 100.0, 1e5] + [rng.uniform(-1, 4) for _ in range(20)]:
            x = f32(x)
            if x > -1:
                yield "log1prel", n, [x], log1prel(n, mp.mpf(x)), -(n + 1) * log1prel(n + 1, mp.mpf(x))
    for n in range(6):
        for x in [0.0, 1e-30, 1e-4, *around(1.0, 2.0, 0.5), 3.0, 5.0, 10.0, 30.0, 1e3, 1e6, -3.0] + [rng.uniform(-4, 8) for _ in range(20)]:
            x = f32(x)
            yield "erfcx", n, [x], repeated(n, mp.mpf(x)), -2 * (n + 1) * repeated(n + 1, mp.mpf(x))
    for n in range(13):
        edges = [math.sqrt(2 * n + 3), n, math.sqrt(4 * n + 6), n * (n + 1), n * (n + 1) / 2, 2 * n * (n + 1)]
        xs = [0.0, 1e-30, 1e-4, 0.1, 1.0, *around(*edges), 20.0, 50.0, 100.0, 1000.0, 1e6] + [rng.uniform(0, 1.5 * n + 6) for _ in range(20)]
        for x in map(f32, xs):
            x_ = mp.mpf(x)
            below = spherical_j(n - 1, x_) if n else 0
            yield "spherical_j", n, [x], spherical_j(n, x_), (n * below - (n + 1) * spherical_j(n + 1, x_)) / (2 * n + 1)
        for x in map(f32, xs):
            x_ = mp.mpf(x)
            with mp.workdps(200):
                below = spherical_i(n - 1, x_) if n else 0
                slope = (n * below + (n + 1) * spherical_i(n + 1, x_)) / (2 * n + 1) - mp.sign(x_) * spherical_i(n, x_)
            yield "spherical_i_scaled", n, [x], spherical_i(n, x_), slope
    for x in [0.0, 1e-20, 0.1, 0.5, 1.0, 2.0, 3.0, 5.0, 7.0, 8.5, 9.0, 9.3, 1e10, -2.0, -5.0]:
        x = f32(x)
        yield "gauss", 0, [x], bell(mp.mpf(x)), -2 * mp.mpf(x) * bell(mp.mpf(x))


def mass_seconds(c, w):
    c, w = mp.mpf(c), mp.mpf(w)
    far, near = mp.exp(-(c + w) ** 2), mp.exp(-(c - w) ** 2)
    return -2 * (c + w) * far + 2 * (c - w) * near, -2 * (c + w) * far - 2 * (c - w) * near, -2 * (c + w) * far + 2 * (c - w) * near


def scaled_mass_seconds(c, w):
    c, w = mp.mpf(c), mp.mpf(w)
    seconds = mass_seconds(c, w)
    m = abs(c) - abs(w)
    if m <= 0:
        return seconds
    along = (mp.sign(c), -mp.sign(w))
    value, slopes = mass(c, w), mass_slopes(c, w)
    out = []
    for second, (i, j) in zip(seconds, ((0, 0), (0, 1), (1, 1))):
        out.append(mp.exp(m * m) * (second + 2 * m * (along[i] * slopes[j] + along[j] * slopes[i]) + (2 + 4 * m * m) * along[i] * along[j] * value))
    return tuple(out)


def angle_seconds(p, x):
    p, x = mp.mpf(p), mp.mpf(x)
    s = x * x + p
    by_p = 2 / (5 * x**5) if p == 0 else (atan2_quotient(p, x) - x / s) / (2 * p * p) - (atan2_quotient_slopes(p, x)[0] + x / s**2) / (2 * p)
    return by_p, 1 / s**2, 2 * x / s**2


SECONDS = {
    "atanq": lambda x: 2 * mp.hyp2f1(3, mp.mpf(5) / 2, mp.mpf(7) / 2, -x) / 5,
    "log1prel": lambda x: 2 * log1prel(2, x),
    "log1pexp": lambda x: sigmoid(x) * sigmoid(-x),
    "erf": lambda x: -2 * x * ROOT * bell(x),
    "erfc": lambda x: 2 * x * ROOT * bell(x),
    "erfcx": lambda x: 8 * repeated(2, x),
}
SECONDS_OF_PAIRS = {"atan2q": angle_seconds, "gaussmass": mass_seconds, "gaussmassx": scaled_mass_seconds}


def second_rows():
    rng = random.Random(13)
    mp.mp.dps = 300
    sizes = [0.0, 1e-30, 1e-10, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.6, 0.9, 1.0, 1.9, 2.1, 3.0, 3.1, 5.0, 8.0]
    for name, second in SECONDS.items():
        xs = [s * x for x in sizes for s in (1, -1)] + [rng.uniform(-5, 8) for _ in range(30)] + [-1 + 2.0 ** rng.uniform(-10, 0) for _ in range(10)]
        for x in dict.fromkeys(map(f32, xs)):
            if REAL[name][2](x):
                yield name, "real", [x], [second(mp.mpf(x))]
    for name, second in SECONDS_OF_PAIRS.items():
        for k in range(120):
            if name == "atan2q":
                x = f32(rng.choice((1, -1)) * 2.0 ** rng.uniform(-4, 4))
                z = rng.choice((0.0, 2.0 ** rng.uniform(-12, 6), -rng.uniform(0, 0.95))) if x > 0 else 2.0 ** rng.uniform(-6, 6)
                args = [f32(x * x * z), x]
            else:
                c = f32(rng.choice((0.0, 1.0, -1.0)) * rng.uniform(0, 5))
                args = [c, f32(rng.choice((1, -1)) * (2.0 ** rng.uniform(-8, 2)))]
            yield name, "real", args, list(second(*args))
    for _, args, *_ in complex_wide_rows():
        x, y = map(f32, args)
        with mp.workdps(400):
            z = mp.mpc(x, y)
            value = mp.log(1 + z) / z
            slope = (1 / (1 + z) - value) / z
            second = -(1 / (1 + z) ** 2 + 2 * slope) / z
        if mp.mpf(10) ** -30 < abs(second) < mp.mpf(10) ** 30:
            yield "log1prel", "complex", [x, y], [second.real, second.imag]


def text(values):
    return " ".join(mp.nstr(v, 25) for v in values)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions")
    with open(os.path.join(out, "integral_families.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# members of the families of ray integrals; written by tests/oracle/integrals.py\n# family\torder\targuments\tvalue\tderivative\n")
        for name, order, args, v, d in family_rows():
            fh.write("\t".join([name, str(order), " ".join(map(repr, args)), show(v), show(d)]) + "\n")
    with open(os.path.join(out, "integral_edges.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# edges of the building blocks of ray integrals; written by tests/oracle/integrals.py\n# function\tx\ty\tvalue\tdx\tdy\tnotes\n")
        for name, x, y, v, dx, dy, notes in edge_rows():
            cells = [name, *(show(a) for a in (x, y, v, dx, dy)), notes]
            fh.write("\t".join(cells) + "\n")
    with open(os.path.join(out, "integral_wide.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# arguments of more bits than float32; written by tests/oracle/integrals.py\n# function\tdomain\targuments\tvalue\tderivative\n")
        for name, args, v, d in wide_rows():
            fh.write("\t".join([name, "real", " ".join(map(repr, args)), text(v), text(d)]) + "\n")
        for name, args, v, d in complex_wide_rows():
            fh.write("\t".join([name, "complex", " ".join(map(repr, args)), text((v.real, v.imag)), text((d.real, d.imag))]) + "\n")
    with open(os.path.join(out, "integral_second.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# second derivatives of the building blocks of ray integrals; written by tests/oracle/integrals.py\n")
        for name, domain, args, values in second_rows():
            cells = " ".join(show(v) if v else "0.0" for v in values)
            fh.write("\t".join([name, domain, " ".join(map(repr, args)), cells]) + "\n")
    mp.mp.dps = 80
    with open(os.path.join(out, "integral_complex.tsv"), "w", encoding="utf-8") as fh:
        fh.write("# edges of the building blocks of ray integrals; written by tests/oracle/integrals.py\n# function\tz.re\tz.im\tw.re\tw.im\tf.re\tf.im\td.re\td.im\tnotes\n")
        for x, y, re, im, d, notes in complex_rows():
            slopes = ["-", "-"] if d is None else [show(d.real), show(d.imag)]
            fh.write("\t".join(["log1prel", show(x), show(y), "-", "-", show(re), show(im), *slopes, notes]) + "\n")


if __name__ == "__main__":
    main()
