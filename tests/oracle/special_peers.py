#!/usr/bin/env python3
"""Compare special functions at the same 400 points with SciPy and mpmath: a table in Markdown.

usage: special_peers.py PULLBACK [PART]      (the program, and a part of the formulas' texts; needs mpmath, scipy)

The points are float32, 400 for each function in the box that the table names; a box of no height has real numbers. The reference is mpmath with 40
digits. mpmath's own column is its default of 15 digits. Errors are relative to the modulus. Cost: the time of one call over all
points, by point; what a picture of ours costs is in docs/performance.md.
"""
import random
import statistics
import struct
import subprocess
import sys
import time

import mpmath as mp
import numpy as np
import scipy.special as sp

COUNT = 400


def f32(v):
    return struct.unpack("f", struct.pack("f", v))[0]


def points(box):
    rng = random.Random(11)
    pairs = [(f32(rng.uniform(box[0], box[1])), f32(rng.uniform(box[2], box[3]))) for _ in range(COUNT)]
    return [x if box[2] == box[3] else complex(x, y) for x, y in pairs]


SQUARE = (-3, 3, -3, 3)
UPPER = (-0.5, 0.5, 0.2, 1.5)
DISC = (-0.6, 0.6, -0.6, 0.6)
CELL = (-0.5, 0.5, -0.5, 0.5)


def klein(t):
    l = (mp.jtheta(2, 0, mp.exp(1j * mp.pi * t)) / mp.jtheta(3, 0, mp.exp(1j * mp.pi * t))) ** 4
    return 4 * (1 - l + l * l) ** 3 / (27 * (l * (1 - l)) ** 2)


def fourth(k):
    return lambda t: mp.jtheta(k, 0, mp.exp(1j * mp.pi * t)) ** 4


def modular_lambda(t):
    return fourth(2)(t) / fourth(3)(t)


def eisenstein(weight):
    """DLMF 23.6.2-4 with theta functions"""

    def value(t):
        a, b, c = (fourth(k)(t) for k in (2, 3, 4))
        return (a**2 + b**2 + c**2) / 2 if weight == 4 else (a + b) * (b + c) * (c - a) / 2

    return value


def dedekind(t):
    """Euler's product"""
    q = mp.exp(2j * mp.pi * t)
    return mp.exp(1j * mp.pi * t / 12) * mp.qp(q)


def dirichlet_beta(s):
    return 4**-s * (mp.zeta(s, mp.mpf(1) / 4) - mp.zeta(s, mp.mpf(3) / 4))


def square_lattice(n):
    """℘ of the lattice of 1 and i, or its derivative, DLMF 23.6.5 and 23.3.10: by theta functions."""
    q = mp.exp(-mp.pi)
    t2, t3, t4 = (mp.jtheta(k, 0, q) for k in (2, 3, 4))

    def value(z):
        one, two, three, four = (mp.jtheta(k, mp.pi * z, q) for k in (1, 2, 3, 4))
        if n == 1:
            return -2 * mp.pi**3 * (t2 * t3 * t4) ** 2 * two * three * four / one**3
        return (mp.pi * t2 * t3 * four / one) ** 2 - mp.pi**2 / 3 * (t2**4 + t3**4)

    return value


def weierstrass(z):
    """g₂ = 4, g₃ = 0"""
    return 1 / mp.ellipfun("sn", mp.sqrt(2) * z, m=mp.mpf(1) / 2) ** 2 * 2 - 1


def legendre(n):
    return lambda x: mp.legendre(n, x)


def harmonic(x):
    """Y(4, 2) at (x, 0.5, 0.25): √(5/π)/8 · 3 (x² - y²)(7z² - r²)/r⁴ up to its sign, orthonormal and real"""
    y, z = mp.mpf(1) / 2, mp.mpf(1) / 4
    r2 = x * x + y * y + z * z
    return 3 * mp.sqrt(5 / mp.pi) / 8 * (x * x - y * y) * (7 * z * z - r2) / r2**2


def harmonic_scipy(x):
    y, z = 0.5, 0.25
    r = np.sqrt(x * x + y * y + z * z)
    return np.sqrt(2) * sp.sph_harm_y(4, 2, np.arccos(z / r), np.arctan2(y, x)).real


def beta(a):
    return mp.gamma(a) * mp.gamma(mp.mpf(5) / 2) / mp.gamma(a + mp.mpf(5) / 2)


def fresnel(k):
    return lambda z: sp.fresnel(z)[k]


AXIS = (-3, 3, 0, 0)
RIGHT = (0.01, 30, 0, 0)
UNIT = (-1, 1, 0, 0)
HALF = mp.mpf(1) / 2

