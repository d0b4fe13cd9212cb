#!/usr/bin/env python3
"""Integrals of densities along rays by mpmath at 60 digits: tests/data/integrals/*.tsv.

Each file has one class of densities. A line `= text` begins a density, written in the language with p, q and r as
parameters; each line below it is a ray and its result: o, d, a, b (numbers that binary32 holds), the integral of f
from a to b along o + t d, and that of |f| from the lesser to the greater of a and b. The value is
mpmath.quad of the density itself, cut where it changes its form, around closest approaches, and where it turns often.

    python3 tests/oracle/integrals_rays.py [CLASS ...]
"""

import math
import random
import re
import struct
import sys
import zlib
from multiprocessing import Pool
from pathlib import Path

from mpmath import mp, mpf

import integrals_densities

mp.dps = 60
OUT = Path(__file__).resolve().parent.parent / "data" / "integrals"
PARAMETERS = {"p": 0.75, "q": -1.25, "r": 2.5}


def single(x):
    """The nearest binary32 number."""
    return struct.unpack("<f", struct.pack("<f", x))[0]


def condition(c, a, b):
    return a if c else b


def namespace():
    names = {
        name: getattr(mp, name)
        for name in "sin cos exp sqrt sinh cosh tanh atan asinh erf erfc pi".split()
    }
    clamp = lambda x, lo, hi: min(max(x, lo), hi)

    def smoothstep(a, b, x):
        t = clamp((x - a) / (b - a), 0, 1)
        return t * t * (3 - 2 * t)

    names.update(
        log=lambda x: mp.log(x) if x > 0 else mp.nan,
        abs=abs,
        min=min,
        max=max,
        iff=condition,
        clamp=clamp,
        smoothstep=smoothstep,
        step=lambda e, x: mpf(0) if x < e else mpf(1),
        sign=mp.sign,
        sech=mp.sech,
        len=lambda *v: mp.sqrt(sum(u * u for u in v)),
        mix=lambda a, b, t: a * (1 - t) + b * t,
        total=lambda f, n: sum(f(mpf(k)) for k in range(1, n + 1)),
        **{k: mpf(v) for k, v in PARAMETERS.items()},
    )
    return names


NAMES = namespace()


def in_floats():
    names = dict(NAMES)
    for name in "sin cos exp sqrt sinh cosh tanh atan asinh erf erfc pi".split():
        names[name] = getattr(math, name)
    names.update(
        log=lambda x: math.log(x) if x > 0 else math.nan,
        sign=lambda x: (x > 0) - (x < 0),
        step=lambda e, x: 0.0 if x < e else 1.0,
        sech=lambda x: 1 / math.cosh(x),
        len=lambda *v: math.hypot(*v),
        total=lambda f, n: sum(f(float(k)) for k in range(1, n + 1)),
        **PARAMETERS,
    )
    return names


FLOATS = in_floats()


def function(text, names=NAMES):
    return eval("lambda x, y, z: " + text.replace("^", "**"), names)


def split_arguments(text):
    depth, parts, last = 0, [], 0
    for k, c in enumerate(text):
        depth += (c in "([") - (c in ")]")
        if c == "," and depth == 0:
            parts.append(text[last:k])
            last = k + 1
    return parts + [text[last:]]


def closing(text, start):
    depth = 0
    for k in range(start, len(text)):
        depth += (text[k] == "(") - (text[k] == ")")
        if depth == 0:
            return k
    raise ValueError(text)


def in_language(text):
    """The density as the language has it."""
    for word in ("iff(", "len(", "total("):
        while (found := re.search(r"\b" + re.escape(word), text)) is not None:
            end = closing(text, found.end() - 1)
            parts = [p.strip() for p in split_arguments(text[found.end() : end])]
            if word == "iff(":
                new = f"(if {parts[0]} then {parts[1]} else {parts[2]})"
            elif word == "len(":
                new = f"length(({', '.join(parts)}))" if len(parts) > 1 else f"abs({parts[0]})"
            else:
                term = parts[0].split(":", 1)[1].strip()
                new = f"(sum(k in 1..{parts[1]}, {term}))"
            text = text[: found.start()] + new + text[end + 1 :]
    return text


def quadratic_through(values):
    """Coefficients of the polynomial of degree 2 with these values at -1, 0 and 1."""
    low, mid, high = values
    return (high + low) / 2 - mid, (high - low) / 2, mid


def cuts(case, o, d, a, b):
    """Places in (a, b) around which the density changes its form or is steep."""
    middle, half = (a + b) / 2, (b - a) / 2
    out = set()
    for mark in case.marks:
        f = function(mark)
        at = lambda u: f(*[oo + (middle + half * u) * dd for oo, dd in zip(o, d)])
        A, B, C = quadratic_through([at(mpf(-1)), at(mpf(0)), at(mpf(1))])
        places = []
        size = max(abs(A), abs(B), abs(C))
        if size == 0:
            continue
        if abs(A) < size * mpf(10) ** -50:
            if B != 0:
                places.append(-C / B)
        else:
            centre = -B / (2 * A)
            D = B * B - 4 * A * C
            places.append(centre)
            radius = mp.sqrt(abs(D)) / (2 * abs(A))
            if D > 0:
                places += [centre - radius, centre + radius]
            if radius > 0:
                k = 0
                while radius * 4**k < 4 and k < 40:
                    places += [centre - radius * 4**k, centre + radius * 4**k]
                    k += 1
        out.update(p for p in places if -1 < p < 1)
    speed = mp.sqrt(sum(dd * dd for dd in d))
    pieces = min(400, int(case.speed * speed * abs(b - a) / 16) + 1)
    out.update(mpf(2 * k) / pieces - 1 for k in range(1, pieces))
    return sorted(middle + half * u for u in out)


