"""Formulas that stability rewrites improve, at points where they lose digits and at extremes.

Writes tests/data/rewrites/*.tsv: a formula in the language with the rules that must act on it, then rows of arguments
and the exact value, 25 digits of mpmath at a precision of thousands of bits. Nothing here knows the compiler.

    python3 tests/oracle/rewrites.py
"""

import random
from pathlib import Path

import mpmath
from mpmath import mp, mpc, mpf

mp.prec = 2400
random.seed(7)
OUT = Path(__file__).parent.parent / "data" / "rewrites"


def size(lo, hi, sign=True):
    """A number of any size between, its logarithm uniform."""
    def draw():
        x = mp.mpf(2) ** mpf(random.uniform(float(mp.log(lo, 2)), float(mp.log(hi, 2))))
        return float(x) * (random.choice((-1, 1)) if sign else 1)
    return draw


def up(lo, hi):
    return size(lo, hi, sign=False)


def near(c, lo, hi):
    """A number near c, its distance of any size between."""
    d = size(lo, hi)
    return lambda: float(c) + d()


def point(*draws):
    return lambda: [d() for d in draws]


def close(lo, hi, dlo, dhi):
    """Two numbers near one another."""
    def draw():
        x = size(lo, hi)()
        return [x, x * (1 + size(dlo, dhi)())]
    return draw


def close_up(lo, hi, dlo, dhi):
    def draw():
        x = up(lo, hi)()
        return [x, x * (1 + size(dlo, dhi)())]
    return draw


any_ = size(1e-30, 1e30)
wide = up(1e-30, 1e30)
small = size(1e-20, 2)
exponent = size(1e-15, 80)
log, exp, sqrt, sin, cos, tan = mp.log, mp.exp, mp.sqrt, mp.sin, mp.cos, mp.tan

MORE = [
    ("cardinal", "f(x: real) = sin(x)/x", lambda x: sin(x)/x, point(size(1e-50, 1e3))),
    ("cardinal", "f(x: real) = 3*x/sin(2*x)", lambda x: 3*x/sin(2*x), point(size(1e-50, 1e3))),
    ("cardinal,one-minus-cos", "f(x: real) = (1 - cos(3*x))/x^2", lambda x: (1-cos(3*x))/x**2, point(size(1e-50, 1e3))),
    ("cardinal,expm1", "f(x: real) = x/(exp(x) - 1)", lambda x: x/(exp(x)-1), point(size(1e-50, 500))),
    ("root-of-squares", "f(x, y) = sqrt(x^2 - y^2)", lambda x, y: sqrt(x*x - y*y), lambda: (lambda y: [y*(1 + up(1e-14, 1e3)()), y])(up(1e-200, 1e200)())),
    ("log-tan", "f(x: real) = log(tan(pi/4 + x))", lambda x: log(tan(mp.pi/4 + x)), point(size(1e-20, 0.7))),
    ("log-tan", "f(x: real) = log(tan(pi/4 - x/2))", lambda x: log(tan(mp.pi/4 - x/2)), point(size(1e-20, 1.5))),
    ("log-sum", "f(x: real) = log(1 + exp(x))", lambda x: mp.log1p(exp(x)), point(size(1e-5, 1e5))),
    ("log-sum", "f(x, y) = log(exp(x) + exp(y))", lambda x, y: log(exp(x) + exp(y)), point(size(10, 1e4), size(10, 1e4))),
    ("log-cosh", "f(x: real) = log(cosh(x))", lambda x: log(mp.cosh(x)), point(size(1e-20, 1e5))),
    ("log-cosh", "f(x: real) = log(sinh(x))", lambda x: log(mp.sinh(x)), point(up(1e-5, 1e5))),
    ("log-cosh", "f(x: real) = log(abs(sinh(x)))", lambda x: log(abs(mp.sinh(x))), point(size(1e-5, 1e5))),
    ("logistic", "f(x: real) = 2/(1 + exp(-2*x)) - 1", mp.tanh, point(size(1e-20, 300))),
    ("logistic", "f(x: real) = 1 - 1/(1 + exp(-x))", lambda x: 1/(1 + exp(x)), point(size(1e-5, 600))),
    ("acos-near-one", "f(x: real) = acos(1 - x)", lambda x: mp.acos(1 - x), point(up(1e-30, 1.99))),
    ("gudermannian", "f(x: real) = 2*(atan(exp(x)) - pi/4)", lambda x: mp.atan(mp.sinh(x)), point(size(1e-20, 50))),
    ("hypot", "f(x: real) = sqrt(2*x^2)", lambda x: sqrt(2)*abs(x), point(size(1e-200, 1e200))),
]

