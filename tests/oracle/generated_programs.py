"""The part of the language that generated programs have: parsed, and evaluated with numbers that know their error."""

import re

from mpmath import mp

import generated_numbers as n
from generated_numbers import Number

TOKEN = re.compile(r"\s*(\d+\.\d+i?|\d+i?|[A-Za-z_]\w*|π|<=|[=>²√(){}|,:<^+*/-])")
WORDS = {"if", "then", "else", "where", "and", "not"}


def tokens(text):
    found, place = [], 0
    while place < len(text):
        match = TOKEN.match(text, place)
        if not match:
            raise SyntaxError(text[place:])
        found.append(match[1])
        place = match.end()
    return found + ["end"]


class Parser:
    """Recursive descent after docs/language.md; each rule gives a function from names to a value."""

    def __init__(self, text):
        self.tokens = tokens(text)
        self.place = 0
        self.bars = 0

    @property
    def next(self):
        return self.tokens[self.place]

    def take(self, *wanted):
        if self.next in wanted:
            self.place += 1
            return self.tokens[self.place - 1]
        return None

    def expect(self, wanted):
        if not self.take(wanted):
            raise SyntaxError(f"{wanted} wanted before {self.tokens[self.place:]}")

    def expression(self):
        value = self.condition()
        if not self.take("where"):
            return value
        names = []
        while True:
            name = self.next
            self.place += 1
            self.expect("=")
            names.append((name, self.condition()))
            if not self.take(","):
                break

        def bound(around):
            inside = dict(around)
            for name, local in names:
                inside[name] = local(inside)
            return value(inside)

        return bound

    def condition(self):
        first = self.negation()
        while self.take("and"):
            first = conjunction(first, self.negation())
        return first

    def negation(self):
        if self.take("not"):
            inner = self.negation()
            return lambda names: not inner(names)
        return self.comparison()

    def comparison(self):
        first = self.sum()
        operator = self.take("<", "<=") or self.take(">")
        if not operator:
            return first
        second = self.sum()
        test = {
            "<": n.less,
            "<=": n.less_equal,
            ">": lambda a, b: n.less(b, a),
        }[operator]
        return lambda names: test(first(names), second(names))

    def sum(self):
        value = self.product()
        while operator := self.take("+", "-"):
            value = binary(n.add if operator == "+" else n.sub, value, self.product())
        return value

    def product(self):
        value = self.prefix()
        while True:
            if operator := self.take("*", "/"):
                value = binary(n.mul if operator == "*" else n.div, value, self.prefix())
            elif self.begins_factor():
                value = binary(n.mul, value, self.power())
            else:
                return value

    def begins_factor(self):
        if self.next == "|":
            return not self.bars
        return self.next in "(√π" or self.next[0].isalpha() and self.next not in WORDS and self.next != "end"

    def prefix(self):
        if self.take("-"):
            inner = self.prefix()
            return lambda names: n.neg(inner(names))
        return self.power()

    def power(self):
        if self.take("√"):
            inner = self.prefix()
            return lambda names: n.root(inner(names))
        base = self.postfix()
        if not self.take("^"):
            return base
        start = self.place
        exponent = self.prefix()
        whole = whole_number(self.tokens[start : self.place])
        if whole is not None:
            return lambda names: n.whole_power(base(names), whole)
        return lambda names: raised(base(names), exponent(names))

    def postfix(self):
        value = self.primary()
        while self.take("²"):
            value = squared(value)
        return value

    def primary(self):
        if self.take("("):
            parts = self.list(")")
            return parts[0] if len(parts) == 1 else lambda names: [part(names) for part in parts]
        if self.take("|"):
            self.bars, before = self.bars + 1, self.bars
            inner = self.expression()
            self.expect("|")
            self.bars = before
            return lambda names: size(inner(names))
        if self.take("{"):
            return self.pieces()
        if self.take("if"):
            return self.choice()
        return self.name_or_number()

    def list(self, end):
        self.bars, before = 0, self.bars
        parts = [self.expression()]
        while self.take(","):
            parts.append(self.expression())
        self.expect(end)
        self.bars = before
        return parts

    def choice(self):
        condition = self.condition()
        self.expect("then")
        first = self.condition()
        self.expect("else")
        second = self.condition()
        return lambda names: first(names) if condition(names) else second(names)

    def pieces(self):
        arms = []
        while True:
            condition = (lambda names: True) if self.take("else") else self.condition()
            self.expect(":")
            arms.append((condition, self.condition()))
            if not self.take(","):
                break
        self.expect("}")

        def first(names):
            return next(value for condition, value in arms if condition(names))(names)

        return first

    def name_or_number(self):
        token = self.next
        self.place += 1
        if token[0].isdigit():
            value = mp.mpf(token.rstrip("i"))
            return constant(Number(mp.mpc(0, value) if token.endswith("i") else value, error(value)))
        if token == "π":
            return constant(Number(+mp.pi, +mp.pi))
        if self.next == "(" and token in FUNCTIONS:
            self.place += 1
            arguments = self.list(")")
            return lambda names: FUNCTIONS[token](*(argument(names) for argument in arguments))
        if token == "i":
            return constant(Number(mp.mpc(0, 1)))
        return lambda names: names[token]



