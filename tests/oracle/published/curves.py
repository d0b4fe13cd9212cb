"""Plane curves."""
import mpmath as mp

from jets import absolute, atan2, cos, hypot, power
from . import formula


def curve(**more):
    return formula("xy", **more)


@curve(special=[(0, 0), (1.4142135, 0), (0.8660254, 0.5)], second=True)
def lemniscate_of_bernoulli(x, y):
    return (x**2 + y**2) ** 2 - 2 * (x**2 - y**2)


def cassini_written(x, y):
    b = mp.mpf("1.1")
    return hypot(x - 1, y) * hypot(x + 1, y) - b * b


@curve(written=cassini_written, special=[(1, 0), (0, 0), (0, 0.4582576)])
def cassini_ovals(x, y):
    # from the quartic (x² + y² + a²)² - 4 a² x² = (product of the distances)²
    return mp.sqrt((x**2 + y**2 + 1) ** 2 - 4 * x**2) - mp.mpf("1.21")


@curve(special=[(0, 0), (1, 0)])
def trifolium(x, y):
    return (x**2 + y**2) ** 2 - x**3 + 3 * x * y**2


@curve(special=[(0, 0), (1.5, 1.5)], second=True)
def folium_of_descartes(x, y):
    return x**3 + y**3 - 3 * x * y


@curve(special=[(0, 0), (1, 0), (3, 0)])
def conchoid(x, y):
    return (x - 1) ** 2 * (x**2 + y**2) - 4 * x**2


@curve(special=[(0, 0), (1, 0)])
def cartesian_oval(x, y):
    m, c, a = 2, 1, mp.mpf("1.5")
    return ((1 - m**2) * (x**2 + y**2) + 2 * m**2 * c * x + a**2 - m**2 * c**2) ** 2 - 4 * a**2 * (x**2 + y**2)


@curve(special=[(1, 0), (0, 1), (0, 0.33333334)])
def bicorn(x, y):
    return y**2 * (1 - x**2) - (x**2 + 2 * y - 1) ** 2


@curve(special=[(0, 0), (1, 0), (0, 0.8)])
def devils_curve(x, y):
    return y**2 * (y**2 - mp.mpf("0.64")) - x**2 * (x**2 - 1)


@curve(special=[(1, 0), (0, -1), (0.35355338, 0.35355338)])
def astroid(x, y):
    return (x**2 + y**2 - 1) ** 3 + 27 * x**2 * y**2


@curve(special=[(0, 0), (-2, 0)])
def cardioid(x, y):
    return (x**2 + y**2 + x) ** 2 - (x**2 + y**2)


@curve(special=[(3, 0), (-1, 0), (-1.5, 2.5980763)])
def deltoid(x, y):
    return (x**2 + y**2) ** 2 + 18 * (x**2 + y**2) - 27 - 8 * (x**3 - 3 * x * y**2)


@curve(special=[(2, 0), (0, 4)])
def nephroid(x, y):
    return (x**2 + y**2 - 4) ** 3 - 108 * y**2


@curve(special=[(0, 0), (1, 0)])
def butterfly(x, y):
    return y**6 - x**2 + x**6


@curve(special=[(0, 0), (1, 1), (1, -1)])
def ampersand(x, y):
    return (y**2 - x**2) * (x - 1) * (2 * x - 3) - 4 * (x**2 + y**2 - 2 * x) ** 2


@curve(special=[(1.25, 0), (0, 1), (0, 0)])
def superellipse(x, y):
    p = mp.mpf(5) / 2
    size = lambda v: power(absolute(v), p) if absolute(v) != 0 else v * v
    return size(x / mp.mpf("1.25")) + size(y) - 1


@curve(special=[(1, 0), (-1, 0.001)])
def rose(x, y):
    # for a point, the nearest branch of the polar curve is the one of its own angle
    return hypot(x, y) - cos(7 * atan2(y, x))