OWN = {formula for _, formula, _, _ in MORE}

REAL = [
    ("cancel", "f(x, y) = (x + y) - x", lambda x, y: y, point(any_, any_)),
    ("constants,sinh", "f(x: real) = (exp(x) - exp(-x))/2", mp.sinh, point(exponent)),
    ("quotients,cancel", "f(x: real) = 1/(x + 1) - 1/x", lambda x: 1/(x+1) - 1/x, point(size(1e-9, 1e9))),
    ("quotients", "f(x: real) = 1/(x + 1) - 2/x + 1/(x - 1)", lambda x: 1/(x+1) - 2/x + 1/(x-1), point(size(1.5, 1e9))),
    ("quotients", "f(x: real) = x/(x + 1) - (x + 1)/(x - 1)", lambda x: x/(x+1) - (x+1)/(x-1), point(size(2, 1e12))),
    ("factor,sqrt-difference", "f(x, y) = y*sqrt(x + 1) - y*sqrt(x)", lambda x, y: y*(sqrt(x+1) - sqrt(x)), point(wide, any_)),
    ("squares", "f(x, y) = x^2 - y^2", lambda x, y: x*x - y*y, close(1e-20, 1e20, 1e-15, 0.5)),
    ("squares", "f(x, y) = x^2 - y^2", lambda x, y: x*x - y*y, point(any_, any_)),
    ("squares", "f(x: real) = (x + 1)*(x + 1) - 1", lambda x: (x+1)**2 - 1, point(size(1e-20, 1e20))),
    ("cubes", "f(x, y) = x^3 - y^3", lambda x, y: x**3 - y**3, close(1e-10, 1e10, 1e-15, 0.5)),
    ("cubes", "f(x, y) = (x + y)^5 - x^5", lambda x, y: (x+y)**5 - x**5, point(size(1, 1e9), size(1e-9, 1))),
    ("sqrt-difference", "f(x: real) = sqrt(x + 1) - sqrt(x)", lambda x: sqrt(x+1) - sqrt(x), point(wide)),
    ("sqrt-difference", "f(x, y) = sqrt(x) - sqrt(y)", lambda x, y: sqrt(x) - sqrt(y), close_up(1e-20, 1e20, 1e-15, 0.5)),
    ("quotients,sqrt-difference", "f(x: real) = 1/sqrt(x) - 1/sqrt(x + 1)", lambda x: 1/sqrt(x) - 1/sqrt(x+1), point(up(1e-10, 1e25))),
    ("conjugate", "f(x, y, z) = (-y + sqrt(y^2 - 4 x z))/(2 x)", lambda a, b, c: (-b + sqrt(b*b - 4*a*c))/(2*a),
     lambda: [random.choice((-1, 1))*up(1e-6, 1e3)(), size(1e4, 1e9)(), up(1e-6, 1e3)()]),
    ("conjugate", "f(x, y, z) = (-y - sqrt(y^2 - 4 x z))/(2 x)", lambda a, b, c: (-b - sqrt(b*b - 4*a*c))/(2*a),
     lambda: [random.choice((-1, 1))*up(1e-6, 1e3)(), size(1e4, 1e9)(), up(1e-6, 1e3)()]),
    ("conjugate", "f(x: real) = sqrt(x^2 + 1) - x", lambda x: sqrt(x*x+1) - x, point(size(1e-10, 1e100))),
    ("conjugate", "f(x: real) = sqrt(1 + x) - 1", lambda x: sqrt(1+x) - 1, point(small)),
    ("cbrt-difference", "f(x: real) = cbrt(x + 1) - cbrt(x)", lambda x: mp.cbrt(x+1) - mp.cbrt(x), point(wide)),
    ("log-difference", "f(x: real) = log(x + 1) - log(x)", lambda x: log(x+1) - log(x), point(wide)),
    ("log-difference", "f(x, y) = log(x) - log(y)", lambda x, y: log(x) - log(y), close_up(1e-20, 1e20, 1e-15, 0.5)),
    ("log-quotient", "f(x: real) = log((1 - x)/(1 + x))", lambda x: log((1-x)/(1+x)), point(size(1e-20, 0.99))),
    ("log1p", "f(x: real) = log(1 - x)/log(1 + x)", lambda x: log(1-x)/log(1+x), point(size(1e-20, 0.99))),
    ("log-power", "f(x: real) = log(abs(x^8))", lambda x: 8*log(abs(x)), point(size(1e-200, 1e200))),
    ("log-power", "f(x: real) = log(exp(x))", lambda x: x, point(size(1e-10, 1e5))),
    ("exp-difference", "f(x, y) = exp(x + y) - exp(x)", lambda x, y: exp(x+y) - exp(x), point(size(1e-3, 80), size(1e-12, 2))),
    ("exp-difference", "f(x, y) = exp(x) - exp(y)", lambda x, y: exp(x) - exp(y), close(1e-3, 80, 1e-13, 0.5)),
    ("expm1", "f(x: real) = (exp(x) - 1)/x", lambda x: (exp(x)-1)/x, point(size(1e-200, 80))),
    ("sinh", "f(x: real) = exp(x) - exp(-x)", lambda x: 2*mp.sinh(x), point(exponent)),
    ("cosh,cosh-minus-one", "f(x: real) = exp(x) - 2 + exp(-x)", lambda x: 2*mp.cosh(x) - 2, point(exponent)),
    ("exp-product", "f(x, y) = exp(x)*exp(-x + y)", lambda x, y: exp(y), point(size(1, 2000), size(1e-3, 50))),
    ("exp-ratio", "f(x: real) = exp(x)/(exp(x) - 1)", lambda x: exp(x)/(exp(x)-1), point(size(1e-10, 2000))),
    ("exponential-ratio", "f(x: real) = (exp(x) - exp(-x))/(exp(x) + exp(-x))", mp.tanh, point(size(1e-10, 2000))),
    ("exponential-ratio", "f(x: real) = sqrt((exp(2*x) - 1)/(exp(x) - 1))", lambda x: sqrt(exp(x)+1), point(size(1e-10, 600))),
    ("power-minus-one", "f(x, y) = 1 - (1 - x)^y", lambda x, y: 1 - (1-x)**y, point(up(1e-15, 0.99), up(0.01, 50))),
    ("power-difference", "f(x, y) = (x + 1)^(1/y) - x^(1/y)", lambda x, y: (x+1)**(1/y) - x**(1/y), point(wide, lambda: float(2**random.randint(0, 6)))),
    ("compound-power", "f(x, y) = (1 + x/y)^y", lambda x, y: (1+x/y)**y, point(size(0.01, 10), lambda: float(2**random.randint(5, 50)))),
    ("one-minus-cos", "f(x: real) = 1 - cos(x)", lambda x: 1 - cos(x), point(size(1e-100, 1e5))),
    ("one-minus-cos", "f(x: real) = (1 - cos(x))/x^2", lambda x: (1-cos(x))/x**2, point(size(1e-50, 1e5))),
    ("cosh-minus-one", "f(x: real) = cosh(x) - 1", lambda x: mp.cosh(x) - 1, point(size(1e-100, 80))),
    ("pythagoras", "f(x: real) = 1 - cos(x)^2", lambda x: sin(x)**2, point(size(1e-100, 1e5))),
    ("pythagoras", "f(x: real) = 1 - tanh(x)^2", lambda x: 1/mp.cosh(x)**2, point(size(1e-10, 200))),
    ("one-minus-tanh", "f(x: real) = 1 - tanh(x)", lambda x: 1 - mp.tanh(x), point(size(1e-10, 300))),
    ("sin-difference", "f(x, y) = sin(x + y) - sin(x)", lambda x, y: sin(x+y) - sin(x), point(size(1e-3, 1e6), size(1e-15, 3))),
    ("sin-difference", "f(x, y) = sin(x) - sin(y)", lambda x, y: sin(x) - sin(y), close(1e-3, 1e3, 1e-13, 0.5)),
    ("cos-difference", "f(x, y) = cos(x + y) - cos(x)", lambda x, y: cos(x+y) - cos(x), point(size(1e-3, 1e6), size(1e-15, 3))),
    ("tan-difference", "f(x, y) = tan(x + y) - tan(x)", lambda x, y: tan(x+y) - tan(x), point(size(1e-3, 1e3), size(1e-15, 3))),
    ("tan-half", "f(x: real) = (1 - cos(x))/sin(x)", lambda x: tan(x/2), point(size(1e-100, 1e5))),
    ("atan-difference", "f(x: real) = atan(x + 1) - atan(x)", lambda x: mp.atan(x+1) - mp.atan(x), point(any_)),
    ("hyperbolic-difference", "f(x, y) = cosh(x + y) - cosh(x)", lambda x, y: mp.cosh(x+y) - mp.cosh(x), point(size(1e-3, 50), size(1e-15, 3))),
    ("hyperbolic-difference", "f(x: real) = tanh(x + 1) - tanh(x)", lambda x: mp.tanh(x+1) - mp.tanh(x), point(size(1e-3, 100))),
    ("hypot", "f(x, y) = sqrt(x^2 + y^2)", lambda x, y: sqrt(x*x+y*y), point(size(1e-200, 1e200), size(1e-200, 1e200))),
    ("hypot", "f(x, y) = sqrt((x - 1)^2 + y^2)", lambda x, y: sqrt((x-1)**2+y*y), point(size(1e-10, 1e200), size(1e-200, 1e200))),
    ("asinh", "f(x: real) = log(x + sqrt(x^2 + 1))", mp.asinh, point(size(1e-20, 1e200))),
    ("asinh", "f(x: real) = log(x + sqrt(x^2 - 1))", mp.acosh, point(up(1.01, 1e200))),
    ("remainder", "f(x: real) = x - sin(x)", lambda x: x - sin(x), point(size(1e-50, 1e3))),
    ("remainder", "f(x: real) = exp(x) - 1 - x", lambda x: exp(x) - 1 - x, point(size(1e-50, 80))),
    ("remainder", "f(x: real) = cos(x) - 1 + x^2/2", lambda x: cos(x) - 1 + x*x/2, point(size(1e-50, 1e3))),
    ("remainder,quotients", "f(x: real) = 1/x - 1/tan(x)", lambda x: 1/x - 1/tan(x), point(size(1e-20, 1.5))),
    ("remainder", "f(x: real) = (x - sin(x))/(x - tan(x))", lambda x: (x-sin(x))/(x-tan(x)), point(size(1e-20, 1.5))),
    ("products,log-difference", "f(x: real) = (x + 1)*log(x + 1) - x*log(x) - 1", lambda x: (x+1)*log(x+1) - x*log(x) - 1, point(up(10, 1e30))),
    *MORE,
]


