"""FPCore expressions (fpbench.org): reading them, writing them in pullback's language, evaluating them in balls.

The three know nothing of one another: the references come from the FPCore tree by Arb's ball arithmetic, never from the
text in our language, so a wrong translation shows as a wrong value.
"""

import re
import unicodedata
from fractions import Fraction

from flint import arb, ctx, fmpq

# ---------------------------------------------------------------------------------------------------------------- reading

TOKEN = re.compile(r';[^\n]*|"(?:[^"\\]|\\.)*"|[()\[\]]|[^\s()\[\]";]+')
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\Z")
RATIO = re.compile(r"([+-]?\d+)/(\d+)\Z")


class Unfit(Exception):
    """The expression has no form in our language; why."""


class Core:
    """One FPCore: its name for others, its arguments, precondition and expression."""

    def __init__(self, ident, args, name, pre, body):
        self.ident, self.args, self.name, self.pre, self.body = ident, args, name, pre, body


def read(text):
    """The s-expressions of a text, as nested lists of strings."""
    stack = [[]]
    for token in TOKEN.findall(text):
        if token.startswith(";"):
            continue
        if token in "([":
            stack.append([])
        elif token in ")]":
            done = stack.pop()
            stack[-1].append(done)
        else:
            stack[-1].append(token)
    return stack[0]


def write(tree):
    """The text of an s-expression on one line."""
    out, stack = [], [tree]
    while stack:
        node = stack.pop()
        if isinstance(node, list):
            stack.append(")")
            for k in range(len(node) - 1, -1, -1):
                stack.append(node[k])
                if k:
                    stack.append(" ")
            stack.append("(")
        else:
            out.append(node)
    return "".join(out)


def core(tree):
    """An FPCore from its s-expression, with its properties dropped but for name and precondition."""
    rest = tree[1:]
    ident = rest.pop(0) if isinstance(rest[0], str) else None
    args = [arg[-1] if isinstance(arg, list) and arg[0] == "!" else arg for arg in rest.pop(0)]
    name, pre = ident, None
    while isinstance(rest[0], str) and rest[0].startswith(":") and len(rest) > 1:
        key, value = rest[0], rest[1]
        rest = rest[2:]
        if key == ":name":
            name = value.strip('"')
        elif key == ":pre":
            pre = value
    return Core(ident, args, name or "", pre, rest[0])


def cores(text):
    """All FPCores of a file."""
    return [core(tree) for tree in read(text) if isinstance(tree, list) and tree and tree[0] == "FPCore"]


def stored(c):
    """What is kept of an FPCore: arguments, name, precondition, expression."""
    parts = ["FPCore"] + ([c.ident] if c.ident else []) + [c.args, ":name", '"%s"' % c.name]
    if c.pre is not None:
        parts += [":pre", c.pre]
    return write(parts + [c.body])


def rational(token):
    """The exact value of a literal, or None."""
    if NUMBER.match(token):
        return Fraction(token)
    ratio = RATIO.match(token)
    if ratio:
        return Fraction(int(ratio[1]), int(ratio[2]))
    if re.match(r"[+-]?0x", token):
        sign = -1 if token[0] == "-" else 1
        match = re.match(r"[+-]?0x([0-9a-fA-F]*)\.?([0-9a-fA-F]*)(?:p([+-]?\d+))?\Z", token)
        if match:
            whole, part, power = match[1] or "0", match[2] or "", int(match[3] or 0)
            return sign * Fraction(int(whole + part, 16), 16 ** len(part)) * Fraction(2) ** power
    return None


# ------------------------------------------------------------------------------------------------------- the language's text

KEYWORDS = "param in show where if then else and or not true false until"
CONSTANTS_OF_OURS = "pi tau phi e i inf nan time pixel f"
FUNCTIONS_OF_OURS = """abs acos acosh acot acoth acsc acsch arccos arccosh arcosh arcsin arctan arg arsinh artanh asec
asech asin asinh atan atan2 atanh box capsule cbrt ceil cellular cellular_border circle clamp complex cone conj cos cosh
cot coth cross csc csch curl cylinder degrees diff digamma distance div dot ellipsoid exp exp2 expm1 faceforward fbm floor
fmod frac fract gamma gaussian_curvature grad hash heaviside hessian hypot im imag integral inversesqrt iterate jacobian
laplacian lb length lg lgamma ln log log10 log1p log2 max mean_curvature min mix mod noise normalize octahedron plane pow
product psi quadrature radians re real reflect refract remap repeat ring rotate round round_box saturate sec sech segment
sgn sign sin sinc sinh smax smin smootherstep smoothstep sphere sqrt step sum tan tanh torus trigamma trunc turbulence
value_noise vec2 vec3 vec4 bool""".split()
TAKEN = set(KEYWORDS.split()) | set(CONSTANTS_OF_OURS.split()) | set(FUNCTIONS_OF_OURS)

