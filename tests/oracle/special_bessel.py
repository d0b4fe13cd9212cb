#!/usr/bin/env python3
"""Write tests/data/functions/special_bessel.txt: Bessel functions, integrals of waves, beta and orthogonal polynomials.

usage: special_bessel.py [OUT_FILE]      (needs mpmath; default ../data/functions/special_bessel.txt beside this file)

Format, digits and scale are those of special.py.
"""
import os
import random
import sys

import mpmath as mp

from special import around, disc, f32, show, three, write

# zeros of the functions that the points lie about
J_ZEROS = (2.4048256, 5.5200781, 8.6537279, 11.7915344, 3.8317060, 7.0155867, 24.3524715)


def bessel(f, n, sign):
    """f of order n with f″ = -f′/x + (n²/x² - sign) f (DLMF 10.2.1, 10.25.1)."""
    value = lambda z: f(n, z)
    slope = lambda z: f(n, z, derivative=1)
    return value, slope, lambda z: -slope(z) / z + (mp.mpf(n * n) / z**2 - sign) * value(z)


def bessel_k(n):
    value = lambda z: mp.besselk(n, z)
    slope = lambda z: -(mp.besselk(n - 1, z) + mp.besselk(n + 1, z)) / 2
    return value, slope, lambda z: -slope(z) / z + (mp.mpf(n * n) / z**2 + 1) * value(z)


def exponential(f, sign):
    """E₁ with sign -1, Ei with sign 1."""
    slope = lambda z: sign * mp.exp(sign * z) / z
    return f, slope, lambda z: slope(z) * (sign - 1 / z)


def sine_integral():
    return mp.si, lambda z: mp.sin(z) / z, lambda z: mp.cos(z) / z - mp.sin(z) / z**2


def cosine_integral():
    return mp.ci, lambda z: mp.cos(z) / z, lambda z: -mp.sin(z) / z - mp.cos(z) / z**2


def logarithmic_integral():
    return lambda z: mp.ei(mp.log(z)), lambda z: 1 / mp.log(z), lambda z: -1 / (z * mp.log(z) ** 2)


def fresnel(f, wave, other, sign):
    phase = lambda z: mp.pi * z * z / 2
    return f, lambda z: wave(phase(z)), lambda z: sign * mp.pi * z * other(phase(z))


def beta(b):
    value = lambda a: mp.gammaprod([a, b], [a + b])
    rise = lambda a, n: mp.polygamma(n, a) - mp.polygamma(n, a + b)
    return value, lambda a: value(a) * rise(a, 0), lambda a: value(a) * (rise(a, 0) ** 2 + rise(a, 1))


def polynomial(coefficients):
    """A polynomial by its coefficients, the highest first."""
    value = lambda c: lambda z: mp.polyval(c, z)
    lower = lambda c: [v * (len(c) - 1 - k) for k, v in enumerate(c[:-1])] or [mp.mpf(0)]
    first = lower(coefficients)
    return value(coefficients), value(first), value(lower(first))


def hypergeometric(n, factor, upper, lower):
    """Coefficients in t of factor Σ (-n)_k (upper…)_k/((lower)_k k!) t^k, the highest first."""
    return [factor * mp.rf(-n, k) * mp.fprod(mp.rf(u, k) for u in upper) / (mp.rf(lower, k) * mp.factorial(k)) for k in range(n, -1, -1)]


def shifted(coefficients, a, b):
    """p(a + b z) from the coefficients of p(t), the highest first."""
    total = [mp.mpf(0)]
    for c in coefficients:
        product = [mp.mpf(0)] * (len(total) + 1)
        for k, v in enumerate(total):
            product[k] += b * v
            product[k + 1] += a * v
        product[-1] += c
        total = product
    return total[1:]


def gegenbauer(n, a):
    """DLMF 18.5.9"""
    a = mp.mpf(a)
    return polynomial(shifted(hypergeometric(n, mp.rf(2 * a, n) / mp.factorial(n), [n + 2 * a], a + mp.mpf(1) / 2), mp.mpf(1) / 2, -mp.mpf(1) / 2))


def chebyshev(n):
    """DLMF 18.5.11"""
    return polynomial(shifted(hypergeometric(n, mp.mpf(1), [n], mp.mpf(1) / 2), mp.mpf(1) / 2, -mp.mpf(1) / 2))


def laguerre(n, a):
    """DLMF 18.5.12"""
    return polynomial(hypergeometric(n, mp.rf(a + 1, n) / mp.factorial(n), [], mp.mpf(a) + 1))


