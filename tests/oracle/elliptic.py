#!/usr/bin/env python3
"""Write tests/data/functions/elliptic.txt: theta and elliptic functions, and series of several arguments.

usage: elliptic.py [OUT_FILE]     (needs mpmath; default ../data/functions/elliptic.txt beside this file)

Values and derivatives by mpmath with 60 digits: theta functions as their sums, elliptic functions as quotients of those, without any
transformation. The scale is that of special.py: 16 u of the norm of the value, 64 u of that of a derivative, and what one unit in
the last place of any argument moves, those that are constants in the formula, too. README.md beside this file has the format.
"""
import functools
import os
import random
import sys

import mpmath as mp

from special import LARGEST, LEAST, SIDE, around, dedekind, disc, eisenstein_e2, eisenstein_e4, eisenstein_e6, f32, klein, modular_lambda, point, show, strip, three

mp.mp.dps = 60
STEP = mp.mpf(10) ** -12


def difference(f, x):
    """The derivative: the error is the fourth power of the step."""
    h = STEP * max(1, abs(x))
    return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h)


@functools.lru_cache
def lattice_roots(g2, g3):
    with mp.workdps(130):
        return mp.polyroots([4, 0, -g2, -g3], maxsteps=600, extraprec=500, error=False)


def weierstrass(z, g2, g3):
    """DLMF 23.6.21"""
    if g2 == 0 and g3 == 0:
        return 1 / z**2
    e1, e2, e3 = lattice_roots(g2, g3)
    return e3 + (e1 - e3) / mp.ellipfun("sn", mp.sqrt(e1 - e3) * z, m=(e2 - e3) / (e1 - e3)) ** 2


