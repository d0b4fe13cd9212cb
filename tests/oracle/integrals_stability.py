#!/usr/bin/env python3
"""Integrals along extreme rays by mpmath at 60 digits: tests/data/integrals/stability.tsv.

The rays are a sample of those of the program `stability` (tests/src/bin/stability.rs):

    cargo run -p pullback-tests --bin stability -- --sample 8 | python3 tests/oracle/integrals_stability.py

A line `= density` begins a class; each line below it is a ray and its result as in integrals_rays.py.
"""

import re
import sys
from multiprocessing import Pool

from mpmath import mp, mpf

from integrals_densities import Density
from integrals_rays import OUT, integral

# where a density changes its form or is steep, and about how fast it turns
PLANES = ["x", "y", "z"]
BALL = ["x^2+y^2+z^2", "x^2+y^2", "y"]
LONGEST = 200.0


def case(text):
    """The density as integrals_rays.py has it."""
    code = re.sub(r"length\(\((.*?)\)\)", r"len(\1)", text)
    code = re.sub(r"if (.*?) then (.*?) else (.*)", r"iff(\1, \2, \3)", code)
    code = re.sub(r"(?<=[\d)]) +(?=[a-z(\d])", "*", code)
    code = re.sub(r"\b([xyz]) +(?=[a-z(])", r"\1*", code)
    code = re.sub(r"(\^\d+) +(?=[a-z(])", r"\1*", code)
    marks = BALL + PLANES + ["x^2+y^2+z^2-1", "y-1", "y+1", "x^2+y^2-4", "y+12", "144-x^2+y^2"]
    turns = 12.0 if "sin(3*x)" in code else 6.0 if "sin" in code or "cos" in code else 1.0
    return Density(code, marks, speed=turns)


def row(job):
    text, line = job
    numbers = [mpf(float(n)) for n in line.split()]
    o, d, a, b = numbers[:3], numbers[3:6], numbers[6], numbers[7]
    if abs(b - a) > LONGEST and any(w in text for w in ("sin", "cos", "exp")):
        return None
    try:
        value, size, error = integral(case(text), o, d, a, b)
    except (ZeroDivisionError, ValueError, TypeError, OverflowError):
        return None
    is_real = not isinstance(value, mp.mpc) and mp.isfinite(value) and mp.isfinite(size)
    if not is_real or size > mpf(10) ** 36 or error > size * mpf(10) ** -14 + mpf(10) ** -60:
        return None
    return f"{line} {mp.nstr(value, 20)} {mp.nstr(size, 8)}"


def main():
    jobs, text = [], None
    for line in sys.stdin.read().splitlines():
        if line.startswith("= "):
            text = line[2:]
        elif line:
            jobs.append((text, line))
    lines, last, left_out = ["# by tests/oracle/integrals_stability.py"], None, 0
    with Pool(2) as pool:
        for (text, _), found in zip(jobs, pool.imap(row, jobs)):
            if text != last:
                lines.append(f"= {text}")
                print(text, flush=True)
                last = text
            left_out += found is None
            lines += [found] if found else []
    (OUT / "stability.tsv").write_text("\n".join(lines) + "\n")
    print(len(jobs) - left_out, "rays,", left_out, "left out")


if __name__ == "__main__":
    main()
