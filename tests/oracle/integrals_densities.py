"""The densities of integrals_rays.py, by class.

Texts are in the language with explicit products, but for: iff(c, a, b) for `if c then a else b`, len(x, y, z) for the
length of a vector, total(lambda k: term, n) for sum(k in 1..n, term). `marks` are polynomials of degree 2 or less along
a line at whose zeros and turning points the density changes its form or is steep; `speed` is about how fast it turns or
grows per unit of length; `far` is the length of a long ray, 0 where none makes sense.
"""

import random
from dataclasses import dataclass, field


@dataclass
class Density:
    text: str
    marks: list = field(default_factory=list)
    speed: float = 2.0
    far: float = 0.0


D = Density
R2 = "(x-0.25)^2+(y+0.5)^2+(z-0.125)^2"
BALL = "len(x-0.25, y+0.5, z-0.125)"


def polynomials():
    texts = [
        "3", "p", "x", "p*x+q*y+r", "x*y", "x*y*z", "x^2+y^2+z^2", f"({R2}-1)^2", "(x^2+y^2-1)^3",
        "x^4-5*x^2+y^4-5*y^2+z^4-5*z^2+11.8", "(x^2+9/4*y^2+z^2-1)^3-x^2*z^3-9/80*y^2*z^3",
        "(len(x,y)^2-r)^2", "p*x^10+q*y^9*z", "(x+y+z)^20", "x^31*y^29", "(x-y)^12*(y-z)^8",
        "x^20-20*x^18*y^2+p", "len(x,y,z)^4", "abs(x)^2*y", "(1-x^2)^2*(1-y^2)^2*(1-z^2)^2",
        "total(lambda k: x^k/k, 9)", "total(lambda k: (x-k*y)^2, 5)*p", "(x+p)*(y+q)*(z+r)*(x-p)*(y-q)*(z-r)",
        "x^2*y^2*z^2-0.01", "((x^2+y^2+z^2+3)^2-16*(x^2+y^2))",
    ]
    return [D(t, far=100.0) for t in texts]


def waves():
    texts = [
        ("0.5+0.5*sin(16*y-3)", 16), ("0.5+0.5*sin(y+2)", 1), ("sin(r*x+q)", 3), ("cos(p*x+q*y+r*z)", 3),
        ("sin(x)*cos(y)", 2), ("sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x)", 2),
        ("(sin(x)*cos(y)+sin(y)*cos(z)+sin(z)*cos(x))^2", 4), ("cos(x)+cos(y)+cos(z)", 2),
        ("(cos(3*x)+cos(3*y)+cos(3*z))^2", 7), ("sin(20*x)^2", 40), ("sin(5*y)^4", 20), ("cos(r*z)^6", 15),
        ("sin(x)*sin(2*x)*sin(3*x)", 6), ("sin(x)^3*cos(y)^2", 5),
        ("3*(cos(x)+cos(y)+cos(z))+4*cos(x)*cos(y)*cos(z)", 3),
        ("(1+cos(8*x))*(1+cos(8*y))*(1+cos(8*z))/8", 24), ("0.5+0.5*sin(12*x+4*y)*sin(7*z)", 20),
        ("total(lambda k: sin(k*x+y)/k, 7)", 8), ("total(lambda k: cos(2*k*y)/(k*k), 5)", 10),
        ("sin(x)^8*p", 8), ("sin(x+p)*sin(x+q)*cos(y+r)*cos(z)", 4), ("(sin(4*x)+q*cos(4*x))^3", 12),
        ("cos(x)*cos(x)", 2), ("sin(6*x)*sin(6*y)*sin(6*z)", 11), ("2-sin(3*x)-sin(3*y)", 4),
        ("sin(1000*y)", 1000), ("sin(0.001*x)", 0.1), ("0.5+0.5*cos(40*len(x,0,0)^1*0+40*z)", 40),
    ]
    return [D(t, speed=s, far=min(1e4, 150 / s)) for t, s in texts if "^1*0" not in t]