def sections(rng):
    """Name, formula with the constants as {0}, {1}, …, function of the argument and the constants, the constants, points."""
    small = (0.3, 1e-2)
    nomes = (("", 0.1), ("_complex", 0.3 + 0.2j), ("_negative", -0.5 + 0.125j), ("_near_1", 0.9), ("_circle", 0.7 - 0.68j))
    for k in (1, 2, 3, 4):
        word = f"jacobi_theta{k}"
        theta = lambda z, q, k=k: mp.jtheta(k, z, q)
        for name, q in nomes:
            size = 1.2 if "circle" in name or "near" in name else 3
            yield word + name, f"f(z) = {word}(z, {{0}})", theta, [q], disc(size, 16, rng) + around(0, rng, small) + around(1.5707963, rng, (1e-2,))
        yield word + "_prime", f"f(z) = diff({word}(z, {{0}}), z)", lambda z, q, k=k: mp.jtheta(k, z, q, derivative=1), [0.3 + 0.2j], disc(3, 14, rng)
        of_nome = lambda q, z, k=k: mp.jtheta(k, z, q)
        inside = [p for p in disc(0.96, 40, rng) if abs(p) < 0.96] + around(0, rng, small)
        yield word + "_nome", f"f(z) = {word}({{0}}, z)", of_nome, [0.3 + 0.2j], inside
        yield word + "_real", f"f(x) = {word}(x, {{0}})", theta, [0.4], [complex(x) for x in (-7.5, -2, -0.7, -0.01, 0.01, 0.3, 1, 1.57, 2.5, 6)]
        yield word + "_real_nome", f"f(x) = {word}({{0}}, x)", of_nome, [0.7], [complex(x) for x in (1e-6, 0.01, 0.1, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95, 0.98)]
    for kind in ("sn", "cn", "dn"):
        word = f"jacobi_{kind}"
        f = lambda u, m, kind=kind: mp.ellipfun(kind, u, m=m)
        for name, m in (("", 0.5), ("_near_1", 0.96875), ("_above_1", 2.5), ("_negative", -3), ("_complex", 0.25 + 0.5j), ("_far", -8 + 6j)):
            yield word + name, f"f(z) = {word}(z, {{0}})", f, [m], disc(3, 24, rng) + around(0, rng, small) + around(1.8540747, rng, small) + around(1.8540747j, rng, small)
        for name, m in (("_real", 0.75), ("_real_above_1", 1.75), ("_real_negative", -1.5)):
            yield word + name, f"f(x) = {word}(x, {{0}})", f, [m], [complex(x) for x in (-9, -3.3, -1.2, -0.4, -1e-3, 1e-3, 0.2, 0.7, 1.9, 2.6, 4.1, 7.7)]
    lattices = (("_square", 4, 0), ("_hexagonal", 0, 4), ("_real", 4, 1), ("_rhombic", -2, 1), ("_complex", 1 + 2j, -3 + 1j), ("_small", 2**-10, 2**-13), ("_double", 12, 8), ("_rational", 0, 0))
    for name, g2, g3 in lattices:
        some = disc(1.7, 30, rng) + around(0, rng, small)
        yield "weierstrass_p_invariants" + name.removeprefix("_square"), "f(z) = weierstrass_p_invariants(z, {0}, {1})", weierstrass, [g2, g3], some
        slope = lambda z, g2, g3: difference(lambda z: weierstrass(z, g2, g3), z)
        if name in ("_real", "_complex"):
            yield "weierstrass_p_prime_invariants" + name.removeprefix("_real"), "f(z) = weierstrass_p_prime_invariants(z, {0}, {1})", slope, [g2, g3], some[:16]
    hurwitz = lambda s, a: mp.zeta(s, mp.re(a))
    right = strip((0, 12), (-20, 20), 24, rng) + strip((0.4, 0.6), (-80, 80), 6, rng) + [p for p in around(1, rng)] + [complex(x) for x in (0, 0.5, 2, 7, 25)]
    for name, a in (("", 0.25), ("_1", 1), ("_large", 30.5)):
        yield "hurwitz_zeta" + name, "f(z) = hurwitz_zeta(z, {0})", hurwitz, [a], right
    yield "hurwitz_zeta_real", "f(x) = hurwitz_zeta(x, {0})", hurwitz, [0.75], [complex(x) for x in (0, 0.1, 0.5, 0.9, 1.1, 1.5, 2, 3.7, 8, 20)]
    yield "hurwitz_zeta_shift", "f(x) = hurwitz_zeta({0}, x)", lambda a, s: mp.zeta(s, mp.re(a)), [1.5], [complex(x) for x in (0.01, 0.1, 0.3, 0.7, 1, 1.5, 3, 10, 100)]
    inside = [p for p in disc(0.95, 16, rng) if abs(p) < 0.95] + around(0, rng, (1e-2,)) + [-3 + 2j, -30 + 0.1j, 0.4 + 2j]
    real = [complex(x) for x in (-20, -3, -0.9, -0.3, -1e-3, 1e-3, 0.2, 0.5, 0.7, 0.85, 0.95)]
    for k, (a, b, c) in enumerate(((0.5, 0.5, 1), (1, 2, 3), (-0.25, 0.75, 1.5), (-3, 4, 1))):
        f = lambda z, a, b, c: mp.hyp2f1(a, b, c, z)
        yield f"hypergeometric_{k}".removesuffix("_0"), "f(z) = hypergeometric({0}, {1}, {2}, z)", f, [a, b, c], inside
        yield f"hypergeometric_{k}_real", "f(x) = hypergeometric({0}, {1}, {2}, x)", f, [a, b, c], real