# formula, mpmath's function, SciPy's (None where it has none for such numbers), box
FUNCTIONS = [
    ("gamma(z)", mp.gamma, sp.gamma, SQUARE),
    ("1/gamma(z)", mp.rgamma, sp.rgamma, SQUARE),
    ("loggamma(z)", mp.loggamma, sp.loggamma, SQUARE),
    ("digamma(z)", mp.digamma, sp.digamma, SQUARE),
    ("trigamma(x)", lambda x: mp.psi(1, x), lambda x: sp.polygamma(1, x), RIGHT),
    ("beta(x, 2.5)", beta, lambda x: sp.beta(x, 2.5), RIGHT),
    ("erf(z)", mp.erf, sp.erf, SQUARE),
    ("erfc(z)", mp.erfc, sp.erfc, SQUARE),
    ("erfcx(x)", lambda x: mp.exp(x * x) * mp.erfc(x), sp.erfcx, AXIS),
    ("faddeeva(z)", lambda z: mp.exp(-z * z) * mp.erfc(-1j * z), sp.wofz, SQUARE),
    ("fresnel_s(z)", mp.fresnels, fresnel(0), SQUARE),
    ("fresnel_c(z)", mp.fresnelc, fresnel(1), SQUARE),
    ("e1(z)", mp.e1, sp.exp1, SQUARE),
    ("ei(x)", mp.ei, sp.expi, AXIS),
    ("si(z)", mp.si, lambda z: sp.sici(z)[0], SQUARE),
    ("ci(z)", mp.ci, lambda z: sp.sici(z)[1], SQUARE),
    ("lambertw(z, 0)", mp.lambertw, sp.lambertw, SQUARE),
    ("lambertw(z, 1)", lambda z: mp.lambertw(z, 1), lambda z: sp.lambertw(z, 1), SQUARE),
    ("lambertw(z, -1)", lambda z: mp.lambertw(z, -1), lambda z: sp.lambertw(z, -1), SQUARE),
    ("zeta(z)", mp.zeta, sp.zeta, (-3, 3, -30, 30)),
    ("zeta(z)", mp.zeta, sp.zeta, (0, 1, 0, 100)),
    ("zeta(x)", mp.zeta, sp.zeta, (1.01, 30, 0, 0)),
    ("dirichlet_eta(z)", mp.altzeta, None, SQUARE),
    ("hurwitz_zeta(z, 0.25)", lambda s: mp.zeta(s, mp.mpf(1) / 4), None, (0, 6, -20, 20)),
    ("hurwitz_zeta(x, 0.25)", lambda s: mp.zeta(s, mp.mpf(1) / 4), lambda s: sp.zeta(s, 0.25), (1.01, 30, 0, 0)),
    ("besselj(0, z)", lambda z: mp.besselj(0, z), lambda z: sp.jv(0, z), (-12, 12, -6, 6)),
    ("besselj(1, z)", lambda z: mp.besselj(1, z), lambda z: sp.jv(1, z), (-12, 12, -6, 6)),
    ("besselj(5, x)", lambda x: mp.besselj(5, x), lambda x: sp.jv(5, x), RIGHT),
    ("bessely(1, x)", lambda x: mp.bessely(1, x), lambda x: sp.yn(1, x), RIGHT),
    ("besseli(1, x)", lambda x: mp.besseli(1, x), lambda x: sp.iv(1, x), RIGHT),
    ("besselk(1, x)", lambda x: mp.besselk(1, x), lambda x: sp.kn(1, x), RIGHT),
    ("airy_ai(z)", mp.airyai, lambda z: sp.airy(z)[0], SQUARE),
    ("airy_ai_prime(z)", lambda z: mp.airyai(z, derivative=1), lambda z: sp.airy(z)[1], SQUARE),
    ("airy_bi(z)", mp.airybi, lambda z: sp.airy(z)[2], SQUARE),
    ("airy_bi_prime(z)", lambda z: mp.airybi(z, derivative=1), lambda z: sp.airy(z)[3], SQUARE),
    ("dilog(z)", lambda z: mp.polylog(2, z), lambda z: sp.spence(1 - z), SQUARE),
    ("elliptic_k(z)", mp.ellipk, None, SQUARE),
    ("elliptic_e(z)", mp.ellipe, None, SQUARE),
    ("elliptic_k(x)", mp.ellipk, sp.ellipk, (-3, 0.99, 0, 0)),
    ("elliptic_e(x)", mp.ellipe, sp.ellipe, (-3, 0.99, 0, 0)),
    ("jacobi_sn(z, 0.5)", lambda z: mp.ellipfun("sn", z, m=HALF), None, SQUARE),
    ("jacobi_sn(x, 0.5)", lambda x: mp.ellipfun("sn", x, m=HALF), lambda x: sp.ellipj(x, 0.5)[0], AXIS),
    ("jacobi_cn(x, 0.5)", lambda x: mp.ellipfun("cn", x, m=HALF), lambda x: sp.ellipj(x, 0.5)[1], AXIS),
    ("jacobi_dn(x, 0.5)", lambda x: mp.ellipfun("dn", x, m=HALF), lambda x: sp.ellipj(x, 0.5)[2], AXIS),
    ("jacobi_theta3(z, 0.3)", lambda z: mp.jtheta(3, z, mp.mpf(f32(0.3))), None, SQUARE),
    ("jacobi_theta3(0.25, z)", lambda q: mp.jtheta(3, mp.mpf(1) / 4, q), None, DISC),
    ("weierstrass_p_invariants(z, 4, 0)", weierstrass, None, SQUARE),
    ("klein_j(z)", klein, None, UPPER),
    ("modular_lambda(z)", modular_lambda, None, UPPER),
    ("eisenstein_e4(z)", eisenstein(4), None, UPPER),
    ("eisenstein_e6(z)", eisenstein(6), None, UPPER),
    ("dedekind_eta(z)", dedekind, None, UPPER),
    ("weierstrass_p(z, i)", square_lattice(0), None, CELL),
    ("weierstrass_p_prime(z, i)", square_lattice(1), None, CELL),
    ("jacobi_theta1(z, 0.3)", lambda z: mp.jtheta(1, z, mp.mpf(f32(0.3))), None, SQUARE),
    ("jacobi_theta2(z, 0.3)", lambda z: mp.jtheta(2, z, mp.mpf(f32(0.3))), None, SQUARE),
    ("jacobi_theta4(z, 0.3)", lambda z: mp.jtheta(4, z, mp.mpf(f32(0.3))), None, SQUARE),
    ("dirichlet_beta(z)", dirichlet_beta, None, SQUARE),
    ("li(x)", lambda x: mp.ei(mp.log(x)), lambda x: sp.expi(np.log(x)), RIGHT),
    ("lgamma(x)", lambda x: mp.re(mp.loggamma(x)), sp.gammaln, RIGHT),
    ("diff(jacobi_sn(0.75, z), z)", lambda m: mp.diff(lambda m: mp.ellipfun("sn", mp.mpf(3) / 4, m=m), m), None, SQUARE),
    ("hypergeometric(0.5, 0.5, 1, z)", lambda z: mp.hyp2f1(0.5, 0.5, 1, z), lambda z: sp.hyp2f1(0.5, 0.5, 1, z), DISC),
    ("legendre_p(6, x)", legendre(6), lambda x: sp.eval_legendre(6, x), UNIT),
    ("chebyshev_t(6, x)", lambda x: mp.chebyt(6, x), lambda x: sp.eval_chebyt(6, x), UNIT),
    ("hermite_h(6, x)", lambda x: mp.hermite(6, x), lambda x: sp.eval_hermite(6, x), AXIS),
    ("laguerre_l(6, x)", lambda x: mp.laguerre(6, 0, x), lambda x: sp.eval_laguerre(6, x), RIGHT),
    ("spherical_harmonic(4, 2, x, 0.5, 0.25)", harmonic, harmonic_scipy, AXIS),
]


