#!/usr/bin/env python3
"""Integrands of public test problems beside SymPy and symplex: tests/data/integrals/peers.tsv.

The integrands are those of Rubi's test suite (https://github.com/RuleBasedIntegration/MathematicaSyntaxTestSuite, the
problems out of Apostol's and Stewart's books) and of SymPy's tests (test_manual.py, test_integrals.py) that lie in the
language and are polynomials, rational functions with factors of degree 2 or less, exponentials, trigonometric and error
functions, logarithms, and roots of polynomials of degree 2 or less, with numbers for their parameters. Nothing else of
either is used.

A line `= source | integrand | SymPy | symplex` begins one; each line below is a ray x = x0 + s t: x0, s, a, b, and by
mpmath at 60 digits the integral of f(x0 + s t) from a to b and that of its absolute value. What a peer did is `no`
(nothing found within the time, or an unevaluated integral), `wrong`, or for each ray the error of (F(x1) - F(x0))/s with
every operation rounded to binary32, as a part of the integral of |f|.

    python3 tests/oracle/integrals_peers.py [FILE]

FILE has what symplex found, a line `number<tab>antiderivative` for each integrand in the order of `--list`, printed by a
program of a few lines around `Context::parse` and `Ex::try_integrate`. Needs mpmath, SymPy.
"""

import math
import signal
import struct
import sys
from pathlib import Path

import sympy
from mpmath import mp, mpf

mp.dps = 40
OUT = Path(__file__).resolve().parent.parent / "data" / "integrals" / "peers.tsv"
SECONDS = 10
X = sympy.Symbol("x", real=True)

