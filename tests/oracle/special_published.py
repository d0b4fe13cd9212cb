#!/usr/bin/env python3
"""Compare special functions with published formulas of a few lines, as shaders use them: a table in Markdown.

usage: special_published.py PULLBACK [PART]      (the program, and a part of the formulas' texts; needs mpmath, numpy)

Each formula is evaluated by NumPy in binary32, as it stands in its source, at the 400 points that special_peers.py takes; the reference
is mpmath with 40 digits. A & S: Abramowitz and Stegun, Handbook of Mathematical Functions, 1964.
"""
import sys

import mpmath as mp
import numpy as np

from special_peers import AXIS, RIGHT, SQUARE, UPPER, f32, judge, klein, points, pullback, timed

F, C = np.float32, np.complex64
PI = F(np.pi)


def horner(x, coefficients):
    """Σ c(k) x^k"""
    total = np.zeros_like(x) + x.dtype.type(coefficients[-1])
    for c in reversed(coefficients[:-1]):
        total = total * x + x.dtype.type(c)
    return total


LANCZOS = (0.99999999999980993, 676.5203681218851, -1259.1392167224028, 771.32342877765313, -176.61502916214059, 12.507343278686905, -0.13857109526572012, 9.9843695780195716e-6, 1.5056327351493116e-7)


def lanczos(z):
    """Godfrey's coefficients for g = 7, with reflection left of 1/2"""
    left = z.real < 0.5
    x = np.where(left, 1 - z, z) - C(1)
    total = np.full_like(x, LANCZOS[0])
    for k, c in enumerate(LANCZOS[1:], 1):
        total = total + C(c) / (x + C(k))
    t = x + C(7.5)
    value = C(np.sqrt(2 * np.pi)) * t ** (x + C(0.5)) * np.exp(-t) * total
    return np.where(left, C(np.pi) / (np.sin(C(np.pi) * z) * value), value)


def digamma(z):
    """The recurrence to re z > 6 and A & S 6.3.18"""
    left = z.real < 0.5
    x = np.where(left, 1 - z, z)
    total = np.zeros_like(x)
    for _ in range(7):
        small = x.real < 6
        total = np.where(small, total - 1 / x, total)
        x = np.where(small, x + C(1), x)
    u = 1 / (x * x)
    value = total + np.log(x) - C(0.5) / x - u * (C(1 / 12) - u * (C(1 / 120) - u * C(1 / 252)))
    return np.where(left, value - C(np.pi) / np.tan(C(np.pi) * z), value)


def erf_as(x):
    """A & S 7.1.26"""
    t = 1 / (1 + F(0.3275911) * np.abs(x))
    p = t * horner(t, (0.254829592, -0.284496736, 1.421413741, -1.453152027, 1.061405429))
    return np.sign(x) * (1 - p * np.exp(-x * x))


def humlicek(z):
    """Humlíček, J. Quant. Spectrosc. Radiat. Transfer 27, 1982, w4, in the upper half-plane"""
    t = z.imag - 1j * z.real
    t = t.astype(C)
    s = np.abs(z.real) + z.imag
    u = t * t
    one = t * C(0.5641896) / (C(0.5) + u)
    two = t * (C(1.410474) + u * C(0.5641896)) / (C(0.75) + u * (C(3) + u))
    three = horner(t, (16.4955, 20.20933, 11.96482, 3.778987, 0.5642236)) / horner(t, (16.4955, 38.82363, 39.27121, 21.69274, 6.699398, 1))
    above = horner(-u, (36183.31, 3321.9905, 1540.787, 219.0313, 35.76683, 1.320522, 0.56419))
    below = horner(-u, (32066.6, 24322.84, 9022.228, 2186.181, 364.2191, 61.57037, 1.841439, 1))
    four = np.exp(u) - t * above / below
    near = z.imag >= 0.195 * np.abs(z.real) - 0.176
    return np.where(s >= 15, one, np.where(s >= 5.5, two, np.where(near, three, four)))