CONSTANTS = {
    "PI": "pi", "E": "e", "LN2": "log(2)", "LN10": "log(10)", "LOG2E": "1/log(2)", "LOG10E": "1/log(10)",
    "PI_2": "pi/2", "PI_4": "pi/4", "M_1_PI": "1/pi", "M_2_PI": "2/pi", "M_2_SQRTPI": "2/sqrt(pi)",
    "SQRT2": "sqrt(2)", "SQRT1_2": "sqrt(1/2)", "TRUE": "true", "FALSE": "false",
}
CALLS = {
    "sqrt": 1, "cbrt": 1, "exp": 1, "exp2": 1, "expm1": 1, "log": 1, "log2": 1, "log10": 1, "log1p": 1, "sin": 1,
    "cos": 1, "tan": 1, "asin": 1, "acos": 1, "atan": 1, "sinh": 1, "cosh": 1, "tanh": 1, "asinh": 1, "acosh": 1,
    "atanh": 1, "floor": 1, "ceil": 1, "trunc": 1, "round": 1, "atan2": 2, "hypot": 2, "fmin": 2, "fmax": 2, "fmod": 2,
    "fabs": 1, "tgamma": 1, "lgamma": 1,
}
OUR_NAMES = {"fmin": "min", "fmax": "max", "fabs": "abs", "tgamma": "gamma"}
COMPARISONS = {"<": "<", "<=": "<=", ">": ">", ">=": ">=", "==": "==", "!=": "!="}

# ranks of our grammar, loose to tight
OPEN, OR, AND, NOT, COMPARE, SUM, PRODUCT, PREFIX, POWER, ATOM = range(10)


