#!/usr/bin/env python3
"""Write tests/data/gallery/NAME.tsv: value and derivatives of every gallery formula, to 20 digits.

usage: gallery.py [OUT_DIR]      (needs mpmath; default OUT_DIR: ../data/gallery beside this file)

The formulas below are translated by hand from docs/gallery/*.pull, with every `param` at its default; nothing here
reads a .pull file or calls the compiler. Values and derivatives come from plain mpmath numbers of 480 digits,
derivatives by symmetric differences with a relative step of 1e-200. README.md beside this file has the format.

A second evaluation, on numbers that carry a running error bound, gives the `scale` columns and is used as a check:
it differentiates forwards, and must agree with the differences.
"""
import os
import random
import sys

import mpmath as mp

mp.mp.dps = 480
STEP = mp.mpf(10) ** -200
SIDE = mp.mpf(10) ** -150  # stands for a signed zero of a complex argument: the limit from that side
NOTHING = mp.mpf(10) ** -90  # what is smaller is a zero, smeared by SIDE or STEP
MAX, TINY = mp.mpf(2) ** 128 * (1 - mp.mpf(2) ** -25), mp.mpf(2) ** -126
DIGITS = 20
UNIT = mp.mpf(2) ** -24


def f32(v):
    """The nearest float32, as a float."""
    import struct

    return struct.unpack("f", struct.pack("f", v))[0]


# ------------------------------------------------------------------------------------------------------------------
# Numbers with a running error bound (Wilkinson): e bounds |computed - exact| to first order, in units of the
# rounding unit, when every operation rounds its result once. Inputs are exact.
class Num:
    largest = mp.mpf(0)  # of all intermediate results since it was reset
    tie = False  # whether a comparison met two equal numbers since it was reset
    coarse = False  # whether float32 leaves the range where first-order bounds mean anything since it was reset

    def __init__(self, v, e=0):
        self.v, self.e = mp.mpmathify(v), mp.mpf(e)
        if mp.isfinite(self.v):
            Num.largest = max(Num.largest, abs(self.v))

    @staticmethod
    def of(c):
        """A constant: rounded once, unless float32 holds it."""
        if isinstance(c, Num):
            return c
        parts = [mp.re(c), mp.im(c)]
        exact = all(abs(p) < 1e30 and mp.mpf(f32(float(p))) == p for p in parts)
        return Num(c, 0 if exact else abs(mp.mpmathify(c)))

    def add(self, o):
        v = self.v + o.v
        return Num(v, self.e + o.e + abs(v))

    def mul(self, o):
        v = self.v * o.v
        return Num(v, abs(self.v) * o.e + abs(o.v) * self.e + abs(v))

    def div(self, o):
        v = self.v / o.v
        Num.coarse = Num.coarse or o.e * UNIT > abs(o.v) / 16
        return Num(v, (self.e + abs(v) * o.e) / abs(o.v) + abs(v))

    def neg(self):
        return Num(-self.v, self.e)

    def conj(self):
        return Num(mp.conj(self.v), self.e)

    def apply(self, fn, slope, second=None):
        """fn with its derivative; where the second one is given, its part in the error is watched."""
        v = fn(self.v)
        if second:
            moved = self.e * UNIT
            bend = abs(second(self.v)) * moved
            Num.coarse = Num.coarse or (bend > abs(slope(self.v)) / 16 and bend * moved > UNIT * abs(v) / 16)
        return Num(v, abs(slope(self.v)) * self.e + abs(v)) if self.e else Num(v, abs(v))


class Dual:
    """A value with its partial derivatives, or with the pair of ∂ and ∂̄ (then `pair` is set)."""

    def __init__(self, a, d, pair=False):
        self.a, self.d, self.pair = a, d, pair

    def like(self, a, d):
        return Dual(a, d, self.pair)

    def lift(self, o):
        return o if isinstance(o, Dual) else self.like(Num.of(o), [None] * len(self.d))

    def __add__(self, o):
        o = self.lift(o)
        return self.like(self.a.add(o.a), [q if p is None else p if q is None else p.add(q) for p, q in zip(self.d, o.d)])

    def __neg__(self):
        return self.like(self.a.neg(), [p and p.neg() for p in self.d])

    def __sub__(self, o):
        return self + (-self.lift(o))

    def __mul__(self, o):
        o = self.lift(o)
        return self.like(self.a.mul(o.a), [plus(times(p, o.a), times(q, self.a)) for p, q in zip(self.d, o.d)])

    def __truediv__(self, o):
        o = self.lift(o)
        q = self.a.div(o.a)
        return self.like(q, [s and s.div(o.a) for s in (plus(p, neg(times(r, q))) for p, r in zip(self.d, o.d))])

    def __radd__(self, o):
        return self + o

    def __rmul__(self, o):
        return self * o

    def __rsub__(self, o):
        return self.lift(o) - self

    def __rtruediv__(self, o):
        return self.lift(o) / self

    def __pow__(self, n):
        assert isinstance(n, int) and n >= 2
        r = self
        for _ in range(n - 1):
            r = r * self
        return r

    def __lt__(self, o):
        other = o.a.v if isinstance(o, Dual) else o
        Num.tie = Num.tie or self.a.v == other
        return self.a.v < other

    def chain(self, value, slope):
        return self.like(value, [times(p, slope) for p in self.d])


def plus(p, q):
    return q if p is None else p if q is None else p.add(q)


