"""Minimal surfaces and distance fields."""
import mpmath as mp

from jets import absolute, atan2, below, clamp, cos, cosh, exp, floor, function, greatest, hypot, least, log, mix, sin, sinh, sqrt
from . import formula

Q = mp.mpf


def space(**more):
    return formula("xyz", **more)


# ------------------------------------------------------------------------------------------------------------------
# Minimal surfaces.
def schwarz_d_written(x, y, z):
    return sin(x) * sin(y) * sin(z) + sin(x) * cos(y) * cos(z) + cos(x) * sin(y) * cos(z) + cos(x) * cos(y) * sin(z)


@space(written=schwarz_d_written, special=[(0, 0, 0), (0.78539816, 0.78539816, -0.78539816)], second=True)
def schwarz_d(x, y, z):
    # by the sum formulas for three angles
    turned = mp.sin(x + y - z) + mp.sin(x - y + z) + mp.sin(y + z - x)
    return mp.sin(x) * mp.sin(y) * mp.sin(z) + (3 * mp.sin(x + y + z) + turned) / 4


@space(special=[(0, 0, 0), (3.1415927, 0, 0)], second=True)
def neovius(x, y, z):
    return 3 * (cos(x) + cos(y) + cos(z)) + 4 * cos(x) * cos(y) * cos(z)


@space(special=[(0, 0, 0)], second=True)
def lidinoid(x, y, z):
    waves = sin(2 * x) * cos(y) * sin(z) + sin(2 * y) * cos(z) * sin(x) + sin(2 * z) * cos(x) * sin(y)
    pairs = cos(2 * x) * cos(2 * y) + cos(2 * y) * cos(2 * z) + cos(2 * z) * cos(2 * x)
    return waves / 2 - pairs / 2 + Q("0.15")


@space(special=[(0, 0, 0), (1.5707964, 1.5707964, 0)], second=True)
def schoen_iwp(x, y, z):
    return 2 * (cos(x) * cos(y) + cos(y) * cos(z) + cos(z) * cos(x)) - (cos(2 * x) + cos(2 * y) + cos(2 * z))


@space(special=[(0, 0, 0), (1.5707964, 0, 0)], second=True)
def schoen_frd(x, y, z):
    return 4 * cos(x) * cos(y) * cos(z) - (cos(2 * x) * cos(2 * y) + cos(2 * y) * cos(2 * z) + cos(2 * z) * cos(2 * x))


@space(special=[(0, 0, 0)], second=True)
def fischer_koch_s(x, y, z):
    return cos(2 * x) * sin(y) * cos(z) + cos(x) * cos(2 * y) * sin(z) + sin(x) * cos(y) * cos(2 * z)


@space(special=[(0, 0, 0), (1.5707964, 1.5707964, 0)], second=True)
def scherk_first(x, y, z):
    return exp(z) * cos(y) - cos(x)


@space(special=[(0, 0, 0), (0, 0, 3.1415927)], second=True)
def scherk_fifth(x, y, z):
    return sin(z) - sinh(x) * sinh(y)


@space(special=[(1, 0, 0)], second=True)
def catenoid(x, y, z):
    return x**2 + y**2 - cosh(z) ** 2


@space(special=[(0, 0, 0), (1, 0, 3.1415927)], second=True)
def helicoid(x, y, z):
    return x * sin(z) - y * cos(z)


@space(special=[(1, 1, 1)], second=True)
def enneper(x, y, z):
    first = (y**2 - x**2) / (2 * z) + Q(2) / 9 * z**2 + Q(2) / 3
    second = (y**2 - x**2) / (4 * z) - Q(1) / 4 * (x**2 + y**2 + Q(8) / 9 * z**2) + Q(2) / 9
    return first**3 - 6 * second**2


@space(special=[(1.5707964, 1.5707964, 1.5707964)])
def tubular_p(x, y, z):
    return absolute(cos(x) + cos(y) + cos(z)) - Q("0.25")


# ------------------------------------------------------------------------------------------------------------------
# Distances. Vectors are tuples.
def dot(a, b):
    s = a[0] * b[0]
    for p, q in zip(a[1:], b[1:]):
        s = s + p * q
    return s


def minus(a, b):
    return tuple(p - q for p, q in zip(a, b))


def scaled(a, s):
    return tuple(p * s for p in a)


def length(a):
    return hypot(*a)


def box_distance(p, b):
    q = [absolute(c) - s for c, s in zip(p, b)]
    outside = length([greatest(c, mp.mpf(0)) for c in q])
    return outside + least(greatest(greatest(q[0], q[1]), q[2]), mp.mpf(0))


