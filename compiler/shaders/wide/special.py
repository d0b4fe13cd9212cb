#!/usr/bin/env python3
"""Print the constants of complex_power.wgsl, gamma.wgsl and its neighbours as sums of f32.

usage: special.py [NAME...]

Closed forms only: values of elementary functions, Bernoulli numbers (DLMF 24.2), values of zeta (DLMF 25.2), Taylor
coefficients of digamma, in 60 digits. Needs: mpmath.
"""
import struct
import sys

from mpmath import (
    atan, atanh, bernoulli, cos, erfc, euler, exp, factorial, findroot, legendre, log, mp, mpf, pi, psi, sqrt, taylor, zeta,
)

mp.dps = 60


def f32(v):
    return mpf(struct.unpack("f", struct.pack("f", float(v)))[0])


def shortest(v):
    """The shortest decimal that reads back as this binary32."""
    for digits in range(1, 13):
        text = "%.*g" % (digits, float(v))
        if f32(float(text)) == v:
            break
    return text if "." in text or "e" in text else text + ".0"


def parts(v, count):
    """v as a sum of f32, each the nearest to what is left."""
    out, left = [], mpf(v)
    for _ in range(count):
        out.append(f32(left))
        left -= out[-1]
    return ", ".join(shortest(p) for p in out)


def lit(v):
    return f"lit({parts(v, 3)})"


def long_lit(v):
    return f"long_lit({parts(v, 5)})"


def cases(values):
    return "\n".join("        case %d: { return %s; }" % (k, long_lit(v)) for k, v in values)


def horner(values):
    """Horner's rule in w, lines of WGSL."""
    lines = [f"    var sum = {lit(values[-1])};"]
    lines += [f"    sum = real_add({lit(v)}, real_mul(w, sum));" for v in reversed(values[:-1])]
    return "\n".join(lines)


def table(values):
    return "\n".join("        case %d: { return %s; }" % (k, lit(v)) for k, v in enumerate(values))


def chebyshev(f, count, points=80):
    """Chebyshev coefficients of f on [-1, 1], the first halved: the sums of DLMF 3.11.11 at that many points."""
    angles = [pi * (k + mpf(1) / 2) / points for k in range(points)]
    values = [f(cos(a)) for a in angles]
    c = [2 * sum(v * cos(j * a) for v, a in zip(values, angles)) / points for j in range(count)]
    return [c[0] / 2] + c[1:]


def erfcx_mapped(y):
    """(1 + 2 x) exp(x^2) erfc x for y = (x - 3)/(x + 3)"""
    x = 3 * (1 + y) / (1 - y)
    return (1 + 2 * x) * exp(x * x) * erfc(x)


def gauss_rule(n):
    """Nodes and weights of Gauss and Legendre's rule that lie right of 0, from the right (DLMF 3.5.v)."""
    for k in range(1, n // 2 + 1):
        x = findroot(lambda x: legendre(n, x), cos(pi * (k - mpf(1) / 4) / (n + mpf(1) / 2)))
        slope = n * (x * legendre(n, x) - legendre(n - 1, x)) / (x * x - 1)
        yield x, 2 / ((1 - x * x) * slope * slope)


def short_rule(n):
    return "\n".join(f"vec2f({shortest(f32(x))}, {shortest(f32(w))})" for x, w in gauss_rule(n))


def long_rule(n):
    return "\n".join(f"RealPair({lit(x)}, {lit(w)})" for x, w in gauss_rule(n))


def double_rule(n):
    return "\n".join(f"({float(x)!r}, {float(w)!r})" for x, w in gauss_rule(n))


B = [bernoulli(2 * n) for n in range(1, 12)]
X0 = findroot(lambda x: psi(0, x), 1.46)
ROWS = {
    "log2": lambda: long_lit(log(2)),
    "half_pi": lambda: long_lit(pi / 2),
    "pi": lambda: long_lit(pi),
    "atan4": lambda: cases([(k, atan(mpf(k) / 4)) for k in range(1, 5)]),
    "atan32": lambda: cases([(k, atan(mpf(k) / 32)) for k in range(1, 5)]),
    "atanh32": lambda: cases([(k, atanh(mpf(k) / 32)) for k in range(1, 5)]),
    "short_arc": lambda: horner([mpf(1) / k for k in (3, 5, 7, 9, 11)]),
    "half_log_tau": lambda: long_lit(log(2 * pi) / 2),
    # B(2n) / (2n (2n - 1)), DLMF 5.11.1
    "stirling": lambda: table([b / (2 * n * (2 * n - 1)) for n, b in enumerate(B[:10], 1)]),
    # B(2n) / (2n), DLMF 5.11.2
    "psi": lambda: table([b / (2 * n) for n, b in enumerate(B[:10], 1)]),
    "bernoulli": lambda: table(B[:10]),
    # B(2n) / (2n)!, DLMF 25.11.43
    "zeta": lambda: table([b / factorial(2 * n) for n, b in enumerate(B[:10], 1)]),
    # (1 - euler), then (zeta(k) - 1) (-1)^k / k, DLMF 5.7.3
    "lgamma": lambda: table([1 - euler] + [(zeta(k) - 1) * (-1) ** k / k for k in range(2, 30)]),
    "psi_zero": lambda: long_lit(X0),
    "psi_taylor": lambda: table(taylor(lambda x: psi(0, x), X0, 25)[1:]),
    "euler": lambda: lit(euler),
    "erfcx": lambda: table(chebyshev(erfcx_mapped, 27)),
    # those of reference/erf.rs
    "erfcx_double": lambda: "\n".join(repr(float(c)) for c in chebyshev(erfcx_mapped, 27)),
    "gauss_node": lambda: long_rule(12),
    "gauss_node_double": lambda: double_rule(12),
    "gauss_node_single": lambda: short_rule(8),
    # of z in Gamma(z) - 1/z + euler, DLMF 5.7.1
    "gamma1": lambda: lit((euler**2 + pi**2 / 6) / 2),
    "scalars": lambda: "\n".join(f"{n} {lit(v)}" for n, v in {
        "log 2": log(2), "pi/2": pi / 2, "pi": pi, "2/sqrt pi": 2 / sqrt(pi), "sqrt pi/2": sqrt(pi) / 2, "1/sqrt pi": 1 / sqrt(pi),
    }.items()),
}
if __name__ == "__main__":
    for name in sys.argv[1:] or ROWS:
        print(f"// {name}\n{ROWS[name]()}")