def times(p, q):
    return None if p is None or q is None else p.mul(q)


def neg(p):
    return None if p is None else p.neg()


# ------------------------------------------------------------------------------------------------------------------
# The functions that the formulas use, on plain numbers and on duals.
def function(fn, d1, d2):
    """fn with its derivative d1; d2 is the derivative of d1, for the error bound of the derivative."""

    def call(x):
        if not isinstance(x, Dual):
            return fn(mp.mpmathify(x))
        return x.chain(x.a.apply(fn, d1, d2), x.a.apply(d1, d2))

    return call


def defined(fn, d1, d2):
    """A special function that is defined in the language: the scale is its goal, see special.py."""

    def call(x):
        if not isinstance(x, Dual):
            return fn(mp.mpmathify(x))
        z = x.a.v
        value = Num(fn(z), abs(d1(z)) * (x.a.e + abs(z) / 2) + 4 * abs(fn(z)))
        return x.chain(value, Num(d1(z), abs(d2(z)) * (x.a.e + 2 * abs(z)) + 16 * abs(d1(z))))

    return call


sin = function(mp.sin, mp.cos, lambda x: -mp.sin(x))
cos = function(mp.cos, lambda x: -mp.sin(x), lambda x: -mp.cos(x))
tan = function(mp.tan, lambda x: 1 + mp.tan(x) ** 2, lambda x: 2 * mp.tan(x) * (1 + mp.tan(x) ** 2))
exp = function(mp.exp, mp.exp, mp.exp)
log = function(mp.log, lambda x: 1 / x, lambda x: -1 / x**2)
log1p = function(mp.log1p, lambda x: 1 / (1 + x), lambda x: -1 / (1 + x) ** 2)
bessel_j0 = defined(lambda x: mp.besselj(0, x), lambda x: -mp.besselj(1, x), lambda x: (mp.besselj(2, x) - mp.besselj(0, x)) / 2)
sqrt = function(mp.sqrt, lambda x: 1 / (2 * mp.sqrt(x)), lambda x: -1 / (4 * x * mp.sqrt(x)))


def absolute(x):
    if not isinstance(x, Dual):
        return abs(x)
    return -x if x < 0 else x


def least(x, y):
    return x if x < y else y


def greatest(x, y):
    return y if x < y else x


def clamp(x, lo, hi):
    return mp.mpf(lo) if x < lo else mp.mpf(hi) if hi < (x.a.v if isinstance(x, Dual) else x) else x


def combine(x, y, value, dx, dy, bend=(0, 0)):
    """A function of two reals with the error bounds of value and slopes taken to be a few roundings, and `bend`: how far
    the errors of the operands move the slopes."""
    e = abs(dx) * x.a.e + abs(dy) * y.a.e + abs(value)
    px, py = Num(dx, 4 * abs(dx) + bend[0]), Num(dy, 4 * abs(dy) + bend[1])
    return x.like(Num(value, e), [plus(times(p, px), times(q, py)) for p, q in zip(x.d, y.d)])


def hypot(x, y):
    if not isinstance(x, Dual):
        return mp.hypot(x, y)
    r = mp.hypot(x.a.v, y.a.v)
    if not r:
        return combine(x, y, r, mp.mpf(0), mp.mpf(0))
    u, v = x.a.v / r, y.a.v / r
    # the direction turns by the error across it
    across = (abs(v) * x.a.e + abs(u) * y.a.e) / r
    return combine(x, y, r, u, v, (abs(v) * across, abs(u) * across))


def hypot3(x, y, z):
    return hypot(hypot(x, y), z)


def atan2(y, x):
    if not isinstance(x, Dual):
        return mp.atan2(y, x)
    q = x.a.v**2 + y.a.v**2
    return combine(y, x, mp.atan2(y.a.v, x.a.v), x.a.v / q, -y.a.v / q)


def conj(z):
    if not isinstance(z, Dual):
        return mp.conj(z)
    assert z.pair, "conj needs the pair"
    dz, dzbar = z.d
    return z.like(z.a.conj(), [dzbar and dzbar.conj(), dz and dz.conj()])


def modulus_squared(z):
    return z * conj(z)


# ------------------------------------------------------------------------------------------------------------------
# The gallery. Parameters stand at their defaults.
pi, phi = mp.pi, mp.phi
PI, PHI = mp.mpf(pi), mp.mpf(phi)
ROOT2 = mp.sqrt(2)


def dome(x, y):
    r = hypot(x, y)
    if r < 1:
        return sqrt(1 - r * r)
    return -(r - 1) * (2 - r) if r < 2 else (r - 2) / 2


def interference(x, y):
    d, k = mp.mpf("1.5"), 4
    return cos(k * hypot(x - d, y)) + cos(k * hypot(x + d, y))


def chladni(x, y):
    n, m = 3 * PI, 5 * PI
    return cos(n * x) * cos(m * y) - cos(m * x) * cos(n * y)


def peaks(x, y):
    hill = 3 * (1 - x) ** 2 * exp(-(x**2) - (y + 1) ** 2)
    waves = 10 * (x / 5 - x**3 - y**5) * exp(-(x**2) - y**2)
    return hill - waves - exp(-((x + 1) ** 2) - y**2) / 3


def norms(x, y):
    d = mp.mpf("1.5")
    return least(absolute(x - d) + absolute(y), least(hypot(x, y), greatest(absolute(x + d), absolute(y))))