def zeta_borwein(s, n=30):
    """Borwein, An efficient algorithm for the Riemann zeta function, 2000, algorithm 2, with the functional equation left of 0"""
    left = s.real < 0
    w = np.where(left, 1 - s, s)
    d = [n * sum(mp.factorial(n + j - 1) * 4**j / (mp.factorial(n - j) * mp.factorial(2 * j)) for j in range(k + 1)) for k in range(n + 1)]
    total = np.zeros_like(w)
    for k in range(n):
        total = total + C((-1) ** k * (float(d[k] / d[n]) - 1)) * np.exp(-w * C(np.log(k + 1)))
    value = -total / (1 - np.exp((1 - w) * C(np.log(2))))
    turned = C(2) ** s * C(np.pi) ** (s - 1) * np.sin(C(np.pi / 2) * s) * lanczos(1 - s) * value
    return np.where(left, turned, value)


def zeta_series(s, n=64):
    """The alternating series of η, 64 terms, with the functional equation left of 0"""
    left = s.real < 0
    w = np.where(left, 1 - s, s)
    total = np.zeros_like(w)
    for k in range(1, n + 1):
        total = total + C((-1) ** (k + 1)) * np.exp(-w * C(np.log(k)))
    value = total / (1 - np.exp((1 - w) * C(np.log(2))))
    turned = C(2) ** s * C(np.pi) ** (s - 1) * np.sin(C(np.pi / 2) * s) * lanczos(1 - s) * value
    return np.where(left, turned, value)


def eta_borwein(s):
    return (1 - np.exp((1 - s) * C(np.log(2)))) * zeta_borwein(s)


def j0(x):
    """A & S 9.4.1 and 9.4.3"""
    near = horner((x / 3) ** 2, (1, -2.2499997, 1.2656208, -0.3163866, 0.0444479, -0.0039444, 0.00021))
    y = 3 / x
    f = horner(y, (0.79788456, -0.00000077, -0.0055274, -0.00009512, 0.00137237, -0.00072805, 0.00014476))
    t = x + horner(y, (-0.78539816, -0.04166397, -0.00003954, 0.00262573, -0.00054125, -0.00029333, 0.00013558))
    return np.where(x < 3, near, f * np.cos(t) / np.sqrt(x))


def j1(x):
    """A & S 9.4.4 and 9.4.6"""
    near = x * horner((x / 3) ** 2, (0.5, -0.56249985, 0.21093573, -0.03954289, 0.00443319, -0.00031761, 0.00001109))
    y = 3 / x
    f = horner(y, (0.79788456, 0.00000156, 0.01659667, 0.00017105, -0.00249511, 0.00113653, -0.00020033))
    t = x + horner(y, (-2.35619449, 0.12499612, 0.0000565, -0.00637879, 0.00074348, 0.00079824, -0.00029166))
    return np.where(x < 3, near, f * np.cos(t) / np.sqrt(x))


def elliptic_k(m):
    """A & S 17.3.34, for 0 ≤ m < 1"""
    r = 1 - m
    a = horner(r, (1.38629436112, 0.09666344259, 0.03590092383, 0.03742563713, 0.01451196212))
    return a - horner(r, (0.5, 0.12498593597, 0.06880248576, 0.03328355346, 0.00441787012)) * np.log(r)


def elliptic_e(m):
    """A & S 17.3.36, for 0 ≤ m < 1"""
    r = 1 - m
    a = horner(r, (1, 0.44325141463, 0.0626060122, 0.04757383546, 0.01736506451))
    return a - r * horner(r, (0.2499836831, 0.09200180037, 0.04069697526, 0.00526449639)) * np.log(r)


def e1(x):
    """A & S 5.1.53 and 5.1.56"""
    near = horner(x, (-0.57721566, 0.99999193, -0.24991055, 0.05519968, -0.00976004, 0.00107857)) - np.log(x)
    above = horner(x, (0.2677737343, 8.6347608925, 18.059016973, 8.5733287401, 1))
    below = horner(x, (3.9584969228, 21.0996530827, 25.6329561486, 9.5733223454, 1))
    return np.where(x <= 1, near, above / below * np.exp(-x) / x)


