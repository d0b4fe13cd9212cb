"""Numbers for the oracles: mpmath numbers with a running error bound, and their derivatives by exact rules.

A `Num` is a number v (real or complex) with e, a first-order bound of |computed - v| in units of the rounding unit u
when every operation and function rounds its result once (Wilkinson). A `Jet` is a Num with its first and, for real and
holomorphic functions, pure second derivatives by the independent variables. The functions below take jets as well as
plain mpmath numbers, so that a formula is written once: on plain numbers it serves difference quotients, on jets it
gives the derivatives by exact rules, and the error scale.

The mode of a jet says what its derivatives are by: "real" (real variables), "holomorphic" (z), "pair" (z and z̄).
"""
import struct

import mpmath as mp

SINGLE, DOUBLE = mp.mpf(2) ** -24, mp.mpf(2) ** -53
MAX_SINGLE = mp.mpf(2) ** 128 * (1 - SINGLE / 2)
MAX_DOUBLE = mp.mpf(2) ** 1024 * (1 - DOUBLE / 2)


def f32(v):
    """The nearest float32, as a float."""
    return struct.unpack("f", struct.pack("f", float(v)))[0]


class Run:
    """What was met since the last reset."""

    largest = mp.mpf(0)  # size of the largest intermediate result
    tie = False  # a choice between two branches met equal numbers
    coarse = mp.mpf(0)  # the greatest rounding unit for which first-order bounds mean something, inverted
    decisions = []  # of every comparison: its margin in units of its error bound
    flip = None  # the decision that is to be taken the other way

    @classmethod
    def reset(cls, flip=None):
        cls.largest, cls.tie, cls.coarse, cls.decisions, cls.flip = mp.mpf(0), False, mp.mpf(0), [], flip

    @classmethod
    def limit(cls, relative):
        """A relative error, in units of u, that has to stay below 1/16."""
        cls.coarse = max(cls.coarse, 16 * relative)


def exact_in_single(c):
    return all(abs(p) < 1e30 and mp.mpf(f32(p)) == p for p in (mp.re(c), mp.im(c)))


class Num:
    def __init__(self, v, e=0):
        self.v, self.e = mp.mpmathify(v), mp.mpf(e)
        if mp.isfinite(self.v):
            Run.largest = max(Run.largest, abs(self.v))

    @staticmethod
    def of(c):
        """A constant: rounded once, unless float32 holds it."""
        c = mp.mpmathify(c)
        return Num(c, 0 if exact_in_single(c) else abs(c))

    def add(self, o):
        v = self.v + o.v
        return Num(v, self.e + o.e + abs(v))

    def mul(self, o):
        v = self.v * o.v
        first = abs(self.v) * o.e + abs(o.v) * self.e + abs(v)
        if self.e and o.e and first:
            Run.limit(self.e * o.e / first / 4)
        return Num(v, first)

    def div(self, o):
        v = self.v / o.v
        if o.e:
            Run.limit(o.e / abs(o.v))
        return Num(v, (self.e + abs(v) * o.e) / abs(o.v) + abs(v))

    def neg(self):
        return Num(-self.v, self.e)

    def map(self, fn):
        """An operation that does not round and does not enlarge: conjugate, parts."""
        return Num(fn(self.v), self.e)


def plus(p, q):
    return q if p is None else p if q is None else p.add(q)


def times(p, q):
    return None if p is None or q is None else p.mul(q)


def neg(p):
    return None if p is None else p.neg()


def over(p, q):
    return None if p is None else p.div(q)


