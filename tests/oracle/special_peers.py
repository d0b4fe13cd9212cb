#!/usr/bin/env python3
"""Compare special functions at the same 400 points with SciPy and mpmath: a table in Markdown.

usage: special_peers.py PULLBACK      (the program; needs mpmath, scipy)

The points are float32, 400 for each function in the square |re z|, |im z| < 3 (or where the table says). The reference is mpmath with 40
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
    return [complex(f32(rng.uniform(box[0], box[1])), f32(rng.uniform(box[2], box[3]))) for _ in range(COUNT)]


SQUARE = (-3, 3, -3, 3)
UPPER = (-0.5, 0.5, 0.2, 1.5)
DISC = (-0.6, 0.6, -0.6, 0.6)


def klein(t):
    l = (mp.jtheta(2, 0, mp.exp(1j * mp.pi * t)) / mp.jtheta(3, 0, mp.exp(1j * mp.pi * t))) ** 4
    return 4 * (1 - l + l * l) ** 3 / (27 * (l * (1 - l)) ** 2)


def weierstrass(z):
    """g₂ = 4, g₃ = 0"""
    return 1 / mp.ellipfun("sn", mp.sqrt(2) * z, m=mp.mpf(1) / 2) ** 2 * 2 - 1


# formula, mpmath's function, SciPy's (None where it has none for complex numbers), box
FUNCTIONS = [
    ("gamma(z)", mp.gamma, sp.gamma, SQUARE),
    ("loggamma(z)", mp.loggamma, sp.loggamma, SQUARE),
    ("digamma(z)", mp.digamma, sp.digamma, SQUARE),
    ("erf(z)", mp.erf, sp.erf, SQUARE),
    ("faddeeva(z)", lambda z: mp.exp(-z * z) * mp.erfc(-1j * z), sp.wofz, SQUARE),
    ("lambertw(z, 0)", mp.lambertw, sp.lambertw, SQUARE),
    ("zeta(z)", mp.zeta, sp.zeta, (-3, 3, -30, 30)),
    ("dirichlet_eta(z)", mp.altzeta, None, SQUARE),
    ("hurwitz_zeta(z, 0.25)", lambda s: mp.zeta(s, mp.mpf(1) / 4), None, (0, 6, -20, 20)),
    ("airy_ai(z)", mp.airyai, lambda z: sp.airy(z)[0], SQUARE),
    ("airy_bi(z)", mp.airybi, lambda z: sp.airy(z)[2], SQUARE),
    ("dilog(z)", lambda z: mp.polylog(2, z), lambda z: sp.spence(1 - z), SQUARE),
    ("elliptic_k(z)", mp.ellipk, None, SQUARE),
    ("elliptic_e(z)", mp.ellipe, None, SQUARE),
    ("jacobi_sn(z, 0.5)", lambda z: mp.ellipfun("sn", z, m=mp.mpf(1) / 2), None, SQUARE),
    ("jacobi_theta3(z, 0.3)", lambda z: mp.jtheta(3, z, mp.mpf(f32(0.3))), None, SQUARE),
    ("jacobi_theta3(0.25, z)", lambda q: mp.jtheta(3, mp.mpf(1) / 4, q), None, DISC),
    ("weierstrass_p_invariants(z, 4, 0)", weierstrass, None, SQUARE),
    ("klein_j(z)", klein, None, UPPER),
    ("hypergeometric(0.5, 0.5, 1, z)", lambda z: mp.hyp2f1(0.5, 0.5, 1, z), lambda z: sp.hyp2f1(0.5, 0.5, 1, z), DISC),
]


def pullback(program, formula, zs, precision):
    rows = "".join(f"{z.real!r} {z.imag!r}\n" for z in zs)
    command = [program, "eval", f"f(z: complex) = {formula.replace('0.3)', f'{f32(0.3)!r})')}", "--precision", precision, "--points", "-"]
    done = subprocess.run(command, input=rows, capture_output=True, text=True, check=True)
    return [complex(*map(float, line.split())) for line in done.stdout.split("\n") if line]


def judge(values, exact):
    errors = [float(abs(mp.mpc(v) - e) / abs(e)) if mp.isfinite(mp.mpc(v)) else float("inf") for v, e in zip(values, exact)]
    return f"{max(errors):.1e} / {statistics.median(errors):.1e}"


def timed(f):
    start = time.perf_counter()
    result = f()
    return result, (time.perf_counter() - start) / COUNT * 1e6


def main():
    program = sys.argv[1]
    print("| function | box | `accurate` | `double` | SciPy | mpmath, 15 digits | SciPy, µs | mpmath, µs |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    for formula, exact, peer, box in FUNCTIONS:
        zs = points(box)
        with mp.workdps(40):
            truth = [mp.mpmathify(exact(mp.mpc(z))) for z in zs]
        cells = [judge(pullback(program, formula, zs, tier), truth) for tier in ("accurate", "double")]
        low, cost = timed(lambda: [complex(exact(mp.mpc(z))) for z in zs])
        if peer is None:
            cells += ["none", judge(low, truth), ""]
        else:
            try:
                found, quick = timed(lambda: peer(np.array(zs)))
                cells += [judge([complex(v) for v in found], truth), judge(low, truth), f"{quick:.2f}"]
            except TypeError:
                cells += ["none", judge(low, truth), ""]
        shown = "{:g} … {:g}, {:g} … {:g}".format(*box)
        print(f"| `{formula}` | {shown} | " + " | ".join(cells) + f" | {cost:.0f} |", flush=True)


if __name__ == "__main__":
    main()