def value(x):
    """The plain number in a dual."""
    return x.a.v if isinstance(x, Dual) else x


def mandelbrot(x, y):
    """Real and imaginary parts apart; the orbit's z and its derivative d."""
    zx, zy, dx, dy = mp.mpf(0), mp.mpf(0), mp.mpf(0), mp.mpf(0)
    for _ in range(200):
        if mp.hypot(value(zx), value(zy)) > 1000:
            break
        zx, zy, dx, dy = zx * zx - zy * zy + x, 2 * (zx * zy) + y, 2 * (zx * dx - zy * dy) + 1, 2 * (zx * dy + zy * dx)
    if mp.hypot(value(zx), value(zy)) <= 2:
        return 0 * x
    size = hypot(zx, zy)
    return log(size) * size / hypot(dx, dy)


def square_wave(x, y):
    terms = [sin((2 * k - 1) * x) / (2 * k - 1) for k in range(1, 10)]
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return y - 4 / PI * total


def parabolic(x, y):
    """The determinant of the second derivatives of `peaks`, each written out by hand term by term."""
    a, b, c = exp(-(x**2) - (y + 1) ** 2), exp(-(x**2) - y**2), exp(-((x + 1) ** 2) - y**2)
    one = lambda v: 0 * x + v
    u = 1 - x
    # 3 u² a
    xx = 3 * a * (2 + 8 * x * u + u * u * (4 * x * x - 2))
    xy = 3 * a * (-2 * (y + 1)) * (-2 * u - 2 * x * u * u)
    yy = 3 * a * u * u * (4 * (y + 1) ** 2 - 2)
    # -10 q b with q = x/5 - x³ - y⁵
    q, qx, qy = x / 5 - x**3 - y**5, one(1) / 5 - 3 * x * x, -5 * y**4
    xx = xx - 10 * b * (-6 * x - 4 * x * qx + q * (4 * x * x - 2))
    xy = xy - 10 * b * (-2 * y * qx - 2 * x * qy + 4 * x * y * q)
    yy = yy - 10 * b * (-20 * y**3 - 4 * y * qy + q * (4 * y * y - 2))
    # -c/3
    xx = xx - c / 3 * (4 * (x + 1) ** 2 - 2)
    xy = xy - c / 3 * 4 * (x + 1) * y
    yy = yy - c / 3 * (4 * y * y - 2)
    return xx * yy - xy * xy


def landscape(x, y):
    import noise

    return noise.fbm([x, y])


def cells(x, y):
    import noise

    return noise.cellular(x, y)


def charges(x, y):
    return 2 / hypot(x, y) - 1 / hypot(x - 2, y) - 1 / hypot(x + 2, y)


# Points that some formulas are judged at: far away the lattice of the noise is finer than binary32; next to the planes
# that the sponge is mirrored by, binary32 cannot tell which of two coordinates is the greater after a fold; far along the tunnel
# all its numbers are whole, where the slope of the sine is greatest and its scale of first order is nil.
JUDGED = {name: lambda c: abs(c) <= 100 for name in ("landscape", "cells", "pebble", "cloud")}
JUDGED["rainbow-tunnel"] = lambda c: abs(c) <= 1e6
JUDGED["sponge"] = lambda c: 1e-3 <= abs(c) <= 100

PLANE = {
    "mandelbrot": (mandelbrot, 2, [(-0.75, 0.1), (0.3, 0.5), (-1.25, 0.05), (-2, 0), (0.251, 0)]),
    "square-wave": (square_wave, 4, [(0, 0), (3.1415927, 1), (1.5707964, 1), (0.05, 1.179)]),
    "parabolic": (parabolic, 3, [(0, 0), (1, -1), (0.2282789, -1.6255349), (-1, 0)]),
    "landscape": (landscape, 3, [(0, 0), (1, 1), (0.5, -0.5), (-2, 0.25)]),
    "cells": (cells, 3, [(0, 0), (1, 1), (0.5, -0.5), (-2, 0.25)]),
    "sin-rings": (lambda x, y: sin(x**2 + y**2), 4, [(0, 0), (1.7724538, 0), (1.2533141, 1.2533141)]),
    "saddle": (lambda x, y: x**2 - y**2, 4, [(1, 1), (3, -3), (10000, 9999.999), (1e10, 1e10)]),
    "tangent-weave": (lambda x, y: tan(x * y), 3, [(1, 1.5707964), (2, 0.7853982), (-1.5707964, 1), (3, -1.5707964)]),
    "dome": (dome, 4, [(1, 0), (0, -1), (0.6, 0.8), (2, 0), (0, -2), (0, 0)]),
    "interference": (interference, 5, [(1.5, 0), (-1.5, 0), (0, 0), (0, 3)]),
    "lemniscate": (lambda x, y: ((x - 1) ** 2 + y**2) * ((x + 1) ** 2 + y**2) - 1, 2, [(0, 0), (1, 0), (1.4142135, 0), (0.8660254, 0.5)]),
    "chladni": (chladni, 1, [(0, 0), (0.5, 0.5), (1, 1), (0.25, 0.75), (0.125, -0.125)]),
    "spiral": (lambda x, y: sin(3 * atan2(y, x) + 4 * log(hypot(x, y))), 2, [(0, 0), (-1, 0), (-2, 1e-6), (-2, -1e-6), (1, 0)]),
    "peaks": (peaks, 3, [(0, 0), (1, -1), (-1, 0), (0.2282789, -1.6255349), (-0.0093176, 1.5813679)]),
    "himmelblau": (lambda x, y: log1p((x**2 + y - 11) ** 2 + (x + y**2 - 7) ** 2), 6, [(3, 2), (-2.805118, 3.131312), (-3.77931, -3.283186), (3.584428, -1.848126)]),
    "charges": (charges, 3, [(0, 0), (2, 0), (-2, 0), (1, 0), (0, 1)]),
    "zone-plate": (lambda x, y: x**2 + y**2, 6, [(0, 0), (1, 1), (0.2, 0.4)]),
    "folium": (lambda x, y: (x**3 + y**3 - 3 * x * y) * (x**2 + y**2 - 3) ** 2, 2.5, [(0, 0), (1.5, 1.5), (1.7320508, 0), (-1, 1.4142135)]),
    "norms": (norms, 2, [(1.5, 0), (-1.5, 0), (0, 0), (0.75, 0), (-1, 1), (-1, 0.5)]),
}