def fresnel(x, wave, other, sign):
    """A & S 7.3.9-10 with 7.3.32-33"""
    a = np.abs(x)
    f = horner(a, (1, 0.926)) / horner(a, (2, 1.792, 3.104))
    g = 1 / horner(a, (2, 4.142, 3.492, 6.67))
    t = PI / 2 * a * a
    return np.sign(x) * (F(0.5) + sign * f * wave(t) - g * other(t))


def lambert(z):
    """Halley's method, four steps from log(1 + z) (Corless et al., On the Lambert W function, 1996, 5.9)"""
    w = np.log(1 + z)
    for _ in range(4):
        e = np.exp(w)
        r = w * e - z
        w = w - r / (e * (w + 1) - (w + 2) * r / (2 * w + 2))
    return w


def weierstrass_sum(z, n=8):
    """The sum over the lattice itself (DLMF 23.2.4) of 1 and i, to 8 around"""
    total = 1 / (z * z)
    for a in range(-n, n + 1):
        for b in range(-n, n + 1):
            if a or b:
                w = C(complex(a, b))
                total = total + 1 / (z - w) ** 2 - 1 / w**2
    return total


def theta3(z):
    """The sum (DLMF 20.2.3) of the nome 0.3, five terms"""
    q = F(f32(0.3))
    return 1 + 2 * sum((q ** (k * k)) * np.cos(C(2 * k) * z) for k in range(1, 6))


def klein_series(t, n=12):
    """E₄³/(E₄³ - E₆²) by twelve terms of the series of both, without a reduction of τ"""
    q = np.exp(C(2j * np.pi) * t)
    sigma = lambda k, p: sum(d**p for d in range(1, k + 1) if k % d == 0)
    e4 = 1 + C(240) * sum(C(sigma(k, 3)) * q**k for k in range(1, n + 1))
    e6 = 1 - C(504) * sum(C(sigma(k, 5)) * q**k for k in range(1, n + 1))
    return e4**3 / (e4**3 - e6**2)


def airy(z):
    """The Maclaurin series (DLMF 9.4.1), sixteen terms of each half"""
    cube = z * z * z
    f = a = np.ones_like(z)
    g = b = z
    for k in range(1, 17):
        a = a * cube / C(3 * k * (3 * k - 1))
        b = b * cube / C(3 * k * (3 * k + 1))
        f, g = f + a, g + b
    return C(0.355028053887817) * f - C(0.258819403792807) * g


def jacobi_sn(x):
    """The descending Landen transformation (A & S 16.4), m = 1/2"""
    a, b, c = [F(1)], np.sqrt(F(0.5)), [np.sqrt(F(0.5))]
    for _ in range(5):
        a, b, c = [*a, (a[-1] + b) / 2], np.sqrt(a[-1] * b), [*c, (a[-1] - b) / 2]
    phi = F(32) * a[-1] * x
    for k in range(5, 0, -1):
        phi = (np.arcsin(c[k] / a[k] * np.sin(phi)) + phi) / 2
    return np.sin(phi)


def dilog(z):
    """The power series (DLMF 25.12.1), 64 terms, with inversion outside of the unit disc (25.12.4)"""
    outside = np.abs(z) > 1
    w = np.where(outside, 1 / z, z)
    total, p = np.zeros_like(w), np.ones_like(w)
    for k in range(1, 65):
        p = p * w
        total = total + p / C(k * k)
    return np.where(outside, -total - C(np.pi**2 / 6) - np.log(-z) ** 2 / 2, total)