def exponentials():
    texts = [
        ("exp(-y)", 1, 80), ("exp(-8*y)", 8, 0), ("exp(-r*(z+1))", 3, 30), ("p*exp(q*x)+r*exp(-y)", 2, 30),
        ("sinh(x)", 1, 60), ("cosh(y-z)", 2, 40), ("exp(-x)*exp(-2*y)*exp(z)", 3, 20), ("exp(-x-y-z)^2", 4, 15),
        ("2^(-x)", 1, 60), ("r^(x+y)", 2, 30), ("exp(-2*y)*sin(5*x)", 6, 10), ("exp(-y)*(1+cos(10*y))", 11, 40),
        ("exp(p*x)*cos(q*y+r)", 2, 40), ("exp(-x)*sin(y)^2", 3, 30), ("exp(x)*sin(3*y)*cos(2*z)", 5, 20),
        ("cosh(x)*cosh(y)", 2, 30), ("sinh(x)*sinh(2*y)", 3, 20), ("sinh(x)*sin(y)", 2, 40), ("cosh(x)^2", 2, 30),
        ("1/exp(2*x)", 2, 30), ("sqrt(exp(x))", 1, 40), ("sin(y)/exp(x)", 2, 30), ("(exp(x)+exp(-x))^3", 3, 20),
        ("(1+exp(-y))^2", 2, 30), ("exp(-20*z)", 20, 0), ("sinh(x)^3", 3, 15), ("exp(0.001*x)", 0.1, 1e4),
        ("exp(-0.5*y)*cos(x)*cos(z)", 3, 40),
    ]
    return [D(t, speed=s, far=f) for t, s, f in texts]


def mixed():
    texts = [
        ("x*exp(-y)", 1, 50), ("x^2*exp(-r*z)", 3, 20), ("y^3*exp(-y)", 1, 60), ("(x+p)*(y+q)*exp(-x-y)", 2, 20),
        ("x*sin(5*y)", 5, 100), ("x^2*cos(q*y+r)", 2, 100), ("(x^2+y^2)*sin(z)", 1, 100), ("x*sinh(y)", 1, 40),
        ("x^2*cosh(z)", 1, 40), ("x*y*z*sin(x)", 1, 50), ("x*exp(-y)*sin(3*z)", 4, 20), ("x^2*sin(y)*sin(z)", 2, 60),
        ("(1-x^2-y^2)*exp(-2*z)", 2, 10), ("x^4*exp(-x)", 1, 40), ("x^5*sin(2*x)", 2, 30), ("x^8*cos(y)", 1, 20),
        ("x^6*exp(-p*y)", 1, 30), ("(x+sin(y))^2", 2, 60), ("(x+exp(-y))^2", 2, 30), ("(1+x*cos(4*y))^2", 8, 40),
        ("y*exp(-y)*cos(y)", 2, 40), ("x^12*sin(3*z)", 3, 8), ("total(lambda k: x^k*exp(-k*y), 4)", 5, 10),
        ("x^2*exp(-r*abs(y))", 3, 20), ("(x-1)^6*exp(3*x)", 3, 0),
    ]
    return [D(t, ["y"], speed=s, far=f) for t, s, f in texts]