def blaschke(z, conjugate=None):
    product = z
    for a in (mp.mpf("0.5"), mp.mpc("-0.25", "0.5"), mp.mpc("-0.25", "-0.5")):
        product = product * ((z - a) / (1 - mp.conj(a) * z))
    return product


def newton_basins(z):
    for _ in range(16):
        z = z - (z**3 - 1) / (3 * z**2)
    return z


def julia(z):
    for _ in range(7):
        z = z**2 + mp.mpc("-0.8", "0.156")
    return z


def halley(z):
    for _ in range(2):
        z = z * (2 * z**5 + 3) / (3 * z**5 + 2)
    return z


HOLOMORPHIC = {
    "bessel": (bessel_j0, 7, [0, 2.4048256, 3.8317060, -5.5200781, 2j, -3j, 6j]),
    "confocal": (lambda z: 2 * sin(z), 3, [0, 1.5707964, -1.5707964, 3.1415927, 1j]),
    "lambert": (lambda z: z * exp(z), 3, [0, -1, -2 + 3.1415927j, 0.5671433]),
    "doyle-mcmullen": (halley, 1.5, [0, 1, 0.309017 + 0.95105652j, -0.9221080, 0.746]),
    "newton-basins": (newton_basins, 2, [1, -0.5 + 0.8660254j, -1, 0.5 + 0.3j]),
    "julia-set": (julia, 1.5, [0, 1, 1.525 - 0.1j, -0.525 + 0.1j]),
    "rational": (lambda z: (z**2 - 1) / (z + mp.j), 3, [1, -1, -1j]),
    "essential": (lambda z: exp(1 / z), 2, [0, 0.05, -0.05, 0.03j]),
    "z-to-z": (lambda z: exp(z * log(z)), 3, [0, 1, -1, -2, 0.36787944]),
    "cardinal-sine": (lambda z: sin(z) / z, 8, [0, 3.1415927, -6.2831855, 4.4934095]),
    "blaschke": (blaschke, 2, [0, 0.5, -0.25 + 0.5j, 2, -0.8 + 1.6j, 0.6 + 0.8j]),
    "joukowski": (lambda z: (z + 1 / z) / 2, 2, [1, -1, 1j, 0]),
    "newton": (lambda z: z - (z**3 - 1) / (3 * z**2), 2, [1, -0.5 + 0.8660254j, 0, -0.5]),
    "branch-cut": (lambda z: sqrt(z**2 - 1), 2, [1, -1, 0, 2j, 0.5]),
    "bipolar": (lambda z: log((z - 1) / (z + 1)), 2, [1, -1, 0, 1j]),
    "tangent": (tan, 4, [1.5707964, -1.5707964, 0, 20j, -40j, 80j]),
}
PAIR = {
    "dipole": (lambda z: conj(z) ** 2 + 1 / z, 2, [0, -1, 0.5 + 0.8660254j]),
    "twirl": (lambda z: z * exp(mp.mpc(0, 2) * modulus_squared(z)), 2, [0, 1, 1j]),
}


def barth(x, y, z):
    p = PHI**2
    planes = 4 * (p * x**2 - y**2) * (p * y**2 - z**2) * (p * z**2 - x**2)
    return planes - (1 + 2 * PHI) * (x**2 + y**2 + z**2 - 1) ** 2


def kummer(x, y, z):
    m = mp.mpf("1.75")
    scale = (3 * m - 1) / (3 - m)
    planes = (1 - z - ROOT2 * x) * (1 - z + ROOT2 * x) * (1 + z + ROOT2 * y) * (1 + z - ROOT2 * y)
    return (x**2 + y**2 + z**2 - m) ** 2 - scale * planes


def harmonic(x, y, z):
    """Of degree 5 and order 3, from sin³θ cos 3φ (9 cos²θ - 1)."""
    r = hypot3(x, y, z)
    u, v, w = x / r, y / r, z / r
    return r - 2 * absolute(mp.sqrt(385 / (2 * PI)) / 16 * (u * (u * u - 3 * v * v) * (9 * w * w - 1)))


def tanglecube(x, y, z):
    q = lambda t: t**4 - 5 * t**2
    return q(x) + q(y) + q(z) + mp.mpf("11.75")


def chmutov(x, y, z):
    t4 = lambda t: 8 * t**4 - 8 * t**2 + 1
    return t4(x) + t4(y) + t4(z) + 1


