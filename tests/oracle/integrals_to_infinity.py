#!/usr/bin/env python3
"""Integrals to infinity by mpmath at 60 digits: tests/data/integrals/to_infinity.tsv.

A line `= lower upper integrand` begins a case, written in the language by t, x and y; each line below it has x and y
(numbers that binary32 holds), the integral, and that of |f|, from the lesser end to the greater. mpmath.quad of the
integrand itself, cut in powers of 4 around the marks.

    python3 tests/oracle/integrals_to_infinity.py
"""

from multiprocessing import Pool
from pathlib import Path

import mpmath
from mpmath import inf, mp, mpf

mp.dps = 60
OUT = Path(__file__).resolve().parent.parent / "data" / "integrals" / "to_infinity.tsv"

POINTS = [(0.5, 1.5), (-0.75, 0.25), (0.0, 4.0), (-2.5, 2.0), (0.015625, 1.0)]

# lower end, upper end, integrand, marks around which it is cut
CASES = [
    ("x", "inf", "exp(-y*t)", "x"),
    ("-inf", "x", "exp(y*t)", "x"),
    ("x", "inf", "t^3*exp(-y*t)", "x 0"),
    ("x", "inf", "exp(-y*t)*sin(3*t + 1)", "x"),
    ("x", "inf", "t^2*exp(-y*t)*cos(2*t)", "x 0"),
    ("x", "inf", "exp(-2*t)*sin(t)*cos(3*t)", "x"),
    ("x", "inf", "exp(-3*t)*sinh(t)", "x 0"),
    ("x", "inf", "(1 + exp(-y*t))^2*exp(-t)", "x 0"),
    ("-inf", "inf", "exp(-y*abs(t - x))", "x"),
    ("-inf", "inf", "cos(t)*exp(-y*abs(t - x))", "x"),
    ("x", "inf", "exp(-y*t^2)", "x 0"),
    ("x", "inf", "exp(-(t - 2)^2/y)", "x 2"),
    ("-inf", "x", "exp(-(t + 1)^2*y)", "x -1"),
    ("-inf", "inf", "exp(-(t - x)^2*y)", "x"),
    ("-inf", "inf", "exp(-y*t^2 + x*t)", "x 0"),
    ("x", "inf", "t*exp(-y*t^2)", "x 0"),
    ("x", "inf", "(1 + t^2)*exp(-y*t^2)", "x 0"),
    ("-inf", "inf", "t^4*exp(-y*(t - x)^2)", "x"),
    ("x", "inf", "(t - 1)^5*exp(-(t - 2)^2)", "x 2"),
    ("x", "inf", "exp(-t^2)*cos(3*t + y)", "x 0"),
    ("-inf", "inf", "exp(-y*(t - x)^2)*sin(2*t)", "x"),
    ("-inf", "x", "exp(-t^2 + t)*cos(y*t)^2", "x 0"),
    ("x", "inf", "erfc(y*t)", "x 0"),
    ("x", "inf", "1/(1 + t^2)", "x 0"),
    ("-inf", "x", "1/(y^2 + (t - 1)^2)", "x 1"),
    ("-inf", "inf", "1/(y + (t - x)^2)", "x"),
    ("x", "inf", "1/(y + t^2)^(3/2)", "x 0"),
    ("-inf", "inf", "1/(y + (t - x)^2)^(3/2)", "x"),
    ("x", "inf", "1/(y + t^2)^2", "x 0"),
    ("-inf", "x", "1/(y + (t - 1)^2)^(5/2)", "x 1"),
    ("x", "inf", "t/(y + t^2)^2", "x 0"),
    ("x", "inf", "(t - 2)^2/(1 + (t - 1)^2)^3", "x 1"),
    ("-inf", "inf", "t^4/(y + t^2)^4", "0"),
    ("x", "inf", "1/(4 + t)^2", "x"),
    ("x", "inf", "1/(4 + t)^(3/2)", "x"),
    ("x", "inf", "t/(4 + t)^(7/2)", "x 0"),
    ("x", "inf", "1/(4 + t)^(2 + y)", "x"),
    ("-inf", "x", "1/(4 - t)^3", "x"),
    ("x", "inf", "1/cosh(y*t)", "x 0"),
    ("-inf", "inf", "1/cosh(t - x)^2", "x"),
    ("x", "inf", "1/cosh(y*t)^2", "x 0"),
    ("x", "inf", "1/(1 + exp(y*t))", "x 0"),
    ("-inf", "x", "1/(2 + 3*exp(-t))", "x 0"),
    ("x", "inf", "max(0, 1 - t) + exp(-y*t)", "x 1"),
    ("x", "inf", "clamp(t, -1, y)*exp(-t)", "x -1 y"),
    ("-inf", "inf", "exp(-abs(t - x))*step(y, t)", "x y"),
    ("-inf", "inf", "abs(t - y)*exp(-t^2)", "y 0"),
    ("x", "inf", "sum(k in 1..4, exp(-k*t)/k)", "x"),
    ("inf", "x", "exp(-t^2)", "x 0"),
    ("x", "-inf", "1/(1 + t^2)", "x 0"),
]


def names(x, y):
    functions = {n: getattr(mp, n) for n in "exp sin cos sinh cosh erfc".split()}
    functions.update(
        abs=abs,
        min=min,
        max=max,
        clamp=lambda v, lo, hi: min(max(v, lo), hi) if lo <= hi else hi,
        step=lambda e, v: mpf(0) if v < e else mpf(1),
        x=mpf(x),
        y=mpf(y),
        inf=inf,
        total=lambda f: sum(f(k) for k in range(1, 5)),
    )
    return functions


def integral(case, point):
    lower, upper, text, marks = case
    known = names(*point)
    text = text.replace("^", "**").replace("sum(k in 1..4,", "total(lambda k:")
    for number in ("3/2", "5/2", "7/2"):
        text = text.replace(f"({number})", f"mpf({number[0]})/2")
    text = text.replace("**mpf(3)/2", "**(mpf(3)/2)").replace("**mpf(5)/2", "**(mpf(5)/2)")
    text = text.replace("**mpf(7)/2", "**(mpf(7)/2)")
    known["mpf"] = mpf
    f = eval("lambda t: " + text, known)
    a, b = (eval(end, known) for end in (lower, upper))
    low, high = min(a, b), max(a, b)
    places = set()
    for mark in marks.split():
        m = eval(mark, known)
        places.add(m)
        for k in range(-3, 5):
            places.update((m - mpf(4) ** k, m + mpf(4) ** k))
    cuts = [low] + sorted(p for p in places if low < p < high) + [high]
    value = mp.quad(f, cuts)
    with mp.workdps(20):
        size = mp.quad(lambda t: abs(f(t)), cuts)
    return (value if a <= b else -value), size


def lines(case):
    out = ["= " + "\t".join(case[:3])]
    for point in POINTS:
        value, size = integral(case, point)
        out.append(f"{point[0]!r} {point[1]!r} {mp.nstr(value, 20)} {mp.nstr(size, 6)}")
    return out


def main():
    with Pool() as pool:
        parts = pool.map(lines, CASES, chunksize=1)
    with open(OUT, "w", encoding="utf-8") as out:
        print("# by tests/oracle/integrals_to_infinity.py", file=out)
        for part in parts:
            print("\n".join(part), file=out)


if __name__ == "__main__":
    main()