def pieces():
    b2 = f"{R2}"
    cases = [
        D("max(0, y)", ["y"], far=50.0), D("abs(x)", ["x"], far=50.0), D("min(x, y)", ["x-y"], far=50.0),
        D("max(x, max(y, z))", ["x-y", "y-z", "x-z"], far=50.0), D("clamp(x, p, r)", ["x-p", "x-r"], far=50.0),
        D("max(0, 1-abs(x))", ["x", "x-1", "x+1"], far=50.0), D("step(p, x)", ["x-p"], far=50.0),
        D("smoothstep(q, r, y)", ["y-q", "y-r"], far=50.0), D("sign(x)*y", ["x"], far=50.0),
        D("iff(0<y+1 and y+1<2, y+1, 0)", ["y+1", "y-1"], far=50.0),
        D("iff(0<y+1 and y+1<2, (y+1)^2, 0)", ["y+1", "y-1"], far=50.0),
        D("clamp(y+1, 0, 2)^2", ["y+1", "y-1"], far=50.0), D("abs(x)+abs(y)+abs(z)", ["x", "y", "z"], far=50.0),
        D("max(0, 1-abs(x)-abs(y))", ["x", "y", "1-x-y", "1-x+y", "1+x-y", "1+x+y"], far=20.0),
        D(f"max(0, 1-({b2}))", [f"1-({b2})"], far=50.0), D(f"max(0, 1-({b2}))^2", [f"1-({b2})"], far=50.0),
        D(f"max(0, 1-({b2}))^3", [f"1-({b2})"], far=20.0), D(f"iff({b2}<1, 1, 0)", [f"1-({b2})"], far=50.0),
        D(f"iff({BALL}<1, exp(-2*z), 0)", [f"1-({b2})"], speed=2.0, far=20.0),
        D(f"max(0, 1-{BALL})", [f"1-({b2})", b2], far=50.0), D(f"max(0, 1-{BALL})^2", [f"1-({b2})", b2], far=20.0),
        D("abs(x)*exp(-y)", ["x"], speed=1.0, far=20.0), D("max(0, x)*sin(3*y)", ["x"], speed=3.0, far=20.0),
        D("max(0, y)^2*max(0, 1-y)", ["y", "1-y"], far=50.0), D("min(1, max(0, x*y))", ["x*y", "x*y-1"], far=20.0),
        D("clamp(x, 0, 1)*clamp(y, 0, 1)*clamp(z, 0, 1)", ["x", "x-1", "y", "y-1", "z", "z-1"], far=20.0),
        D("iff(x<0, iff(y<0, 1, 2), iff(z<0, x, x*y))", ["x", "y", "z"], far=20.0),
        D("abs(abs(x)-1)", ["x", "x-1", "x+1"], far=20.0), D("abs(x^2-y)", ["x^2-y"], far=20.0),
        D("abs(x)^3", ["x"], far=20.0), D("iff(y<p*x+q, r, x)", ["y-p*x-q"], far=20.0),
        D("mix(x, y, smoothstep(0, 1, z))", ["z", "z-1"], far=20.0),
        D("(1-smoothstep(0, 1, y))*(0.5+0.5*sin(8*x))", ["y", "y-1"], speed=8.0, far=10.0),
        D("max(0, 1-x^2)*max(0, 1-y^2)", ["1-x^2", "1-y^2"], far=20.0), D("exp(-abs(y))", ["y"], speed=1.0, far=30.0),
        D("exp(-3*abs(y-p))*abs(x)", ["y-p", "x"], speed=3.0, far=10.0), D("max(x, 0)/(1+max(y, 0))", ["x",
        "y"], far=20.0),
        D("iff(x^2+y^2<1, 1-x^2-y^2, 0)*iff(abs(z)<1, 1, 0)", ["1-x^2-y^2", "z-1", "z+1"], far=20.0),
        D("total(lambda k: max(0, x-k/4)/k, 4)", ["x-1/4", "x-1/2", "x-3/4", "x-1"], far=20.0),
        D("max(0, min(y+1, 1-y))^2", ["y", "y+1", "y-1"], far=20.0),
    ]
    return cases


def algebraic():
    marks = [R2]
    texts = [
        f"1/({R2}+0.01)", f"1/({R2}+1e-4)", f"p/({R2}+p)", f"1/({R2})", f"1/({R2}+0.25)^2", f"1/({R2}+0.01)^2",
        f"1/({R2}+0.5)^3", f"1/({R2}+1)^5", f"1/sqrt({R2}+0.01)", f"1/{BALL}", f"{BALL}", f"sqrt({R2}+0.04)",
        f"{BALL}^3", f"({R2}+0.1)^1.5", f"{BALL}^5", f"1/{BALL}^3", f"1/({R2}+0.01)^1.5", f"1/({R2}+0.1)^2.5",
        f"log({BALL})", f"log({R2}+0.01)", f"log(1+{R2})", f"x/({R2}+0.1)", f"(x+y)/({R2}+0.01)^2", f"x/{BALL}",
        f"x*{BALL}", f"x^2*{BALL}", f"x^2/({R2}+0.1)", f"(x-0.25)^4/({R2}+0.5)", f"x*log({R2}+0.1)",
        f"1/({R2}+0.01)+sin(3*x)", f"({BALL}-1)^2", f"(1-{BALL})^3", "1/(x^2+y^2+0.01)", "1/(1+y^2)", "len(x,y)",
        "1/(x*x+1)^2",
        "sqrt(1+x^2)", "1/sqrt(1+z^2)", "1/(x^2+2*x*y+4*y^2+1)", "sqrt(x^2+y^2+z^2+1)-p", "1/(2*x^2+3*y^2+z^2+p)",
        "log(x^2+y^2+0.5)*r", "x^3/sqrt(1+x^2)", "x^2*log(1+y^2+z^2)", "z/(x^2+y^2+z^2+0.2)^1.5",
        f"({R2}+0.1)^2.5", f"x^2*y/sqrt({R2}+0.3)", f"{BALL}*({R2})",
    ]
    return [D(t, marks if "0.25" in t else ["x^2+y^2+z^2", "x^2+y^2", "y^2", "x", "y",
    "z"], speed=1.0, far=1e3) for t in texts]