class Jet:
    second = False  # whether second derivatives are followed

    def __init__(self, a, d, h, mode):
        self.a, self.d, self.mode = a, d, mode
        self.h = h if Jet.second else [None] * len(d)

    def like(self, a, d, h):
        return Jet(a, d, h, self.mode)

    def constant(self, c):
        none = [None] * len(self.d)
        return self.like(c if isinstance(c, Num) else Num.of(c), none, none)

    def lift(self, o):
        return o if isinstance(o, Jet) else self.constant(o)

    def __add__(self, o):
        o = self.lift(o)
        return self.like(self.a.add(o.a), list(map(plus, self.d, o.d)), list(map(plus, self.h, o.h)))

    def __neg__(self):
        return self.like(self.a.neg(), list(map(neg, self.d)), list(map(neg, self.h)))

    def __sub__(self, o):
        return self + (-self.lift(o))

    def __mul__(self, o):
        o = self.lift(o)
        d = [plus(times(p, o.a), times(q, self.a)) for p, q in zip(self.d, o.d)]
        if not Jet.second:
            return self.like(self.a.mul(o.a), d, None)
        cross = [times(Num(2), times(p, q)) for p, q in zip(self.d, o.d)]
        h = [plus(plus(times(p, o.a), times(q, self.a)), c) for p, q, c in zip(self.h, o.h, cross)]
        return self.like(self.a.mul(o.a), d, h)

    def __truediv__(self, o):
        o = self.lift(o)
        q = self.a.div(o.a)
        d = [over(plus(p, neg(times(r, q))), o.a) for p, r in zip(self.d, o.d)]
        h = []
        for p, r, s, first in zip(self.h, o.h, o.d, d) if Jet.second else ():
            cross = times(Num(2), times(first, s))
            h.append(over(plus(p, neg(plus(times(r, q), cross))), o.a))
        return self.like(q, d, h)

    __radd__ = lambda self, o: self + o
    __rmul__ = lambda self, o: self * o
    __rsub__ = lambda self, o: self.lift(o) - self
    __rtruediv__ = lambda self, o: self.lift(o) / self

    def __pow__(self, n):
        assert isinstance(n, int) and n >= 1
        r = self
        for _ in range(n - 1):
            r = r * self
        return r

    def chain(self, n0, n1, n2):
        """A function of this number with value n0 and derivatives n1, n2 there."""
        d = [times(p, n1) for p in self.d]
        h = [plus(times(q, n1), times(times(p, p), n2)) for p, q in zip(self.d, self.h)] if Jet.second else None
        return self.like(n0, d, h)


def real_value(x):
    return x.a.v if isinstance(x, Jet) else mp.mpmathify(x)


def below(x, y, branch=True):
    """x < y; `branch` says that a tie is a kink (of abs, min, if), not the end of a loop."""
    if not isinstance(x, Jet) and not isinstance(y, Jet):
        return x < y
    jet = x if isinstance(x, Jet) else y
    a, b = (x if isinstance(x, Jet) else jet.constant(x)).a, (y if isinstance(y, Jet) else jet.constant(y)).a
    gap, error = abs(a.v - b.v), a.e + b.e
    Run.tie = Run.tie or (branch and gap == 0)
    decided = a.v < b.v
    if error:
        Run.decisions.append(gap / error)
        if Run.flip == len(Run.decisions) - 1:
            return not decided
    return decided


# ------------------------------------------------------------------------------------------------------------------
# Functions of one number, with three derivatives: the last is for the error of the second.
def function(f0, f1, f2, f3):
    def rounded(fn, slope, a):
        v, s = fn(a.v), abs(slope(a.v))
        return Num(v, s * a.e + abs(v))

    def call(x):
        if not isinstance(x, Jet):
            return f0(mp.mpmathify(x))
        a = x.a
        n0 = rounded(f0, f1, a)
        if a.e:
            bend, slope = abs(f2(a.v)) * a.e, abs(f1(a.v))
            # the second-order part of the error, against the first-order part and the rounding
            if bend:
                Run.limit(min(bend / slope if slope else mp.inf, bend * a.e / n0.e) / 4)
        second = rounded(f2, f3, a) if Jet.second and any(p is not None for p in x.d) else None
        return x.chain(n0, rounded(f1, f2, a), second)

    return call