def z(lo, hi):
    return lambda: mpc(size(lo, hi)(), size(lo, hi)())


COMPLEX = [
    ("log1p", "f(z) = log(1 + z)", lambda z: log(1+z), z(1e-30, 0.4)),
    ("expm1", "f(z) = (exp(z) - 1)/z", lambda z: (exp(z)-1)/z, z(1e-30, 3)),
    ("one-minus-cos", "f(z) = 1 - cos(z)", lambda z: 1 - cos(z), z(1e-30, 3)),
    ("sqrt-difference", "f(z) = sqrt(z + 1) - sqrt(z)", lambda z: sqrt(z+1) - sqrt(z), z(1e-3, 1e20)),
    ("log-difference", "f(z) = log(z + 1) - log(z)", lambda z: log(z+1) - log(z), z(1e-3, 1e20)),
    ("squares", "f(z) = z^2 - 1", lambda z: z*z - 1, lambda: mpc(near(1, 1e-15, 0.5)(), size(1e-15, 0.5)())),
    ("complex-squares", "f(z) = z^2 + 1", lambda z: z*z + 1, lambda: mpc(size(1e-15, 0.5)(), near(1, 1e-15, 0.5)())),
    ("sinh", "f(z) = exp(z) - exp(-z)", lambda z: 2*mp.sinh(z), z(1e-30, 3)),
    ("quotients", "f(z) = 1/(z + 1) - 1/z", lambda z: 1/(z+1) - 1/z, z(1e-3, 1e12)),
    ("sin-difference", "f(z) = sin(z + 2^-10) - sin(z)", lambda z: sin(z+mpf(2)**-10) - sin(z), z(1e-3, 20)),
    ("cos-difference", "f(z) = cos(z + 2^-10) - cos(z)", lambda z: cos(z+mpf(2)**-10) - cos(z), z(1e-3, 20)),
    ("log-abs", "f(z) = log(abs(z))", lambda z: log(abs(z)), lambda: mpc(*(lambda t, d: (float(cos(t)*(1+d)), float(sin(t)*(1+d))))(random.uniform(-3, 3), size(1e-15, 0.3)()))),
    ("log-power", "f(z) = log(abs(z^9))", lambda z: 9*log(abs(z)), z(1e-100, 1e100)),
    ("cardinal", "f(z) = sin(z)/z", lambda z: sin(z)/z, z(1e-30, 20)),
    ("cardinal", "f(z) = (exp(z) - exp(-z))/(2*z)", lambda z: mp.sinh(z)/z, z(1e-30, 20)),
]

