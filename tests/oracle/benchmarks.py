"""The benchmark expressions of FPBench and Herbie in our language, with points of their domains and exact values there.

    python3 tests/oracle/benchmarks.py extract fpbench PATH   # once: writes tests/data/benchmarks/fpbench.fpcore from a checkout
    python3 tests/oracle/benchmarks.py extract herbie PATH
    python3 tests/oracle/benchmarks.py                        # writes {fpbench,herbie}.tsv and {fpbench,herbie}_points.tsv

Arguments are float32 numbers that are uniform among the representable ones in the precondition, as Herbie samples
(Panchekha et al., "Automatically improving accuracy for floating point expressions", PLDI 2015). Exact values are
balls of Arb (python-flint) at 200 bits, or as many more as leave an error below 2^-110 of the value.
"""

import glob
import os
import random
import struct
import sys
import threading
from fractions import Fraction

import mpmath
from flint import arb

import fpcore
import rounded

DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data", "benchmarks")
POINTS = 64
# points of the whole box that are tried for the precondition, and points of the domain that are tried for a value
DRAWS = 400_000
TRIES = 20_000
COLUMNS = 16
PRECISIONS = (200, 400, 800, 1600, 3200, 6400, 12800)
# a point whose loops take more steps is left out
STEPS = 1_000
TOP = 0x7F7FFFFF


# ----------------------------------------------------------------------------------------------------------------- extraction

FOLDERS = {"fpbench": "benchmarks", "herbie": "bench"}