sin = function(mp.sin, mp.cos, lambda x: -mp.sin(x), lambda x: -mp.cos(x))
cos = function(mp.cos, lambda x: -mp.sin(x), lambda x: -mp.cos(x), mp.sin)
exp = function(mp.exp, mp.exp, mp.exp, mp.exp)
log = function(mp.log, lambda x: 1 / x, lambda x: -1 / x**2, lambda x: 2 / x**3)
sinh = function(mp.sinh, mp.cosh, mp.sinh, mp.cosh)
cosh = function(mp.cosh, mp.sinh, mp.cosh, mp.sinh)
sqrt = function(mp.sqrt, lambda x: 1 / (2 * mp.sqrt(x)), lambda x: -1 / (4 * x * mp.sqrt(x)), lambda x: 3 / (8 * x * x * mp.sqrt(x)))


def derivatives_of_tan(x):
    t = mp.tan(x)
    s = 1 + t * t
    return t, s, 2 * t * s, 2 * s * (1 + 3 * t * t)


tan = function(*[lambda x, k=k: derivatives_of_tan(x)[k] for k in range(4)])


def derivatives_of_tanh(x):
    t = mp.tanh(x)
    s = 1 - t * t
    return t, s, -2 * t * s, 2 * s * (3 * t * t - 1)


tanh = function(*[lambda x, k=k: derivatives_of_tanh(x)[k] for k in range(4)])
asin = function(
    mp.asin,
    lambda x: 1 / mp.sqrt(1 - x * x),
    lambda x: x / mp.sqrt(1 - x * x) ** 3,
    lambda x: (1 + 2 * x * x) / mp.sqrt(1 - x * x) ** 5,
)
acos = function(
    mp.acos,
    lambda x: -1 / mp.sqrt(1 - x * x),
    lambda x: -x / mp.sqrt(1 - x * x) ** 3,
    lambda x: -(1 + 2 * x * x) / mp.sqrt(1 - x * x) ** 5,
)
atan = function(
    mp.atan, lambda x: 1 / (1 + x * x), lambda x: -2 * x / (1 + x * x) ** 2, lambda x: (6 * x * x - 2) / (1 + x * x) ** 3
)


def derivatives_of_gamma(z):
    g, p0, p1, p2 = mp.gamma(z), mp.psi(0, z), mp.psi(1, z), mp.psi(2, z)
    return g, g * p0, g * (p0**2 + p1), g * (p0**3 + 3 * p0 * p1 + p2)


gamma = function(*[lambda z, k=k: derivatives_of_gamma(z)[k] for k in range(4)])
digamma = function(*[lambda z, k=k: mp.psi(k, z) for k in range(4)])


def power(x, p):
    """x^p with a constant real exponent."""
    p = mp.mpmathify(p)
    fall = lambda k: mp.fprod(p - j for j in range(k))
    return function(*[lambda v, k=k: fall(k) * mp.power(v, p - k) for k in range(4)])(x)


# ------------------------------------------------------------------------------------------------------------------
# Functions that choose, and parts of complex numbers.
def absolute(x):
    """Of a real."""
    if not isinstance(x, Jet):
        return abs(x)
    return -x if below(x, 0) else x


def least(x, y):
    return x if below(x, y) else y


def greatest(x, y):
    return y if below(x, y) else x


def clamp(x, lo, hi):
    return least(greatest(x, mp.mpf(lo)), mp.mpf(hi))


def mix(a, b, t):
    return a * (1 - t) + b * t


def conj(z):
    if not isinstance(z, Jet):
        return mp.conj(z)
    flip = lambda p: p and p.map(mp.conj)
    if z.mode == "pair":
        return z.like(z.a.map(mp.conj), [flip(z.d[1]), flip(z.d[0])], z.h)
    assert z.mode == "real", "conj is not holomorphic"
    return z.like(z.a.map(mp.conj), list(map(flip, z.d)), list(map(flip, z.h)))