class Translator:
    """Writes one FPCore in our language. `others` are the FPCores of the file that it may call."""

    STEPS = 100_000

    def __init__(self, c, others):
        self.core, self.others = c, others
        self.used, self.calls, self.budget = set(TAKEN), [], self.STEPS

    def fresh(self, name):
        latin = "".join(c if c.isascii() else unicodedata.name(c, "").split()[-1].lower() for c in name)
        plain = re.sub(r"[^A-Za-z0-9_]", "_", latin)
        if not plain or plain[0].isdigit():
            plain = "v" + plain
        word, k = plain, 1
        while word in self.used:
            k += 1
            word = plain + "_" if k == 2 else f"{plain}_{k}"
        self.used.add(word)
        return word

    def program(self):
        """Names of the columns, and the text."""
        env, names = {}, []
        for arg in self.core.args:
            names += self.declare(arg, env)
        body = self.text(self.core.body, env, OPEN)
        if not names:
            raise Unfit("no arguments: a constant, computed when it is compiled")
        head = f"{names[0]}: real" if len(names) == 1 else ", ".join(names)
        return names, f"f({head}) = {body}"

    def declare(self, arg, env):
        """An argument, or the components of one that is a small vector."""
        if isinstance(arg, str):
            env[arg] = self.fresh(arg)
            return [env[arg]]
        if len(arg) == 2 and arg[1].isdigit():
            words = [self.fresh(f"{arg[0]}{k}") for k in range(int(arg[1]))]
            env[arg[0]] = words
            return words
        raise Unfit("arrays of unknown size")

    def at(self, rank, least, text):
        return text if rank >= least else f"({text})"

    def text(self, node, env, least):
        """The text of a node that can stand where operands bind at least as tightly as `least`."""
        text, rank = self.node(node, env)
        return self.at(rank, least, text)

    def node(self, node, env):
        if isinstance(node, str):
            return self.leaf(node, env)
        head = node[0]
        if not isinstance(head, str):
            raise Unfit("not an operation")
        args = node[1:]
        if head == "!":
            return self.node(args[-1], env)
        if head == "cast":
            return self.node(args[0], env)
        method = getattr(self, "do_" + WORDS.get(head, head.rstrip("*")), None)
        if method and head in SPECIAL:
            return method(head, args, env)
        if head in CALLS:
            if len(args) != CALLS[head]:
                raise Unfit(f"{head} of {len(args)}")
            inner = ", ".join(self.text(a, env, COMPARE) for a in args)
            return f"{OUR_NAMES.get(head, head)}({inner})", ATOM
        if head in COMPARISONS:
            return self.comparison(head, args, env)
        if head in self.others:
            return self.call(head, args, env)
        raise Unfit(f"`{head}`")

    def leaf(self, token, env):
        if token in env:
            if isinstance(env[token], list):
                raise Unfit("a vector as a value")
            return env[token], ATOM
        value = rational(token)
        if value is not None:
            return self.literal(token, value)
        if token in CONSTANTS:
            text = CONSTANTS[token]
            return text, (PRODUCT if "/" in text and "(1/2)" not in text else ATOM)
        if token in ("INFINITY", "NAN"):
            return {"INFINITY": "inf", "NAN": "nan"}[token], ATOM
        raise Unfit(f"`{token}`")

    def literal(self, token, value):
        if value < 0:
            text, rank = self.literal(token.lstrip("-"), -value)
            return "-" + self.at(rank, PREFIX, text), PREFIX
        token = token.lstrip("+")
        if re.match(r"\d+(\.\d+)?([eE][+-]?\d+)?\Z", token):
            if value > Fraction(1.7976931348623157e308):
                raise Unfit("a number beyond doubles")
            return token, ATOM
        if RATIO.match(token):
            return token, PRODUCT
        if NUMBER.match(token):
            return re.sub(r"^\.", "0.", re.sub(r"\.(?=[eE]|$)", ".0", token)), ATOM
        return (str(value.numerator), ATOM) if value.denominator == 1 else (f"{value.numerator}/{value.denominator}", PRODUCT)

    # operations with a form of their own

    def do_add(self, head, args, env):
        if len(args) == 1:
            return self.node(args[0], env) if head == "+" else ("-" + self.text(args[0], env, POWER), PREFIX)
        text = self.text(args[0], env, SUM)
        for arg in args[1:]:
            right, rank = self.node(arg, env)
            text += f" {head} " + (f"({right})" if rank in (PREFIX, SUM) or rank < SUM else right)
        return text, SUM

    def do_mul(self, head, args, env):
        if len(args) == 1:
            return (self.node(args[0], env)) if head == "*" else (f"1/{self.text(args[0], env, POWER)}", PRODUCT)
        text = self.text(args[0], env, PRODUCT)
        for arg in args[1:]:
            text += (" * " if head == "*" else "/") + self.text(arg, env, POWER)
        return text, PRODUCT

    def do_pow(self, head, args, env):
        base = self.text(args[0], env, ATOM)
        return f"{base}^{self.text(args[1], env, ATOM)}", POWER

    def do_fma(self, head, args, env):
        return self.do_add("+", [["*", args[0], args[1]], args[2]], env)

    def do_copysign(self, head, args, env):
        size, sign = self.text(args[0], env, COMPARE), self.text(args[1], env, SUM)
        return f"if {sign} < 0 then -abs({size}) else abs({size})", OPEN

    def do_if(self, head, args, env):
        condition = self.text(args[0], env, OR)
        chosen = self.text(args[1], env, SUM)
        return f"if {condition} then {chosen} else {self.alternative(args[2], env)}", OPEN

    def alternative(self, node, env):
        if isinstance(node, list) and node[0] == "if":
            return self.text(node, env, OPEN)
        return self.text(node, env, SUM)

    def do_logic(self, head, args, env):
        rank = AND if head == "and" else OR
        return f" {head} ".join(self.text(a, env, rank + 1) for a in args), rank

    def do_not(self, head, args, env):
        return "not " + self.text(args[0], env, ATOM), NOT

    def comparison(self, head, args, env):
        if head == "!=" and len(args) > 2:
            pairs = [["!=", a, b] for k, a in enumerate(args) for b in args[k + 1 :]]
            return self.do_logic("and", pairs, env)
        return f" {COMPARISONS[head]} ".join(self.text(a, env, SUM) for a in args), COMPARE

    def do_let(self, head, args, env):
        locals_, inner = [], dict(env)
        node = [head] + args
        while isinstance(node, list) and node[0] in ("let", "let*"):
            scope = dict(inner)
            for name, value in node[1]:
                text = self.text(value, scope if node[0] == "let*" else inner, COMPARE)
                word = self.fresh(name)
                locals_.append(f"{word} = {text}")
                scope[name] = word
            inner = scope
            node = node[2]
        body = self.text(node, inner, OR)
        return f"{body} where {', '.join(locals_)}", OPEN

    def do_while(self, head, args, env):
        condition, bindings, body = args
        if condition == "TRUE":
            raise Unfit("a loop that does not end")
        # the bound on steps is shared with the loops within
        before = self.budget
        steps = before // 100 ** self.depth(args)
        self.budget = before // steps
        result = self.while_of(head, condition, bindings, body, env, steps)
        self.budget = before
        return result

    def depth(self, loop):
        """How many loops stand within this one, in its condition and states."""
        deepest, stack = 0, [(part, 0) for part in loop[:2]]
        while stack:
            node, level = stack.pop()
            if isinstance(node, list):
                level += bool(node) and node[0] in ("while", "while*")
                deepest = max(deepest, level)
                stack += [(child, level) for child in node]
        return deepest

    def while_of(self, head, condition, bindings, body, env, steps):
        sequential = head == "while*"
        start, inside, starts = dict(env), dict(env), []
        for name, first, _ in bindings:
            text = self.text(first, start if sequential else env, COMPARE)
            word = self.fresh(name)
            starts.append((word, text))
            inside[name] = word
            if sequential:
                # the starts do not see the states: what an earlier one is, is written out
                start[name] = f"({text})"
        names, new, locals_ = [name for name, _, _ in bindings], dict(inside), []
        updates = []
        for name, _, update in bindings:
            text = self.text(update, new if sequential else inside, COMPARE)
            if sequential:
                word = self.fresh(name + "_next")
                locals_.append(f"{word} = {text}")
                new[name] = word
                text = word
            updates.append(text)
        step = ", ".join(updates)
        if 1 < len(updates) <= 4:
            step = f"({step})"
            if locals_:
                step += " where " + ", ".join(locals_)
        elif locals_:
            # locals of all steps go with a bracket, which holds four at most: here each step has its own
            step = ", ".join(f"({u} where {', '.join(locals_[: k + 1])})" for k, u in enumerate(updates))
        until = self.text(["not", condition], inside, OR)
        state = ", ".join(f"{word} = {text}" for word, text in starts)
        loop = f"iterate({steps}, {state}, {step} until {until})"
        word = self.fresh("loop" if len(names) > 1 else names[0])
        after = dict(env)
        for name in names:
            after[name] = f"{word}.{inside[name]}" if len(names) > 1 else word
        return f"{self.text(body, after, OR)} where {word} = {loop}", OPEN

    def do_ref(self, head, args, env):
        if len(args) == 2 and isinstance(args[0], str) and isinstance(env.get(args[0]), list) and args[1].isdigit():
            return env[args[0]][int(args[1])], ATOM
        raise Unfit("elements of arrays")

    def call(self, head, args, env):
        """A call of another FPCore, written in its place."""
        other = self.others[head]
        if head in self.calls:
            raise Unfit("recursion")
        self.calls.append(head)
        names = [a for a in other.args]
        if any(not isinstance(a, str) for a in names) or len(names) != len(args):
            raise Unfit("calls with arrays")
        bindings = [[name, value] for name, value in zip(names, args)]
        text = self.do_let("let", [bindings, other.body], env)
        self.calls.pop()
        return text


