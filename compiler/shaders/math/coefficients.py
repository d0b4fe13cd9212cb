#!/usr/bin/env python3
"""Print the minimax coefficients of real.wgsl and its neighbours.

usage: coefficients.py [NAME...]

Each row approximates g on [a, b] by a polynomial of least degree whose error, weighted with w, is below `goal`: w is
chosen so that the error is relative to the function that g is part of. Method: Remez' exchange algorithm (Cheney,
"Introduction to Approximation Theory", ch. 3) in 40 digits; the coefficients are then rounded to binary32.
Printed: the errors before and after rounding, then Horner's rule in WGSL. Needs: mpmath.
"""
import struct
import sys

from mpmath import *

mp.dps = 40


def f32(v):
    return mpf(struct.unpack("f", struct.pack("f", float(v)))[0])


def grid(a, b, n):
    """Points of [a, b], denser at the ends."""
    return [(a + b) / 2 - (b - a) / 2 * cos(pi * mpf(i) / n) for i in range(n + 1)]


def horner(c, x):
    s = mpf(0)
    for v in reversed(c):
        s = s * x + v
    return s


def remez(g, w, a, b, degree, points):
    """The polynomial p that makes w (g - p) least."""
    n = degree + 1
    xs = [(a + b) / 2 - (b - a) / 2 * cos(pi * (mpf(i) + mpf(1) / 2) / (n + 1)) for i in range(n + 1)]
    xs = [x if abs(x) > (b - a) / 100 else x + (b - a) / 77 for x in xs]  # the weight may vanish at 0
    values = [(x, g(x), w(x)) for x in points]
    c = []
    for _ in range(12):
        m, r = matrix(n + 1, n + 1), matrix(n + 1, 1)
        for i, x in enumerate(xs):
            for j in range(n):
                m[i, j] = x**j
            m[i, n] = (-1) ** i / w(x)
            r[i] = g(x)
        s = lu_solve(m, r)
        c = [s[j] for j in range(n)]
        err = [(x, ww * (v - horner(c, x))) for x, v, ww in values]
        # the largest error of each run of one sign
        runs = []
        for x, e in err:
            if runs and (e >= 0) == (runs[-1][1] >= 0):
                if abs(e) > abs(runs[-1][1]):
                    runs[-1] = (x, e)
            else:
                runs.append((x, e))
        while len(runs) > n + 1:
            i = min(range(len(runs)), key=lambda i: abs(runs[i][1]))
            runs.pop(i)
            if 0 < i < len(runs):  # its neighbours have one sign: keep the larger
                runs.pop(i - 1 if abs(runs[i - 1][1]) < abs(runs[i][1]) else i)
        if len(runs) < n + 1:
            break
        xs = [x for x, _ in runs]
        es = [abs(e) for _, e in runs]
        if max(es) < min(es) * mpf("1.01"):
            break
    return c, max(abs(e) for _, e in err)


def fit(g, w, a, b, goal):
    a, b = mpf(a), mpf(b)
    points = [x for x in grid(a, b, 400) if abs(x) > mpf(10) ** -9]
    for degree in range(1, 24):
        c, best = remez(g, w, a, b, degree, points)
        if best < goal:
            break
    fixed = [f32(v) for v in c]
    after = max(abs(w(x) * (g(x) - horner(fixed, x))) for x in points)
    return fixed, best, after


stirling = lambda x: loggamma(x) - (x - 0.5) * log(x) + x - log(2 * pi) / 2
psi_rest = lambda x: (log(x) - psi(0, x) - 1 / (2 * x)) * x * x
psi1_rest = lambda x: (psi(1, x) - 1 / x - 1 / (2 * x * x)) * x**3
X0 = findroot(lambda x: psi(0, x), 1.46)
odd = lambda f: lambda z: (f(sqrt(z)) - sqrt(z)) / (z * sqrt(z))
odd_weight = lambda f: lambda z: z * sqrt(z) / f(sqrt(z))
Q = (pi / 4) ** 2 * mpf("1.001")
H = log(2) / 2 * mpf("1.001")
R = sqrt(2)
erfcx_at = lambda x: exp(x * x) * erfc(x) if x < 1000 else (1 - 1 / (2 * x * x) + 3 / (4 * x**4)) / (x * sqrt(pi))
erfcx_mapped = lambda y: 2 / sqrt(pi) if y == 1 else (1 + 6 * (1 + y) / (1 - y)) * erfcx_at(3 * (1 + y) / (1 - y))

