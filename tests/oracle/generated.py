"""Values of the generated programs with 60 digits, and how far rounding in float64 may move them.

Reads the programs and their points as `generated_programs` prints them, and writes tests/data/generated.tsv:

    cargo build --workspace --example generated_programs
    target/debug/examples/generated_programs > programs.tsv
    python3 tests/oracle/generated.py programs.tsv

A program is parsed and evaluated here after docs/language.md alone; nothing of the compiler is asked.
"""

import collections
import pathlib
import sys

from mpmath import mp

from generated_numbers import Coarse, Jump, Overflow
from generated_programs import compiled

mp.dps = 60
OUT = pathlib.Path(__file__).parent.parent / "data" / "generated.tsv"
HEADER = """\
# Values of generated programs with 60 digits, by tests/oracle/generated.py; the programs have the checksum {checksum}
# value (of complex programs both parts)\tscale\tnotes
"""


def checksum(data):
    """FNV-1a of 64 bits (Fowler, Noll, Vo; draft-eastlake-fnv)."""
    state = 0xCBF29CE484222325
    for byte in data:
        state = (state ^ byte) * 0x100000001B3 % 2**64
    return f"{state:016x}"


def digits(x):
    return mp.nstr(x, 20, min_fixed=0, max_fixed=0) if mp.isfinite(x) else str(x)


def row(kind, text, x, y):
    """A line of the table, and its note."""
    try:
        found = compiled(kind, text)(mp.mpf(float(x)), mp.mpf(float(y)))
    except (Jump, Coarse, Overflow) as reason:
        note = type(reason).__name__.lower()
        return "-\t-\t" + note, f"{note}: {reason}"
    parts = [mp.re(found.v), mp.im(found.v)] if kind == "complex" else [found.v]
    return f"{' '.join(map(digits, parts))}\t{mp.nstr(found.e, 4)}\t-", "-"


def main():
    data = pathlib.Path(sys.argv[1]).read_bytes()
    notes = collections.Counter()
    lines = []
    for line in data.decode().splitlines():
        told, note = row(*line.split("\t"))
        lines.append(told)
        notes[note] += 1
    OUT.write_text(HEADER.format(checksum=checksum(data)) + "\n".join(lines) + "\n")
    for note, count in notes.most_common():
        print(count, note)


if __name__ == "__main__":
    main()
