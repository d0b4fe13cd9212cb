#!/usr/bin/env python3
"""Write tests/data/functions/library.txt: functions on vectors, the library of the language, parts of complex numbers.

usage: library.py [OUT_FILE]      (needs mpmath; default OUT_FILE: ../data/functions/library.txt beside this file)

The file is a sequence of sections: `# NAME | FORMULA`, a line that names the columns, and rows as in the gallery's
tables (see README.md). NAME is what the section covers. Definitions are translated by hand.
"""
import os
import random
import sys

import gallery as g
from gallery import Dual, Num, absolute, cos, exp, greatest, hypot, hypot3, least, mp, sin, tan

sinh = g.function(mp.sinh, mp.cosh, mp.sinh)
cosh = g.function(mp.cosh, mp.sinh, mp.cosh)
tanh = g.function(mp.tanh, lambda x: mp.sech(x) ** 2, lambda x: -2 * mp.sech(x) ** 2 * mp.tanh(x))


def constant(like, c):
    return like.lift(c) if isinstance(like, Dual) else mp.mpmathify(c)


def clamp(x, lo, hi):
    return least(greatest(x, lo), hi)


def smoothstep(a, b, x):
    t = clamp((x - a) / (b - a), constant(x, 0), constant(x, 1))
    return t * t * (3 - 2 * t)


def blend(x, y, k, sign):
    """The polynomial minimum (sign 1) or maximum (sign -1) of width k."""
    h = clamp(HALF + sign * (y - x) / (2 * k), constant(x, 0), constant(x, 1))
    return y * (1 - h) + x * h - sign * (k * h * (1 - h))


def heaviside(x):
    v = g.value(x)
    return constant(x, (v > 0) - (v < 0)) / 2 + HALF


def fmod(a, b):
    """The remainder with the sign of a."""
    q = g.value(a) / g.value(b)
    whole = mp.floor(abs(q)) * (1 if q >= 0 else -1)
    return a - whole * b


def step(edge, x):
    return constant(x, 0) if x < edge else constant(x, 1)


HALF = mp.mpf("0.5")
REAL = {
    "sec": ("sec(x)", lambda x: 1 / cos(x)), "csc": ("csc(x)", lambda x: 1 / sin(x)), "cot": ("cot(x)", lambda x: 1 / tan(x)),
    "sech": ("sech(x)", lambda x: 1 / cosh(x)), "csch": ("csch(x)", lambda x: 1 / sinh(x)), "coth": ("coth(x)", lambda x: 1 / tanh(x)),
    "mix": ("mix(1, 3, x)", lambda x: 1 * (1 - x) + 3 * x), "clamp": ("clamp(x, -1, 0.5)", lambda x: clamp(x, constant(x, -1), constant(x, HALF))),
    "heaviside": ("heaviside(x)", heaviside), "fmod": ("fmod(x, -0.75)", lambda x: fmod(x, mp.mpf("-0.75"))),
    "saturate": ("saturate(x)", lambda x: clamp(x, constant(x, 0), constant(x, 1))), "step": ("step(0.5, x)", lambda x: step(HALF, x)),
    "smoothstep": ("smoothstep(-1, 2, x)", lambda x: smoothstep(-1, 2, x)),
    "radians": ("radians(x)", lambda x: x * (mp.pi / 180)), "degrees": ("degrees(x)", lambda x: x * (180 / mp.pi)),
    "powint": ("x^5 - x^-3", lambda x: x**5 - 1 / x**3),
}
PLANE = {
    "mix": ("mix(x, y, 0.25)", lambda x, y: x * (1 - HALF / 2) + y * (HALF / 2)), "lerp": ("lerp(2, x, y)", lambda x, y: 2 * (1 - y) + x * y),
    "clamp": ("clamp(1, x, y)", lambda x, y: least(greatest(constant(x, 1), x), y)),
    "step": ("step(x, y)", lambda x, y: step(x, y)),
    "smin": ("smin(x, y, 0.5)", lambda x, y: blend(x, y, HALF, 1)), "smax": ("smax(x, y, 0.5)", lambda x, y: blend(x, y, HALF, -1)),
    "length": ("length(vec2(x, y))", hypot), "distance": ("distance(vec2(x, y), vec2(1, 2))", lambda x, y: hypot(x - 1, y - 2)),
    "dot": ("dot(vec2(x, y), vec2(y, 2))", lambda x, y: x * y + y * 2), "vec2": ("dot(vec2(x), vec2(y, 3))", lambda x, y: x * y + x * 3),
    "rotate": ("rotate(vec2(x, y), 0.75).x", lambda x, y: mp.cos(mp.mpf("0.75")) * x - mp.sin(mp.mpf("0.75")) * y),
    "rotate ": ("rotate(vec2(1, 2), x).y", lambda x, y: sin(x) + cos(x) * 2 + 0 * y),
    "normalize": ("normalize(vec2(x, y)).x", lambda x, y: x / hypot(x, y)),
    "abs": ("|x| y", lambda x, y: absolute(x) * y),
    "select": ("{ x < y: x^2, y < 1: y - x, else: 3 x }", lambda x, y: x * x if x < y else y - x if y < 1 else 3 * x),
}
SPACE = {
    "length": ("length(vec3(x, y, z))", hypot3), "hypot3": ("|vec3(x, y, z)|", hypot3),
    "distance": ("distance(vec3(x, y, z), vec3(1, -2, 0.5))", lambda x, y, z: hypot3(x - 1, y + 2, z - HALF)),
    "dot": ("dot(vec3(x, y, z), vec3(x, z, 3))", lambda x, y, z: x * x + y * z + z * 3),
    "cross": ("cross(vec3(x, y, z), vec3(2, -1, 0.5)).x", lambda x, y, z: y * HALF + z),
    "cross ": ("cross(vec3(x, y, z), vec3(z, x, y)).y", lambda x, y, z: z * z - x * y),
    "cross  ": ("cross(vec3(x, y, z), vec3(z, x, y)).z", lambda x, y, z: x * x - y * z),
    "normalize": ("normalize(vec3(x, y, z)).z", lambda x, y, z: z / hypot3(x, y, z)),
    "vec3": ("dot(vec3(x), vec3(y, z, 1))", lambda x, y, z: x * y + x * z + x),
    "vec4": ("length(vec4(x, y, z, 2))", lambda x, y, z: hypot(hypot3(x, y, z), constant(x, 2))),
    "mix": ("mix(x, y, z)", lambda x, y, z: x * (1 - z) + y * z), "clamp": ("clamp(x, y, z)", lambda x, y, z: least(greatest(x, y), z)),
    "smoothstep": ("smoothstep(x, y, z)", lambda x, y, z: smoothstep(x, y, z)),
    "smin": ("smin(x, y, z)", lambda x, y, z: blend(x, y, z, 1)),
}
HOLOMORPHIC = {
    "sec": ("sec(z)", lambda z: 1 / cos(z)), "csc": ("csc(z)", lambda z: 1 / sin(z)), "cot": ("cot(z)", lambda z: 1 / tan(z)),
    "sech": ("sech(z)", lambda z: 1 / cosh(z)), "csch": ("csch(z)", lambda z: 1 / sinh(z)), "coth": ("coth(z)", lambda z: 1 / tanh(z)),
    "add": ("z + (2 - i)", lambda z: z + mp.mpc(2, -1)), "sub": ("(1 + 2i) - z", lambda z: mp.mpc(1, 2) - z), "neg": ("-z", lambda z: -z),
    "mul": ("z exp(z)", lambda z: z * exp(z)), "powint": ("z^5", lambda z: z**5),
}