def affine():
    texts = [
        ("1/(x+4)", "x+4"), ("sqrt(x+8)", "x+8"), ("1/sqrt(y+8)", "y+8"), ("(z+8)^1.5", "z+8"), ("(x+8)^0.3", "x+8"),
        ("(y+9)^p", "y+9"), ("(y+9)^q", "y+9"), ("1/(x+4)^2", "x+4"), ("1/(x+y+8)^3", "x+y+8"), ("log(x+8)", "x+8"),
        ("x*log(y+8)", "y+8"), ("y/(x+8)", "x+8"), ("x^2*sqrt(x+8)", "x+8"), ("x^3/(y+8)^2", "y+8"),
        ("log(1+z+9)*r", "z+10"),
        ("1/(1-x-8)", "x+7"), ("(x+8)^-0.999", "x+8"), ("(x+8)^-1.0001", "x+8"), ("sqrt(max(0, y))", "y"),
        ("max(0, x)^1.5", "x"),
        ("log(abs(x))", "x"), ("1/(p*x+9)", "p*x+9"), ("log2(x+8)", "x+8"), ("x^2*log(x+8)", "x+8"),
    ]
    return [D(t.replace("log2(x+8)", "log(x+8)/log(2)"), [m], speed=1.0, far=0.0) for t, m in texts]


def bells():
    marks = [R2, "x", "y", "z", "x^2+y^2+z^2"]
    texts = [
        (f"exp(-({R2}))", 2), (f"exp(-r*({R2}))", 4), (f"exp(-20*({R2}))", 8), (f"exp(-{BALL}^2/0.02)", 12),
        ("exp(-x^2)", 2), ("exp(-(x^2+y^2))", 2), ("exp(-x^2-y)", 3), ("exp(-4*x^2-2*y^2-z^2)", 4),
        (f"x*exp(-({R2}))", 2),
        (f"(x^2+y^2)*exp(-2*({R2}))", 3), ("x^4*exp(-x^2)", 3), (f"(1-({R2}))*exp(-({R2}))", 2),
        ("x*y*z*exp(-x^2-y^2-z^2)", 3),
        (f"exp(-({R2}))+0.5*exp(-3*((x+1)^2+y^2+z^2))", 4), (f"(exp(-({R2}))+exp(-(x^2+y^2+z^2)))^2", 4),
        ("exp(-0.001*(x^2+y^2+z^2))", 0.5), ("p*exp(-r*x^2)*exp(-y^2)", 3), ("x^6*exp(-2*x^2)", 4),
        ("y^3*exp(-x^2-y^2+x)", 3),
        ("tanh(3*x)", 6), ("1/cosh(4*y)^2", 8), ("sech(2*x+y)", 5), ("1/cosh(x)", 2), ("atan(5*x)", 10),
        ("asinh(3*x-y)", 5),
        ("1/(1+exp(-6*y))", 8), ("1/(2+3*exp(4*x))", 6), ("erf(2*x)", 4), ("1-tanh(2*z)", 4), ("1/(1+exp(x))", 2),
        ("0.5+atan(20*y)/pi", 30),
        ("1/cosh(20*x)^2", 40),
    ]
    return [D(t, marks, speed=s, far=50.0 if s < 20 else 4.0) for t, s in texts]