def parameters(rng):
    """The same of derivatives by parameters."""
    ring = [complex(1.2 * mp.cos(t), 1.2 * mp.sin(t)) for t in range(6)] + [complex(0.5, y) for y in (-0.75, -0.25, 0.25, 0.8)]
    plane = disc(3, 16, rng) + around(0, rng) + around(1, rng) + ring + [complex(x) for x in (0, 2**-20, 0.25, 0.75, 1.5, -2)] + [-40 + 9j, 300 + 2j]
    axis = [complex(x) for x in (-100, -3, -0.9, -0.1, -1e-4, 1e-4, 0.25, 0.5, 0.75, 0.9, 0.999, 1.001, 1.25, 1.9, 6, 50)]
    for kind in ("sn", "cn", "dn"):
        f = lambda m, u, kind=kind: mp.ellipfun(kind, u, m=m)
        for name, u in (("", 0.75), ("_complex", 1.5 + 0.75j), ("_far", 3.25 - 2.5j), ("_small", 2**-6)):
            yield f"jacobi_{kind}_parameter{name}", f"f(z) = jacobi_{kind}({{0}}, z)", f, [u], plane
        yield f"jacobi_{kind}_parameter_real", f"f(x) = jacobi_{kind}({{0}}, x)", f, [1.25], axis
        both = lambda z, kind=kind: mp.ellipfun(kind, z, m=z / 4 + 0.5)
        yield f"jacobi_{kind}_both", f"f(z) = jacobi_{kind}(z, z/4 + 1/2)", both, [], disc(2.5, 16, rng) + around(0, rng, (1e-2,))
    some = disc(2.5, 12, rng) + [complex(x) for x in (-2, -1, 0, 1, 2, -1.5, 0.25)]
    right = [z + 2.75 for z in disc(2, 14, rng)] + [complex(x) for x in (-1.5, 0.25, 1, 2, 7)]
    line = [complex(x) for x in (-2.625, -1.25, -0.3125, 1e-4, 1e-3, 0.125, 0.5, 1, 1.75, 2, 3.75, 6)]
    positive = [complex(x) for x in (-0.75, 0.125, 0.375, 0.5, 1, 1.625, 2, 3.75, 5.5, 9)]
    for name, x in (("", 0.5), ("_complex", 0.25 + 0.5j), ("_left", -3), ("_turned", -0.5 + 2j)):
        for k, (b, c) in enumerate(((0.5, 1), (2, 3.25))):
            of = (f"_{k}" if k else "") + name
            yield "hypergeometric_a" + of, "f(z) = hypergeometric(z, {0}, {1}, {2})", mp.hyp2f1, [b, c, x], some
            yield "hypergeometric_b" + of, "f(z) = hypergeometric({0}, z, {1}, {2})", lambda b, a, c, x: mp.hyp2f1(a, b, c, x), [b, c, x], some
            by_c = lambda c, a, b, x: mp.hyp2f1(a, b, c, x)
            yield "hypergeometric_c" + of, "f(z) = hypergeometric({0}, {1}, z, {2})", by_c, [b, c, x], right
            if complex(x).imag == 0:
                yield f"hypergeometric_a_real{of}", "f(x) = hypergeometric(x, {0}, {1}, {2})", mp.hyp2f1, [b, c, x], line
                yield f"hypergeometric_c_real{of}", "f(x) = hypergeometric({0}, {1}, x, {2})", by_c, [b, c, x], positive
    for n in (1, 5, 12):
        for word, f in (("gegenbauer_c", gegenbauer(n)), ("laguerre_l", laguerre(n))):
            yield f"{word}_parameter_{n}", f"f(z) = {word}({n}, z, {{0}})", f, [0.375 + 0.25j], some
            yield f"{word}_parameter_{n}_real", f"f(x) = {word}({n}, x, {{0}})", f, [0.625], line


def of_lattice(z, tau):
    """℘ of 1 and τ by theta functions (DLMF 23.6.5, 20.2)"""
    q = mp.expjpi(tau)
    t2, t3 = mp.jtheta(2, 0, q), mp.jtheta(3, 0, q)
    quotient = mp.jtheta(4, mp.pi * z, q) / mp.jtheta(1, mp.pi * z, q)
    return (mp.pi * t2 * t3 * quotient) ** 2 - mp.pi**2 / 3 * (t2**4 + t3**4)


def of_lattice_slope(z, tau):
    return difference(lambda z: of_lattice(z, tau), z)


