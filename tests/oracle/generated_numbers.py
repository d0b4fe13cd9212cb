"""Numbers of 60 digits that know how far rounding in float64 may have moved them: Wilkinson's running error analysis.

The error `e` is a first-order bound of the absolute error of the value `v`, in units of u = 2^-53, if every operation and
function rounds its result once, and pi is rounded. For complex numbers both are meant in norm. What every operation has
wrong by K ulp at most is within 2 K u e of the exact value, because an ulp is 2 u at most. K may be up to MOST.

Complex gamma, lgamma and digamma count for more roundings: as many as make MOST of them the bound that the operator table
declares for float64, of lgamma and digamma by the unit of 1 where the result is smaller.

Where that is not so, there is a reason:
Jump      within that error the operation jumps: a comparison, floor, sign, mod, fract, step, or a branch cut;
Coarse    the error is a sixteenth of the distance to where a first-order bound means nothing (a pole, a zero of a
          divisor, a period of a wave);
Overflow  the value leaves the range of float64.
"""

from mpmath import mp

MOST = 2
UNIT = mp.mpf(2) ** -53
MARGIN = 2 * MOST * UNIT
LARGEST = mp.mpf(2) ** 1024 * (1 - UNIT)
# exp of more is beyond the range
LONGEST = mp.mpf("709.78")


# Declared bounds in ulp, of float64: compiler/src/table/bounds.tsv.
COMPLEX_GAMMA = 104.1
LGAMMA = 2.4
DIGAMMA = 5.8


class Jump(Exception):
    pass


class Coarse(Exception):
    pass


class Overflow(Exception):
    pass


class Number:
    """A value and its error."""

    def __init__(self, v, e=0):
        self.v = v
        self.e = mp.mpf(e)


def is_complex(x):
    return isinstance(x.v, mp.mpc)


def made(v, carried, roundings=1):
    """The result of an operation: what its operands' errors do to it, and its own roundings."""
    size = abs(v)
    if size > LARGEST:
        raise Overflow("beyond float64")
    return Number(v, carried + roundings * size)


def basic(v, carried):
    """The result of an operation that IEEE 754 rounds correctly: exact where the exact result has 53 bits."""
    if carried == 0 and not isinstance(v, mp.mpc) and v.man.bit_length() <= 53:
        return made(v, 0, 0)
    return made(v, carried)


def near(distance, error, reason):
    """Refuses a first-order bound where the error is not small beside a distance."""
    if error and MARGIN * error > distance / 16:
        raise Coarse(reason)


def add(a, b):
    return basic(a.v + b.v, a.e + b.e)


def neg(a):
    return Number(-a.v, a.e)


def sub(a, b):
    return add(a, neg(b))


def mul(a, b):
    return basic(a.v * b.v, abs(a.v) * b.e + abs(b.v) * a.e)


def div(a, b):
    near(abs(b.v), b.e, "divisor")
    v = a.v / b.v
    carried = (a.e + abs(v) * b.e) / abs(b.v)
    if not carried and not is_complex(a) and not is_complex(b) and v * b.v == a.v:
        return basic(v, 0)
    return made(v, carried)


def whole_power(a, n):
    """A constant whole exponent is a product, of |n| factors, and a quotient where it is negative."""
    if n < 0:
        near(abs(a.v), a.e, "divisor")
    near(abs(a.v) / abs(n) if a.v else mp.inf, a.e, "power")
    if abs(n) * mp.log(abs(a.v) if a.v else 1) * (1 if n > 0 else -1) > LONGEST:
        raise Overflow("power")
    v = a.v**n
    carried = abs(n * a.v ** (n - 1)) * a.e
    if carried == 0 and n > 0 and not is_complex(a) and v.man.bit_length() <= 53:
        return made(v, 0, 0)
    return made(v, carried, abs(n) - 1 + (n < 0))


def cut(z):
    """The principal logarithm's cut, along the negative real axis."""
    if is_complex(z) and z.v.real < 0 and abs(z.v.imag) <= MARGIN * z.e:
        raise Jump("branch cut")


def power(a, b):
    """exp(b log a); a real base is positive here."""
    if not is_complex(a) and a.v <= 0:
        raise ValueError("a base that is not positive")
    cut(a)
    near(abs(a.v), a.e, "logarithm")
    log = mp.log(a.v)
    if (b.v * log).real > LONGEST:
        raise Overflow("power")
    v = mp.exp(b.v * log)
    carried = abs(v) * (abs(b.v / a.v) * a.e + abs(log) * b.e)
    near(1, abs(b.v / a.v) * a.e + abs(log) * b.e, "power")
    return made(v, carried)


def smooth(f, slope):
    """A function whose first-order bound holds as long as its argument's error is small beside 1."""

    def apply(a):
        near(1, a.e, "argument")
        return made(f(a.v), abs(slope(a.v)) * a.e)

    return apply


def growing(f, slope):
    """A function that grows as exp of the real or imaginary part does."""

    def apply(a):
        if is_complex(a) and max(abs(a.v.real), abs(a.v.imag)) > LONGEST or abs(a.v.real) > mp.mpf(10) ** 400:
            raise Overflow("exponential")
        return smooth(f, slope)(a)

    return apply


def logarithm(a):
    cut(a)
    near(abs(a.v), a.e, "logarithm")
    return made(mp.log(a.v), a.e / abs(a.v))


def root(a):
    cut(a)
    if a.v == 0:
        return basic(a.v, a.e)
    near(abs(a.v), a.e, "root")
    return basic(mp.sqrt(a.v), a.e / (2 * abs(mp.sqrt(a.v))))