def error(value):
    """Of a decimal that is rounded to float64, in units of u."""
    return 0 if mp.mpf(float(value)) == value else abs(value)


def constant(value):
    return lambda names: value


def conjunction(a, b):
    return lambda names: a(names) and b(names)


def binary(operation, a, b):
    return lambda names: operation(a(names), b(names))


def squared(a):
    return lambda names: n.whole_power(a(names), 2)


def whole_number(tokens):
    match = re.fullmatch(r"-?\d+", "".join(tokens))
    return int(match[0]) if match else None


def raised(a, b):
    """An exponent that turns out to be whole gives the product."""
    if b.e == 0 and not n.is_complex(b) and b.v == mp.nint(b.v) and abs(b.v) < 64 and b.v != 0:
        return n.whole_power(a, int(b.v))
    return n.power(a, b)


def size(a):
    return n.length(*a) if isinstance(a, list) else n.modulus(a)


def elementary(name):
    def apply(a):
        return (n.COMPLEX if n.is_complex(a) else n.REAL)[name](a)

    return apply


def dot(a, b):
    products = [n.mul(x, y) for x, y in zip(a, b)]
    total = products[0]
    for product in products[1:]:
        total = n.add(total, product)
    return total


ZERO, ONE, TWO, THREE, HALF = (Number(mp.mpf(x)) for x in (0, 1, 2, 3, 0.5))


def clamp(x, lo, hi):
    return n.smaller(n.greater(x, lo), hi)


def smoothstep(a, b, x):
    t = clamp(n.div(n.sub(x, a), n.sub(b, a)), ZERO, ONE)
    return n.mul(n.mul(t, t), n.sub(THREE, n.mul(TWO, t)))


def mix(a, b, t):
    return n.add(n.mul(a, n.sub(ONE, t)), n.mul(b, t))


def smin(a, b, k):
    """The quadratic polynomial smooth minimum (Quilez, iquilezles.org/articles/smin)."""
    h = clamp(n.add(HALF, n.div(n.sub(b, a), n.mul(TWO, k))), ZERO, ONE)
    return n.sub(mix(b, a, h), n.mul(n.mul(k, h), n.sub(ONE, h)))


def step(edge, x):
    return ZERO if n.less(x, edge) else ONE


def real_part(a):
    return Number(mp.mpf(a.v.real), a.e)


FUNCTIONS = {name: elementary(name) for name in n.REAL.keys() | n.COMPLEX.keys()} | {
    "hypot": n.hypot,
    "atan2": n.atan2,
    "floor": n.floor,
    "fract": n.fract,
    "mod": n.mod,
    "sign": n.sign,
    "min": n.smaller,
    "max": n.greater,
    "abs": n.modulus,
    "dot": dot,
    "clamp": clamp,
    "smoothstep": smoothstep,
    "mix": mix,
    "smin": smin,
    "step": step,
    "re": real_part,
}


def compiled(kind, text):
    """The program as a function of its two coordinates, or of the parts of z."""
    parser = Parser(text)
    value = parser.expression()
    parser.expect("end")
    if kind == "complex":
        return lambda x, y: value({"z": Number(mp.mpc(x, y))})
    return lambda x, y: value({"x": Number(x), "y": Number(y)})