def scenes():
    texts = [
        ("1", [], 1), ("0.5+0.5*sin(16*y-8*0.3)", [], 16), ("0.5+0.5*sin(y+tau0)", [], 1),
        ("iff(0<y+1 and y+1<2, y+1, 0)", ["y+1", "y-1"], 1), ("iff(0<y+1 and y+1<2, (y+1)^2, 0)", ["y+1", "y-1"], 1),
        ("exp(-3*y)*(1+0.3*cos(6*x)*cos(6*z))", [], 15), (f"0.3/({R2}+0.05)+exp(-2*(x^2+z^2))", [R2, "x^2+z^2"], 4),
        ("(1+sin(5*x)*cos(5*y))*exp(-abs(z))", ["z"], 11), (f"max(0, 1-({R2}))^2*(1+y)", [f"1-({R2})"], 2),
        ("smoothstep(-1, 1, y)*(1-smoothstep(1, 2, y))", ["y+1", "y-1", "y-2"], 2),
        ("clamp(1-len(x,z), 0, 1)", ["x^2+z^2", "1-x^2-z^2"], 2), ("clamp(1-len(x,z)/(2-y*0.5), 0, 1)", [], 2),
        ("1/(x^2+z^2+0.01)*max(0, 1-y*y/4)", ["x^2+z^2", "1-y*y/4"], 2), ("(sin(7*x)+sin(7*y)+sin(7*z)+3)/6", [], 15),
        ("0.2+0.8*cos(3*x)^2*cos(3*z)^2", [], 12), ("exp(-4*(x^2+z^2))*(0.5+0.5*sin(10*y))", ["x^2+z^2"], 12),
    ]
    out = []
    for t, m, s in texts:
        if "(2-y*0.5)" in t or "exp(-4*(x^2+z^2))*(0.5" in t:
            continue
        out.append(D(t.replace("tau0", "2"), m, speed=s, far=min(50.0, 300 / s)))
    return out


def random_densities():
    rng = random.Random(7)
    atoms = [
        ("{a}*x+{b}*y", [], 1), ("({a}*x^2+{b}*z)", [], 1), ("sin({a}*x+{b}*z)", [], 3), ("cos({b}*y)", [], 3),
        ("exp({a}*z-{c}*y)", [], 2), ("x*sin({b}*y)", [], 3), ("z^2*exp(-{c}*x)", [], 3),
        ("max(0, x+{a})", ["x+{a}"], 1),
        ("abs(y-{b})", ["y-{b}"], 1), ("1/(x^2+y^2+{c})", ["x^2+y^2"], 1),
        ("sqrt((x-{a})^2+y^2+z^2)", ["(x-{a})^2+y^2+z^2"], 1),
        ("exp(-{c}*((x-{a})^2+y^2))", ["(x-{a})^2+y^2"], 2), ("log(z^2+{c}+x^2)", ["z^2+x^2"], 1),
        ("tanh({c}*x)", ["x"], 4),
        ("clamp(z, {a}-2, {a}+1)", ["z-{a}+2", "z-{a}-1"], 1), ("1/cosh({c}*y)^2", ["y"], 4),
    ]
    factors = [("x", [], 0), ("(1+{a}*y)", [], 0), ("sin({b}*z)", [], 3), ("exp(-{c}*x)", [], 2),
    ("step({a}, y)", ["y-{a}"], 0), ("p", [], 0)]
    closed_product = {0, 1, 2, 3, 4, 5, 6, 7, 8, 14}
    out = []
    while len(out) < 80:
        numbers = {k: v for k, v in zip("abc", [round(rng.uniform(-2, 2), 2), round(rng.uniform(-3, 3), 2), round(rng.uniform(0.25, 2), 2)])}
        text, marks, speed = [], [], 1.0
        for _ in range(rng.choice([1, 2, 2, 3])):
            k = rng.randrange(len(atoms))
            t, m, s = atoms[k]
            if k in closed_product and rng.random() < 0.7:
                f, fm, fs = rng.choice(factors)
                t, m, s = f"({t})*{f}", m + fm, s + fs
            elif rng.random() < 0.4:
                t, m = f"({t})*step({{a}}, y)", m + ["y-{a}"]
            text.append(t.format(**numbers))
            marks += [mark.format(**numbers) for mark in m]
            speed += s
        out.append(D("+".join(text).replace("+-", "-"), marks, speed=speed, far=8.0))
    return out


