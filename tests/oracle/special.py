#!/usr/bin/env python3
"""Write tests/data/functions/special.txt: special functions, over what a plot shows, and where they are hardest.

usage: special.py [OUT_FILE]      (needs mpmath; default ../data/functions/special.txt beside this file)

Values and derivatives by mpmath with 60 digits, of definitions that are not those of the compiler's library. The scale
states the goal: with K = 2 the bound |computed - reference| <= 2 K u scale is 16 u of the norm of the value (64 u for a
derivative) and what one unit in the last place of the argument moves. README.md beside this file has the format.
"""
import os
import random
import struct
import sys

import mpmath as mp

mp.mp.dps = 60
LARGEST = mp.mpf(2) ** 120
LEAST = mp.mpf(2) ** -100
SIDE = mp.mpf(10) ** -50  # stands for a zero as an imaginary part, above a cut on the reals


def f32(v):
    return struct.unpack("f", struct.pack("f", v))[0]


def show(v):
    return mp.nstr(mp.mpf(v), 20)


def point(z):
    return complex(f32(z.real), f32(z.imag))


# ------------------------------------------------------------------------------------------------------------------
# Definitions: each a function of an exact argument, the derivative and the second derivative.
def by_differences(f):
    """f, f' and f'' of a function that mpmath can compute to any number of digits."""

    def slope(z, n):
        with mp.workdps(110):
            h = mp.mpf(10) ** -20 * max(1, abs(z)) if z == 0 else mp.mpf(10) ** -20 * abs(z)
            if n == 1:  # the errors of both are h^4, far below 60 digits of a function that is analytic
                return (8 * (f(z + h) - f(z - h)) - (f(z + 2 * h) - f(z - 2 * h))) / (12 * h)
            return (16 * (f(z + h) + f(z - h)) - (f(z + 2 * h) + f(z - 2 * h)) - 30 * f(z)) / (12 * h * h)

    return f, lambda z: slope(z, 1), lambda z: slope(z, 2)


def faddeeva():
    w = lambda z: mp.exp(-z * z) * mp.erfc(-1j * z)
    d = lambda z: -2 * z * w(z) + 2j / mp.sqrt(mp.pi)
    return w, d, lambda z: -2 * z * d(z) - 2 * w(z)


def erf_like(f, sign):
    d = lambda z: sign * 2 / mp.sqrt(mp.pi) * mp.exp(-z * z)
    return f, d, lambda z: -2 * z * d(z)


def erfcx():
    w, d, second = faddeeva()
    return lambda z: w(1j * z), lambda z: 1j * d(1j * z), lambda z: -second(1j * z)


def lambert(k):
    w = lambda z: mp.lambertw(z, k)
    d = lambda z: 1 / ((1 + w(z)) * mp.exp(w(z)))
    return w, d, lambda z: -d(z) ** 2 * (2 + w(z)) / (1 + w(z))


def zeta():
    return mp.zeta, lambda s: mp.zeta(s, 1, 1), lambda s: mp.zeta(s, 1, 2)


def products(f, g):
    """The product of two functions, each with its first two derivatives, likewise."""
    value = lambda z: f[0](z) * g[0](z)
    slope = lambda z: f[1](z) * g[0](z) + f[0](z) * g[1](z)
    return value, slope, lambda z: f[2](z) * g[0](z) + 2 * f[1](z) * g[1](z) + f[0](z) * g[2](z)


def power(base, factor=1, constant=0):
    """constant + factor base^-s"""
    l = mp.log(base)
    p = lambda s: factor * mp.exp(-s * l)
    return lambda s: constant + p(s), lambda s: -l * p(s), lambda s: l * l * p(s)


def eta():
    return products(power(2, -2, 1), zeta())


def beta():
    quarter = mp.mpf(1) / 4
    part = lambda n: lambda s: mp.zeta(s, quarter, n) - mp.zeta(s, 3 * quarter, n)
    return products(power(4), (part(0), part(1), part(2)))


def airy(f, n):
    fn = lambda z: f(z, derivative=n) if n else f(z)
    if n == 0:
        return fn, lambda z: f(z, derivative=1), lambda z: z * f(z)
    return fn, lambda z: z * f(z), lambda z: f(z) + z * f(z, derivative=1)