def smooth_union(x, y, z):
    k = mp.mpf("0.5")
    ball = lambda cx, cz, r: hypot3(x - mp.mpf(cx), y, z - mp.mpf(cz)) - mp.mpf(r)

    def blend(a, b):
        h = clamp((b - a) / (2 * k) + mp.mpf("0.5"), 0, 1)
        return b * (1 - h) + a * h - k * h * (1 - h)

    return blend(blend(ball("-0.75", 0, "0.5"), ball("0.75", 0, "0.5")), ball(0, "0.75", "0.625"))


def turned(x, y, angle):
    c, s = mp.cos(mp.mpf(angle)), mp.sin(mp.mpf(angle))
    return x * c - y * s, x * s + y * c


def kifs(x, y, z):
    for _ in range(6):
        x, y, z = (absolute(v) - mp.mpf(f) for v, f in zip((x, y, z), ("0.625", "0.5", "0.375")))
        x, y = turned(x, y, "0.45")
        x, z = turned(x, z, "0.45")
        x, y, z = (mp.mpf("1.75") * v for v in (x, y, z))
    return (hypot3(x, y, z) - mp.mpf("1.25")) / mp.mpf("1.75") ** 6


def smin(a, b, width):
    k = mp.mpf(width)
    h = clamp((b - a) / (2 * k) + mp.mpf("0.5"), 0, 1)
    return b * (1 - h) + a * h - k * h * (1 - h)


def folded_rods(x, y, z, warp, folds, scale, radius, core, soft):
    amplitude, frequency = warp
    u, v, w = (a + mp.mpf(amplitude) * sin(frequency * b) for a, b in ((x, z), (y, x), (z, y)))
    corner, xy_angle, yz_angle = folds
    for _ in range(2):
        u, v, w = (absolute(a) - mp.mpf(f) for a, f in zip((u, v, w), corner))
        u, v = turned(u, v, xy_angle)
        v, w = turned(v, w, yz_angle)
        u, v, w = (mp.mpf(scale) * a for a in (u, v, w))
    rods = smin(smin(hypot(v, w), hypot(u, w), soft), hypot(u, v), soft)
    return smin((rods - mp.mpf(radius)) / mp.mpf(scale) ** 2, hypot3(x, y, z) - mp.mpf(core), "0.3")


def ember(x, y, z):
    return folded_rods(x, y, z, ("0.06", 7), (("0.55", "0.35", "0.4"), "0.6", "0.4"), "1.6", "0.09", "0.35", "0.2")


def orbit_trap(x, y, z):
    return folded_rods(x, y, z, ("0.06", 6), (("0.6", "0.4", "0.35"), "0.5", "0.5"), "1.6", "0.07", "0.3", "0.15")


def sponge(x, y, z):
    for _ in range(4):
        x, y, z = absolute(x), absolute(y), absolute(z)
        x, y = greatest(x, y), least(x, y)
        y, z = greatest(y, z), least(y, z)
        x, y = greatest(x, y), least(x, y)
        x, y, z = (3 * v - 2 for v in (x, y, z))
        z = z + 2 if z < -1 else z
    outside = [absolute(v) - mp.mpf("1.02") for v in (x, y, z)]
    furthest = greatest(greatest(outside[0], outside[1]), outside[2])
    if furthest < 0:
        return furthest / 81
    x, y, z = (greatest(v, 0 * v) for v in outside)
    return hypot3(x, y, z) / 81


def mandelbulb(x, y, z):
    """White and Nylander's formula, angles measured from the z axis."""
    u, v, w, d = x, y, z, 1
    for _ in range(5):
        r = hypot3(u, v, w)
        if value(r) > 4:
            break
        inclination, azimuth = atan2(hypot(u, v), w), atan2(v, u)
        s, r8, r7 = sin(8 * inclination), r**8, r**7
        u, v, w, d = r8 * s * cos(8 * azimuth) + x, r8 * s * sin(8 * azimuth) + y, r8 * cos(8 * inclination) + z, 8 * r7 * d + 1
    r = hypot3(u, v, w)
    return log(r) / 2 * r / d - mp.mpf("0.002")


def pebble(x, y, z):
    import noise

    return hypot3(x, y, z) - 1 + mp.mpf("0.3") * noise.noise([3 * x, 3 * y, 3 * z])


def cloud(x, y, z):
    import noise

    u, v = turned(x, y, "2.5")
    octaves = noise.fbm([mp.mpf("1.2") * (c + 3) for c in (u, v, z)])
    t = clamp((hypot3(x / 2, y / 2, z / mp.mpf("1.25")) - mp.mpf("0.1")) / mp.mpf("0.9"), 0, 1)
    density = mp.mpf("0.65") - mp.mpf("1.5") * t * t * (3 - 2 * t) + mp.mpf("1.6") * octaves
    return greatest(0 * density, density)


def multipole(x, y, z):
    a, b = mp.mpf("1.25"), mp.mpf("0.5")
    return 1 / hypot3(x - a, y, z) + 1 / hypot3(x + b, y - 1, z) - 2 / hypot3(x + b, y + 1, z)


def orbital(x, y, z):
    r = hypot3(x, y, z)
    return z * (5 * z**2 - 3 * r**2) * exp(-r / 4)


def resonance(x, y, z):
    first = cos(2 * x) * cos(3 * y) * cos(z)
    return first + cos(3 * x) * cos(y) * cos(2 * z) - cos(x) * cos(2 * y) * cos(3 * z)


