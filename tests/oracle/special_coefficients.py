#!/usr/bin/env python3
"""Print the coefficients of compiler/src/check/library/special/*.pull, or check that the files have them.

usage: special_coefficients.py [--check]      (needs mpmath)
"""
import os
import sys

import mpmath as mp

mp.mp.dps = 40
LIBRARY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "compiler", "src", "check", "library", "special")


def tables():
    """File, what it is, coefficients."""
    bernoulli = lambda j: mp.bernoulli(2 * j)
    yield "zeta.pull", "B(2j)/(2j)!", [bernoulli(j) / mp.factorial(2 * j) for j in range(1, 18)]
    yield "dilogarithm.pull", "B(2j)/(2j + 1)!", [bernoulli(j) / mp.factorial(2 * j + 1) for j in range(1, 13)]
    yield "gamma.pull", "(-1)^k (ζ(k) - 1)/k", [(-1) ** k * (mp.zeta(k) - 1) / k for k in range(2, 37)]
    yield "gamma.pull", "1 - γ", [1 - mp.euler]
    # of x^(2j) in 2 csc² x + x (csc² x)′ - 2/3 - (4/15) sin² x, from csc² x = Σ (2k - 1) 2^(2k) |B(2k)|/(2k)! x^(2k - 2)
    cosecant = lambda k: mp.mpf(4) ** k * abs(mp.bernoulli(2 * k)) / mp.factorial(2 * k - 2)
    yield "lattice.pull", "series of R", [cosecant(j + 1) + mp.mpf(-1) ** j * 2 * mp.mpf(4) ** j / (15 * mp.factorial(2 * j)) for j in range(2, 21)]
    yield "airy.pull", "Ai(0), -Ai′(0), Bi(0), Bi′(0)", [mp.airyai(0), -mp.airyai(0, derivative=1), mp.airybi(0), mp.airybi(0, derivative=1)]


def main():
    missing = 0
    for name, what, values in tables():
        shown = [mp.nstr(abs(v), 18) for v in values]
        if "--check" not in sys.argv:
            print(f"{name}: {what}", *shown, sep="\n  ")
            continue
        with open(os.path.join(LIBRARY, name), encoding="utf-8") as fh:
            text = fh.read()
        for value in shown:
            if value not in text:
                print(f"{name}: {what}: {value} is missing")
                missing += 1
    sys.exit(missing > 0)


if __name__ == "__main__":
    main()