def hermite(n):
    """DLMF 18.5.13"""
    out = [mp.mpf(0)] * (n + 1)
    for k in range(n // 2 + 1):
        out[2 * k] = mp.factorial(n) * (-1) ** k * mp.mpf(2) ** (n - 2 * k) / (mp.factorial(k) * mp.factorial(n - 2 * k))
    return polynomial(out)


def harmonic(l, m):
    """Of (x, y, z), from complex spherical harmonics as mpmath has them."""

    def value(x, y, z):
        r = mp.sqrt(x * x + y * y + z * z)
        theta, angle = mp.acos(z / r), mp.atan2(y, x)
        k = abs(m)
        norm = mp.sqrt((2 * l + 1) / (4 * mp.pi) * mp.factorial(l - k) / mp.factorial(l + k))
        wave = mp.mpf(1) if m == 0 else mp.sqrt(2) * (mp.cos(k * angle) if m > 0 else mp.sin(k * angle))
        # Ferrers' function by DLMF 14.7.10 without (-1)^m: a derivative of Legendre's polynomial
        p = gegenbauer(l, mp.mpf(1) / 2)[0] if k == 0 else legendre_derivative(l, k)
        return norm * wave * mp.sin(theta) ** k * p(mp.cos(theta))

    return value


def legendre_derivative(l, k):
    """The k-th derivative of the polynomial of Rodrigues (DLMF 18.5.5)."""
    c = [mp.mpf(0)] * (2 * l + 1)
    for j in range(l + 1):
        c[2 * j] = mp.binomial(l, j) * (-1) ** j
    for _ in range(l + k):
        c = [v * (len(c) - 1 - i) for i, v in enumerate(c[:-1])] or [mp.mpf(0)]
    scale = 1 / (mp.mpf(2) ** l * mp.factorial(l))
    return lambda z: scale * mp.polyval(c, z)


# ------------------------------------------------------------------------------------------------------------------
def reals(*values):
    return [complex(v) for v in values]


def line(lo, hi, n, rng):
    return [complex(rng.uniform(lo, hi)) for _ in range(n)]


def sections(rng):
    waves = reals(1e-10, 1e-3, 0.1, 0.5, 0.9999, 1.0001, 1.4, 1.42, 2, 3.3, 11.99, 12.01, 17, 24.9, 25.1, 49, 51, 100, 1e3, 12345.678, 1e6, 1e9)
    zeros = [complex(z + d) for z in J_ZEROS for d in (0, 1e-3, -0.05)]
    both = [-z for z in waves[2:20:3]]
    for n in (0, 1, 2, 3, 7, 20, 50):
        name = "besselj" if n == 0 else f"besselj_{n}"
        yield name, f"f(x) = besselj({n}, x)", bessel(mp.besselj, n, 1), waves + both + zeros + line(0, 60, 25, rng)
        yield name.replace("lj", "ly"), f"f(x) = bessely({n}, x)", bessel(mp.bessely, n, 1), waves + line(0, 60, 25, rng) + reals(0.8935770, 3.9576784, 2.1971413, 5.4296810, 7.0860511, 0.05, 1e-5)
        rising = reals(1e-10, 1e-3, 0.1, 0.5, 0.9999, 1.0001, 1.4, 2, 3.3, 8, 14, 20, 33, 34, 60, 80)
        yield name.replace("lj", "li"), f"f(x) = besseli({n}, x)", bessel(mp.besseli, n, -1), rising + [-z for z in rising[2:10]] + line(0, 30, 15, rng)
        yield name.replace("lj", "lk"), f"f(x) = besselk({n}, x)", bessel_k(n), rising + line(0, 30, 15, rng)
    yield "besselj_minus_3", "f(x) = besselj(-3, x)", bessel(mp.besselj, -3, 1), line(-20, 20, 15, rng)
    yield "bessely_minus_3", "f(x) = bessely(-3, x)", bessel(mp.bessely, -3, 1), line(0, 20, 15, rng)
    yield "besseli_minus_3", "f(x) = besseli(-3, x)", bessel(mp.besseli, 3, -1), line(-20, 20, 15, rng)
    yield "besselk_minus_3", "f(x) = besselk(-3, x)", bessel_k(-3), line(0, 20, 15, rng)
    plane = lambda r: disc(r, 30, rng) + disc(1.5, 12, rng) + around(0, rng, (0.3, 1e-2)) + disc(30, 25, rng)
    for n in (0, 1, 2, 5, 10):
        some = [p for z in J_ZEROS[:5] for p in around(z, rng, (1e-2,))] + [200 + 3j, -70 + 20j, 3 + 60j, -11.9 + 1j, 12.1 + 1j, 30j, -25j]
        yield f"besselj_{n}_complex", f"f(z) = besselj({n}, z)", bessel(mp.besselj, n, 1), plane(12) + some
    yield "besselj_minus_1_complex", "f(z) = besselj(-1, z)", bessel(mp.besselj, -1, 1), disc(10, 15, rng)

    cut = [complex(-x, y) for x in (0.3, 1, 3, 7, 20, 23, 25, 50) for y in (0, 0.2, -0.2, 4)]
    far = [30 + 3j, -35 + 20j, 5 - 60j, 3 + 200j, -38 + 3j, -45 + 9j]
    spread = lambda: disc(8, 30, rng) + disc(1.5, 12, rng) + disc(45, 25, rng) + around(0, rng) + far
    yield "expint_e1", "f(z) = expint_e1(z)", exponential(mp.e1, -1), spread() + cut
    yield "e1", "f(x) = e1(x)", exponential(mp.e1, -1), reals(1e-20, 1e-5, 0.01, 0.3, 0.7, 0.999, 1.001, 1.5, 2, 4, 9, 20, 50, 70) + line(0, 6, 10, rng)
    yield "expint_ei", "f(z) = expint_ei(z)", exponential(mp.ei, 1), spread() + [-p for p in cut] + cut + around(0.37250741, rng, (0.03, 1e-3))
    yield "ei", "f(x) = ei(x)", exponential(mp.ei, 1), reals(1e-5, 0.01, 0.3, 0.37250741, 0.372, 0.38, 0.7, 2, 4, 9, 20, 23.9, 24.1, 39.9, 40.1, 60, -1e-5, -0.3, -0.99, -1.01, -3, -20, -60) + line(-6, 6, 12, rng)
    yield "sinint", "f(z) = sinint(z)", sine_integral(), spread() + [-p for p in far]
    yield "si", "f(x) = si(x)", sine_integral(), reals(1e-5, 0.01, 0.3, 1, 2.49, 2.51, 3.1, 4, 9, 20, 100, 1e4, 1e8, -0.5, -2.6, -30) + line(-30, 30, 20, rng)
    yield "cosint", "f(z) = cosint(z)", cosine_integral(), spread() + [-p for p in far] + around(0.61650548, rng, (0.03, 1e-3)) + around(3.3841804, rng, (0.03,)) + [-3 + 0j, -0.5 + 0j]
    yield "ci", "f(x) = ci(x)", cosine_integral(), reals(1e-5, 0.01, 0.3, 0.61650548, 0.6, 1, 2.49, 2.51, 3.1, 3.3841804, 3.38, 6.4270477, 9, 20, 100, 1e4) + line(0, 30, 20, rng)
    yield "logint", "f(z) = logint(z)", logarithmic_integral(), disc(3, 30, rng) + disc(30, 15, rng) + around(1, rng) + around(1.4513692, rng, (0.03, 1e-3)) + [1e3 + 4j, -1e5 + 3e4j, 1e8 - 1e9j, 0.5 + 0j, 0.01 + 0j, -3 + 0j]
    yield "li", "f(x) = li(x)", logarithmic_integral(), reals(1e-6, 0.01, 0.3, 0.9, 0.99, 1.01, 1.1, 1.4513692, 1.45, 1.46, 2, 3, 3.99, 4.01, 10, 100, 1e4, 1e8, 2.6e10, 3e10, 1e15, 1e20) + line(0, 5, 12, rng)

    for name, f, wave, other, sign in (("fresnel_s", mp.fresnels, mp.sin, mp.cos, 1), ("fresnel_c", mp.fresnelc, mp.cos, mp.sin, -1)):
        functions = fresnel(f, wave, other, sign)
        yield name, f"f(z) = {name}(z)", functions, disc(3, 40, rng) + disc(1.2, 12, rng) + around(0, rng, (0.3, 1e-2)) + [4 + 1j, -5 + 2j, 1 - 6j, -0.3 + 7j, 1.06 + 1.06j, 3 + 3j, -2 + 2j]
        yield name + "_real", f"f(x) = {name}(x)", functions, reals(1e-4, 0.1, 0.5, 1, 1.49, 1.51, 2, 2.5, 3, 4.4, 7, 13, 50, 333.25, -0.3, -1.7, -20) + line(-8, 8, 25, rng)

    for b in (2.5, 0.125, 17, -0.75):
        name = {2.5: "euler_beta", 0.125: "euler_beta_eighth", 17: "euler_beta_17", -0.75: "euler_beta_negative"}[b]
        yield name, f"f(z) = euler_beta(z, {b})", beta(mp.mpf(b)), disc(5, 30, rng) + disc(20, 15, rng) + around(0, rng, (0.3,)) + around(-2, rng, (0.3,)) + [40 + 5j, 12 + 30j]
        yield name.replace("euler_", ""), f"f(x) = beta(x, {b})", beta(mp.mpf(b)), reals(1e-5, 0.1, 0.5, 1, 2, 3, 7.5, 8.5, 15, 20, 33, 50, 100, -0.3, -1.5, -2.4, -7.3) + line(0, 12, 20, rng) + line(-5, 0, 8, rng)
    yield "beta_second", "f(x) = beta(3.25, x)", beta(mp.mpf(3.25)), reals(1e-5, 0.1, 1, 5, 30, 100, -0.3) + line(0, 12, 10, rng)

    ordinary = lambda: reals(1e-4, 0.01, 0.5, 0.9, 0.999, 1, 1.001, 1.5, -0.3, -1, -2) + line(-1, 1, 30, rng)
    around_unit = lambda: disc(1.5, 25, rng) + around(1, rng, (0.1, 1e-3))
    for n in (1, 2, 3, 6, 12, 25):
        suffix = "" if n == 3 else f"_{n}"
        yield "chebyshev_t" + suffix, f"f(x) = chebyshev_t({n}, x)", chebyshev(n), ordinary()
        yield "chebyshev_u" + suffix, f"f(x) = chebyshev_u({n}, x)", gegenbauer(n, 1), ordinary()
        yield "legendre_p" + suffix, f"f(x) = legendre_p({n}, x)", gegenbauer(n, 0.5), ordinary()
        yield "gegenbauer_c" + suffix, f"f(x) = gegenbauer_c({n}, 1.75, x)", gegenbauer(n, 1.75), ordinary()
        yield "hermite_h" + suffix, f"f(x) = hermite_h({n}, x)", hermite(n), ordinary() + line(-6, 6, 20, rng)
        yield "laguerre_l" + suffix, f"f(x) = laguerre_l({n}, x)", laguerre(n, 0), ordinary() + line(0, 30, 20, rng)
    yield "laguerre_l_2.5", "f(x) = laguerre_l(5, 2.5, x)", laguerre(5, 2.5), line(0, 20, 20, rng)
    yield "chebyshev_t_complex", "f(z) = chebyshev_t(7, z)", chebyshev(7), around_unit()
    yield "legendre_p_complex", "f(z) = legendre_p(5, z)", gegenbauer(5, 0.5), around_unit()
    yield "gegenbauer_c_complex", "f(z) = gegenbauer_c(4, 2.25, z)", gegenbauer(4, 2.25), around_unit()
    yield "hermite_h_complex", "f(z) = hermite_h(6, z)", hermite(6), disc(3, 25, rng)
    yield "laguerre_l_complex", "f(z) = laguerre_l(6, 0.5, z)", laguerre(6, 0.5), disc(6, 25, rng)


HARMONICS = ((0, 0), (1, -1), (1, 0), (1, 1), (2, 0), (2, -1), (2, 2), (3, 2), (4, -3), (5, 0), (6, 4), (8, -7), (12, 5), (20, 9))


def partial(f, at, k):
    """∂f/∂x_k at a point, with an error far below 60 digits."""
    with mp.workdps(110):
        h = mp.mpf(10) ** -20
        moved = lambda s: f(*[v + s * h if j == k else v for j, v in enumerate(at)])
        return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * h)