WORDS = {"+": "add", "-": "add", "*": "mul", "/": "mul", "and": "logic", "or": "logic"}
SPECIAL = {"+", "-", "*", "/", "pow", "fma", "copysign", "if", "and", "or", "not", "let", "let*", "while", "while*", "ref"}

# ------------------------------------------------------------------------------------------------------------------ exact values


class Undecided(Exception):
    """The balls are too wide to decide; more precision may help."""


class Invalid(Exception):
    """The expression has no real value at the point."""


class Slow(Exception):
    """More steps than are worth it."""


def need(certainly_not, certainly):
    if certainly_not:
        raise Invalid
    if not certainly:
        raise Undecided


def checked(value):
    if not value.is_finite():
        raise Undecided
    return value


def real_sqrt(x):
    need(x < 0, x >= 0 or x.is_zero())
    return x.sqrt()


def real_log(x):
    need(x <= 0, x > 0)
    return x.log()


def real_cbrt(x):
    if x.is_zero():
        return x
    if x > 0:
        return x.root(3)
    if x < 0:
        return -((-x).root(3))
    raise Undecided


def real_div(x, y):
    need(y.is_zero(), not y.contains(0))
    return x / y


def real_pow(x, y):
    if y.is_exact() and y.is_integer():
        n = int(y.unique_fmpz())
        if n == 0:
            return arb(1)
        if n < 0:
            need(x.is_zero(), not x.contains(0))
        if abs(n) < 1 << 40:
            return x**y
    if x.is_zero():
        need(y <= 0, y > 0)
        return arb(0)
    need(x < 0 and not y.contains_integer(), x > 0)
    return (x.log() * y).exp()


