#!/usr/bin/env python3
"""Write tests/data/functions/second_formulas.txt: random formulas with their Hessians, and f″ of complex ones.

usage: second_formulas.py [OUT_DIR]      (needs mpmath; default OUT_DIR: ../data/functions beside this file)

Each formula is a random tree, written both as text of the language and as a truncated power series of second order
(Griewank and Walther, Evaluating Derivatives, chapter 13) in 60 digits with the second derivatives of the elementary
functions below. The series is checked against symmetric differences with 200 digits. README.md beside this file has the
format.
"""
import os
import random
import struct
import sys

import mpmath as mp

mp.mp.dps = 60
REAL_FORMULAS, COMPLEX_FORMULAS, POINTS = 60, 24, 6


def f32(v):
    return struct.unpack("f", struct.pack("f", v))[0]


class Series:
    """A value with first and second partial derivatives; `scale` has the same with every term as its modulus."""

    def __init__(self, v, d, h, scale=None):
        self.v, self.d, self.h = v, d, h
        self.scale = scale or (abs(v), [abs(t) for t in d], [[abs(t) for t in row] for row in h])

    @staticmethod
    def variable(v, k, n):
        zero = mp.mpf(0)
        return Series(mp.mpmathify(v), [mp.mpf(i == k) for i in range(n)], [[zero] * n for _ in range(n)])

    def constant(self, v):
        n, zero = len(self.d), mp.mpf(0)
        return Series(mp.mpmathify(v), [zero] * n, [[zero] * n for _ in range(n)])

    def lift(self, o):
        return o if isinstance(o, Series) else self.constant(o)

    def outer(self, o, v, da, db, daa, dab, dbb):
        """A function of two series with these partial derivatives."""
        n = range(len(self.d))
        def combine(a, b, s, absolute):
            size = abs if absolute else (lambda t: t)
            p, q, pp, pq, qq = (size(t) for t in (da, db, daa, dab, dbb))
            d = [p * a[0][i] + q * b[0][i] for i in n]
            h = [[p * a[1][i][k] + q * b[1][i][k] + pp * a[0][i] * a[0][k] + pq * (a[0][i] * b[0][k] + b[0][i] * a[0][k]) + qq * b[0][i] * b[0][k] for k in n] for i in n]
            return d, h
        d, h = combine((self.d, self.h), (o.d, o.h), v, False)
        sd, sh = combine(self.scale[1:], o.scale[1:], v, True)
        # what the errors of the operands do to the value, and through the next order to the slopes
        ea, eb = self.scale[0], o.scale[0]
        move = [abs(daa) * ea + abs(dab) * eb, abs(dab) * ea + abs(dbb) * eb]
        sd = [t + move[0] * abs(self.d[i]) + move[1] * abs(o.d[i]) for i, t in enumerate(sd)]
        bend = max(move) * max([1, *map(abs, self.d), *map(abs, o.d)]) ** 2
        sh = [[t + bend for t in row] for row in sh]
        return Series(v, d, h, (abs(v) + abs(da) * ea + abs(db) * eb, sd, sh))

    def __add__(self, o):
        o = self.lift(o)
        return self.outer(o, self.v + o.v, mp.mpf(1), mp.mpf(1), mp.mpf(0), mp.mpf(0), mp.mpf(0))

    def __sub__(self, o):
        o = self.lift(o)
        return self.outer(o, self.v - o.v, mp.mpf(1), mp.mpf(-1), mp.mpf(0), mp.mpf(0), mp.mpf(0))

    def __mul__(self, o):
        o = self.lift(o)
        return self.outer(o, self.v * o.v, o.v, self.v, mp.mpf(0), mp.mpf(1), mp.mpf(0))

    def __truediv__(self, o):
        o = self.lift(o)
        r = 1 / o.v
        return self.outer(o, self.v * r, r, -self.v * r**2, mp.mpf(0), -(r**2), 2 * self.v * r**3)

    def apply(self, f):
        value, slope, bend = f
        return self.outer(self.constant(0), value(self.v), slope(self.v), mp.mpf(0), bend(self.v), mp.mpf(0), mp.mpf(0))


