"""FPCore trees with every operation rounded to float32's 24 bits, and exponents without bounds.

What this loses is what the formula as it is written loses by rounding alone: cancellation and the amplification of
rounding errors, but no overflow, no underflow and no adapter. mpmath rounds each operation to the nearest.
"""

import operator

import mpmath
from mpmath import mp, mpf

import fpcore

BITS = 24


class NoNumber(Exception):
    """An operation has no real value at rounded arguments."""


def real(value):
    if isinstance(value, bool):
        return value
    if isinstance(value, mpmath.mpc) or not mpmath.isfinite(value):
        raise NoNumber
    return value


def literal(token):
    """A literal, rounded once."""
    exact = fpcore.rational(token)
    with mp.workprec(200):
        value = mpf(exact.numerator) / mpf(exact.denominator)
    return +value


def cbrt(x):
    return -mpmath.cbrt(-x) if x < 0 else mpmath.cbrt(x)


def divide(x, y):
    if y == 0:
        raise NoNumber
    return x / y


def to_nearest(x):
    return mpmath.floor(x + 0.5) if x >= 0 else mpmath.ceil(x - 0.5)


def truncated(x):
    return mpmath.floor(x) if x >= 0 else mpmath.ceil(x)


def hypot(x, y):
    return mpmath.hypot(x, y)


def power(x, y):
    if x == 0 and y <= 0:
        if y == 0:
            return mpf(1)
        raise NoNumber
    if x != 1 and abs(y) > 1e60:
        raise NoNumber
    return mpmath.power(x, y)


def fmod(x, y):
    if y == 0 or abs(x) > HUGE:
        raise NoNumber
    with mp.workprec(4000):
        value = x - y * truncated(x / y)
    return +value


def log_base(base):
    def f(x):
        if x <= 0:
            raise NoNumber
        with mp.workprec(60):
            value = mpmath.log(x) / mpmath.log(base)
        return +value

    return f


def logarithm(x):
    if x <= 0:
        raise NoNumber
    return mpmath.log(x)


def log1p(x):
    if x <= -1:
        raise NoNumber
    return mpmath.log1p(x)


def atanh(x):
    if abs(x) >= 1:
        raise NoNumber
    return mpmath.atanh(x)


def exponential(f):
    """Powers that are too large to write down have no place here."""

    def g(x):
        if abs(x) > 1e60:
            raise NoNumber
        return f(x)

    return g


HUGE = mpf(2) ** 4096


def wave(f):
    """A number of more digits than that is not reduced."""

    def g(x):
        if abs(x) > HUGE:
            raise NoNumber
        return f(x)

    return g


def whole(f):
    return lambda x: x if abs(x) > HUGE else f(x)


UNARY = {
    "sqrt": mpmath.sqrt, "cbrt": cbrt, "exp": exponential(mpmath.exp), "expm1": exponential(mpmath.expm1),
    "exp2": exponential(lambda x: mpmath.power(2, x)), "log": logarithm, "log1p": log1p, "log2": log_base(2),
    "log10": log_base(10), "sin": wave(mpmath.sin), "cos": wave(mpmath.cos), "tan": wave(mpmath.tan), "asin": mpmath.asin,
    "acos": mpmath.acos, "atan": mpmath.atan, "sinh": exponential(mpmath.sinh), "cosh": exponential(mpmath.cosh),
    "tanh": lambda x: mpmath.tanh(x) if abs(x) < 1e4 else mpmath.sign(x), "asinh": mpmath.asinh, "acosh": mpmath.acosh,
    "atanh": atanh, "fabs": lambda x: abs(x), "floor": whole(mpmath.floor), "ceil": whole(mpmath.ceil),
    "trunc": whole(truncated), "round": whole(to_nearest), "tgamma": wave(mpmath.gamma),
    "lgamma": wave(lambda x: logarithm(abs(mpmath.gamma(x)))),
}
BINARY = {
    "pow": power, "atan2": mpmath.atan2, "hypot": hypot, "fmin": lambda x, y: min(x, y), "fmax": lambda x, y: max(x, y),
    "fmod": fmod, "copysign": lambda x, y: -abs(x) if y < 0 else abs(x),
}
FIXED = {
    "PI": lambda: +mpmath.pi, "E": lambda: +mpmath.e, "LN2": lambda: mpmath.log(2), "LN10": lambda: mpmath.log(10),
    "LOG2E": lambda: 1 / mpmath.log(2), "LOG10E": lambda: 1 / mpmath.log(10), "PI_2": lambda: mpmath.pi / 2,
    "PI_4": lambda: mpmath.pi / 4, "M_1_PI": lambda: 1 / mpmath.pi, "M_2_PI": lambda: 2 / mpmath.pi,
    "M_2_SQRTPI": lambda: 2 / mpmath.sqrt(mpmath.pi), "SQRT2": lambda: mpmath.sqrt(2),
    "SQRT1_2": lambda: mpmath.sqrt(0.5), "TRUE": lambda: True, "FALSE": lambda: False,
}
COMPARE = {
    "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge, "==": operator.eq, "!=": operator.ne,
}


class Rounded(fpcore.Exact):
    """Evaluates FPCore trees in 24 bits."""

    unary, binary, fixed = UNARY, BINARY, FIXED
    literal, div, checked = staticmethod(literal), staticmethod(divide), staticmethod(real)
    holds = staticmethod(lambda op, a, b: COMPARE[op](a, b))


def bits_lost(evaluator, body, env, exact):
    """log2(1 + the number of 24-bit numbers between the rounded evaluation and the exact value, a Fraction), at most 32."""
    mp.prec = BITS
    try:
        got = evaluator.value(body, env)
    except (NoNumber, fpcore.Slow, ValueError, ZeroDivisionError, OverflowError, mpmath.libmp.NoConvergence):
        return 32.0
    with mp.workprec(300):
        right = mpf(exact.numerator) / mpf(exact.denominator)
        if right == 0:
            return 0.0 if got == 0 else 32.0
        with mp.workprec(BITS):
            nearest = +right
        step = mpf(2) ** (mpmath.frexp(nearest)[1] - BITS)
        between = abs(got - nearest) / step
        return min(32.0, float(mpmath.log(1 + between, 2)))