def pullback(program, formula, zs, precision):
    real = isinstance(zs[0], float)
    rows = "".join(f"{z!r}\n" if real else f"{z.real!r} {z.imag!r}\n" for z in zs)
    head = "f(x: real)" if real else "f(z: complex)"
    text = f"{head} = {formula.replace('0.3)', f'{f32(0.3)!r})')}"
    # exact binary32 and binary64, by the shader of the tier
    command = [program, "eval", text, "--precision", precision, "--adapter", "ieee32", "--points", "-"]
    done = subprocess.run(command, input=rows, capture_output=True, text=True, check=True)
    return [complex(*map(float, line.split())) for line in done.stdout.split("\n") if line]


def judge(values, exact):
    errors = [float(abs(mp.mpc(v) - e) / abs(e)) if mp.isfinite(mp.mpc(v)) else float("inf") for v, e in zip(values, exact, strict=True)]
    return f"{max(errors):.1e} / {statistics.median(errors):.1e}"


def timed(f):
    start = time.perf_counter()
    result = f()
    return result, (time.perf_counter() - start) / COUNT * 1e6


def main():
    program = sys.argv[1]
    part = sys.argv[2] if len(sys.argv) > 2 else ""
    print("| function | box | `accurate` | `double` | SciPy | mpmath, 15 digits | SciPy, µs | mpmath, µs |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for formula, exact, peer, box in FUNCTIONS:
        if part not in formula:
            continue
        zs = points(box)
        number = mp.mpf if box[2] == box[3] else mp.mpc
        with mp.workdps(40):
            truth = [mp.mpmathify(exact(number(z))) for z in zs]
        cells = [judge(pullback(program, formula, zs, tier), truth) for tier in ("accurate", "double")]
        low, cost = timed(lambda: [complex(exact(number(z))) for z in zs])
        found, quick = (None, 0) if peer is None else timed(lambda: peer(np.array(zs)))
        cells += ["none" if peer is None else judge([complex(v) for v in found], truth), judge(low, truth)]
        cells += ["" if peer is None else f"{quick:.2f}", f"{cost:.0f}"]
        shown = "{:g} … {:g}".format(*box[:2]) + ("" if box[2] == box[3] else ", {:g} … {:g}".format(*box[2:]))
        print(f"| `{formula}` | {shown} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