def integral(case, o, d, a, b):
    f = function(case.text)
    along = lambda t: f(*[oo + t * dd for oo, dd in zip(o, d)])
    places = [a] + (cuts(case, o, d, a, b) if a < b else cuts(case, o, d, b, a)[::-1]) + [b]
    value, size, error = mpf(0), mpf(0), mpf(0)
    for lo, hi in zip(places, places[1:]):
        part, bound = mp.quad(along, [lo, hi], error=True, method="gauss-legendre", maxdegree=7)
        if abs(bound) > mpf(10) ** -30 * abs(part):
            part, bound = mp.quad(along, [lo, hi], error=True, maxdegree=9)
        value += part
        error += abs(bound)
        # |f| by its sign changes: where a piece has one, quad of |f| is right to some digits, which is enough
        samples = [along(lo + (hi - lo) * mpf(k) / 7) for k in range(1, 7)]
        if all(s >= 0 for s in samples) or all(s <= 0 for s in samples):
            size += abs(part)
        else:
            size += roughly(case, o, d, lo, hi)
    return value, size, error


def roughly(case, o, d, lo, hi):
    """The integral of |f| to a few digits, by the midpoints of many pieces."""
    f = function(case.text, FLOATS)
    o, d, lo, hi = [float(v) for v in o], [float(v) for v in d], float(lo), float(hi)
    n = 400
    width = (hi - lo) / n
    places = (lo + (k + 0.5) * width for k in range(n))
    return abs(width) * sum(abs(f(*[oo + t * dd for oo, dd in zip(o, d)])) for t in places)


def rays(case):
    rng = random.Random(zlib.crc32(case.text.encode()))
    centre = (0.25, -0.5, 0.125)

    def unit():
        v = [rng.gauss(0, 1) for _ in range(3)]
        n = math.sqrt(sum(x * x for x in v))
        return [x / n for x in v]

    def axis(tiny):
        v, k = unit(), rng.randrange(3)
        return [v[i] if i != k else tiny for i in range(3)]

    def alone(tiny):
        k = rng.randrange(3)
        return [1.0 if i == k else t for i, t in zip(range(3), [tiny, -tiny, tiny])]

    origin = lambda s: [rng.uniform(-s, s) for _ in range(3)]
    out = [
        (origin(2), unit(), -0.5, rng.uniform(0.5, 3)),
        (origin(2), axis(0.0), 0.0, rng.uniform(1, 4)),
        (origin(1), alone(0.0), 0.0, rng.uniform(1, 3)),
        (origin(2), axis(10.0 ** -rng.choice([1, 2, 3])), 0.0, 2.0),
        (origin(2), axis(10.0 ** -rng.choice([4, 5, 6, 7, 8])), 0.5, 2.5),
        (origin(2), alone(10.0 ** -rng.choice([8, 20, 30])), -1.0, 1.0),
        (origin(1), unit(), 1.5, rng.uniform(-1, 1)),
        (origin(1), unit(), 0.5, 0.5 + 1e-7 * rng.uniform(1, 4)),
        (origin(1), unit(), -0.25, -0.25 + 10.0 ** -rng.choice([2, 3, 4])),
        (origin(1), unit(), 0.75, 0.75),
        (origin(1), [0.0, 0.0, 0.0], 0.0, 1.5),
    ]
    # from ten units away, past the centre at some distance
    d = unit()
    miss = [c + 10.0 ** -rng.choice([1, 2, 3]) * u for c, u in zip(centre, unit())]
    out.append(([m - 10 * x for m, x in zip(miss, d)], d, 6.0, 14.0))
    out.append(([m - 2 * x for m, x in zip(miss, d)], d, 0.0, 2.0 + rng.uniform(-0.1, 2)))
    if case.far:
        d = unit()
        out.append((origin(2), d, 0.0, case.far))
        out.append((origin(2), alone(1e-3), 0.0, case.far))
    rounded = []
    for o, d, a, b in out:
        rounded.append(([single(x) for x in o], [single(x) for x in d], single(a), single(b)))
    return rounded


def rows(case):
    lines = [f"= {in_language(case.text)}"]
    for o, d, a, b in rays(case):
        try:
            numbers = [mpf(x) for x in (*o, *d, a, b)]
            value, size, error = integral(case, numbers[:3], numbers[3:6], *numbers[6:])
        except (ZeroDivisionError, ValueError, TypeError, OverflowError):
            continue
        if not (mp.isfinite(value) and mp.isfinite(size)) or size > mpf(10) ** 36:
            continue
        if isinstance(value, mp.mpc) or error > size * mpf(10) ** -18 + mpf(10) ** -60:
            print(f"left out: {case.text} {o} {d} {a} {b}: {mp.nstr(error, 3)}", file=sys.stderr)
            continue
        given = " ".join(repr(x) for x in (*o, *d, a, b))
        lines.append(f"{given} {mp.nstr(value, 20)} {mp.nstr(size, 8)}")
    return lines


def main():
    wanted = sys.argv[1:]
    with Pool(2) as pool:
        for name, cases in integrals_densities.classes().items():
            if wanted and name not in wanted:
                continue
            lines = [f"# {name}: by tests/oracle/integrals_rays.py"]
            for block in pool.map(rows, cases, chunksize=1):
                lines += block
            (OUT / f"{name}.tsv").write_text("\n".join(lines) + "\n")
            print(name, len(cases), len(lines), flush=True)


if __name__ == "__main__":
    main()