def products():
    """Gaussians by waves, products of reciprocals, sums with conditions of their own, cuts at parameters, erfc."""
    ball, other = "x^2+y^2+z^2", "(x-1)^2+y^2+z^2"
    waves = [
        ("exp(-(x^2+y^2+z^2))*cos(3*x+1)", 4), ("exp(-r*((x-0.25)^2+y^2))*sin(8*z)", 9),
        ("exp(-x^2)*sin(2*x)*cos(3*y)", 5), ("exp(-p*x^2-y)*cos(r*x)", 4), ("exp(-4*x^2)*cos(20*x)", 20),
        ("exp(-(x^2+y^2))*sin(4*x)^2", 8), ("exp(-0.01*x^2)*sin(x+y)", 2), ("exp(-9*(x^2+y^2+z^2))*sin(x)", 6),
        ("exp(-x*x-2*x*y-y*y)*cos(r*z+x)", 4),
    ]
    rational = [
        ("1/((x^2+y^2+z^2+0.1)*((x-1)^2+y^2+z^2+0.2))", [ball, other]),
        ("1/((x^2+y^2+z^2+0.1)*(x^2+y^2+z^2+0.11))", [ball]), ("1/((x^2+1)*(y^2+1))", ["x^2", "y^2"]),
        ("1/((x^2+y^2+0.5)*(z^2+2))", ["x^2+y^2", "z^2"]), ("1/((y+12)*(x+11))", []), ("1/((y+12)*(y+12.001))", []),
        ("p/((x-0.25)^2+y^2+z^2+0.01)/((x-0.2501)^2+y^2+z^2+0.01)", ["(x-0.25)^2+y^2+z^2"]),
        ("1/((x^2+y^2+z^2+0.01)*((x-0.125)^2+y^2+z^2+0.01))", [ball, "(x-0.125)^2+y^2+z^2"]),
        ("r/((x^2+y^2+z^2+4)*(x^2+4*y^2+p))", [ball, "x^2+4*y^2"]),
    ]
    pieces = [
        ("clamp(x,0,1)+clamp(y,0,1)", ["x", "x-1", "y", "y-1"]), ("abs(x)+abs(y)-abs(z)", ["x", "y", "z"]),
        ("max(0,1-abs(x))+smoothstep(-1,1,z)*2", ["x", "x-1", "x+1", "z-1", "z+1"]), ("clamp(y,0,p)", ["y", "y-p"]),
        ("clamp(x,q,p)^2", ["x-q", "x-p"]), ("smoothstep(q,p,z)", ["z-q", "z-p"]),
        ("step(p,y)+step(q,x)*y", ["y-p", "x-q"]), ("max(y-p,0)*min(y,r)", ["y-p", "y-r"]),
        ("abs(x-p)*abs(x-q)*abs(x-r)", ["x-p", "x-q", "x-r"]),
    ]
    tails = [("erfc(2*x)", 3), ("erfc(x-y+1)", 2), ("erfc(6+x)", 12), ("p*erfc(y-4)+x", 2)]
    return [D(t, ["x", "x^2+y^2"], speed=s) for t, s in waves] + [D(t, m, speed=3) for t, m in rational] + [
        D(t, m, speed=1) for t, m in pieces] + [D(t, ["x", "y"], speed=s) for t, s in tails]