APOSTOL = """
sqrt(2*x+1); x*sqrt(1+3*x); x^2*sqrt(x+1); x/sqrt(2-3*x) @ 0.1 0.6; (x+1)/(x^2+2*x+2)^3; sin(x)^3; x*(x-1)^(1/3) @ 1.2 2;
1/(x^2+1)^(3/2); x*sin(x); x^2*sin(x); x^3*cos(x); x^3*sin(x); sin(x)*cos(x); x*sin(x)*cos(x); sin(x)^2; sin(x)^4;
sin(x)^5; sin(x)^6; x*sin(x)^2; x*sin(x)^3; x^2*sin(x)^2; cos(x)^2; cos(x)^3; cos(x)^4; (4-x^2)^(5/2);
x^5/sqrt(5+x^2); (2+3*x)*sin(5*x); x*sqrt(1+x^2); x*(x^2-1)^9; (2*x+3)/(6*x+7)^3; x^4*(1+x^5)^5; x^4*(1-x)^20;
1/(2+3*x); x*log(x); 1/(1+x); x^2*log(3*x); exp(x)*sin(x); exp(x)*cos(x); 1/(1+exp(x)); x*exp(x); x*exp(-x); x^2*exp(x);
x^2*exp(-2*x); x^3*exp(-x^2); exp(0.75*x)*cos(2.5*x); 1/sqrt(4-x^2); 1/sqrt(1-2*x-x^2) @ 0.05 0.35; 1/(4+x^2);
1/(2+3*x^2); 1/(x^2-x+2); sqrt(1-x^2) @ -0.5 0.7; x^2/(1+x^2)^2; sqrt((x-1)*(3-x)) @ 1.2 2.7;
1/sqrt((x-1)*(3-x)) @ 1.2 2.7; (5*x+3)/(x^2+2*x-3) @ 2 3; (2*x+5)/(x^2+2*x-3) @ 2 3; (x^3+3*x)/(x^2-2*x-3) @ 4 5;
(2*x^2+5*x-1)/(x^3+x^2-2*x) @ 2 3; (x^2+2*x+3)/((x-1)*(x+1)^2) @ 2 3; (3*x^2+2*x-2)/(x^3-1) @ 2 3;
(2*x+3)/((x-2)*(x+5)) @ 3 4; x/((x+1)*(x+2)*(x+3)); (x^4+2*x-6)/(x^3+x^2-2*x) @ 2 3; (8*x^3+7)/((x+1)*(2*x+1)^3);
x^4/(x^4+5*x^2+4); (x+2)/(x^2+x); 1/(x*(x^2+1)^2); 1/((x+1)*(x+2)^2*(x+3)^3); x/(x+1)^2; x^2/(x^2+x-6) @ 3 4;
(x+2)/(x^2-4*x+4) @ 3 4; 1/(x^2-1)^2 @ 2 3; (1-x^3)/(x*(x^2+1)); x^2/(x^2+2*x+2)^2; sqrt(3-x^2); x/sqrt(3-x^2);
sqrt(x^2+5); x/sqrt(x^2+x+1); 1/sqrt(x^2+x)
"""
STEWART = """
exp(x); sinh(x); cosh(x); x*sinh(x); x*cosh(2.5*x); x*exp(2*x); x*cos(x); x*sin(4*x); x^2*cos(3*x); x^2*sin(2*x);
x^2*log(x); x^3*exp(x); exp(2*x)*sin(3*x); cos(3*x)*exp(-x); sqrt(x)*log(x); sin(3*x)*cos(5*x); sin(2*x)*sin(4*x);
x^3*exp(x^2); (3+2*x)*exp(x); x*5^x; x*cos(3.25*x); sin(3*x)^2; sin(x)^3*cos(x)^4; sin(x)^4*cos(x)^3; sin(x)^4*cos(x)^2;
sin(x)^2*cos(x)^2; (1-sin(2*x))^2; sin(x+0.5)*cos(x); cos(x)^5*sin(x)^5; cos(x)^6; sin(2*x)^2*cos(2*x)^4;
sin(x)^4*cos(x)^4; sin(5*x)*sin(2*x); cos(3*x)*cos(4*x); sin(3*x)*sin(6*x); sin(x)*cos(x)^5; cos(x)*cos(2*x)*cos(3*x);
x/sqrt(4+x^2); x^3/(9+4*x^2)^(3/2); x/sqrt(3-2*x-x^2) @ 0.1 0.8; x^3*sqrt(4-x^2); x*sqrt(4-x^2);
sqrt(1-4*x^2) @ -0.3 0.4; x^3/sqrt(x^2+4); 1/sqrt(9+x^2); sqrt(x^2+1); x^2/sqrt(5-x^2); x/(x^2+4)^(5/2); x^2*sqrt(9-x^2);
sqrt(2*x-x^2); 1/sqrt(x^2+4*x+8); 1/sqrt(9*x^2+6*x-8) @ 1 2; x^2/sqrt(4*x-x^2); 1/(2+2*x+x^2)^2;
1/(5-4*x-x^2)^(5/2) @ -1 0.5; (5+x)/(x^2+x-2) @ 2 3; (x+x^3)/(x-1) @ 2 3; (2-3*x+4*x^2)/(3-4*x+4*x^2);
1/((x-1)*(2+x)) @ 2 3; 7/(2*x^2+5*x-12) @ 2 3; x/(x-5); x^2/(1+x); (6*x-5)/(3+2*x); (1+x^2)/(x^2-x) @ 2 3;
(3+2*x)/(1+x)^2; x/(4+4*x+x^2); x^2/(1+x)^3; x^3/(1+x^2); (x-1)/(2+2*x+x^2); x/(1+x+x^2);
(7+5*x+4*x^2)/(5+4*x+4*x^2); (x-3)/(4+2*x+x^2)^2; 1/(x^2+2*x-3) @ 2 3; 1/(x^2-2*x) @ 3 4;
(2*x+1)/(4*x^2+12*x-7) @ 1 2; x/(x^2+x-1) @ 1 2; x^4/(9+x^2)^3
"""
SYMPY = """
x^2; 3*x^2+4*x^3; (3*x+4)^2; exp(2*x); 2^x; 1/(2*x+3); (3*x^2+5)*exp(x); 1/(4+9*x^2); 1/(16+16*x^2);
1/(1+4*x^2); 1/sqrt(1-x^2) @ -0.5 0.7; 3/sqrt(1-9*x^2) @ -0.2 0.25; 1/sqrt(4*x^2+1); 1/sqrt(x^2-1) @ 1.5 2.5;
1/sqrt(9*x^2-1) @ 1.5 2.5; 1/(4-x^2); (x-3)/(x^2-2*x+2)^2; sqrt(2*x+3)/2*x; x^(3/2)*log(x); sin(2*x)*exp(x);
cos(x)*sin(2*x); (3*x^3-x^2+2*x-4)/sqrt(x^2-3*x+2) @ 3 4; exp(-x^2); x*exp(-x^2); erf(x); exp(-(x-2)^2/2);
(5*x+2)/(3*x^2-2*x+8); sqrt(4+2*x+3*x^2); (1+2*x)/sqrt(4+2*x+3*x^2); atan(x); x^2*exp(-0.5*x^2); asinh(x); tanh(x)
"""


def problems():
    for source, text in (("Apostol", APOSTOL), ("Stewart", STEWART), ("SymPy", SYMPY)):
        for item in text.replace("\n", " ").split(";"):
            integrand, _, ends = item.partition("@")
            lo, hi = [float(e) for e in ends.split()] if ends else (0.3, 1.3)
            yield source, integrand.strip(), lo, hi


def single(x):
    return struct.unpack("<f", struct.pack("<f", x))[0]


def rays(lo, hi):
    """x0, s, a, b: along x, and where x changes a thousandth and a millionth as fast."""
    middle = (lo + hi) / 2
    out = [(lo, 1.0, 0.0, hi - lo), (middle, 1e-3, 0.0, 2.0), (middle, 1e-6, -1.0, 1.0)]
    return [tuple(single(v) for v in ray) for ray in out]