K = mpf("1.8")


def atan_quotient(x):
    """atan(sqrt x)/sqrt x, continued through 0."""
    r = sqrt(abs(x))
    return 1 - x / 3 if abs(x) < mpf(10) ** -20 else (atan(r) if x > 0 else atanh(r)) / r


def atan_quotient1(x):
    """(1 - atan(sqrt x)/sqrt x)/x"""
    return mpf(1) / 3 - x / 5 + x * x / 7 if abs(x) < mpf(10) ** -9 else (1 - atan_quotient(x)) / x


def shortest(v):
    """The shortest decimal that reads back as this binary32."""
    for digits in range(1, 12):
        text = "%.*g" % (digits, float(v))
        if f32(float(text)) == v:
            break
    return text if "." in text or "e" in text else text + ".0"


def nested(c):
    """Horner's rule in z, as WGSL."""
    text = shortest(c[-1])
    for v in reversed(c[:-1]):
        text = f"{shortest(v)} + z * " + (f"({text})" if "*" in text else text)
    return text


# name: (g, weight, a, b, goal, what)
ROWS = {
    "sin": (odd(sin), odd_weight(sin), 0, Q, 1e-8, "sin r = r + r^3 P(r^2)"),
    "cos": (lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2, 0, Q, 5e-9, "cos r = 1 - z/2 + z^2 P(z)"),
    "sinpi": (
        lambda z: (sin(pi * sqrt(z)) / sqrt(z) - pi) / z, lambda z: z * sqrt(z) / sin(pi * sqrt(z)), 0, 0.0626, 2e-9,
        "sin(pi f) = pi f + f^3 P(f^2), |f| < 1/4",
    ),
    "cospi": (
        lambda z: (cos(pi * sqrt(z)) - 1) / z, lambda z: z / cos(pi * sqrt(z)), 0, 0.0626, 5e-9,
        "cos(pi f) = 1 + z P(z), z = f^2, |f| < 1/4",
    ),
    "atan_short": (odd(atan), odd_weight(atan), 0, mpf(1) / 60, 1e-11, "atan u = u + u^3 P(u^2), |u| < 1/8"),
    "atan_quotient": (
        lambda v: atan_quotient(2 * v / (1 - v)), lambda v: 1 / atan_quotient(2 * v / (1 - v)), -mpf(1) / 3, mpf(1) / 5,
        2e-8, "atan(sqrt x)/sqrt x = P(z), z = x/(2 + x), |x| < 1/2",
    ),
    "atan_quotient1": (
        lambda v: atan_quotient1(K * v / (1 - v)), lambda v: 1 / atan_quotient1(K * v / (1 - v)), mpf(-0.75) / (K - 0.75),
        2 / (K + 2), 1.2e-8, "(1 - atan(sqrt x)/sqrt x)/x = P(z), z = x/(1.8 + x), -3/4 < x < 2",
    ),
    "tan": (odd(tan), odd_weight(tan), 0, Q, 1.5e-8, "tan r = r + r^3 P(r^2)"),
    "atan": (odd(atan), odd_weight(atan), 0, 1, 1e-8, "atan t = t + t^3 P(t^2)"),
    "asin": (odd(asin), odd_weight(asin), 0, 0.25, 6e-9, "asin t = t + t^3 P(t^2)"),
    "sinh": (odd(sinh), odd_weight(sinh), 0, 1, 6e-9, "sinh t = t + t^3 P(t^2)"),
    "cosh": (
        lambda z: (cosh(sqrt(z)) - 1 - z / 2) / z**2, lambda z: z**2 / cosh(sqrt(z)), 0, mpf("1.0001"), 1e-8,
        "cosh t = 1 + z/2 + z^2 P(z), z = t^2",
    ),
    "tanh": (odd(tanh), odd_weight(tanh), 0, 0.4, 1e-8, "tanh t = t + t^3 P(t^2)"),
    "asinh": (odd(asinh), odd_weight(asinh), 0, 0.25, 1e-8, "asinh t = t + t^3 P(t^2)"),
    "atanh": (odd(atanh), odd_weight(atanh), 0, 0.25, 1e-8, "atanh t = t + t^3 P(t^2)"),
    "expm1": (lambda r: (expm1(r) - r) / r**2, lambda r: r**2 / expm1(r), -H, H, 8e-9, "expm1 r = r + r^2 P(r)"),
    "exp2": (lambda r: (mpf(2) ** r - 1) / r, lambda r: abs(r), -0.502, 0.502, 4e-9, "2^r = 1 + r P(r)"),
    "log": (
        lambda f: (log1p(f) - f + f**2 / 2) / f**3, lambda f: f**3 / log1p(f), 1 / R - 1, R - 1, 1e-8,
        "log(1+f) = f - f^2/2 + f^3 P(f)",
    ),
    "log_pair": (
        lambda z: (log((1 + sqrt(z)) / (1 - sqrt(z))) / (2 * sqrt(z)) - 1) / z, lambda z: z, 0, 0.0296, 1e-11,
        "log((1+s)/(1-s)) = 2 s (1 + z P(z)), z = s^2",
    ),
    "erf": (
        lambda z: (erf(sqrt(z)) / sqrt(z) - 2 / sqrt(pi)) / z, lambda z: z * sqrt(z) / erf(sqrt(z)), 0, 1, 1e-8,
        "erf x = x (2/sqrt(pi) + z P(z)), z = x^2, |x| < 1",
    ),
    "erfcx": (
        erfcx_mapped, lambda y: 1 / erfcx_mapped(y), -1, 1, 2e-8,
        "(1 + 2x) exp(x^2) erfc x = P(y), y = (x - 3)/(x + 3), x > 0",
    ),
    "rgamma": (lambda t: rgamma(1 + t), lambda t: 1, -0.5, 0.5, 1e-8, "1/Gamma(1+t)"),
    "lgamma1": (lambda t: loggamma(1 + t) / t, lambda t: t / loggamma(1 + t), -0.5, 0.5, 1e-8, "log Gamma(1+t) = t P(t)"),
    "lgamma2": (lambda t: loggamma(2 + t) / t, lambda t: t / loggamma(2 + t), -0.5, 0.5, 1e-8, "log Gamma(2+t) = t P(t)"),
    "stirling": (
        lambda w: stirling(1 / sqrt(w)) / sqrt(w), lambda w: sqrt(w), mpf(1) / 40**2, mpf(1) / 3.5**2, 3e-9,
        "log Gamma x = (x-1/2) log x - x + log(2 pi)/2 + P(w)/x, w = 1/x^2, x > 3.5",
    ),
    "psi": (
        lambda t: psi(0, 1.75 + t) / (1.75 + t - X0), lambda t: 1 / (psi(0, 1.75 + t) / (1.75 + t - X0)),
        -0.75, 0.75, 1e-8, "psi x = (x - x0) P(x - 1.75), 1 < x < 2.5",
    ),
    "psi_far": (
        lambda w: psi_rest(1 / sqrt(w)), lambda w: w / psi(0, 1 / sqrt(w)), mpf(1) / 40**2, mpf(1) / 2.5**2, 1e-8,
        "psi x = log x - 1/(2x) - w P(w), w = 1/x^2, x > 2.5",
    ),
    "psi1_far": (
        lambda w: psi1_rest(1 / sqrt(w)), lambda w: w * sqrt(w) / psi(1, 1 / sqrt(w)), mpf(1) / 40**2, mpf(1) / 2.5**2,
        1e-8, "psi' x = 1/x + w/2 + w P(w)/x, w = 1/x^2, x > 2.5",
    ),
}
if __name__ == "__main__":
    for name in sys.argv[1:] or ROWS:
        g, w, a, b, goal, what = ROWS[name]
        c, before, after = fit(g, w, a, b, goal)
        print(f"// {name}: {what}, error {nstr(before, 2)}, rounded {nstr(after, 2)}")
        print(nested(c))
        sys.stdout.flush()