def weierstrass_slope(z, g2, g3):
    return difference(lambda z: weierstrass(z, g2, g3), z)


def lattices(rng):
    """The same of ℘ by its lattice and by its invariants."""
    half = [complex(x, y) for x, y in ((0, 1), (0.5, 0.875), (0.25, 1.5), (-0.4375, 0.625), (0, 4), (0.125, 9), (1.25, 0.5), (-2.5, 0.3125), (0.375, 0.2), (-0.6875, 0.125))]
    half += [complex(rng.uniform(-1, 1), rng.uniform(0.15, 1.5)) for _ in range(8)] + around(1j, rng, (1e-2,)) + around(0.5 + 0.8660254j, rng, (1e-2,))
    for name, z in (("", 0.25), ("_complex", 0.375 + 0.25j), ("_small", 2**-6 + 2**-7 * 1j), ("_far", 1.3125 + 2.1875j), ("_half", 0.5), ("_near", 0.9375 - 0.03125j), ("_zero", 0.46875 + 0.484375j)):
        yield "weierstrass_p_lattice" + name, "f(z) = weierstrass_p({0}, z)", lambda t, z: of_lattice(z, t), [z], half
        if name in ("_complex", "_small", "_far"):
            yield "weierstrass_p_prime_lattice" + name, "f(z) = weierstrass_p_prime({0}, z)", lambda t, z: of_lattice_slope(z, t), [z], half[:14]
    yield "weierstrass_p_lattice_both", "f(z) = weierstrass_p(z/2, z + i)", lambda z: of_lattice(z / 2, z + mp.j), [], disc(0.9, 12, rng) + [complex(x, 0.25) for x in (-1.5, 2.25)]
    some = disc(4, 12, rng) + around(0, rng, (1e-2,)) + [complex(x) for x in (0, 3, 4, -2, 0.25, 40)] + [-300 + 200j]
    at = (("", 0.75), ("_complex", 0.5 + 0.375j), ("_small", 2**-4), ("_far", 2.5 - 1j), ("_tiny", 2**-10 + 2**-11 * 1j))
    for name, z in at:
        for other in (1, -2 + 1j):
            of = name + ("_1" if other != 1 else "")
            yield "weierstrass_p_invariants_g2" + of, "f(z) = weierstrass_p_invariants({0}, z, {1})", lambda g2, z, g3: weierstrass(z, g2, g3), [z, other], some
            g2 = 3 * other
            yield "weierstrass_p_invariants_g3" + of, "f(z) = weierstrass_p_invariants({0}, {1}, z)", lambda g3, z, g2: weierstrass(z, g2, g3), [z, g2], some
    for name, z in at[:3]:
        yield "weierstrass_p_prime_invariants_g2" + name, "f(z) = weierstrass_p_prime_invariants({0}, z, {1})", lambda g2, z, g3: weierstrass_slope(z, g2, g3), [z, 1], some[:12]
        yield "weierstrass_p_prime_invariants_g3" + name, "f(z) = weierstrass_p_prime_invariants({0}, {1}, z)", lambda g3, z, g2: weierstrass_slope(z, g2, g3), [z, 3], some[:12]
    yield "weierstrass_p_invariants_all", "f(z) = weierstrass_p_invariants(z/2, z + 3, 1 - z)", lambda z: weierstrass(z / 2, z + 3, 1 - z), [], disc(2, 12, rng)


def stencil(f, x):
    """The first three derivatives, from seven values: the errors are the sixth, sixth and fourth powers of the step."""
    h = mp.mpf(10) ** -8 * max(1, abs(x))
    at = [f(x + j * h) for j in range(-3, 4)]
    weights = [[-1, 9, -45, 0, 45, -9, 1], [2, -27, 270, -490, 270, -27, 2], [1, -8, 13, 0, -13, 8, -1]]
    return [mp.fdot(w, at) / (below * h**n) for n, (w, below) in enumerate(zip(weights, (60, 180, 8)), 1)]