def nearest_of_box(x, y, z):
    # definition: the distance from the nearest point of the box, or minus that from the nearest face
    b = (Q("0.75"), Q("0.5"), Q("0.625"))
    p = (x, y, z)
    gaps = [abs(c) - s for c, s in zip(p, b)]
    if all(g <= 0 for g in gaps):
        return max(gaps)
    near = [max(-s, min(s, c)) for c, s in zip(p, b)]
    return mp.sqrt(mp.fsum((c - n) ** 2 for c, n in zip(p, near)))


def sdf_box_written(x, y, z):
    return box_distance((x, y, z), (Q("0.75"), Q("0.5"), Q("0.625")))


@space(written=sdf_box_written, special=[(0.75, 0.5, 0.625), (1, 1, 1), (0, 0, 0.625)])
def sdf_box(x, y, z):
    return nearest_of_box(x, y, z)


@space(special=[(0.75, 0.5, 0.625), (0.25, 0.125, 0)])
def sdf_box_frame(x, y, z):
    e = Q("0.125")
    p = [absolute(c) - s for c, s in zip((x, y, z), (Q("0.75"), Q("0.5"), Q("0.625")))]
    q = [absolute(c + e) - e for c in p]

    def edge(a, b, c):
        return length([greatest(v, mp.mpf(0)) for v in (a, b, c)]) + least(greatest(a, greatest(b, c)), mp.mpf(0))

    return least(least(edge(p[0], q[1], q[2]), edge(q[0], p[1], q[2])), edge(q[0], q[1], p[2]))


@space(special=[(-1, 0.5, 0), (1.5, -1, 0.5)])
def sdf_capsule(x, y, z):
    a, b = (Q("-0.5"), Q("0.25"), Q(0)), (Q("0.75"), Q("-0.5"), Q("0.5"))
    p, v = minus((x, y, z), a), minus(b, a)
    t = clamp(dot(p, v) / dot(v, v), 0, 1)
    return length(minus(p, tuple(t * c for c in v))) - Q("0.25")


@space(special=[(0.5, 0.75, 0), (0, 1, 0), (1, 0, 0)])
def sdf_capped_cylinder(x, y, z):
    r, h = Q("0.5"), Q("0.75")
    d = (hypot(x, z) - r, absolute(y) - h)
    return least(greatest(*d), mp.mpf(0)) + length([greatest(c, mp.mpf(0)) for c in d])


def sign(x):
    if below(0, x):
        return 1
    return -1 if below(x, 0) else 0


@space(special=[(0.75, 0.5, 0.25), (0, 1, 1)])
def sdf_hex_prism(x, y, z):
    k, hx, hy, root = (-mp.sqrt(3) / 2, Q("0.5")), Q("0.75"), Q("0.5"), mp.sqrt(3)
    x, y, z = absolute(x), absolute(y), absolute(z)
    fold = 2 * least(x * k[0] + y * k[1], mp.mpf(0))
    x, y = x - fold * k[0], y - fold * k[1]
    d = (hypot(x - clamp(x, -hx / root, hx / root), y - hx) * sign(y - hx), z - hy)
    return least(greatest(*d), mp.mpf(0)) + length([greatest(c, mp.mpf(0)) for c in d])


def octahedron_written(x, y, z):
    s = Q("0.875")
    x, y, z = absolute(x), absolute(y), absolute(z)
    m = x + y + z - s

    def corner(a, b, c):
        k = clamp(Q("0.5") * (c - b + s), 0, s)
        return hypot(a, b - s + k, c - k)

    if below(3 * x, m):
        return corner(x, y, z)
    if below(3 * y, m):
        return corner(y, z, x)
    if below(3 * z, m):
        return corner(z, x, y)
    return m / mp.sqrt(3)


@space(written=octahedron_written, special=[(1, 0, 0.01), (0, 0, 0), (0.5, 0.5, 0.5)])
def sdf_octahedron(x, y, z):
    # definition: project on the face |x| + |y| + |z| = s; outside of it, on the nearest edge
    s = Q("0.875")
    p = [abs(c) for c in (x, y, z)]
    gap = (sum(p) - s) / 3
    if all(c - gap >= 0 for c in p):
        return gap * mp.sqrt(3)
    best = mp.inf
    for k in range(3):
        a, b, c = p[k], p[(k + 1) % 3], p[(k + 2) % 3]
        t = max(mp.mpf(0), min(s, (b - c + s) / 2))
        best = min(best, mp.sqrt(a**2 + (b - t) ** 2 + (c - s + t) ** 2))
    return best


