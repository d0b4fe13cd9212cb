"""Values and gradients deep in a zoom, with 60 digits: tests/data/deep_zoom.tsv.

    python3 tests/oracle/deep_zoom.py > tests/data/deep_zoom.tsv

Three fields that have detail at every scale around their centre (the first two) or down to some scale (the third). The
centre is an f64 number, the offset from it an f32 number; the value is that at their exact sum. Columns: field, width of
the view, offset x, offset y, value, ∂f/∂x, ∂f/∂y.
"""

import random
import struct

from mpmath import cos, log, mp, mpc, mpf, nstr, polyroots, sin

mp.dps = 60
POINTS = 48
STEPS = 500
ESCAPE = 1000


def single(x):
    return struct.unpack("f", struct.pack("f", x))[0]


def misiurewicz():
    """The point with 0 -> c -> ... of preperiod 4 and period 1 in the upper half plane nearest to -0.1 + 0.96 i: the
    root of P5(c) - P4(c), P(n+1) = Pn² + c."""
    z = mpc("-0.1010963638", "0.9562865108")
    for _ in range(60):
        p, d = mpf(0), mpf(0)
        values = []
        for _ in range(5):
            d = 2 * p * d + 1
            p = p * p + z
            values.append((p, d))
        f, g = values[4][0] - values[3][0], values[4][1] - values[3][1]
        z -= f / g
    return float(z.real), float(z.imag)


def mandelbrot(x, y):
    """log of the distance estimate |z| log|z| / |z'|, and its gradient through the derivative by c."""
    c = mpc(x, y)
    z, d, dd = mpc(0), mpc(0), mpc(0)
    for _ in range(STEPS):
        if abs(z) > ESCAPE:
            break
        z, d, dd = z * z + c, 2 * z * d + 1, 2 * (z * dd + d * d)
    if abs(z) <= ESCAPE:
        return None
    size = log(abs(z))
    slope = d / z * (1 + 1 / size) - dd / d
    return log(abs(z) * size / abs(d)), slope.real, -slope.imag


THIRD, SEVENTH = mpf(1 / 3), mpf(1 / 7)


def ripples(x, y):
    """sin(3 log r²) around (1/3, 1/7), rounded to f64."""
    u, v = x - THIRD, y - SEVENTH
    s = u * u + v * v
    slope = 6 * cos(3 * log(s)) / s
    return sin(3 * log(s)), slope * u, slope * v


def sweep(x, y):
    """sin(1/(x² + y²))."""
    s = x * x + y * y
    slope = -2 * cos(1 / s) / (s * s)
    return sin(1 / s), slope * x, slope * y


FIELDS = [
    ("mandelbrot", mandelbrot, misiurewicz()),
    ("ripples", ripples, (1 / 3, 1 / 7)),
    ("sweep", sweep, (0.004, 0.001)),
]


def main():
    print("# field\twidth\toffset x\toffset y\tvalue\tdx\tdy")
    for name, field, (cx, cy) in FIELDS:
        print(f"# {name}: centre {cx!r}, {cy!r}")
        source = random.Random(name)
        for exponent in range(0, 13):
            width = 10.0**-exponent
            if name == "sweep":
                width *= 0.002
            count = 0
            while count < POINTS:
                ox, oy = (single(width * (source.random() - 0.5) * side) for side in (1.0, 0.75))
                row = field(mpf(cx) + mpf(ox), mpf(cy) + mpf(oy))
                if row is None:
                    continue
                count += 1
                numbers = "\t".join(nstr(v, 20) for v in row)
                print(f"{name}\t{width!r}\t{ox!r}\t{oy!r}\t{numbers}")


main()