# their derivatives are products of a zero and an infinity where cosh overflows
RECIPROCALS = {"sec", "csc", "sech", "csch"}


def part(fn, dz, dzbar):
    """A part of a complex number, with its Wirtinger pair; for z itself."""

    def call(z):
        if not isinstance(z, Dual):
            return fn(z)
        v, p, q = (t(z.a.v) for t in (fn, dz, dzbar))
        return z.like(Num(v, abs(v)), [Num(p, 4 * abs(p)), Num(q, 4 * abs(q))])

    return call


I = mp.mpc(0, 1)
PAIR = {
    "abs": ("complex(abs(z), 0)", part(lambda z: mp.mpc(abs(z)), lambda z: mp.conj(z) / abs(z) / 2, lambda z: z / abs(z) / 2)),
    "arg": ("complex(arg(z), 0)", part(lambda z: mp.mpc(mp.arg(z)), lambda z: -I / (2 * z), lambda z: I / (2 * mp.conj(z)))),
    "re": ("complex(re(z), 0)", part(lambda z: mp.mpc(mp.re(z)), lambda z: mp.mpf(1) / 2, lambda z: mp.mpf(1) / 2)),
    "im": ("complex(im(z), 0)", part(lambda z: mp.mpc(mp.im(z)), lambda z: -I / 2, lambda z: I / 2)),
    "conj": ("conj(z)", g.conj),
    "complex": ("complex(im(z), re(z))", lambda z: I * g.conj(z)),
    "mul": ("z conj(z)", lambda z: z * g.conj(z)),
}


def section(fh, name, signature, formula, f, pts, columns, complex_=False, pair=False):
    rows = [r for r in (g.row(f, p, complex_, pair) for p in pts) if r]
    assert len(rows) >= 20, (name, len(rows))
    fh.write(f"# {name.strip()} | f({signature}) = {formula}\n# " + "\t".join(columns) + "\n" + "\n".join(rows) + "\n")


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    out = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "data", "functions", "library.txt")
    tail = lambda ds: ["condition", "scale_f"] + [f"scale_{d}" for d in ds] + ["notes"]
    with open(out, "w", encoding="utf-8") as fh:
        for table, names in ((REAL, "x"), (PLANE, "xy"), (SPACE, "xyz")):
            slopes = [f"d{n}" for n in names]
            for name, (formula, f) in table.items():
                rng = random.Random(f"{name} {formula}")
                special = [(0.5,) * len(names), tuple((1.0, -1.0, 2.0)[: len(names)]), (0.0,) * len(names)]
                pts = g.points(rng, len(names), 3, special)
                if name == "clamp" and len(names) > 1:  # an interval of one point: which bound holds is a convention
                    pts = [p for p in pts if len(set(p)) > 1]
                if name in RECIPROCALS or name == "fmod":
                    pts = [p for p in pts if abs(p[0]) < 500]
                section(fh, name, ", ".join(names), formula, f, pts, [*names, "f", *slopes, *tail(slopes)])
        for table, slopes in ((HOLOMORPHIC, ["dz"]), (PAIR, ["dz", "dzbar"])):
            for name, (formula, f) in table.items():
                rng = random.Random(f"{name} {formula}")
                columns = ["z.re", "z.im", "f.re", "f.im"] + [f"{d}.{p}" for d in slopes for p in ("re", "im")] + tail(slopes)
                pts = g.complex_points(rng, 3, [0, 1, 1.5707964, 1j, 40j, -40.0])
                if name in ("abs", "arg"):  # no derivative there
                    pts = [p for p in pts if p != (0.0, 0.0)]
                if name in RECIPROCALS:
                    pts = [p for p in pts if max(map(abs, p)) < 500]
                section(fh, name, "z", formula, f, pts, columns, True, len(slopes) == 2)


if __name__ == "__main__":
    main()
