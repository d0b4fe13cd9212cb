#!/usr/bin/env python3
"""Print the polynomials at the ends of pair.wgsl and double.wgsl, and the constants of both.

usage: polynomials.py [NAME...]

Minimax fits as in ../math/coefficients.py, whose exchange algorithm is used. For pairs the coefficients that matter
beyond f32 are given as two words, those of the tail as one. Needs: mpmath.
"""
import os
import struct
import sys

from mpmath import *

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "math"))
from coefficients import f32, grid, horner, remez, shortest  # noqa: E402

mp.dps = 60


def f64(v):
    return mpf(float(v))


def words(v, n):
    """v as the sum of n binary32 numbers."""
    out = []
    for _ in range(n):
        out.append(f32(v))
        v -= out[-1]
    return out


def fit(g, w, a, b, goal):
    a, b = mpf(a), mpf(b)
    points = [x for x in grid(a, b, 300) if abs(x) > mpf(10) ** -12]
    for degree in range(1, 24):
        c, best = remez(g, w, a, b, degree, points)
        if best < goal:
            return c, best, points


Q = (pi / 4) ** 2 * mpf("1.001")
H = log(2) / 2 * mpf("1.002")
Z = ((sqrt(2) - 1) / (sqrt(2) + 1)) ** 2 * mpf("1.001")
A = mpf(1) / 15.9**2


def series(f, n, count):
    """The Taylor series of f from term n on, divided by z^n, as a function."""
    c = [f(k) for k in range(n, n + count)]
    return lambda z: horner(c, z)


exp_g = series(lambda k: 1 / factorial(k), 2, 40)
sin_g = series(lambda k: (-1) ** k / factorial(2 * k + 1), 1, 25)
cos_g = series(lambda k: (-1) ** k / factorial(2 * k), 2, 25)
log_g = series(lambda k: mpf(2) / (2 * k + 1), 2, 60)
atan_g = series(lambda k: mpf(-1) ** k / (2 * k + 1), 1, 60)

# name: (g, weight, a, b, what, words of two in the pair)
ROWS = {
    "exp_tail": (exp_g, lambda r: r**2 / expm1(r), -H, H, "(e^r - 1 - r) / r²", 6),
    "log_rest": (log_g, lambda z: z**2 / 2, 0, Z, "(log((1 + s)/(1 - s)) - 2 s - 2 s³/3) / s⁵, z = s²", 2),
    "sin_tail": (sin_g, lambda z: z, 0, Q, "(sin r - r) / r³, z = r²", 4),
    "cos_tail": (cos_g, lambda z: z**2, 0, Q, "(cos r - 1 + r²/2) / r⁴, z = r²", 3),
    "atan_tail": (atan_g, lambda z: z, 0, A, "(arctan t - t) / t³, z = t²", 2),
}
CONSTANTS = {
    "pi": pi, "pi/2": pi / 2, "log 2": log(2), "1/log 2": 1 / log(2), "1/log 10": 1 / log(10), "2/3": mpf(2) / 3,
    "1/3": mpf(1) / 3, "log 2 - 16 bits": log(2) - mpf("0.693145751953125"),
    "log10 2 - short": log10(2) - mpf("0.30102539"[:10]),
}


def double_text(v):
    text = repr(float(v))
    return text if "." in text or "e" in text else text + ".0"


def main():
    for name in sys.argv[1:] or ROWS:
        g, w, a, b, what, long = ROWS[name]
        variable = "r" if name == "exp_tail" else "z"
        c, best, points = fit(g, w, a, b, mpf(2) ** -49.5)
        fixed = [sum(words(v, 2)) if i < long else f32(v) for i, v in enumerate(c)]
        after = max(abs(w(x) * (g(x) - horner(fixed, x))) for x in points)
        print(f"// pair {name}: degree {len(c) - 1}, error 2^{nstr(log(best, 2), 3)}, rounded 2^{nstr(log(after, 2), 3)}")
        tail = shortest(fixed[-1])
        for v in reversed(fixed[long:-1]):
            tail = f"{shortest(v)} + {variable}.x * " + (f"({tail})" if "*" in tail else tail)
        print(f"    var p = pair_step0({tail}, {variable}, …)")
        for v in reversed(c[:long]):
            print(f"    pair_step(p, {variable}, {', '.join(shortest(x) for x in words(v, 2))}, zero)")
        c, best, points = fit(g, w, a, b, mpf(2) ** -56)
        fixed = [f64(v) for v in c]
        after = max(abs(w(x) * (g(x) - horner(fixed, x))) for x in points)
        print(f"// double {name}: degree {len(c) - 1}, error 2^{nstr(log(best, 2), 3)}, rounded 2^{nstr(log(after, 2), 3)}")
        text = double_text(fixed[-1]) + "lf"
        for v in reversed(fixed[:-1]):
            text = f"{double_text(v)}lf + {variable} * " + (f"({text})" if "*" in text else text)
        print("    return " + text)
        sys.stdout.flush()
    for name, v in CONSTANTS.items():
        print(name, "lit(" + ", ".join(shortest(x) for x in words(v, 3)) + ")")
    print("trigonometry.wgsl: words of pi/2", ", ".join(shortest(x) for x in words(pi / 2, 6)))
    for k in range(1, 9):
        print(f"arctan({k}/8) lit(" + ", ".join(shortest(x) for x in words(atan(mpf(k) / 8), 3)) + ")")
    with workprec(1400):
        turns = 2 / pi
        for i in range(40):
            print(f"2/pi, word {i}: 0x{int(floor(turns * 2 ** (32 * (i + 1)))) % 2**32:08x}u")


if __name__ == "__main__":
    main()