def fractions():
    """A linear function beside a quadratic, and rational functions of one linear function."""
    ball = ["x^2+y^2+z^2"]
    cases = [
        ("1/((x+13)*(x^2+y^2+z^2+0.5))", ball), ("1/((y+12)*(x^2+z^2+1))", ["x^2+z^2"]),
        ("p/((x^2+y^2+z^2+0.1)*(2*z-25))", ball), ("1/((x+14)*(y^2+2))", ["y^2"]),
        ("1/(x^4+5*x^2+4)", ["x^2"]), ("x^4/(x^4+5*x^2+4)", ["x^2"]), ("1/((x^2+1)*(x^2+4)*(x^2+9))", ["x^2"]),
        ("(1-x^3)/((x+13)*(x^2+1))", ["x^2"]), ("(8*x^3+7)/((x+13)*(2*x+31)^3)", []),
        ("1/((x+y+25)*(x+y+26)^2)", []), ("(2*x+3)/((x^2+1)^2*(x^2+4))", ["x^2"]),
        ("1/((x-2*y)^4+1)", ["(x-2*y)^2"]), ("r/(z^6+1)", ["z^2"]),
        ("x^3/(9+4*x^2)^(3/2)", ["x^2"]), ("(x^2+y)/(x^2+y^2+z^2+0.5)^(3/2)", ball),
        ("sqrt(y+12)*log(y+12)", []), ("(x+14)^(3/2)*log(x+14)", []),
    ]
    return [D(t, m, speed=3) for t, m in cases]


def gaussians():
    """Gaussians by waves and polynomials, and exponentials of squares that grow."""
    by_waves = [
        ("x^2*exp(-(x^2+y^2+z^2))*cos(5*y)", 5), ("x*exp(-4*x^2)*sin(20*x)", 20), ("y*z*exp(-r*(x^2+y^2))*cos(x+z)", 4),
        ("(1-4*x^2)*exp(-2*x^2)*sin(3*x)*cos(2*y)", 6), ("x^3*exp(-x^2-y)*cos(p*x-q*z)", 4),
        ("x^4*exp(-0.01*x^2)*sin(2*y)", 3), ("(x+y-z)*exp(-9*(x^2+y^2+z^2))*sin(x)^2", 8),
        ("x^7*exp(-2*(x^2+z^2))*cos(4*y)", 6),
    ]
    growing = [
        ("x^3*exp(x^2)", 4), ("exp(x^2)", 4), ("y*exp(x^2+y^2-z)", 4), ("p*exp(0.5*(x^2+y^2+z^2))", 4),
        ("(x-2*y)^2*exp(0.25*x^2+y)", 3), ("exp(x*y)", 3), ("z*exp(x^2-y^2)", 4), ("x^7*exp(0.01*x^2)", 2),
    ]
    return [D(t, ["x", "x^2+y^2+z^2"], speed=s) for t, s in by_waves + growing]


def rest():
    """Without closed form: for the nodes."""
    ball = ["x^2+y^2+z^2"]
    texts = [
        ("exp(-x^2*y^2)", 6, []), ("sin(3*x*y)", 12, []), ("exp(sin(4*x)+cos(3*y))", 12, []),
        ("exp(-r*len(x,y,z))", 4, ball), ("sqrt(1+x^4+y^2)", 4, []), ("exp(-x^4)", 8, []), ("tanh(x*y)", 4, []),
        ("sin(x)/(2+cos(3*y))", 6, []), ("cos(1/(0.2+x^2))", 30, ["x"]), ("exp(-20*(sin(x)-0.3)^2)", 12, []),
        ("log(2+sin(5*x)*cos(y))", 12, []), ("(1+x^2+y^2)^0.3", 4, []), ("1/(1+exp(4*sin(3*x)))", 30, []),
        ("atan(x*y+z)", 4, []), ("exp(x)/(y+6)", 4, []), ("sinh(x*y)/cosh(x*y+1)", 6, []),
        ("1/(0.0001+x^2)^0.3", 4, ["x^2+0.0001"]), ("1/(0.01+x^2+y^4)", 8, ["x^2"]), ("tanh(40*x*y)", 40, ["x*y"]),
        ("exp(p*x)*asinh(q*y+z)", 4, []), ("erf(x*y)*x", 4, []), ("x^2*sech(x^2+y)", 8, []),
    ]
    return [D(t, marks, speed=s) for t, s, marks in texts]


def classes():
    return {
        "polynomials": polynomials(),
        "waves": waves(),
        "exponentials": exponentials(),
        "mixed": mixed(),
        "pieces": pieces(),
        "algebraic": algebraic(),
        "affine": affine(),
        "bells": bells(),
        "scenes": scenes(),
        "random": random_densities(),
        "products": products(),
        "fractions": fractions(),
        "gaussians": gaussians(),
        "rest": rest(),
    }