sec2 = lambda x: mp.sech(x) ** 2
root = mp.sqrt
# name: value, first and second derivative, where it is taken, whether complex numbers, too
ELEMENTARY = {
    "sin": (mp.sin, mp.cos, lambda x: -mp.sin(x), None, True),
    "cos": (mp.cos, lambda x: -mp.sin(x), lambda x: -mp.cos(x), None, True),
    "exp": (mp.exp, mp.exp, mp.exp, lambda x: abs(x) < 4, True),
    "log": (mp.log, lambda x: 1 / x, lambda x: -1 / x**2, lambda x: mp.re(x) > 0.05 and abs(x) > 0.2, True),
    "sqrt": (root, lambda x: 1 / (2 * root(x)), lambda x: -1 / (4 * x * root(x)), lambda x: mp.re(x) > 0.05 and abs(x) > 0.2, True),
    "tan": (mp.tan, lambda x: mp.sec(x) ** 2, lambda x: 2 * mp.tan(x) * mp.sec(x) ** 2, lambda x: abs(mp.cos(x)) > 0.3, True),
    "atan": (mp.atan, lambda x: 1 / (1 + x * x), lambda x: -2 * x / (1 + x * x) ** 2, lambda x: abs(1 + x * x) > 0.3 and abs(mp.re(x)) > 0.05, True),
    "asinh": (mp.asinh, lambda x: 1 / root(1 + x * x), lambda x: -x / root(1 + x * x) ** 3, lambda x: abs(1 + x * x) > 0.3 and mp.re(x) > 0.05, True),
    "asin": (mp.asin, lambda x: 1 / root(1 - x * x), lambda x: x / root(1 - x * x) ** 3, lambda x: abs(x) < 0.8, True),
    "sinh": (mp.sinh, mp.cosh, mp.sinh, lambda x: abs(x) < 4, True),
    "cosh": (mp.cosh, mp.sinh, mp.cosh, lambda x: abs(x) < 4, True),
    "tanh": (mp.tanh, sec2, lambda x: -2 * mp.tanh(x) * sec2(x), lambda x: abs(mp.cosh(x)) > 0.3, True),
    "sech": (mp.sech, lambda x: -mp.sech(x) * mp.tanh(x), lambda x: mp.sech(x) * (1 - 2 * sec2(x)), lambda x: abs(mp.cosh(x)) > 0.3, True),
    "cbrt": (lambda x: mp.sign(x) * mp.cbrt(abs(x)), lambda x: 1 / (3 * mp.cbrt(x * x)), lambda x: -2 * mp.sign(x) / (9 * mp.cbrt(abs(x)) ** 5), lambda x: abs(x) > 0.2, False),
    "abs": (abs, mp.sign, lambda x: mp.mpf(0), lambda x: abs(x) > 0.1, False),
    "digamma": (mp.digamma, lambda x: mp.psi(1, x), lambda x: mp.psi(2, x), lambda x: mp.re(x) > 0.5, False),
}


def powers(a, b):
    p, l = mp.power(a, b), mp.log(a)
    return p, b * p / a, p * l, b * (b - 1) * p / a**2, p / a * (1 + b * l), p * l * l


def hypots(a, b):
    r = root(a * a + b * b)
    return r, a / r, b / r, b * b / r**3, -a * b / r**3, a * a / r**3


def angles(a, b):
    r = a * a + b * b
    return mp.atan2(a, b), b / r, -a / r, -2 * a * b / r**2, (a * a - b * b) / r**2, 2 * a * b / r**2


