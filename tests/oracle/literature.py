#!/usr/bin/env python3
"""Write tests/data/literature/NAME.tsv: value and derivatives of published formulas, to 20 digits.

usage: literature.py [NAME …]      (needs mpmath; without a name, all tables)

The formulas stand in published/*.py, written from their sources; of a .pull file only the line `// box:` is read,
which says where the random points lie. Values and derivatives are computed with 150 digits. Derivatives come from exact
rules (jets.py) and must agree with symmetric differences; where a formula has a closed form besides the loop that
computes it, the value must agree with that, too. README.md beside this file has the format.
"""
import os
import random
import re
import sys

import mpmath as mp

from jets import DOUBLE, MAX_DOUBLE, MAX_SINGLE, OPEN, SINGLE, Jet, Num, Run, f32
from published import FORMULAS

mp.mp.dps = 150
STEP = mp.mpf(10) ** -40
AGREE = mp.mpf(10) ** -30
NOTHING = mp.mpf(10) ** -60  # what differences leave of a derivative that vanishes
DIGITS = 20
HERE = os.path.dirname(os.path.abspath(__file__))
FOLDER = os.path.join(HERE, "..", "data", "literature")


def box(name, variables):
    """Ranges of the variables, from the header of the .pull file: `// box: 2` or `// box: x 0..1, y -2..2`."""
    with open(os.path.join(FOLDER, name + ".pull"), encoding="utf-8") as f:
        found = re.search(r"^// box: (.*)$", f.read(), re.M)
    assert found, f"{name}: no box"
    if re.fullmatch(r"[\d.]+", found[1]):
        side = float(found[1])
        return [(-side, side)] * len(variables)
    ranges = dict(p.strip().split(" ") for p in found[1].split(","))
    return [tuple(map(float, ranges[v].split(".."))) for v in variables]


def points(formula, ranges):
    """Random points, the special ones, and points close to these."""
    rng = random.Random(formula.name)
    found = [tuple(rng.uniform(*r) for r in ranges) for _ in range(formula.count)]
    for p in formula.special:
        p = (p.real, p.imag) if isinstance(p, complex) else p if isinstance(p, tuple) else (p,)
        p = p + (0.0,) * (len(ranges) - len(p))
        found.append(p)
        if formula.near:
            shift = lambda c: c + rng.choice((-1, 1)) * 10 ** rng.uniform(-5, -2) * max(1, abs(c))
            found.append(tuple(map(shift, p)))
    for p in formula.exact:
        found.append(p if isinstance(p, tuple) else (p,))
    return list(dict.fromkeys(tuple(f32(c) + 0.0 for c in p) for p in found))


def seeds(formula, args):
    n = len(args) if formula.mode == "real" else 2 if formula.mode == "pair" else 1
    one = lambda k: [Num(1) if j == k else None for j in range(n)]
    if formula.mode == "real":
        return [Jet(Num(a), one(k), [None] * n, "real") for k, a in enumerate(args)]
    return [Jet(Num(args[0]), one(0), [None] * n, formula.mode)]


def evaluate(formula, args, flip=None):
    """The jet of the formula as it is written."""
    Run.reset(flip)
    Jet.second = formula.second
    return formula.written(*seeds(formula, args))


def size_of_value(formula, args):
    """The largest intermediate result of the value alone."""
    Run.reset()
    Jet.second = False
    none = [None] * (2 if formula.mode == "pair" else 1)
    formula.written(*[Jet(Num(a), none, none, formula.mode) for a in args])
    return Run.largest


def difference(f, args, k, unit=1):
    """First and second derivative along a direction by differences; None where the sides disagree."""
    h = STEP * max(abs(args[k]), 1) * unit
    at = lambda s: f(*[a + s if i == k else a for i, a in enumerate(args)])
    here, ahead, behind = at(0), at(h), at(-h)
    right, left = (ahead - here) / h, (here - behind) / h
    if abs(right - left) > mp.mpf(10) ** -25 * (abs(right) + abs(left) + 1):
        return None, None
    return (ahead - behind) / (2 * h), (ahead - 2 * here + behind) / h**2


def slopes(formula, args):
    """All derivatives by differences, in the order of a jet."""
    f = formula.definition
    if formula.mode == "real":
        both = [difference(f, args, k) for k in range(len(args))]
        return [b[0] for b in both], [b[1] for b in both]
    x, xx = difference(f, args, 0)
    y, _ = difference(f, args, 0, mp.j)
    if x is None or y is None:
        return [None] * (2 if formula.mode == "pair" else 1), [None]
    if formula.mode == "pair":
        return [(x + y) / 2, (x - y) / 2], [None, None]
    assert abs(x - y) <= AGREE * (abs(x) + 1), (formula.name, "is not holomorphic at", args)
    return [x], [xx]


def text(v):
    if not mp.isfinite(v):
        return "nan" if mp.isnan(v) else "inf"
    return "0.0" if v == 0 else mp.nstr(v, DIGITS)