HALF = mp.mpf(1) / 2
UNIT = (0, 0.99, 0, 0)
# formula, name of the published one, the function, mpmath's, box
PUBLISHED = [
    ("gamma(z)", "Lanczos, g = 7, nine terms", lanczos, mp.gamma, SQUARE),
    ("digamma(z)", "A & S 6.3.18, three terms", digamma, mp.digamma, SQUARE),
    ("erf(x)", "A & S 7.1.26", erf_as, mp.erf, AXIS),
    ("faddeeva(z)", "Humlíček's w4", humlicek, lambda z: mp.exp(-z * z) * mp.erfc(-1j * z), (-3, 3, 0, 3)),
    ("zeta(z)", "Borwein, 30 terms", zeta_borwein, mp.zeta, (-3, 3, -30, 30)),
    ("zeta(z)", "alternating series, 64 terms", zeta_series, mp.zeta, (-3, 3, -30, 30)),
    ("dirichlet_eta(z)", "Borwein, 30 terms", eta_borwein, mp.altzeta, SQUARE),
    ("besselj(0, x)", "A & S 9.4.1, 9.4.3", j0, lambda x: mp.besselj(0, x), RIGHT),
    ("besselj(1, x)", "A & S 9.4.4, 9.4.6", j1, lambda x: mp.besselj(1, x), RIGHT),
    ("airy_ai(z)", "power series, 16 terms", airy, mp.airyai, SQUARE),
    ("e1(x)", "A & S 5.1.53, 5.1.56", e1, mp.e1, RIGHT),
    ("fresnel_s(x)", "A & S 7.3.32-33", lambda x: fresnel(x, np.cos, np.sin, -1), mp.fresnels, AXIS),
    ("fresnel_c(x)", "A & S 7.3.32-33", lambda x: fresnel(x, np.sin, np.cos, 1), mp.fresnelc, AXIS),
    ("elliptic_k(x)", "A & S 17.3.34", elliptic_k, mp.ellipk, UNIT),
    ("elliptic_e(x)", "A & S 17.3.36", elliptic_e, mp.ellipe, UNIT),
    ("jacobi_sn(x, 0.5)", "A & S 16.4, five steps", jacobi_sn, lambda x: mp.ellipfun("sn", x, m=HALF), AXIS),
    ("weierstrass_p(z, i)", "sum over 17² points", weierstrass_sum, None, (-0.5, 0.5, -0.5, 0.5)),
    ("jacobi_theta3(z, 0.3)", "five terms", theta3, lambda z: mp.jtheta(3, z, mp.mpf(f32(0.3))), SQUARE),
    ("klein_j(z)", "twelve terms of E₄ and E₆", klein_series, klein, UPPER),
    ("dilog(z)", "power series, 64 terms", dilog, lambda z: mp.polylog(2, z), SQUARE),
    ("lambertw(z, 0)", "Halley, four steps", lambert, mp.lambertw, SQUARE),
]


def square_lattice(z):
    q = mp.exp(-mp.pi)
    t2, t3, t4 = (mp.jtheta(k, 0, q) for k in (2, 3, 4))
    return (mp.pi * t2 * t3 * mp.jtheta(4, mp.pi * z, q) / mp.jtheta(1, mp.pi * z, q)) ** 2 - mp.pi**2 / 3 * (t2**4 + t3**4)


def main():
    program = sys.argv[1]
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    print("| function | box | published formula | it | `accurate` | NumPy, µs |")
    print("| --- | --- | --- | --- | --- | --- |")
    for formula, name, published, exact, box in PUBLISHED:
        if part not in formula:
            continue
        zs = points(box)
        real = box[2] == box[3]
        with mp.workdps(40):
            truth = [mp.mpmathify((exact or square_lattice)((mp.mpf if real else mp.mpc)(z))) for z in zs]
        with np.errstate(all="ignore"):
            found, cost = timed(lambda: published(np.array(zs, dtype=F if real else C)))
        cells = [judge([complex(v) for v in found], truth), judge(pullback(program, formula, zs, "accurate"), truth), f"{cost:.2f}"]
        shown = "{:g} … {:g}".format(*box[:2]) + ("" if real else ", {:g} … {:g}".format(*box[2:]))
        print(f"| `{formula}` | {shown} | {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