def part(z, sign):
    half = (z + conj(z)) / 2 if sign > 0 else (z - conj(z)) / mp.mpc(0, 2)
    if isinstance(z, Jet):
        half.a = z.a.map(mp.re if sign > 0 else mp.im)
    return half if isinstance(z, Jet) else mp.re(half)


def re(z):
    return part(z, 1)


def im(z):
    return part(z, -1)


def hypot(*xs):
    """Euclidean length of reals; its derivative at the origin is 0."""
    if not any(isinstance(x, Jet) for x in xs):
        return mp.sqrt(mp.fsum(x * x for x in xs))
    jet = next(x for x in xs if isinstance(x, Jet))
    xs = [jet.lift(x) for x in xs]
    r = mp.sqrt(mp.fsum(x.a.v**2 for x in xs))
    e = mp.fsum(abs(x.a.v) * x.a.e for x in xs) / r + r if r else mp.fsum(x.a.e for x in xs)
    length = Num(r, e)
    if not r:
        return jet.constant(length)
    # as it is computed: r' = Σ x x' / r, r'' = (Σ (x'² + x x'') - r'²) / r
    units = [x.a.div(length) for x in xs]
    d, h = [], []
    for k in range(len(jet.d)):
        first, second = None, None
        for x, unit in zip(xs, units):
            first = plus(first, times(x.d[k], unit))
            if Jet.second:
                second = plus(second, plus(times(x.d[k], x.d[k]), times(x.h[k], x.a)))
        d.append(first)
        if Jet.second:
            h.append(over(plus(second, neg(times(first, first))), length))
    return jet.like(length, d, h)


def modulus(z):
    """|z|; of a holomorphic jet only its value, for conditions."""
    if not isinstance(z, Jet):
        return abs(z)
    v = abs(z.a.v)
    size = Num(v, z.a.e + v)
    if z.mode == "holomorphic":
        return z.constant(size)
    if z.mode == "real":
        return hypot(re(z), im(z))
    # ∂|z| = (z̄ ∂z + z ∂z̄)/(2 |z|)
    if not v:
        return z.constant(size)
    back, unit = conj(z), z.a.div(size)
    half = lambda p, q: times(Num(mp.mpf(1) / 2), plus(times(p, unit.map(mp.conj)), times(q, unit)))
    d = [half(p, q) for p, q in zip(z.d, back.d)]
    return z.like(size, d, z.h)


def atan2(y, x):
    if not isinstance(x, Jet) and not isinstance(y, Jet):
        return mp.atan2(y, x)
    jet = x if isinstance(x, Jet) else y
    x, y = jet.lift(x), jet.lift(y)
    r = x.a.mul(x.a).add(y.a.mul(y.a))
    v = mp.atan2(y.a.v, x.a.v)
    e = (abs(x.a.v) * y.a.e + abs(y.a.v) * x.a.e) / r.v + abs(v)
    px, py = y.a.neg().div(r), x.a.div(r)
    d = [plus(times(p, px), times(q, py)) for p, q in zip(x.d, y.d)]
    # θ'' = (x y'' - y x'')/r² - 2 θ' (x x' + y y')/r²
    h = []
    for k, first in enumerate(d) if Jet.second else ():
        bend = plus(times(x.h[k], px), times(y.h[k], py))
        stretch = over(plus(times(x.a, x.d[k]), times(y.a, y.d[k])), r)
        h.append(plus(bend, neg(times(Num(2), times(first, stretch)))))
    return jet.like(Num(v, e), d, h)


def floor(x):
    """Piecewise constant; at whole numbers its derivative is taken to be 0."""
    if not isinstance(x, Jet):
        return mp.floor(x)
    near = mp.nint(x.a.v)
    if x.a.e:
        Run.decisions.append(abs(x.a.v - near) / x.a.e)
        if Run.flip == len(Run.decisions) - 1:
            return x.constant(2 * near - 1 - mp.floor(x.a.v))
    elif x.a.v == near:
        Run.tie = True
    return x.constant(mp.floor(x.a.v))