def extract(collection, checkout):
    """Keeps of a checkout what a benchmark is: name, arguments, precondition, expression, and the file it stands in."""
    folder = os.path.join(checkout, FOLDERS[collection])
    lines = []
    for path in sorted(glob.glob(os.path.join(folder, "**", "*.fpcore"), recursive=True)):
        lines.append("; " + os.path.relpath(path, folder))
        with open(path, encoding="utf-8") as file:
            lines += [fpcore.stored(c) for c in fpcore.cores(file.read())]
    with open(os.path.join(DATA, collection + ".fpcore"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def kept(collection):
    """What was extracted: (file, cores of the file) in order."""
    with open(os.path.join(DATA, collection + ".fpcore"), encoding="utf-8") as file:
        parts = ("\n" + file.read()).split("\n; ")[1:]
    for part in parts:
        name, _, text = part.partition("\n")
        yield name, fpcore.cores(text)


# ------------------------------------------------------------------------------------------------------------------- float32


def ordinal(x):
    """The place of the greatest float32 that is at most x, a Fraction, counted from zero."""
    low, high = -TOP, TOP
    while low < high:
        middle = (low + high + 1) // 2
        if Fraction(number(middle)) <= x:
            low = middle
        else:
            high = middle - 1
    return low


def bits_of(place):
    return place if place >= 0 else 0x80000000 | -place


def number(place):
    return struct.unpack("<f", struct.pack("<I", bits_of(place)))[0]


# ------------------------------------------------------------------------------------------------------------------ sampling


def conjuncts(node):
    if isinstance(node, list) and node[0] == "and":
        return [part for arg in node[1:] for part in conjuncts(arg)]
    return [node]


def constant(node):
    """A rational next to the value of a constant expression, or None."""
    try:
        value = fpcore.at_precision(200, lambda: fpcore.Exact().value(node, {}))
        return Fraction(str(value.mid().fmpq()).replace(" ", "")) if hasattr(value, "mid") else None
    except (fpcore.Unfit, fpcore.Invalid, fpcore.Undecided, KeyError, TypeError, ValueError):
        return None


def flat(node, names):
    """The column that a node is, or None."""
    if isinstance(node, list) and len(node) == 3 and node[0] == "ref":
        node = f"{node[1]}[{node[2]}]"
    return node if isinstance(node, str) and node in names else None


def intervals(pre, names):
    """The places of each argument that comparisons with constants leave; only to sample faster."""
    low, high = dict.fromkeys(names, -TOP), dict.fromkeys(names, TOP)

    def at_least(name, bound):
        if bound is not None:
            low[name] = max(low[name], ordinal(bound) if bound > -Fraction(number(TOP)) else -TOP)

    def at_most(name, bound):
        if bound is not None:
            high[name] = min(high[name], ordinal(bound) if bound >= -Fraction(number(TOP)) else -TOP - 1)

    def chain(op, parts):
        if op in (">", ">="):
            parts = parts[::-1]
        elif op == "==":
            chain("<=", parts)
            parts = parts[::-1]
        for k, part in enumerate(parts):
            name = flat(part, names)
            inside = flat(part[1], names) if isinstance(part, list) and part[0] in ("fabs", "abs") else None
            if name:
                for other in parts[:k]:
                    at_least(name, constant(other))
                for other in parts[k + 1 :]:
                    at_most(name, constant(other))
            elif inside:
                for other in parts[k + 1 :]:
                    bound = constant(other)
                    at_most(inside, bound)
                    at_least(inside, None if bound is None else -bound)

    for part in conjuncts(pre) if pre is not None else []:
        if isinstance(part, list) and part[0] in ("<", "<=", ">", ">=", "=="):
            chain(part[0], part[1:])
    return [(low[n], high[n]) for n in names]


def columns(args):
    out = []
    for arg in args:
        out += [arg] if isinstance(arg, str) else [f"{arg[0]}[{k}]" for k in range(int(arg[1]))]
    return out


def environment(args, values):
    env, rest = {}, list(values)
    for arg in args:
        if isinstance(arg, str):
            env[arg] = rest.pop(0)
        else:
            env[arg[0]] = [rest.pop(0) for _ in range(int(arg[1]))]
    return env


def admitted(core, evaluator, values):
    """Whether a point is in the domain that the precondition states."""
    if core.pre is None:
        return True
    for bits in PRECISIONS[:3]:
        try:
            env = environment(core.args, [arb(v) for v in values])
            return fpcore.at_precision(bits, lambda: evaluator.value(core.pre, env))
        except fpcore.Undecided:
            continue
        except fpcore.Invalid:
            break
    return False


def exact(core, evaluator, values):
    """The value as (hi, lo) in float64, or None where there is none in the range of float32."""

    def once():
        return evaluator.value(core.body, environment(core.args, [arb(v) for v in values]))

    for bits in PRECISIONS:
        try:
            ball = fpcore.at_precision(bits, once)
        except fpcore.Undecided:
            continue
        except (fpcore.Invalid, OverflowError):
            return None
        if not isinstance(ball, arb):
            raise fpcore.Unfit("a condition as a value")
        if ball.is_zero():
            return 0.0, 0.0
        if ball.rel_accuracy_bits() >= 110:
            return in_range(ball)
        if abs(ball) > 1e40:
            return None
        if abs(ball) < arb(2) ** -1100:
            # so close to zero that it rounds to it in both formats
            return 0.0, 0.0
    raise fpcore.Undecided


LARGEST = Fraction(2) ** 128 - Fraction(2) ** 103


def in_range(ball):
    middle = ball.mid()
    if not abs(middle) < arb(2) ** 129:
        return None
    mantissa, exponent = middle.man_exp()
    mantissa, exponent = int(mantissa), int(exponent)
    if exponent + mantissa.bit_length() < -1100:
        return 0.0, 0.0
    value = Fraction(mantissa) * Fraction(2) ** exponent
    if abs(value) >= LARGEST:
        return None
    hi = float(value)
    return hi, float(value - Fraction(hi))


def sample(core, others, seed):
    """Points with their values, and how many were drawn."""
    names = columns(core.args)
    cases = core.pre[1:] if isinstance(core.pre, list) and core.pre[0] == "or" else [core.pre]
    boxes = [box for box in (intervals(case, names) for case in cases) if all(low <= high for low, high in box)]
    if not boxes:
        return [], 0
    source, evaluator, found, seen = random.Random(seed), fpcore.Exact(others, STEPS), [], set()
    drawn = tried = slow = undecided = 0
    while drawn < DRAWS and tried < TRIES and len(found) < POINTS:
        drawn += 1
        if tried > TRIES // 10 and not found:
            break
        box = source.choice(boxes) if len(boxes) > 1 else boxes[0]
        places = tuple(source.randint(low, high) for low, high in box)
        if places in seen:
            if all(low == high for box in boxes for low, high in box) and len(seen) == len(boxes):
                break
            continue
        seen.add(places)
        values = [number(p) for p in places]
        if not admitted(core, evaluator, values):
            continue
        tried += 1
        try:
            value = exact(core, evaluator, values)
        except fpcore.Slow:
            slow += 1
            if slow == 8 and not found:
                raise fpcore.Unfit(f"more than {evaluator.steps} steps") from None
            continue
        except fpcore.Undecided:
            undecided += 1
            continue
        if value is not None:
            found.append((places, value))
    if not found and undecided == tried > 0:
        raise fpcore.Unfit("what it compares is equal, or what it gives is zero, and no precision proves it")
    return found, drawn


# ---------------------------------------------------------------------------------------------------------------------- tables


def one(collection, file, index, core, others):
    """A row of the table and the lines of its points."""
    stem = os.path.splitext(file)[0]
    ident = f"{collection}/{stem}/{index}"
    pre = fpcore.write(core.pre) if core.pre is not None else "-"
    row = [ident, core.name, pre]
    try:
        names, text = fpcore.Translator(core, others).program()
        if len(names) > COLUMNS:
            raise fpcore.Unfit(f"{len(names)} arguments, more than the {COLUMNS} columns of a row")
        points, drawn = sample(core, others, ident)
        if not points:
            raise fpcore.Unfit(f"no float32 point with a finite value among {drawn}")
    except fpcore.Unfit as reason:
        return row + ["-", str(reason)], []
    lines = [f"{ident}\t{len(points)}\t{drawn}"]
    for places, (hi, lo) in points:
        args = " ".join(f"{bits_of(p):08x}" for p in places)
        lines.append(f"{args} {struct.unpack('<Q', struct.pack('<d', hi))[0]:016x} {lo:.6e}")
    return row + ["fits", text], lines


def work(collection, file, index):
    for name, cores in kept(collection):
        if name == file:
            others = {c.ident: c for c in cores if c.ident}
            return one(collection, file, index, cores[index - 1], others)
    raise ValueError(file)


def tables(collection, processes):
    from multiprocessing import Pool

    jobs = [(collection, name, k + 1) for name, cores in kept(collection) for k in range(len(cores))]
    with Pool(processes) as pool:
        results = pool.starmap(work_deep, jobs, chunksize=1)
    with open(os.path.join(DATA, collection + ".tsv"), "w", encoding="utf-8") as file:
        file.write(f"# expressions of {collection} in our language; written by tests/oracle/benchmarks.py\n")
        file.write("# id\tname\tprecondition\tfits\tformula, or why not\n")
        for row, _ in results:
            file.write("\t".join(row) + "\n")
    with open(os.path.join(DATA, collection + "_points.tsv"), "w", encoding="utf-8") as file:
        file.write("# a benchmark's line is: id, number of points, number of points drawn for them, bits that 24-bit rounding of every operation loses on average\n")
        file.write("# a point's line is: arguments (bits of float32), value (bits of float64), what the value is more than that\n")
        for _, lines in results:
            for line in lines:
                file.write(line + "\n")


def plain(collection):
    """Adds to each benchmark's line how many bits its formula loses as it is written, by rounding to 24 bits alone."""
    path = os.path.join(DATA, collection + "_points.tsv")
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    starts = [k for k, line in enumerate(lines) if not line.startswith("#") and "\t" in line]
    where = {f"{collection}/{os.path.splitext(name)[0]}/{k + 1}": (cores, k) for name, cores in kept(collection) for k in range(len(cores))}
    for start, end in zip(starts, starts[1:] + [len(lines)]):
        ident, count, drawn = lines[start].split("\t")[:3]
        cores, k = where[ident]
        evaluator = rounded.Rounded({c.ident: c for c in cores if c.ident}, STEPS)
        lost = [lost_at(cores[k], evaluator, line) for line in lines[start + 1 : end]]
        lines[start] = f"{ident}\t{count}\t{drawn}\t{sum(lost) / len(lost):.3f}"
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def lost_at(core, evaluator, line):
    fields = line.split(" ")
    values = [mpmath.mpf(struct.unpack("<f", struct.pack("<I", int(word, 16)))[0]) for word in fields[:-2]]
    hi = struct.unpack("<d", struct.pack("<Q", int(fields[-2], 16)))[0]
    exact = Fraction(hi) + Fraction(fields[-1])
    return rounded.bits_lost(evaluator, core.body, environment(core.args, values), exact)


def deep():
    sys.setrecursionlimit(1_000_000)
    threading.stack_size(512 << 20)


def run_deep(job, *arguments):
    """Runs a job on a stack for deep expressions."""
    deep()
    result = []
    thread = threading.Thread(target=lambda: result.append(job(*arguments)))
    thread.start()
    thread.join()
    if not result:
        raise RuntimeError(str(arguments))
    return result[0]


def work_deep(*job):
    return run_deep(work, *job)


if __name__ == "__main__":
    if sys.argv[1:2] == ["extract"]:
        run_deep(extract, *sys.argv[2:4])
    else:
        for collection in FOLDERS:
            tables(collection, int(os.environ.get("JOBS", "2")))
            run_deep(plain, collection)