def write_harmonic(fh, l, m, rng):
    """The value and the gradient; the scale is that of special.py with the greatest |Y| and |∇Y| r in the place of theirs."""
    name = "spherical_harmonic" if (l, m) == (3, 2) else f"spherical_harmonic_{l}_{m}"
    fh.write(f"# {name} | f(x, y, z) = spherical_harmonic({l}, {m}, x, y, z)\n")
    fh.write("# x\ty\tz\tf\tdx\tdy\tdz\tscale_f\tscale_dx\tscale_dy\tscale_dz\tnotes\n")
    f = harmonic(l, m)
    fixed = [(0.5, 0.25, -0.75), (3, 0, 4), (0, 1, 0.5), (1e-3, 2e-3, 1), (-2, 1e-3, 1e-3), (1e4, -2e4, 5e3)]
    for point in fixed + [tuple(rng.uniform(-1, 1) for _ in range(3)) for _ in range(14)]:
        at = [mp.mpf(f32(v)) for v in point]
        value, slopes = f(*at), [partial(f, at, k) for k in range(3)]
        r = mp.sqrt(sum(v * v for v in at))
        size = mp.sqrt(mp.mpf(2 * l + 1) / (4 * mp.pi))
        steep = mp.sqrt(sum(s * s for s in slopes)) + size / r
        scales = [4 * abs(value) + size * (l + 1) / 2] + [16 * steep * (l + 1)] * 3
        fh.write("\t".join([show(v) for v in at] + [show(v) for v in [value] + slopes] + [three(s) for s in scales] + ["-"]) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "special_bessel.txt")
    rng = random.Random(9)
    with open(path, "w", encoding="utf-8") as fh:
        for section in sections(rng):
            write(fh, *section)
            print(section[0], flush=True)
        for l, m in HARMONICS:
            write_harmonic(fh, l, m, rng)


if __name__ == "__main__":
    main()