def dilogarithm():
    d = lambda z: -mp.log(1 - z) / z if z else mp.mpf(1)
    return lambda z: mp.polylog(2, z), d, lambda z: (1 / (1 - z) - d(z)) / z if z else mp.mpf(1) / 4


def weierstrass(tau):
    """DLMF 23.6.5 with the nome exp(iπτ): by theta functions."""
    q = mp.exp(1j * mp.pi * tau)
    t2, t3, t4 = (mp.jtheta(k, 0, q) for k in (2, 3, 4))
    fixed = mp.pi**2 / 3 * (t2**4 + t3**4)

    def p(z):
        z = z - mp.nint(mp.im(z) / mp.im(tau)) * tau
        return (mp.pi * t2 * t3 * mp.jtheta(4, mp.pi * z, q) / mp.jtheta(1, mp.pi * z, q)) ** 2 - fixed

    return by_differences(p)


def eisenstein_e2(tau):
    """The sum itself."""
    q = mp.exp(2j * mp.pi * tau)
    total, n = mp.mpf(0), 1
    while True:
        term = n * q**n / (1 - q**n)
        total += term
        if abs(term) < mp.mpf(10) ** (-mp.mp.dps - 5) * max(1, abs(total)):
            return 1 - 24 * total
        n += 1


def theta_powers(tau):
    """Fourth powers of theta functions, of which modular forms are polynomials (DLMF 23.6.2-4, 23.15.6)."""
    q = mp.exp(1j * mp.pi * tau)
    return tuple(mp.jtheta(k, 0, q) ** 4 for k in (2, 3, 4))


def eisenstein_e4(tau):
    a, b, c = theta_powers(tau)
    return (a**2 + b**2 + c**2) / 2


def eisenstein_e6(tau):
    a, b, c = theta_powers(tau)
    return (a + b) * (b + c) * (c - a) / 2


def klein(tau):
    l = modular_lambda(tau)
    return 4 * (1 - l + l * l) ** 3 / (27 * (l * (1 - l)) ** 2)