def within_one(f, strict):
    def g(x):
        if strict:
            need(abs(x) >= 1, abs(x) < 1)
        else:
            need(abs(x) > 1, abs(x) <= 1)
        return f(x)

    return g


def real_acosh(x):
    need(x < 1, x >= 1)
    return x.acosh()


def real_log1p(x):
    need(x <= -1, x > -1)
    return x.log1p()


def integer(f):
    """A function that is constant between integers (or halves)."""

    def g(x):
        low, high = f(x.lower()), f(x.upper())
        if not (low.is_exact() and high.is_exact() and low == high):
            raise Undecided
        return low

    return g


def truncated(x):
    return x.floor() if x >= 0 else x.ceil()


def rounded(x):
    """To the nearest, halves away from zero, as C's round."""
    return (x + arb(0.5)).floor() if x >= 0 else (x - arb(0.5)).ceil()


def real_fmod(x, y):
    need(y.is_zero(), not y.contains(0))
    return x - y * integer(truncated)(x / y)


def real_atan2(y, x):
    if y.is_zero() and x.is_zero():
        raise Invalid
    if y.is_zero() and x < 0:
        return arb.pi()
    if y.contains(0) and not x > 0:
        raise Undecided
    return arb.atan2(y, x)


def real_gamma(x):
    need(x.is_exact() and x.is_integer() and x <= 0, x > 0 or not x.contains_integer())
    return x.gamma()


def real_lgamma(x):
    if x > 0:
        return x.lgamma()
    return real_log(abs(real_gamma(x)))


def copysign(x, y):
    if y < 0:
        return -abs(x)
    if y >= 0:
        return abs(x)
    raise Undecided


UNARY = {
    "sqrt": real_sqrt, "cbrt": real_cbrt, "exp": arb.exp, "expm1": arb.expm1, "log": real_log, "log1p": real_log1p,
    "exp2": lambda x: (x * arb.const_log2()).exp(), "log2": lambda x: real_log(x) / arb.const_log2(),
    "log10": lambda x: real_log(x) / arb.const_log10(), "sin": arb.sin, "cos": arb.cos, "tan": arb.tan,
    "asin": within_one(arb.asin, False), "acos": within_one(arb.acos, False), "atan": arb.atan, "sinh": arb.sinh,
    "cosh": arb.cosh, "tanh": arb.tanh, "asinh": arb.asinh, "acosh": real_acosh, "atanh": within_one(arb.atanh, True),
    "fabs": abs, "floor": integer(arb.floor), "ceil": integer(arb.ceil), "trunc": integer(truncated),
    "round": integer(rounded), "tgamma": real_gamma, "lgamma": real_lgamma,
}
BINARY = {
    "pow": real_pow, "atan2": real_atan2, "hypot": lambda x, y: (x * x + y * y).sqrt(), "fmin": arb.min, "fmax": arb.max,
    "fmod": real_fmod, "copysign": copysign,
}
FIXED = {
    "PI": arb.pi, "E": arb.const_e, "LN2": arb.const_log2, "LN10": arb.const_log10, "LOG2E": lambda: 1 / arb.const_log2(),
    "LOG10E": lambda: 1 / arb.const_log10(), "PI_2": lambda: arb.pi() / 2, "PI_4": lambda: arb.pi() / 4,
    "M_1_PI": lambda: 1 / arb.pi(), "M_2_PI": lambda: 2 / arb.pi(), "M_2_SQRTPI": lambda: 2 / arb.pi().sqrt(),
    "SQRT2": lambda: arb(2).sqrt(), "SQRT1_2": lambda: (arb(1) / 2).sqrt(), "TRUE": lambda: True, "FALSE": lambda: False,
}
PARSED = {}