def short(v):
    return mp.nstr(v, 3) if v < mp.mpf(10) ** 5000 else "inf"


def cells(v, complex_):
    if v is None:
        return ["nan", "nan"] if complex_ else ["nan"]
    huge = lambda p: abs(p) > mp.mpf(10) ** 5000
    parts = [mp.re(v), mp.im(v)] if complex_ else [mp.re(v)]
    return [("-" if p < 0 else "") + "inf" if huge(p) else text(p) for p in parts]


def numbers(jet):
    return [jet.a] + [p or Num(0) for p in jet.d + (jet.h if Jet.second else [])]


def line(formula, point, jet, columns, notes):
    """A row: arguments, values, scales, notes. `columns` are the values, None where there is none."""
    out = [repr(c) for c in point]
    for v in columns:
        out += cells(v, formula.complex)
    out += [short(n.tighten()) for n in numbers(jet)]
    return "\t".join(out + [",".join(notes) or "-"])


def rows(formula, point):
    """The row of a point, and one for each comparison that float32 leaves open."""
    args = [mp.mpf(c) for c in point] if formula.mode == "real" else [mp.mpc(*point)]
    try:
        value = mp.mpmathify(formula.definition(*args))
        alone = size_of_value(formula, args)
        jet = evaluate(formula, args)
        first, second = slopes(formula, args)
    except (ZeroDivisionError, ValueError):
        return []  # a pole
    if not mp.isfinite(value) or mp.isnan(value):
        return []
    notes, found = [], numbers(jet)
    scale = jet.a.e + abs(value)
    assert abs(jet.a.v - value) <= AGREE * scale + NOTHING, (formula.name, "value", point, mp.nstr(value, 20), mp.nstr(jet.a.v, 20))
    columns = [value]
    checks = list(zip(found[1:], first + (second if Jet.second else [])))
    for n, by_difference in checks:
        same = by_difference is not None and abs(n.v - by_difference) <= AGREE * (n.e + abs(n.v) + scale) + NOTHING
        if not same:
            # a value too large for the step of the differences has no check
            assert Run.tie or Run.largest > 1e60 or by_difference is None, (
                formula.name, "derivative", point, mp.nstr(n.v, 20), by_difference and mp.nstr(by_difference, 20))
        if Run.tie and not same:
            notes.append("kink")
        columns.append(None if Run.tie and not same else n.v)
    for word, largest in (("overflow", alone), ("slope-overflow", Run.largest)):
        if largest > MAX_SINGLE:
            notes.append(word + ("64" if largest > MAX_DOUBLE else ""))
    if Run.coarse * DOUBLE > 1:
        notes.append("coarse64")
    elif Run.coarse * SINGLE > 1:
        notes.append("coarse")
    undecided = [(k, margin) for k, margin in enumerate(Run.decisions) if margin < OPEN * SINGLE]
    if len(undecided) > 1:
        notes.append("coarse64" if any(m < OPEN * DOUBLE for _, m in undecided) else "coarse")
        undecided = []
    out = [line(formula, point, jet, columns, dict.fromkeys(notes))]
    for k, margin in undecided:
        try:
            other = evaluate(formula, args, flip=k)
        except (ZeroDivisionError, ValueError):
            continue
        kinks = [None if c is None else n.v for n, c in zip(numbers(other), columns)]
        out.append(line(formula, point, other, kinks, ["other64" if margin < OPEN * DOUBLE else "other"]))
    return out


def header(formula):
    one = (lambda n: [f"{n}.re", f"{n}.im"]) if formula.complex else (lambda n: [n])
    if formula.mode == "real":
        names = list(formula.variables)
        d = [f"d{v}" for v in names]
        h = [f"d{v}{v}" for v in names]
    else:
        names = ["z.re", "z.im"]
        d, h = (["dz", "dzbar"], []) if formula.mode == "pair" else (["dz"], ["dzz"])
    quantities = ["f"] + d + (h if formula.second else [])
    columns = names + [c for q in quantities for c in one(q)] + [f"scale_{q}" for q in quantities] + ["notes"]
    return "# " + "\t".join(columns)


def write(formula):
    variables = formula.variables if formula.mode == "real" else ["re", "im"]
    found = []
    for point in points(formula, box(formula.name, variables)):
        found += rows(formula, point)
    with open(os.path.join(FOLDER, formula.name + ".tsv"), "w", encoding="utf-8") as f:
        f.write(f"# {formula.name}.pull; written by tests/oracle/literature.py\n{header(formula)}\n")
        f.write("\n".join(found) + "\n")
    return len(found)


def main():
    names = sys.argv[1:] or list(FORMULAS)
    failed = 0
    for name in names:
        try:
            print(f"{name}: {write(FORMULAS[name])} rows", file=sys.stderr)
        except Exception as problem:  # all problems of all formulas in one run
            failed += 1
            print(f"{name}: {type(problem).__name__}: {problem}", file=sys.stderr)
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