# what leaves the range of numbers on its way; drawn from a sequence of its own
RANGE = [
    ("power-quotient", "f(x: real) = x^9/x^8", lambda x: x, point(size(1e-200, 1e200))),
    ("power-quotient", "f(x, y) = (x^3 y - 3 x^2)/(2 x^2)", lambda x, y: (x*y - 3)/2, point(size(1e-200, 1e200), size(1e-9, 1e9))),
    ("power-quotient", "f(x, y) = y*exp(x)/exp(x)", lambda x, y: y, point(size(1, 2000), any_)),
    ("square-quotient", "f(x, y) = (x^2 - y^2)/(x^2 + y^2)", lambda x, y: (x*x-y*y)/(x*x+y*y), close(1e-170, 1e170, 1e-10, 0.5)),
    ("square-quotient", "f(x, y) = (x^2 + y^2 - 1)/(x^2 + y^2 + 1)", lambda x, y: (x*x+y*y-1)/(x*x+y*y+1), point(size(1e-5, 1e170), size(10, 1e170))),
    ("square-quotient", "f(x: real) = 2*x/(x^2 + 1)", lambda x: 2*x/(x*x+1), point(size(1, 1e170))),
    ("square-quotient", "f(x: real) = (x^2 + 3*x)/(1 + 4*x^2)", lambda x: (x*x+3*x)/(1+4*x*x), point(size(1, 1e170))),
    ("arg-exp", "f(x, y) = arg(exp(x + y*i))", lambda x, y: mp.atan2(sin(y), cos(y)), point(size(1, 2000), size(1e-3, 1e3))),
]