def literal_ball(token):
    value = PARSED.get(token)
    if value is None:
        exact = rational(token)
        if exact is None:
            raise Unfit(f"`{token}`")
        value = PARSED[token] = fmpq(exact.numerator, exact.denominator)
    return arb(value)


def holds(op, a, b):
    """Whether a comparison of balls holds, where that is certain."""
    yes, no = {
        "<": (a < b, a >= b), "<=": (a <= b, a > b), ">": (a > b, a <= b), ">=": (a >= b, a < b),
        "==": (a.is_exact() and b.is_exact() and a == b, a != b), "!=": (a != b, a.is_exact() and b.is_exact() and a == b),
    }[op]
    if yes:
        return True
    if no:
        return False
    raise Undecided


class Exact:
    """Evaluates FPCore trees in balls, at the precision of `ctx`."""

    unary, binary, fixed = UNARY, BINARY, FIXED
    literal, holds, div = staticmethod(literal_ball), staticmethod(holds), staticmethod(real_div)
    checked = staticmethod(checked)

    def __init__(self, others=None, steps=0):
        self.others, self.steps = others or {}, steps

    def value(self, node, env):
        if isinstance(node, str):
            if node in env:
                return env[node]
            if node in self.fixed:
                return self.fixed[node]()
            return self.literal(node)
        head, args = node[0], node[1:]
        if head in ("+", "-", "*", "/"):
            return self.arithmetic(head, [self.value(a, env) for a in args])
        if head in self.unary:
            return self.checked(self.unary[head](self.value(args[0], env)))
        if head in self.binary:
            return self.checked(self.binary[head](self.value(args[0], env), self.value(args[1], env)))
        if head in COMPARISONS:
            values = [self.value(a, env) for a in args]
            if head == "!=":
                return all(self.holds(head, a, b) for k, a in enumerate(values) for b in values[k + 1 :])
            return all(self.holds(head, a, b) for a, b in zip(values, values[1:]))
        if head == "if":
            return self.value(args[1] if self.value(args[0], env) else args[2], env)
        if head == "and":
            return all(self.value(a, env) for a in args)
        if head == "or":
            return any(self.value(a, env) for a in args)
        if head == "not":
            return not self.value(args[0], env)
        if head == "=>":
            return not self.value(args[0], env) or self.value(args[1], env)
        if head in ("let", "let*"):
            inner = dict(env)
            for name, value in args[0]:
                inner[name] = self.value(value, inner if head == "let*" else env)
            return self.value(args[1], inner)
        if head in ("while", "while*"):
            return self.loop(head, args, env)
        if head == "fma":
            a, b, c = (self.value(x, env) for x in args)
            return a * b + c
        if head == "!":
            return self.value(args[-1], env)
        if head == "cast":
            return self.value(args[0], env)
        if head == "ref":
            return env[args[0]][int(args[1])]
        if head in self.others:
            other = self.others[head]
            return self.value(other.body, {n: self.value(a, env) for n, a in zip(other.args, args)})
        raise Unfit(f"`{head}`")

    def arithmetic(self, head, values):
        if len(values) == 1:
            return -values[0] if head == "-" else values[0] if head in "+*" else self.div(self.literal("1"), values[0])
        result = values[0]
        for value in values[1:]:
            if head == "+":
                result = result + value
            elif head == "-":
                result = result - value
            elif head == "*":
                result = result * value
            else:
                result = self.div(result, value)
        return self.checked(result)

    def loop(self, head, args, env):
        condition, bindings, body = args
        inner = dict(env)
        for name, start, _ in bindings:
            inner[name] = self.value(start, inner if head == "while*" else env)
        count = 0
        while self.value(condition, inner):
            count += 1
            if count > self.steps:
                raise Slow
            if head == "while*":
                for name, _, update in bindings:
                    inner[name] = self.value(update, inner)
            else:
                new = {name: self.value(update, inner) for name, _, update in bindings}
                inner.update(new)
        return self.value(body, inner)


def at_precision(bits, run):
    """What `run` gives at a precision of so many bits."""
    before, ctx.prec = ctx.prec, bits
    try:
        return run()
    finally:
        ctx.prec = before