def curves(rng):
    """Functions whose second derivatives are wanted: the formulas are the first ones, so that their derivatives are the second ones."""
    plane = disc(2, 5, rng) + around(0, rng, (1e-2,))[:2] + around(1, rng, (1e-2,))[:2] + [complex(0.5, 0.8), 0.25, 1.5, -3, -40 + 9j]
    axis = [complex(x) for x in (-30, -0.9, -1e-4, 0.25, 0.5, 0.9, 0.999, 1.001, 1.9, 6)]
    for kind in ("sn", "cn", "dn"):
        f = lambda m, u, kind=kind: mp.ellipfun(kind, u, m=m)
        for name, u in (("", 0.75), ("_complex", 1.5 + 0.75j), ("_far", 3.25 - 2.5j), ("_small", 2**-6)):
            yield f"jacobi_{kind}_curve{name}", f"f(z) = diff(jacobi_{kind}({{0}}, z), z)", f, [u], plane
        yield f"jacobi_{kind}_curve_real", f"f(x) = diff(jacobi_{kind}({{0}}, x), x)", f, [1.25], axis
        both = lambda z, kind=kind: mp.ellipfun(kind, z, m=z / 4 + 0.5)
        yield f"jacobi_{kind}_curve_both", f"f(z) = diff(jacobi_{kind}(z, z/4 + 1/2), z)", both, [], disc(2, 8, rng)
    for name, f in (("elliptic_k", mp.ellipk), ("elliptic_e", mp.ellipe)):
        yield name + "_curve", f"f(z) = diff({name}(z), z)", f, [], plane
        yield name + "_curve_real", f"f(x) = diff({name}(x), x)", f, [], [x for x in axis if x.real < 1] + [-3, -0.25, 0.75]
    some = disc(2, 6, rng) + [complex(x) for x in (-1, 0, 1, 0.25)]
    right = [z + 2.75 for z in disc(2, 6, rng)] + [complex(x) for x in (0.25, 1, 4)]
    line = [complex(x) for x in (-2.625, -0.3125, 1e-3, 0.5, 1, 2, 3.75, 0.125, 1.5, 2.5, 5, 7)]
    for name, x in (("", 0.5), ("_complex", 0.25 + 0.5j), ("_left", -3), ("_turned", -0.5 + 2j)):
        by_a = mp.hyp2f1
        by_c = lambda c, a, b, x: mp.hyp2f1(a, b, c, x)
        by_both = lambda a, c, x: mp.hyp2f1(a, a + 0.5, c, x)
        by_ends = lambda a, b, x: mp.hyp2f1(a, b, a + 1, x)
        yield "hypergeometric_aa" + name, "f(z) = diff(hypergeometric(z, {0}, {1}, {2}), z)", by_a, [2, 3.25, x], some
        yield "hypergeometric_cc" + name, "f(z) = diff(hypergeometric({0}, {1}, z, {2}), z)", by_c, [0.5, 1, x], right
        yield "hypergeometric_ab" + name, "f(z) = diff(hypergeometric(z, z + 1/2, {0}, {1}), z)", by_both, [1.25, x], some
        yield "hypergeometric_ac" + name, "f(z) = diff(hypergeometric(z, {0}, z + 1, {1}), z)", by_ends, [0.75, x], right
        if complex(x).imag == 0:
            yield f"hypergeometric_aa_real{name}", "f(x) = diff(hypergeometric(x, {0}, {1}, {2}), x)", by_a, [2, 3.25, x], line
            yield f"hypergeometric_ab_real{name}", "f(x) = diff(hypergeometric(x, x + 1/2, {0}, {1}), x)", by_both, [1.25, x], line
            yield f"hypergeometric_ac_real{name}", "f(x) = diff(hypergeometric(x, {0}, x + 1, {1}), x)", by_ends, [0.75, x], line[2:]
            yield f"hypergeometric_cc_real{name}", "f(x) = diff(hypergeometric({0}, {1}, x, {2}), x)", by_c, [0.5, 1, x], line[3:]
    inside = [p for p in disc(0.9, 10, rng) if abs(p) < 0.9] + [0.01 + 0.002j]
    for k in (1, 2, 3, 4):
        theta = lambda q, z, k=k: mp.jtheta(k, z, q)
        yield f"jacobi_theta{k}_curve", f"f(z) = diff(jacobi_theta{k}({{0}}, z), z)", theta, [0.3 + 0.2j], inside
    half = [complex(x, y) for x, y in ((0, 1), (0.5, 0.875), (0.25, 1.5), (-0.4375, 0.625), (1.25, 0.5), (-0.6875, 0.25), (0.1875, 2.5), (0.0625, 1.75), (-0.3125, 0.9375), (0.4375, 0.75))]
    forms = (("eisenstein_e2", eisenstein_e2), ("eisenstein_e4", eisenstein_e4), ("eisenstein_e6", eisenstein_e6), ("klein_j", klein), ("dedekind_eta", dedekind), ("modular_lambda", modular_lambda))
    for name, form in forms:
        yield name + "_curve", f"f(z) = diff({name}(z), z)", form, [], half
    yield "hurwitz_zeta_shift_curve", "f(x) = diff(hurwitz_zeta({0}, x), x)", lambda a, s: mp.zeta(s, mp.re(a)), [1.5], [complex(x) for x in (0.1, 0.7, 1.5, 10, 3, 30)] + axis[3:6]
    for n in (2, 5, 12):
        for word, f in (("gegenbauer_c", gegenbauer(n)), ("laguerre_l", laguerre(n))):
            yield f"{word}_curve_{n}", f"f(z) = diff({word}({n}, z, {{0}}), z)", f, [0.375 + 0.25j], some
            yield f"{word}_curve_{n}_real", f"f(x) = diff({word}({n}, x, {{0}}), x)", f, [0.625], line
    on_right = [complex(x, y) for x, y in ((2, 3), (0.5, 14.125), (0.5, 40), (0.25, -30), (3, -0.5), (8, 0), (0.5, 5), (1.5, 0.125), (0.0625, 0.03125), (0.5, -98.75), (12, 2), (0.75, 1))]
    everywhere = on_right + [complex(x, y) for x, y in ((-2.5, 1), (-6.25, -8), (-1.25, 0), (-0.25, 0.5), (-15.5, 2), (-3, 4.5), (-0.5, 20), (1.015625, 0.03125))]
    beta = lambda s: (mp.zeta(s, mp.mpf(1) / 4) - mp.zeta(s, mp.mpf(3) / 4)) / mp.mpf(4) ** s
    zetas = [complex(x) for x in (-11.25, -6.25, -3, -1.5, -0.25, 0.25, 0.5, 0.9375, 1.125, 2, 3, 7, 15)]
    yield "zeta_curve", "f(z) = diff(zeta(z), z)", mp.zeta, [], everywhere
    yield "zeta_curve_real", "f(x) = diff(zeta(x), x)", mp.zeta, [], zetas
    yield "dirichlet_beta_curve", "f(z) = diff(dirichlet_beta(z), z)", beta, [], everywhere
    yield "hurwitz_zeta_curve", "f(z) = diff(hurwitz_zeta(z, {0}), z)", lambda s, a: mp.zeta(s, mp.re(a)), [0.25], on_right
    yield "hurwitz_zeta_curve_large", "f(z) = diff(hurwitz_zeta(z, {0}), z)", lambda s, a: mp.zeta(s, mp.re(a)), [7.5], on_right