class Tree:
    """A random formula: its text, and a function from leaves to its series that fails where it is hard to judge."""

    def __init__(self, source, depth, complex_):
        self.text, self.run = self.grow(source, depth, complex_)

    def grow(self, source, depth, complex_):
        leaves = ["z"] if complex_ else ["x", "y"]
        if depth == 0:
            if source.random() < 0.25:
                c = source.choice([0.5, 1.5, 2.0, 3.0, 0.75])
                return repr(c), lambda v, c=c: v[leaves[0]].constant(c)
            name = source.choice(leaves)
            return name, lambda v, name=name: v[name]
        kind = source.random()
        if kind < 0.45:
            names = [n for n, row in ELEMENTARY.items() if row[4] or not complex_]
            name = source.choice(names)
            text, inner = self.grow(source, depth - 1, complex_)
            row = ELEMENTARY[name]
            def run(v):
                a = inner(v)
                if row[3] and not row[3](a.v):
                    raise ValueError
                return a.apply(row[:3])
            return f"{name}({text})", run
        left, a = self.grow(source, depth - 1, complex_)
        right, b = self.grow(source, source.randrange(depth), complex_)
        if kind < 0.85 or complex_:
            op = source.choice("+-**/")
            def run(v):
                p, q = a(v), b(v)
                if op == "/":
                    if abs(q.v) < 0.2:
                        raise ValueError
                    return p / q
                return p + q if op == "+" else p - q if op == "-" else p * q
            return f"(({left}) {op} ({right}))", run
        name = source.choice(["hypot", "atan2", "pow", "min", "max", "if"])
        def run(v):
            p, q = a(v), b(v)
            if name in ("min", "max", "if"):
                if abs(p.v - q.v) < 0.01:
                    raise ValueError
                return p if (p.v < q.v) == (name != "max") else q
            if name == "pow" and p.v < 0.2 or name != "pow" and abs(p.v) + abs(q.v) < 0.3 or name == "atan2" and q.v < 0.1:
                raise ValueError
            return p.outer(q, *{"hypot": hypots, "atan2": angles, "pow": powers}[name](p.v, q.v))
        if name == "if":
            return f"(if {left} < {right} then {left} else {right})", run
        return f"{name}({left}, {right})", run


def checked(tree, names, at, series):
    """Compares a series with symmetric differences."""
    with mp.workdps(200):
        h = mp.mpf(10) ** -60
        f = lambda *v: tree.run({n: Series.variable(t, 0, 1) for n, t in zip(names, v)}).v
        for i in range(len(at)):
            for k in range(len(at)):
                move = lambda a, b: [t + h * (a * (j == i) + b * (j == k)) for j, t in enumerate(at)]
                found = (f(*move(1, 1)) - f(*move(1, -1)) - f(*move(-1, 1)) + f(*move(-1, -1))) / (4 * h * h)
                assert abs(found - series.h[i][k]) < mp.mpf(10) ** -35 * (1 + abs(found)), (tree.text, at)


def rows(tree, names, source):
    out = []
    for _ in range(60):
        at = [mp.mpf(f32(source.uniform(-3, 3))) for _ in range(2)]
        variables = at if len(names) == 2 else [mp.mpc(*at)]
        try:
            series = tree.run({n: Series.variable(t, k, len(names)) for k, (n, t) in enumerate(zip(names, variables))})
        except (ValueError, ZeroDivisionError, OverflowError):
            continue
        largest = max(abs(t) for row in series.h for t in row)
        spread = max(t for row in series.scale[2] for t in row)
        if not 1e-3 < largest < 1e4 or spread > 1e4 * largest:
            continue
        checked(tree, names, variables, series)
        out.append((at, series))
        if len(out) == POINTS:
            return out
    return None


def show(v):
    return mp.nstr(v, 20, min_fixed=-3, max_fixed=6)


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions")
    source = random.Random("second formulas")
    with open(os.path.join(out, "second_formulas.txt"), "w", encoding="utf-8") as fh:
        fh.write("# random formulas with second derivatives; written by tests/oracle/second_formulas.py\n")
        for names, count in ((["x", "y"], REAL_FORMULAS), (["z"], COMPLEX_FORMULAS)):
            written = set()
            while len(written) < count:
                tree = Tree(source, source.randrange(2, 5), len(names) == 1)
                found = None if tree.text in written else rows(tree, names, source)
                if not found:
                    continue
                written.add(tree.text)
                fh.write(f"f({', '.join(names)}) = {tree.text}\n")
                for at, series in found:
                    if len(names) == 2:
                        cells = [series.h[0][0], series.h[0][1], series.h[1][1]]
                        scale = max(t for row in series.scale[2] for t in row)
                    else:
                        f, d, h = series.v, series.d[0], series.h[0][0]
                        # Δ|f| = |f′|²/|f|
                        cells = [h.real, h.imag, abs(d) ** 2 / abs(f)]
                        scale = series.scale[2][0][0]
                    fh.write("\t".join(show(v) for v in [*at, *cells, scale]) + "\n")


if __name__ == "__main__":
    main()