def sparks(x, y, z):
    inside = 1 - x**2 - 9 * y**2 - z**2
    return greatest(0 * inside, inside) ** 3


def spotlight(x, y, z):
    t = (z + mp.mpf("1.5")) / 3
    return least(greatest(0 * t, t), 0 * t + 1) ** 2


def helix(x, y, z):
    total = 0 * x
    for k in range(12):
        angle = 0 * x + PI  # the error of the angle moves the centre
        angle = angle * k / 4
        c = [mp.mpf("0.9") * cos(angle), mp.mpf("0.9") * sin(angle), (k - mp.mpf("5.5")) / 4]
        total = total + exp(-18 * sum(((p - q) ** 2 for p, q in zip((x, y, z), c)), start=0 * x))
    return total


def shadow(x, y, z):
    fog = mp.mpf("0.12") * exp(-mp.mpf("2.5") * (z + mp.mpf("1.2")))
    return fog + 5 * exp(-14 * ((x - mp.mpf("0.2")) ** 2 + (y + mp.mpf("0.1")) ** 2 + (z - mp.mpf("0.3")) ** 2))


SPACE = {
    "helix": (helix, 2, [(0.9, 0, -1.375), (0, 0.9, -0.875), (0, 0, 0)]),
    "shadow": (shadow, 2, [(0.2, -0.1, 0.3), (0, 0, -1.2), (0, 0, 0)]),
    "hologram": (lambda x, y, z: mp.mpf("0.5") + mp.mpf("0.5") * sin(9 * z), 1.5, [(0, 0, 0.17453292), (0, 0, 0.52359877), (0, 0, 0)]),
    "mist": (lambda x, y, z: exp(-mp.mpf("2.5") * (z + 1)), 3, [(0, 0, -1), (0, 0, 1)]),
    "rainbow-tunnel": (lambda x, y, z: mp.mpf("0.5") + mp.mpf("0.5") * sin(2 * PI * z), 2.5, [(0, 0, 0.25), (0, 0, 0.75), (0, 0, 0)]),
    "sparks": (sparks, 1, [(1, 0, 0), (0, 0.33333334, 0), (0.6, 0.2, 0.5291503), (0, 0, 0)]),
    "spotlight": (spotlight, 1.5, [(0, 0, -1.5), (0, 0, 1.5), (0, 0, 0)]),
    "ember": (ember, 2, [(0.35, 0, 0), (0.55, 0.35, 0.4), (0, 0, 0), (0.25, 0.5, 0.75)]),
    "orbit-trap": (orbit_trap, 2, [(0.3, 0, 0), (0.6, 0.4, 0.35), (0, 0, 0), (0.25, 0.5, 0.75)]),
    "multipole": (multipole, 2, [(1.25, 0.125, 0), (-0.5, 1, 0.25), (-0.5, -0.75, 0), (0, 0, 0)]),
    "schwarz-family": (lambda x, y, z: cos(PI * x) + cos(PI * y) + cos(PI * z), 1.5, [(0, 0, 0), (0.5, 0.5, 0.5), (1, 0, 0), (1, 1, 0)]),
    "neovius": (lambda x, y, z: 3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z), 4.5, [(0, 0, 0), (1.5707964, 1.5707964, 1.5707964), (3.1415927, 0, 0)]),
    "orbital": (orbital, 27, [(0, 0, 9), (3, 4, 0), (6, 0, 4.6475801)]),
    "resonance": (resonance, 3.1415927, [(0, 0, 0), (1.5707964, 0.5, 0.25), (3.1415927, 1, 2)]),
    "kifs": (kifs, 2, [(0.625, 0.5, 0.375), (1, 0.2, 0.3), (0, 0, 0)]),
    "sponge": (sponge, 1.25, [(1, 0.4, 0.3), (0.34, 0.9, 1), (0.5, 0.5, 0.2)]),
    "mandelbulb": (mandelbulb, 1.25, [(0.9, 0.3, 0.2), (0, 1.1, 0.1), (0.5, 0.5, 0.5)]),
    "cloud": (cloud, 2, [(0.5, 0.25, 0.125), (0, 0, 0), (-0.75, 0.5, -0.25), (0.25, -0.75, 0.5)]),
    "pebble": (pebble, 1.5, [(1, 0, 0), (0, 0.6666667, 0.3333333), (0.3, 0.2, -0.9)]),
    "schwarz-p": (lambda x, y, z: cos(PI * x) + cos(PI * y) + cos(PI * z), 2, [(0, 0, 0), (0.5, 0.5, 0.5), (1, 0, 0.5), (1, 1, 0)]),
    "gyroid": (lambda x, y, z: sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x), 6, [(0, 0, 0), (3.1415927, 0, 0), (1.5707964, 1.5707964, 0)]),
    "clebsch": (lambda x, y, z: x**3 + y**3 + z**3 + 1 - (x + y + z + 1) ** 3, 3, [(0.5, -0.5, -1), (2, -2, -1), (-1, 0.25, -0.25), (0, 0, 0)]),
    "cayley": (lambda x, y, z: x**2 + y**2 + z**2 + 2 * x * y * z - 1, 1.5, [(1, 1, -1), (-1, 1, 1), (-1, -1, -1), (0, 0, 1)]),
    "barth-sextic": (barth, 2, [(1, 0, 0), (0, 0, 0), (0.8506508, 0.5257311, 0), (0.618034, 1, 0)]),
    "kummer": (kummer, 3, [(0.70710677, 0.70710677, 0), (0, 0, 1), (1.3228756, 0, 0)]),
    "tanglecube": (tanglecube, 3, [(1.5811388, 1.5811388, 0), (0, 0, 0), (1.5811388, 1.5811388, 1.5811388)]),
    "chmutov": (chmutov, 1.25, [(0, 0.70710677, 0.70710677), (0.70710677, 0.70710677, 1), (1, 1, 1)]),
    "steiner": (lambda x, y, z: x**2 * y**2 + y**2 * z**2 + z**2 * x**2 - x * y * z, 0.625, [(0.5, 0, 0), (0, 0, 0.25), (0, -0.5, 0), (0.33333334, 0.33333334, 0.33333334)]),
    "harmonic": (harmonic, 1, [(0, 0, 1), (0, 0.5, 0.5), (0.5, 0, 0), (0.5, 0.25, 0.1767767), (0.3, 0.1, -0.6)]),
    "torus": (lambda x, y, z: (hypot(x, y) - 1) ** 2 + z**2 - mp.mpf("0.25"), 2, [(1, 0, 0), (1.5, 0, 0), (0, 0, 0), (0, 1, 0.5)]),
    "ding-dong": (lambda x, y, z: x**2 + y**2 - (1 - z) * z**2, 1.25, [(0, 0, 0), (0, 0, 1), (0.3849002, 0, 0.6666667)]),
    "heart": (lambda x, y, z: (x**2 + mp.mpf("2.25") * y**2 + z**2 - 1) ** 3 - x**2 * z**3 - mp.mpf(9) / 80 * y**2 * z**3, 1.5, [(1, 0, 0), (0, 0, 1), (0, 0.6666667, 0), (0, 0, 0)]),
    "smooth-union": (smooth_union, 2, [(-0.75, 0, 0), (0.25, 0, 0), (0, 0, 0.125), (0, 0, 0.75), (0, 0, 1.375)]),
}