def dedekind(tau):
    """Euler's pentagonal numbers."""
    q = mp.exp(2j * mp.pi * tau)
    total, n = mp.mpf(1), 1
    while True:
        term = (-1) ** n * (q ** (n * (3 * n - 1) // 2) + q ** (n * (3 * n + 1) // 2))
        total += term
        if abs(term) < mp.mpf(10) ** (-mp.mp.dps - 5):
            return mp.exp(1j * mp.pi * tau / 12) * total
        n += 1


def modular_lambda(tau):
    q = mp.exp(1j * mp.pi * tau)
    return (mp.jtheta(2, 0, q) / mp.jtheta(3, 0, q)) ** 4


# ------------------------------------------------------------------------------------------------------------------
# Points.
def disc(r, n, rng):
    return [complex(rng.uniform(-r, r), rng.uniform(-r, r)) for _ in range(n)]


def strip(lo, hi, n, rng):
    return [complex(rng.uniform(*lo), rng.uniform(*hi)) for _ in range(n)]


def around(center, rng, sizes=(0.3, 0.03, 1e-3)):
    turn = [1, 1j, -1, -1j, 0.7 + 0.7j, 0.7 - 0.7j, -0.7 + 0.7j, -0.7 - 0.7j]
    return [complex(center) + s * t for s in sizes for t in rng.sample(turn, 4)]


def sections(rng):
    half = lambda n: [complex(rng.uniform(-1.5, 1.5), 10 ** rng.uniform(-1.2, 0.6)) for _ in range(n)]
    plane = lambda r: disc(r, 30, rng) + disc(1.2, 10, rng) + around(0, rng)
    axis = lambda r: [complex(x, 0) for x in (-r, -0.7 * r, -0.3 * r, -0.1, 0.2, 0.3 * r, 0.6 * r, r)]
    far = [complex(3e3, 1e3), complex(-2e4, 5), complex(1e8, 1e9), complex(0.5, 3e6)]
    yield "faddeeva", "f(z) = faddeeva(z)", faddeeva(), plane(6) + axis(9) + far + around(1.9914668 - 1.3548101j, rng) + strip((-7, 7), (-0.5, 6.5), 30, rng)
    yield "erf", "f(z) = erf(z)", erf_like(mp.erf, 1), plane(4) + axis(3) + around(1.4506161 + 1.8809430j, rng) + [7 + 2j, -9 + 3j, 1 + 0.01j]
    yield "erfc", "f(z) = erfc(z)", erf_like(mp.erfc, -1), plane(4) + axis(5) + around(-1.3548101 + 1.9914668j, rng) + [7 + 2j, -9 + 3j, 6 - 5j]
    yield "erfcx", "f(z) = erfcx(z)", erfcx(), plane(5) + axis(5) + [30 + 2j, 1e6 + 3j, 6 - 5j]
    for k in (0, -1, 1, 2, -3):
        name = "lambertw" if k == 0 else f"lambertw_{k}"
        branch = around(-0.36787944, rng, (0.3, 0.03, 1e-3)) if k in (0, -1, 1) else []
        cut = [complex(-x, y) for x in (0.1, 0.3, 0.5, 1, 2, 7) for y in (0, 1e-3, -1e-3)]
        yield name, f"f(z) = lambertw(z, {k})", lambert(k), disc(4, 30, rng) + disc(0.6, 20, rng) + branch + cut + [1e5 + 3e4j, -3e8 + 1e7j, 1e-6 + 1e-6j, -1e-9j]
    yield "lambertw_real", "f(x) = lambertw(x, 0)", lambert(0), [complex(x) for x in (-0.3678, -0.36, -0.3, -0.2, -0.1, -1e-4, 1e-6, 0.01, 0.3, 0.9, 1.5, 1.99, 2.01, 2.7, 10, 1e3, 1e6, 1e20)]
    yield "lambertw_lower", "f(x) = lambertw(x, -1)", lambert(-1), [complex(x) for x in (-0.3678, -0.36, -0.3, -0.2, -0.1, -1e-2, -1e-4, -1e-8, -1e-20)]
    zeros = [0.5 + 14.134725j, 0.5 + 21.02204j, 0.5 + 98.831194j]
    on_strip = [complex(0.5, t) for t in range(5, 100, 12)] + strip((0, 1), (-100, 100), 8, rng)
    wide = strip((-6, 6), (-30, 30), 14, rng) + strip((-25, 30), (-12, 12), 10, rng) + strip((-4, 4), (-3, 3), 12, rng)
    small = (0.3, 1e-2)
    near_zeros = [p for z in zeros for p in around(z, rng, small)] + around(-2, rng, small) + around(-4, rng, small)
    yield "zeta", "f(z) = zeta(z)", zeta(), wide + on_strip + around(1, rng) + near_zeros + [complex(x) for x in (-3.5, -1, 0.001, 0.5, 2, 3, 20)]
    yield "zeta_real", "f(x) = zeta(x)", zeta(), [complex(x) for x in (-21.5, -11.2, -6.3, -3, -1.5, -1, -0.3, 0.25, 0.5, 0.9, 1.1, 1.5, 2, 3, 7, 15, 40)]
    yield "dirichlet_eta", "f(z) = dirichlet_eta(z)", eta(), wide + on_strip + around(1, rng) + around(0, rng)
    yield "dirichlet_beta", "f(z) = dirichlet_beta(z)", beta(), wide + on_strip + around(1.01, rng) + around(0, rng) + around(0.5 + 6.0209489j, rng, small)
    for name, f, n in (("airy_ai", mp.airyai, 0), ("airy_ai_prime", mp.airyai, 1), ("airy_bi", mp.airybi, 0), ("airy_bi_prime", mp.airybi, 1)):
        zeros = [-2.3381074, -4.0879494] if "ai" in name[5:] else [-1.1737132, complex(0.97754489, 2.1412907)]
        some = plane(8) + [p for z in zeros for p in around(z, rng, small)] + [complex(20, 3), complex(-30, 2), complex(-12, 12), complex(-12, -21)]
        yield name, f"f(z) = {name}(z)", airy(f, n), some
        yield name + "_real", f"f(x) = {name}(x)", airy(f, n), axis(10) + [complex(x) for x in (-30, -5.4, -2.34, 1e-3, 1, -1, 15)]
    yield "loggamma", "f(z) = loggamma(z)", (mp.loggamma, mp.digamma, lambda z: mp.polygamma(1, z)), plane(6) + strip((-9, 3), (-12, 12), 30, rng) + around(1, rng, small) + around(2, rng, small) + around(-1, rng, small) + [30 + 200j, 1e4 + 1j]
    yield "dilog", "f(z) = dilog(z)", dilogarithm(), plane(3) + around(1, rng) + [100 + 3j, -1e5 + 1j, 0.99 + 0.2j, 0.5 + 0.866j, -1 + 0.1j]
    yield "dilog_real", "f(x) = dilog(x)", dilogarithm(), [complex(x) for x in (-1e4, -30, -3, -1, -0.4, -1e-3, 1e-3, 0.2, 0.499, 0.51, 0.7, 0.95, 0.999)]
    for name, f in (("elliptic_k", mp.ellipk), ("elliptic_e", mp.ellipe)):
        yield name, f"f(z) = {name}(z)", by_differences(f), plane(3) + around(1, rng) + [complex(x, y) for x, y in ((30, 3), (-50, 2), (-1e4, 1))]
        yield name + "_real", f"f(x) = {name}(x)", by_differences(f), [complex(x) for x in (-100, -3, -0.5, -1e-3, 1e-3, 0.2, 0.5, 0.8, 0.95, 0.999)]
    for name, tau in (("square", 1j), ("hexagonal", mp.mpc(0.5, f32(0.8660254))), ("skew", mp.mpc(f32(0.3), f32(0.2)))):
        word = "weierstrass_p" if name == "square" else "weierstrass_p_" + name
        shown = f"complex({mp.nstr(mp.re(tau), 17)}, {mp.nstr(mp.im(tau), 17)})"
        yield word, f"f(z) = weierstrass_p(z, {shown})", weierstrass(tau), disc(1.6, 40, rng) + around(0.5, rng, small) + around(0, rng, (0.3, 1e-2))
        yield word + "_prime", f"f(z) = diff(weierstrass_p(z, {shown}), z)", weierstrass_slope(tau), disc(1.6, 20, rng) + around(0.5, rng, small)
    for name, form in (("eisenstein_e4", eisenstein_e4), ("eisenstein_e6", eisenstein_e6), ("eisenstein_e2", eisenstein_e2), ("klein_j", klein), ("dedekind_eta", dedekind), ("modular_lambda", modular_lambda)):
        yield name, f"f(z) = {name}(z)", by_differences(form), half(8 if name == "eisenstein_e2" else 40) + around(1j, rng, small) + around(0.5 + 0.8660254j, rng, small)


def weierstrass_slope(tau):
    p, d, second = weierstrass(tau)
    third = lambda z: 12 * p(z) * d(z)
    return d, second, third


# ------------------------------------------------------------------------------------------------------------------
def three(v):
    return mp.nstr(v, 3)


def write(fh, name, formula, functions, points):
    real = formula.startswith("f(x)")
    fh.write(f"# {name} | {formula}\n")
    if real:
        fh.write("# x\tf\tdx\tscale_f\tscale_dx\tnotes\n")
    else:
        fh.write("# z.re\tz.im\tf.re\tf.im\tdz.re\tdz.im\tscale_f\tscale_dz\tnotes\n")
    f, d, second = functions
    for z in dict.fromkeys(point(complex(p)) for p in points):
        try:
            at = mp.mpf(z.real) if real else mp.mpc(z.real, z.imag or SIDE)
            value, slope, curve = (mp.mpmathify(g(at)) for g in (f, d, second))
        except (ValueError, ZeroDivisionError, mp.libmp.libhyper.NoConvergence):
            continue
        sizes = [abs(v) for v in (value, slope, curve)]
        if any(not mp.isfinite(s) or s > LARGEST for s in sizes) or sizes[0] < LEAST or sizes[1] < LEAST:
            continue
        cells = [show(z.real)] if real else [show(z.real), show(z.imag)]
        for v in (value, slope):
            cells += [show(mp.re(v))] if real else [show(mp.re(v)), show(mp.im(v))]
        scales = [4 * sizes[0] + abs(z) * sizes[1] / 2, 16 * sizes[1] + 2 * abs(z) * sizes[2]]
        fh.write("\t".join(cells + [three(s) for s in scales] + ["-"]) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "special.txt")
    rng = random.Random(8)
    with open(path, "w", encoding="utf-8") as fh:
        for section in sections(rng):
            write(fh, *section)
            print(section[0], flush=True)


if __name__ == "__main__":
    main()