def expression(text):
    return sympy.sympify(text.replace("^", "**"), locals={"x": X}, rational=True)


def exact(f, x0, s, a, b):
    value, size = mpf(0), mpf(0)
    for k in range(4):
        lo, hi = a + (b - a) * mpf(k) / 4, a + (b - a) * mpf(k + 1) / 4
        value += mp.quad(lambda t: f(x0 + s * t), [lo, hi])
        size += mp.quad(lambda t: abs(f(x0 + s * t)), [lo, hi])
    return value, size


class Rounded(Exception):
    """What binary32 cannot evaluate."""


def in_single(expr, x):
    """The value of an expression, every operation rounded to binary32; complex where the expression is."""
    memo = {}

    def rounded(v):
        if isinstance(v, complex):
            return complex(single(v.real), single(v.imag)) if v.imag else single(v.real)
        return single(v)

    def value(e):
        if e not in memo:
            memo[e] = rounded(operation(e))
        return memo[e]

    def operation(e):
        if e == X:
            return x
        if e.is_number and not e.has(X):
            number = complex(sympy.N(e, 20))
            return number if number.imag else number.real
        if e.is_Add or e.is_Mul:
            total = value(e.args[0])
            for arg in e.args[1:]:
                total = rounded(total + value(arg) if e.is_Add else total * value(arg))
            return total
        if isinstance(e, sympy.Piecewise):
            for piece, condition in e.args:
                if condition.subs(X, x) == True:  # noqa: E712
                    return value(piece)
            raise Rounded
        args = [value(a) for a in e.args]
        if e.is_Pow:
            if isinstance(args[0], complex) or args[0] < 0 and args[1] != int(args[1].real):
                return complex(args[0]) ** args[1]
            return args[0] ** args[1]
        out = complex(sympy.N(e.func(*[sympy.sympify(a) for a in args]), 17))
        return out if out.imag else out.real

    return value(expr)


def judged(found, rays, truths):
    """What a peer's antiderivative is worth."""
    if found is None or found.has(sympy.Integral, sympy.nan, sympy.zoo, sympy.oo):
        return "no"
    errors = []
    number = sympy.lambdify(X, found, "mpmath")
    for (x0, s, a, b), (value, size) in zip(rays, truths):
        ends = [mpf(x0) + mpf(s) * mpf(t) for t in (a, b)]
        try:
            high, low = [number(e) for e in ends[::-1]]
            difference = complex((high - low) / mpf(s))
        except (TypeError, ValueError, ZeroDivisionError, NameError, AttributeError):
            return "no"
        if not abs(difference - float(value)) <= 1e-9 * float(size):
            return "wrong"
        try:
            at = [in_single(found, single(x0 + s * t)) for t in (a, b)]
            difference = (at[1] - at[0]) / s
            off = abs(difference - float(value)) / float(size)
        except (ZeroDivisionError, OverflowError, ValueError, TypeError, AttributeError, Rounded):
            off = math.inf
        errors.append(off if off == off else math.inf)
    return " ".join(f"{e:.1e}" for e in errors)


def by_sympy(f):
    def late(*_):
        raise TimeoutError

    signal.signal(signal.SIGALRM, late)
    signal.alarm(SECONDS)
    try:
        return sympy.integrate(f, X)
    except Exception:
        return None
    finally:
        signal.alarm(0)


def by_symplex(path):
    out = {}
    for line in Path(path).read_text().splitlines():
        number, _, text = line.partition("\t")
        known = text and text[0] not in "!?" and "Integral" not in text
        try:
            locals_ = {"x": X, "ln": sympy.log, "asinh": sympy.asinh, "e": sympy.E}
            out[int(number)] = sympy.sympify(text.replace("^", "**"), locals=locals_) if known else None
        except (sympy.SympifyError, SyntaxError, TypeError):
            print(f"not read: {text}", file=sys.stderr)
            out[int(number)] = None
    return out


def main():
    if sys.argv[1:] == ["--list"]:
        for _, text, _, _ in problems():
            print(text)
        return
    symplex = by_symplex(sys.argv[1]) if sys.argv[1:] else {}
    lines = ["# by tests/oracle/integrals_peers.py"]
    for k, (source, text, lo, hi) in enumerate(problems()):
        f = expression(text)
        number = sympy.lambdify(X, f, "mpmath")
        theirs = rays(lo, hi)
        truths = [exact(number, *[mpf(v) for v in ray]) for ray in theirs]
        verdicts = [judged(by_sympy(f), theirs, truths), judged(symplex.get(k), theirs, truths) if symplex else "–"]
        lines.append(f"= {source} | {text} | {verdicts[0]} | {verdicts[1]}")
        for ray, (value, size) in zip(theirs, truths):
            lines.append(" ".join([*[repr(v) for v in ray], mp.nstr(value, 20), mp.nstr(size, 8)]))
        print(lines[-len(theirs) - 1], flush=True)
    OUT.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