# ------------------------------------------------------------------------------------------------------------------
# Points.
def signed(rng, v):
    return v if rng.random() < 0.5 else -v


def points(rng, count, radius, special):
    """About sixty points of `count` coordinates: the view, tiny and huge ones, axes, and round the special ones."""
    res = [tuple(rng.uniform(-radius, radius) for _ in range(count)) for _ in range(20)]
    res += [tuple(signed(rng, 10 ** rng.uniform(-15, -1)) for _ in range(count)) for _ in range(6)]
    for size in (1e2, 1e3, 1e5, 1e10):
        res += [tuple(signed(rng, size * rng.uniform(0.1, 1)) for _ in range(count))]
    for axis in range(count):
        for v in (0.75 * radius, -0.375 * radius, 1.0):
            res.append(tuple(v if k == axis else 0.0 for k in range(count)))
    each = max(2, 24 // len(special))
    for p in special:
        res.append(p)
        for _ in range(each):
            res.append(tuple(c + signed(rng, 10 ** rng.uniform(-6, -1)) * max(1, abs(c)) for c in p))
    return [tuple(f32(c) for c in p) for p in res]


def complex_points(rng, radius, special):
    res = points(rng, 2, radius, [(complex(p).real, complex(p).imag) for p in special])
    for v in (0.5, -0.5, 2.0, -2.0):
        res += [(v, 0.0), (v, -0.0), (0.0, v), (-0.0, v)]
    return list({repr(p): p for p in res + [(0.0, 0.0)]}.values())


# ------------------------------------------------------------------------------------------------------------------
# Values, derivatives, rows.
def clean(v):
    """Without the smear that stands for a zero."""
    v = mp.mpmathify(v)
    if isinstance(v, mp.mpc):
        return mp.mpc(clean(v.real), clean(v.imag))
    return mp.mpf(0) if abs(v) < NOTHING else v


def parts(v, complex_):
    return [mp.re(v), mp.im(v)] if complex_ else [mp.re(v)]


def representable(v):
    return all(mp.isfinite(p) and abs(p) < MAX for p in (mp.re(v), mp.im(v)))


def underflows(v):
    return any(0 < abs(p) < TINY for p in (mp.re(v), mp.im(v)))


def difference(f, args, k, unit=1):
    """df/d(args[k]) along `unit`, or nan where the one-sided derivatives differ."""
    h = STEP * max(abs(args[k]), mp.mpf(10) ** -10) * unit
    at = lambda s: f(*[a + s if i == k else a for i, a in enumerate(args)])
    here = at(0)
    ahead, behind = (at(h) - here) / h, (here - at(-h)) / h
    if abs(ahead - behind) > mp.mpf(10) ** -60 * (abs(ahead) + abs(behind)) + NOTHING:
        return mp.nan
    return clean((at(h) - at(-h)) / (2 * h))


def text(v):
    return mp.nstr(v, DIGITS) if mp.isfinite(v) else ("nan" if mp.isnan(v) else "inf")


def short(v):
    return mp.nstr(v, 3) if mp.isfinite(v) else "inf"


def evaluate(f, args, complex_, pair):
    """Value, derivatives, and the dual; None where the row is to be left out."""
    try:
        value = clean(f(*args))
        if not representable(value):
            return None
        if not complex_:
            slopes = [difference(f, args, k) for k in range(len(args))]
            seeds = [Dual(Num(a), [Num(1) if i == k else None for i in range(len(args))]) for k, a in enumerate(args)]
        else:
            x, y = difference(f, args, 0), difference(f, args, 0, mp.j)
            if mp.isnan(x) or mp.isnan(y):
                return None  # a singular point, smeared
            # `difference` divides by h along the unit: y is already f's change per i, so f' = x = y where it exists.
            if pair:
                slopes = [clean((x + y) / 2), clean((x - y) / 2)]
                seeds = [Dual(Num(args[0]), [Num(1), None], pair=True)]
            else:
                assert abs(x - y) <= mp.mpf(10) ** -60 * abs(x) + NOTHING, ("not holomorphic", args)
                slopes = [x]
                seeds = [Dual(Num(args[0]), [Num(1)])]
        if not all(mp.isnan(s) or representable(s) for s in slopes):
            return None
        Num.largest, Num.tie, Num.coarse = mp.mpf(0), False, False
        return value, slopes, f(*seeds)
    except ZeroDivisionError:
        return None


def defined_at_zero(f):
    """Whether the formula as it is written has a value at 0: not so for sin(z)/z."""
    try:
        return mp.isfinite(f(mp.mpc(0)))
    except (ZeroDivisionError, ValueError):
        return False


def row(f, point, complex_, pair):
    if complex_:
        smear = lambda c: SIDE * (-1 if repr(c).startswith("-") else 1) if c == 0 else mp.mpf(c)
        if point == (0.0, 0.0) and not defined_at_zero(f):
            return None
        args = [mp.mpc(smear(point[0]), smear(point[1]))]
    else:
        args = [mp.mpf(c) for c in point]
    found = evaluate(f, args, complex_, pair)
    if found is None:
        return None
    value, slopes, dual = found
    notes = ["overflow"] if Num.largest > MAX else []
    if Num.coarse:
        notes.append("coarse")
    if complex_ and 0.0 in point:
        z = args[0]
        others = [mp.conj(z)] if point[1] == 0.0 else []
        others += [-mp.conj(z)] if point[0] == 0.0 else []
        if any(abs(f(o) - value) > mp.mpf(10) ** -30 * abs(value) + NOTHING for o in others):
            notes.append("cut")
    if any(not mp.isnan(v) and underflows(v) for v in (value, *slopes)):
        notes.append("underflow")
    tangents = [t if t is not None else Num(0) for t in dual.d]
    for k, (s, t) in enumerate(zip(slopes, tangents)):
        agree = abs(t.v - s) <= mp.mpf(10) ** -60 * (t.e + abs(s)) + NOTHING
        if mp.isnan(s) or (Num.tie and not agree):
            slopes[k] = mp.nan
            notes.append("kink")
        else:
            assert agree, (point, s, t.v)
    norms = [abs(args[0])] * len(slopes) if complex_ else [abs(a) for a in args]
    moved = sum(n * abs(s) for n, s in zip(norms, slopes))
    if mp.isnan(moved):
        condition = mp.nan
    else:
        condition = moved / abs(value) if value else (mp.inf if moved > NOTHING else mp.mpf(0))
    cells = [repr(c) for c in point]
    cells += [text(p) for p in parts(value, complex_)]
    for s in slopes:
        cells += ["nan"] * (2 if complex_ else 1) if mp.isnan(s) else [text(p) for p in parts(s, complex_)]
    cells.append("nan" if mp.isnan(condition) else short(condition))
    cells.append(short(clean(dual.a.e)))
    cells += ["nan" if mp.isnan(s) else short(clean(t.e)) for s, t in zip(slopes, tangents)]
    cells.append(",".join(dict.fromkeys(notes)) or "-")
    return "\t".join(cells)


def write(out, name, f, pts, columns, complex_=False, pair=False):
    rows, left_out = [], 0
    for p in pts:
        r = row(f, p, complex_, pair)
        if r is None:
            left_out += 1
        else:
            rows.append(r)
    with open(os.path.join(out, name + ".tsv"), "w", encoding="utf-8") as fh:
        fh.write(f"# docs/gallery/{name}.pull, parameters at their defaults; written by tests/oracle/gallery.py\n")
        fh.write("# " + "\t".join(columns) + "\n")
        fh.write("\n".join(rows) + "\n")
    print(f"{name}: {len(rows)} rows, {left_out} left out", file=sys.stderr)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "gallery")
    os.makedirs(out, exist_ok=True)
    tail = lambda ds: ["condition", "scale_f"] + [f"scale_{d}" for d in ds] + ["notes"]
    for table, names in ((PLANE, "xy"), (SPACE, "xyz")):
        slopes = [f"d{n}" for n in names]
        for name, (f, radius, special) in table.items():
            rng = random.Random(name)
            pts = points(rng, len(names), radius, special)
            if name in JUDGED:
                pts = [p for p in pts if all(map(JUDGED[name], p))]
            write(out, name, f, pts, [*names, "f", *slopes, *tail(slopes)])
    for table, slopes in ((HOLOMORPHIC, ["dz"]), (PAIR, ["dz", "dzbar"])):
        for name, (f, radius, special) in table.items():
            rng = random.Random(name)
            columns = ["z.re", "z.im", "f.re", "f.im"] + [f"{d}.{p}" for d in slopes for p in ("re", "im")] + tail(slopes)
            write(out, name, f, complex_points(rng, radius, special), columns, True, len(slopes) == 2)


if __name__ == "__main__":
    # under its own name, which noise.py imports it by
    import gallery

    gallery.main()