@space(special=[(0.5, 0, 0), (0, 0.875, 0)])
def sdf_link(x, y, z):
    y = greatest(absolute(y) - Q("0.375"), mp.mpf(0))
    return hypot(hypot(x, y) - Q("0.5"), z) - Q("0.125")


@space(special=[(1, 0, 0), (0, 0, 0.75)])
def sdf_ellipsoid(x, y, z):
    r = (Q(1), Q("0.5"), Q("0.75"))
    k0 = hypot(*[c / s for c, s in zip((x, y, z), r)])
    k1 = hypot(*[c / s**2 for c, s in zip((x, y, z), r)])
    return k0 * (k0 - 1) / k1


@space(special=[(0.5112, 0.5487, 0), (0, -0.75, 0), (0, 0.75, 0)])
def sdf_capped_torus(x, y, z):
    ra, rb, arc = Q("0.75"), Q("0.25"), Q("0.75")
    x = absolute(x)
    sx, sy = mp.sin(arc), mp.cos(arc)
    inside = below(sx * y, sy * x)
    k = x * sx + y * sy if inside else hypot(x, y)
    return sqrt(x * x + y * y + z * z + ra**2 - 2 * ra * k) - rb


@space(special=[(0, 1.0625, 0.01), (0.5, 0, 0.5), (0.01, -0.25, 0.125)])
def sdf_pyramid(x, y, z):
    h, half = mp.mpf(1), Q("0.5")
    m = h * h + Q("0.25")
    x, z = absolute(x), absolute(z)
    x, z = greatest(x, z) - half, least(x, z) - half
    q = (z, h * y - half * x, h * x + half * y)
    s = greatest(-q[0], mp.mpf(0))
    t = clamp((q[1] - half * z) / (m + Q("0.25")), 0, 1)
    a = m * (q[0] + s) ** 2 + q[1] ** 2
    b = m * (q[0] + half * t) ** 2 + (q[1] - m * t) ** 2
    d = 0 if below(0, least(q[1], -q[0] * m - half * q[1])) else least(a, b)
    return sqrt((d + q[2] ** 2) / m) * sign(greatest(q[2], -y))


@formula("xy", special=[(0.25, 0.75), (0, 0.5), (0, 1), (0.5, 0.5)])
def sdf_heart(x, y):
    x = absolute(x)
    if below(1, x + y):
        return hypot(x - Q("0.25"), y - Q("0.75")) - mp.sqrt(2) / 4
    half = Q("0.5") * greatest(x + y, mp.mpf(0))
    a, b = x**2 + (y - 1) ** 2, (x - half) ** 2 + (y - half) ** 2
    return sqrt(least(a, b)) * sign(x - y)


@formula("xy", special=[(0, 1), (0.5, 0.25)])
def sdf_star(x, y):
    r, rf = mp.mpf(1), Q("0.5")
    c, s = mp.cos(mp.pi / 5), mp.sin(mp.pi / 5)
    k1, k2 = (c, -s), (-c, -s)
    ba = (rf * s, rf * c - 1)
    x = absolute(x)
    for k in (k1, k2):
        fold = 2 * greatest(x * k[0] + y * k[1], mp.mpf(0))
        x, y = x - fold * k[0], y - fold * k[1]
    x, y = absolute(x), y - r
    h = clamp((x * ba[0] + y * ba[1]) / (ba[0] ** 2 + ba[1] ** 2), 0, r)
    return hypot(x - ba[0] * h, y - ba[1] * h) * sign(y * ba[0] - x * ba[1])


def rotated(x, y, angle):
    if isinstance(angle, (int, mp.mpf)) and not hasattr(angle, "a"):
        c, s = mp.cos(angle), mp.sin(angle)
    else:
        c, s = cos(angle), sin(angle)
    return x * c - y * s, x * s + y * c


@space(special=[(0.5, 0, 0.375), (0, 1, 0)])
def sdf_twist(x, y, z):
    x, z = rotated(x, z, 2 * y)
    return box_distance((x, y, z), (Q("0.5"), Q(1), Q("0.375")))


def repetition_written(x, y, z):
    s = Q("1.5")
    nearest = lambda c: floor(c / s + Q("0.5"))
    return hypot(*[c - s * nearest(c) for c in (x, y, z)]) - Q("0.375")