def gamma(a):
    if abs(a.v) > 1000 or a.v.real > 171:
        raise Overflow("gamma")
    pole = min(mp.nint(a.v.real), 0)
    near(min(abs(a.v - pole), 1), a.e, "gamma")
    v = mp.gamma(a.v)
    return made(v, abs(v * mp.psi(0, a.v)) * a.e, COMPLEX_GAMMA / MOST if is_complex(a) else 1)


def absolute(f, slope, declared):
    """A function of positive reals whose declared bound is in units of 1 where its result is smaller."""

    def apply(a):
        near(a.v, a.e, "argument")
        v = f(a.v)
        return made(v, abs(slope(a.v)) * a.e + declared / MOST * max(abs(v), 1), 0)

    return apply


def cbrt(x):
    return mp.cbrt(x) if x >= 0 else -mp.cbrt(-x)


def sinc(x):
    return mp.sinc(x)


def sinc_slope(x):
    return (mp.cos(x) - mp.sinc(x)) / x if x else mp.mpf(0)


def one(_):
    return mp.mpf(1)


def hypot(a, b):
    v = mp.hypot(a.v, b.v)
    carried = (abs(a.v) * a.e + abs(b.v) * b.e) / v if v else a.e + b.e
    return made(v, carried)


def length(*parts):
    v = mp.sqrt(sum(p.v**2 for p in parts))
    carried = sum(abs(p.v) * p.e for p in parts) / v if v else sum(p.e for p in parts)
    return made(v, carried)


def atan2(a, b):
    """The second operand is positive here."""
    square = a.v**2 + b.v**2
    return made(mp.atan2(a.v, b.v), (abs(a.v) * b.e + abs(b.v) * a.e) / square)


def less(a, b):
    if a.v != b.v or a.e or b.e:
        if abs(a.v - b.v) <= MARGIN * (a.e + b.e):
            raise Jump("comparison")
    return a.v < b.v


def less_equal(a, b):
    return a is b or not less(b, a)


def choose(a, b, first):
    """The first or the second of two numbers by a condition at whose border they are equal."""
    taken, other = (a, b) if first else (b, a)
    if abs(a.v - b.v) <= MARGIN * (a.e + b.e):
        return Number(taken.v, max(a.e, b.e))
    return taken


def smaller(a, b):
    return choose(a, b, a.v <= b.v)


def greater(a, b):
    return choose(a, b, a.v >= b.v)


def modulus(a):
    return made(abs(a.v), a.e) if is_complex(a) else Number(abs(a.v), a.e)


def whole(quotient, error):
    """The greatest whole number that is not greater, where rounding does not decide."""
    if error and abs(quotient - mp.nint(quotient)) <= MARGIN * error:
        raise Jump("whole number")
    return mp.floor(quotient)


def floor(a):
    return Number(whole(a.v, a.e))


def fract(a):
    return basic(a.v - whole(a.v, a.e), a.e)


def mod(a, b):
    near(abs(b.v), b.e, "divisor")
    quotient = a.v / b.v
    times = whole(quotient, (a.e + abs(quotient) * b.e) / abs(b.v))
    return basic(a.v - b.v * times, a.e + abs(times) * b.e)


def sign(a):
    if a.e and abs(a.v) <= MARGIN * a.e:
        raise Jump("sign")
    return Number(mp.sign(a.v))


REAL = {
    "sin": smooth(mp.sin, mp.cos),
    "cos": smooth(mp.cos, mp.sin),
    "tanh": smooth(mp.tanh, lambda x: mp.sech(x) ** 2),
    "atan": smooth(mp.atan, lambda x: 1 / (1 + x**2)),
    "asinh": smooth(mp.asinh, lambda x: 1 / mp.sqrt(1 + x**2)),
    "sinc": smooth(sinc, sinc_slope),
    "cbrt": lambda a: near(abs(a.v), a.e, "root") or made(cbrt(a.v), a.e / (3 * cbrt(a.v) ** 2)),
    "exp": growing(mp.exp, mp.exp),
    "expm1": growing(mp.expm1, mp.exp),
    "lgamma": absolute(mp.loggamma, lambda x: mp.psi(0, x), LGAMMA),
    "digamma": absolute(lambda x: mp.psi(0, x), lambda x: mp.psi(1, x), DIGAMMA),
    "asin": lambda a: near(1 - abs(a.v), a.e, "asin") or made(mp.asin(a.v), a.e / mp.sqrt(1 - a.v**2)),
    "acosh": lambda a: near(a.v - 1, a.e, "acosh") or made(mp.acosh(a.v), a.e / mp.sqrt(a.v**2 - 1)),
    "atanh": lambda a: near(1 - abs(a.v), a.e, "atanh") or made(mp.atanh(a.v), a.e / (1 - a.v**2)),
    "log1p": lambda a: near(1 + a.v, a.e, "log1p") or made(mp.log1p(a.v), a.e / abs(1 + a.v)),
    "sinh": growing(mp.sinh, mp.cosh),
    "cosh": growing(mp.cosh, mp.sinh),
    "tan": lambda a: near(abs(mp.cos(a.v)), a.e, "tan") or made(mp.tan(a.v), a.e / mp.cos(a.v) ** 2),
    "log": logarithm,
    "sqrt": root,
    "gamma": gamma,
}

COMPLEX = {
    "sin": growing(mp.sin, mp.cos),
    "cos": growing(mp.cos, mp.sin),
    "sinh": growing(mp.sinh, mp.cosh),
    "exp": growing(mp.exp, mp.exp),
    "log": logarithm,
    "sqrt": root,
    "gamma": gamma,
}