def gegenbauer(n):
    return lambda a, z: mp.fsum(mp.rf(a, n - k) * (-1) ** k / (mp.factorial(k) * mp.factorial(n - 2 * k)) * (2 * z) ** (n - 2 * k) for k in range(n // 2 + 1))


def laguerre(n):
    return lambda a, z: mp.fsum((-z) ** k / mp.factorial(k) * mp.rf(a + k + 1, n - k) / mp.factorial(n - k) for k in range(n + 1))


def constant(c, real):
    """As the formula writes it, and exactly."""
    re, im = f32(complex(c).real), f32(complex(c).imag)
    if real or im == 0:
        return mp.nstr(mp.mpf(re), 17), mp.mpf(re)
    return f"complex({mp.nstr(mp.mpf(re), 17)}, {mp.nstr(mp.mpf(im), 17)})", mp.mpc(re, im)


def at_argument(z, real):
    return mp.mpf(z.real) if real else mp.mpc(z.real, z.imag or SIDE)


def row(z, real, f, constants):
    """Value, derivative, and the scales of their errors."""
    at = at_argument(z, real)
    value = lambda x, c=constants: mp.mpmathify(f(x, *c))
    slope = lambda x, c=constants: difference(lambda x: value(x, c), x)
    v, d, curve = value(at), slope(at), difference(slope, at)
    moved = [abs(at) * abs(d), abs(at) * abs(curve)]
    for c, h, near in moved_constants(constants):
        moved[0] += abs(c) * abs(value(at, near) - v) / h
        moved[1] += abs(c) * abs(slope(at, near) - d) / h
    return v, d, [4 * abs(v) + moved[0] / 2, 16 * abs(d) + 2 * moved[1]]


def moved_constants(constants):
    for k, c in enumerate(constants):
        h = STEP * abs(c)
        if h != 0:
            yield c, h, [*constants[:k], c + h, *constants[k + 1 :]]


def curve_row(z, real, f, constants):
    """The first and the second derivative, with scales of four times what those of a value and of its derivative are."""
    at = at_argument(z, real)
    d, curve, third = stencil(lambda x: f(x, *constants), at)
    moved = [abs(at) * abs(curve), abs(at) * abs(third)]
    for c, h, near in moved_constants(constants):
        first, second, _ = stencil(lambda x: f(x, *near), at)
        moved[0] += abs(c) * abs(first - d) / h
        moved[1] += abs(c) * abs(second - curve) / h
    return d, curve, [16 * abs(d) + 2 * moved[0], 64 * abs(curve) + 8 * moved[1]]


def write(fh, name, formula, f, constants, points, row=row):
    real = formula.startswith("f(x)")
    shown = [constant(c, real) for c in constants]
    fh.write(f"# {name} | {formula.format(*(text for text, _ in shown))}\n")
    if real:
        fh.write("# x\tf\tdx\tscale_f\tscale_dx\tnotes\n")
    else:
        fh.write("# z.re\tz.im\tf.re\tf.im\tdz.re\tdz.im\tscale_f\tscale_dz\tnotes\n")
    for z in dict.fromkeys(point(complex(p)) for p in points):
        try:
            value, slope, scales = row(z, real, f, [c for _, c in shown])
        except (ValueError, ZeroDivisionError, mp.libmp.libhyper.NoConvergence):
            continue
        if any(not mp.isfinite(v) or abs(v) > LARGEST or abs(v) < LEAST for v in (value, slope)):
            continue
        cells = [show(z.real)] if real else [show(z.real), show(z.imag)]
        for v in (value, slope):
            cells += [show(mp.re(v))] if real else [show(mp.re(v)), show(mp.im(v))]
        fh.write("\t".join(cells + [three(s) for s in scales] + ["-"]) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    path = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "elliptic.txt")
    rng = random.Random(9)
    with open(path, "w", encoding="utf-8") as fh:
        for section in (*sections(rng), *parameters(random.Random(10)), *lattices(random.Random(11))):
            write(fh, *section)
            print(section[0], flush=True)
        for section in curves(random.Random(12)):
            write(fh, *section, row=curve_row)
            print(section[0], flush=True)


if __name__ == "__main__":
    main()