@space(written=repetition_written, special=[(0.375, 0, 0), (1.5, 1.5, 0), (0.74, 0, 0)])
def sdf_repetition(x, y, z):
    # the nearest of all centres
    s = Q("1.5")
    near = lambda c: min(abs(c - s * n) for n in range(-4, 5))
    return mp.sqrt(mp.fsum(near(c) ** 2 for c in (x, y, z))) - Q("0.375")


@space(special=[(0.5, 0, 0.5), (0, 0, 0)])
def sdf_exponential_union(x, y, z):
    k = Q("0.125")
    a = hypot(x - Q("0.5"), y, z) - Q("0.5")
    b = hypot(hypot(x + Q("0.5"), z) - Q("0.5"), y) - Q("0.25")
    two = lambda v: exp(v * mp.log(2)) if not hasattr(v, "a") else exp2(v)
    lb = lambda v: mp.log(v, 2) if not hasattr(v, "a") else log2(v)
    return -(k * lb(two(-a / k) + two(-b / k)))


LN2 = lambda: mp.log(2)
exp2 = function(*[lambda v, j=j: mp.power(2, v) * LN2() ** j for j in range(4)])
log2 = function(
    lambda v: mp.log(v) / LN2(), lambda v: 1 / (v * LN2()), lambda v: -1 / (v**2 * LN2()), lambda v: 2 / (v**3 * LN2())
)


@space(special=[(0, 0, 0.5), (0.5, -0.25, 0)])
def sdf_root_union(x, y, z):
    k = Q("0.25")
    a, b = y + Q("0.25"), hypot(x, y - Q("0.5"), z) - Q("0.5")
    return (a + b - sqrt((b - a) ** 2 + 4 * k**2)) / 2


@space(special=[(0, 0.375, 0), (0.875, 0, 0)])
def sdf_cubic_union(x, y, z):
    k, c = Q("0.125"), Q("0.375")
    a, b = hypot(x - c, y, z) - Q("0.5"), hypot(x + c, y, z) - Q("0.5")
    h = greatest(6 * k - absolute(a - b), mp.mpf(0)) / (6 * k)
    return least(a, b) - h**3 * k / 6


@space(special=[(1, 0, 0), (0, 0.75, 0.75)], second=True)
def sdf_displaced(x, y, z):
    return hypot(x, y, z) - 1 + sin(20 * x) * sin(20 * y) * sin(20 * z) / 20


@space(special=[(1.25, -0.5, 0), (0, -1, 0)])
def sdf_onion(x, y, z):
    d = hypot(x, y, z) - 1
    for t in ("0.25", "0.125", "0.0625"):
        d = absolute(d) - Q(t)
    return greatest(d, y)


@space(special=[(0.44, 0, 0), (0.25, 0.25, 0.25)])
def kifs_volumetric(x, y, z):
    def smooth(a, b, k):
        h = clamp(Q("0.5") + Q("0.5") * (b - a) / k, 0, 1)
        return mix(b, a, h) - k * h * (1 - h)

    warp = Q("0.29")
    q = [x + warp * sin(4 * z), y + warp * sin(4 * x), z + warp * sin(4 * y)]
    q = [absolute(c) - s for c, s in zip(q, (Q("0.5"), Q("0.25"), Q("0.375")))]
    q[0], q[1] = rotated(q[0], q[1], Q("0.5"))
    q[0], q[2] = rotated(q[0], q[2], Q("-0.25"))
    q[1], q[2] = rotated(q[1], q[2], Q("1.25"))
    u, v, w = [c * 2 for c in q]
    k = Q("0.3")
    rays = smooth(smooth(hypot(v, w) - Q("0.5"), hypot(u, w) - Q("0.25"), k), hypot(u, v) - Q("0.125"), k)
    return smooth(hypot(x, y, z) - Q("0.44"), rays / Q("2.6"), k) * Q("0.3")


@space(special=[(1, 0.25, 0), (0.5, 0.5, 0.375)])
def sdf_cheap_bend(x, y, z):
    x, y = rotated(x, y, Q("-0.75") * x)
    return box_distance((x, y, z), (Q(1), Q("0.25"), Q("0.375")))


@space(special=[(0.75, 0, 0.5), (-1.25, 0.25, 0)])
def sdf_elongated_torus(x, y, z):
    stretched = lambda c: c - clamp(c, Q("-0.25"), Q("0.25"))
    x, y, z = absolute(x) - Q("0.75"), stretched(y), stretched(z)
    return hypot(hypot(x, z) - Q("0.5"), y) - Q("0.125")