def text(x):
    return mpmath.nstr(mpf(x), 25)


def write_real(name, formulas):
    with open(OUT / name, "w") as out:
        for rules, formula, f, draw in formulas:
            out.write(f"# {rules}\t{formula}\n")
            before = random.getstate()
            if formula in OWN:  # later ones leave the points of the others as they are
                random.seed(formula)
            rows = 0
            while rows < 60:
                args = draw()
                value = f(*map(mpf, args))
                if isinstance(value, mpc) or not mp.isfinite(value) or value == 0 or not 1e-300 < abs(value) < 1e300:
                    continue
                out.write("\t".join([repr(a) for a in args] + [text(value)]) + "\n")
                rows += 1
            if formula in OWN:
                random.setstate(before)


def main():
    OUT.mkdir(exist_ok=True)
    write_real("real.tsv", REAL)
    with open(OUT / "complex.tsv", "w") as out:
        for rules, formula, f, draw in COMPLEX:
            out.write(f"# {rules}\t{formula}\n")
            for _ in range(60):
                arg = draw()
                value = mpc(f(arg))
                out.write("\t".join([repr(float(arg.real)), repr(float(arg.imag)), text(value.real), text(value.imag)]) + "\n")
    random.seed(8)
    write_real("range.tsv", RANGE)


if __name__ == "__main__":
    main()
