#!/usr/bin/env python3
"""Derivatives of integrals by both ends by mpmath at 40 digits: tests/data/integrals/slopes.tsv.

A line `= integrand` begins a case, written in the language by u = x + t (y - x), with t from 0 to 1; each line below it has x
and y, the integral, and its derivatives by x and by y: ∫ (1 - t) f'(u) dt and ∫ t f'(u) dt. In the first points x is y, or
almost: the integrand does not change along the way.

    python3 tests/oracle/integrals_slopes.py
"""

from multiprocessing import Pool
from pathlib import Path

import mpmath
from mpmath import mp, mpf

mp.dps = 40
OUT = Path(__file__).resolve().parent.parent / "data" / "integrals" / "slopes.tsv"

POINTS = [
    (0.5, 0.5),
    (0.5, 0.5 + 2.0**-24),
    (0.5 + 2.0**-24, 0.5),
    (1.25, 1.25),
    (0.5, 0.625),
    (1.75, 0.25),
    (0.25, 3.0),
]
# where the integrand is smooth at 0 and on the left of it
ROUND = [(0.0, 0.0), (-0.5, -0.5), (0.0, 0.75), (0.75, 0.0), (-0.5, 0.5), (-0.75, 1.5), (-2.0, -0.25)]

CASES = [
    ("exp(-u)", ROUND),
    ("exp(3*u)", ROUND),
    ("exp(-u)*sin(2*u + 1)", ROUND),
    ("exp(-u)*cos(3*t + u)", ROUND),
    ("u^3*exp(-u)", ROUND),
    ("sin(2*u)", ROUND),
    ("sin(u)*cos(2*u)", ROUND),
    ("u^2*cos(u)", ROUND),
    ("1/u", []),
    ("u^(1/3)", []),
    ("u^(-3/2)", []),
    ("log(u)", []),
    ("1/cosh(u)", ROUND),
    ("1/cosh(u)^2", ROUND),
    ("tanh(u)", ROUND),
    ("atan(u)", ROUND),
    ("asinh(u)", ROUND),
    ("erf(u)", ROUND),
    ("erfc(u)", ROUND),
    ("1/(1 + exp(-u))", ROUND),
    ("1/(1 + exp(u))", ROUND),
    ("exp(-u^2)", ROUND),
    ("u*exp(-u^2)", ROUND),
    ("(1 + u^3)*exp(-u^2)", ROUND),
    ("exp(-u^2)*sin(u)", ROUND),
    ("1/(1 + u^2)", ROUND),
    ("1/(1 + u^2)^2", ROUND),
    ("1/(1 + u^2)^3", ROUND),
    ("u/(1 + u^2)", ROUND),
    ("sqrt(1 + u^2)", ROUND),
    ("1/sqrt(1 + u^2)", ROUND),
    ("(1 + u^2)^(-3/2)", ROUND),
    ("(1 + u^2)^(-5/2)", ROUND),
    ("(1 + u^2)^(3/2)", ROUND),
    ("log(1 + u^2)", ROUND),
    ("1/((u + 1)*(u + 2))", []),
    ("1/((1 + u^2)*(3 + u^2))", ROUND),
    ("max(0, u)", []),
    ("abs(u)*exp(-abs(u))", []),
]


def rows(case):
    text, more = case
    code = text.replace("^", "**").replace("1/3", "mpf(1)/3")
    names = {n: getattr(mpmath, n) for n in "exp sin cos log cosh tanh atan asinh erf erfc sqrt mpf".split()}
    names |= {"abs": abs, "max": max}
    f = eval("lambda u, t: " + code, names)
    out = ["= " + text]
    for x, y in POINTS + more:
        x, y = mpf(x), mpf(y)
        way = lambda t: x + t * (y - x)
        slope = lambda t: mpmath.diff(lambda u: f(u, t), way(t))
        marks = [0, mpf(1) / 4, mpf(1) / 2, mpf(3) / 4, 1]
        numbers = [
            mpmath.quad(lambda t: f(way(t), t), marks),
            mpmath.quad(lambda t: (1 - t) * slope(t), marks),
            mpmath.quad(lambda t: t * slope(t), marks),
        ]
        out.append(" ".join([repr(float(x)), repr(float(y))] + [mpmath.nstr(n, 20) for n in numbers]))
    return out


if __name__ == "__main__":
    with Pool(2) as pool:
        found = pool.map(rows, CASES)
    head = "# tests/oracle/integrals_slopes.py\n"
    OUT.write_text(head + "\n".join(line for case in found for line in case) + "\n")
