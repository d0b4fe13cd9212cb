"""Numbers for the oracles: mpmath numbers with a running error bound, and their derivatives by exact rules.

A `Num` is a number v (real or complex) with e, a first-order bound of |computed - v| in units of the rounding unit u
when every operation and function rounds its result once (Wilkinson). A `Jet` is a Num with its first and, for real and
holomorphic functions, pure second derivatives by the independent variables. The functions below take jets as well as
plain mpmath numbers, so that a formula is written once: on plain numbers it serves difference quotients, on jets it
gives the derivatives by exact rules, and the error scale.

The mode of a jet says what its derivatives are by: "real" (real variables), "holomorphic" (z), "pair" (z and z̄).
"""
import heapq
import struct

import mpmath as mp

SINGLE, DOUBLE = mp.mpf(2) ** -24, mp.mpf(2) ** -53
OPEN = 8  # a comparison is open within this many times its error bound
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
    def limit(cls, relative, numbers):
        """A relative error, in units of u, that has to stay below 1/16; it depends on the errors of these numbers."""
        found = 16 * relative()
        for unit in (SINGLE, DOUBLE):
            if found * unit > 1 >= cls.coarse * unit:
                for n in numbers:
                    n.tighten()
                found = 16 * relative()
        cls.coarse = max(cls.coarse, found)


def exact_in_single(c):
    return all(abs(p) < 1e30 and mp.mpf(f32(p)) == p for p in (mp.re(c), mp.im(c)))


class Num:
    """A result v with the results that it was computed from, the partial derivatives by them, and its own rounding.

    e is a bound of its error that forgets where errors come from; `tighten` replaces it by the bound that follows every
    rounding to this result, which lets those of one rounding cancel that came along several ways.
    """

    made = 0

    def __init__(self, v, local=0, parents=()):
        Num.made += 1
        self.k, self.v, self.local, self.parents = Num.made, mp.mpmathify(v), mp.mpf(local), parents
        self.e = self.local + sum(abs(p) * n.e for n, p, _ in parents)
        if mp.isfinite(self.v):
            Run.largest = max(Run.largest, abs(self.v))

    @staticmethod
    def of(c):
        """A constant: rounded once, unless float32 holds it."""
        c = mp.mpmathify(c)
        return Num(c, 0 if exact_in_single(c) else abs(c))

    def tighten(self):
        # (a, b) of a result: what an error δ of it makes of this number is a δ + b δ̄
        with mp.workdps(15):
            reached, weights, bound = [(-self.k, self)], {self.k: (mp.mpf(1), mp.mpf(0))}, mp.mpf(0)
            while reached:
                _, n = heapq.heappop(reached)
                a, b = weights.pop(n.k)
                bound += (abs(a) + abs(b)) * n.local
                for parent, p, kind in n.parents:
                    if not parent.e:
                        continue
                    c, d = KINDS[kind](a, b, +p)
                    known = weights.get(parent.k)
                    if known is None:
                        heapq.heappush(reached, (-parent.k, parent))
                        known = (0, 0)
                    weights[parent.k] = (known[0] + c, known[1] + d)
        self.e = min(self.e, bound)
        return self.e

    def rounding(self, o, v):
        """What rounding v adds: nothing where both operands are exact, and float32 holds the result."""
        return mp.mpf(0) if not self.e and not o.e and exact_in_single(v) else abs(v)

    def add(self, o):
        v = self.v + o.v
        return Num(v, self.rounding(o, v), ((self, mp.mpf(1), "linear"), (o, mp.mpf(1), "linear")))

    def mul(self, o):
        v = self.v * o.v
        result = Num(v, self.rounding(o, v), ((self, o.v, "linear"), (o, self.v, "linear")))
        if self.e and o.e:
            # the product of both errors, against what is of first order
            Run.limit(lambda: self.e * o.e / result.e / 4 if result.e else mp.mpf(0), (self, o))
        return result

    def div(self, o):
        v = self.v / o.v
        if o.e:
            Run.limit(lambda: o.e / abs(o.v), (o,))
        return Num(v, self.rounding(o, v), ((self, 1 / o.v, "linear"), (o, -v / o.v, "linear")))

    def neg(self):
        return Num(-self.v, 0, ((self, mp.mpf(-1), "linear"),))

    def part(self, fn, kind):
        """An operation that does not round: conjugate, real or imaginary part."""
        return Num(fn(self.v), 0, ((self, mp.mpf(1), kind),))


KINDS = {
    "linear": lambda a, b, p: (a * p, b * mp.conj(p)),
    "conj": lambda a, b, p: (b, a),
    "re": lambda a, b, p: ((a + b) / 2, (a + b) / 2),
    "im": lambda a, b, p: ((a + b) / mp.mpc(0, 2), -(a + b) / mp.mpc(0, 2)),
}


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
    gap = abs(a.v - b.v)
    Run.tie = Run.tie or (branch and gap == 0)
    decided = a.v < b.v
    if a.e + b.e:
        if gap < OPEN * SINGLE * (a.e + b.e):
            a.tighten(), b.tighten()
        Run.decisions.append(gap / (a.e + b.e))
        if Run.flip == len(Run.decisions) - 1:
            return not decided
    return decided


# ------------------------------------------------------------------------------------------------------------------
# Functions of one number, with three derivatives: the last is for the error of the second.
def function(f0, f1, f2, f3, unit=0):
    """`unit` is the size below which results are not known relatively, but absolutely."""

    def rounded(fn, slope, a):
        v = fn(a.v)
        return Num(v, max(abs(v), unit), ((a, slope(a.v), "linear"),) if a.e else ())

    def call(x):
        if not isinstance(x, Jet):
            return f0(mp.mpmathify(x))
        a = x.a
        n0 = rounded(f0, f1, a)
        if a.e:
            bend, slope = abs(f2(a.v)), abs(f1(a.v))
            # the second-order part of the error, against the first-order part and against the whole

            def second_order():
                b = bend * a.e
                return min(b / slope if slope else mp.inf, b * a.e / n0.e) / 4 if b else mp.mpf(0)

            Run.limit(second_order, (a,))
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
digamma = function(*[lambda z, k=k: mp.psi(k, z) for k in range(4)], unit=1)  # its roots are where large terms cancel


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
    flip = lambda p: p and p.part(mp.conj, "conj")
    if z.mode == "pair":
        return z.like(flip(z.a), [flip(z.d[1]), flip(z.d[0])], z.h)
    assert z.mode == "real", "conj is not holomorphic"
    return z.like(flip(z.a), list(map(flip, z.d)), list(map(flip, z.h)))


def part(z, kind):
    take = mp.re if kind == "re" else mp.im
    if not isinstance(z, Jet):
        return take(z)
    own = lambda p: p and p.part(take, kind)
    if z.mode == "real":
        return z.like(own(z.a), list(map(own, z.d)), list(map(own, z.h)))
    pair = (z + conj(z)) / 2 if kind == "re" else (z - conj(z)) / mp.mpc(0, 2)
    return z.like(own(z.a), pair.d, z.h)


def re(z):
    return part(z, "re")


def im(z):
    return part(z, "im")


def hypot(*xs):
    """Euclidean length of reals; its derivative at the origin is 0."""
    if not any(isinstance(x, Jet) for x in xs):
        return mp.sqrt(mp.fsum(x * x for x in xs))
    jet = next(x for x in xs if isinstance(x, Jet))
    xs = [jet.lift(x) for x in xs]
    r = mp.sqrt(mp.fsum(x.a.v**2 for x in xs))
    on_axis = not any(x.a.e for x in xs) and sum(x.a.v != 0 for x in xs) <= 1
    length = Num(r, 0 if on_axis and exact_in_single(r) else r, tuple((x.a, x.a.v / r if r else mp.mpf(1), "linear") for x in xs))
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
    # |z + δ| moves by Re(z̄ δ)/|z|
    on_axis = not z.a.e and 0 in (mp.re(z.a.v), mp.im(z.a.v)) and exact_in_single(v)
    size = Num(v, 0 if on_axis else v, ((z.a, mp.conj(z.a.v) / v, "linear"),) if v else ((z.a, mp.mpf(1), "linear"),))
    if z.mode == "holomorphic":
        return z.constant(size)
    if z.mode == "real":
        return hypot(re(z), im(z))
    # ∂|z| = (z̄ ∂z + z ∂z̄)/(2 |z|)
    if not v:
        return z.constant(size)
    back, unit = conj(z), z.a.div(size)
    half = lambda p, q: times(Num(mp.mpf(1) / 2), plus(times(p, unit.part(mp.conj, "conj")), times(q, unit)))
    d = [half(p, q) for p, q in zip(z.d, back.d)]
    return z.like(size, d, z.h)


def atan2(y, x):
    if not isinstance(x, Jet) and not isinstance(y, Jet):
        return mp.atan2(y, x)
    jet = x if isinstance(x, Jet) else y
    x, y = jet.lift(x), jet.lift(y)
    r = x.a.mul(x.a).add(y.a.mul(y.a))
    v = mp.atan2(y.a.v, x.a.v)
    angle = Num(v, abs(v), ((y.a, x.a.v / r.v, "linear"), (x.a, -y.a.v / r.v, "linear")))
    px, py = y.a.neg().div(r), x.a.div(r)
    d = [plus(times(p, px), times(q, py)) for p, q in zip(x.d, y.d)]
    # θ'' = (x y'' - y x'')/r² - 2 θ' (x x' + y y')/r²
    h = []
    for k, first in enumerate(d) if Jet.second else ():
        bend = plus(times(x.h[k], px), times(y.h[k], py))
        stretch = over(plus(times(x.a, x.d[k]), times(y.a, y.d[k])), r)
        h.append(plus(bend, neg(times(Num(2), times(first, stretch)))))
    return jet.like(angle, d, h)


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
