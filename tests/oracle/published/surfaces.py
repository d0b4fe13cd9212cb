"""Algebraic surfaces."""
import mpmath as mp

from jets import hypot
from . import formula


def phi():
    return (1 + mp.sqrt(5)) / 2


def rt(n):
    return mp.sqrt(n)


def surface(**more):
    return formula("xyz", **more)


@surface(special=[(1, 0, 0), (0.5257311, 0.8506508, 0), (0, 0, 0.618034)])
def barth_decic(x, y, z):
    t = phi()
    w = x**2 + y**2 + z**2
    planes = (x**2 - t**4 * y**2) * (y**2 - t**4 * z**2) * (z**2 - t**4 * x**2)
    quartic = x**4 + y**4 + z**4 - 2 * x**2 * y**2 - 2 * x**2 * z**2 - 2 * y**2 * z**2
    return 8 * planes * quartic + (3 + 5 * t) * (w - 1) ** 2 * (w - (2 - t)) ** 2


@surface(special=[(1, 1, 0), (0, 0, 1), (1.4142135, 0, 0)])
def endrass_octic(x, y, z):
    r = rt(2)
    q = x**2 + y**2
    planes = 64 * (x**2 - 1) * (y**2 - 1) * ((x + y) ** 2 - 2) * ((x - y) ** 2 - 2)
    square = -4 * (1 + r) * q**2 + (8 * (2 + r) * z**2 + 2 * (2 + 7 * r)) * q - 16 * z**4 + 8 * (1 - 2 * r) * z**2 - (1 + 12 * r)
    return planes - square**2


@surface(special=[(1, 0, 0), (-0.5, 0.5, 0)])
def togliatti_quintic(x, y, z):
    s = rt(5 - rt(5))
    planes = x**4 - 4 * x**3 - 10 * x**2 * y**2 - 4 * x**2 + 16 * x - 20 * x * y**2 + 5 * y**4 + 16 - 20 * y**2
    quadric = 4 * (x**2 + y**2 - z**2) + (1 + 3 * rt(5))
    return 64 * (x - 1) * planes - 5 * s * (2 * z - s) * quadric**2


def labs_coefficients():
    # the real root of 7 a^3 + 7 a + 1
    a = mp.findroot(lambda t: 7 * t**3 + 7 * t + 1, mp.mpf("-0.14010685"))
    q = lambda n, d: mp.mpf(n) / d
    return (
        q(-12, 7) * a**2 - q(384, 49) * a - q(8, 7),
        q(-32, 7) * a**2 + q(24, 49) * a - 4,
        -4 * a**2 + q(24, 49) * a - 4,
        q(-8, 7) * a**2 + q(8, 49) * a - q(8, 7),
        49 * a**2 - 7 * a + 50,
    )


@surface(special=[(0, 0, 0), (1, 0, -1), (0, 0, -1)])
def labs_septic(x, y, z):
    a1, a2, a3, a4, a5 = labs_coefficients()
    s = x**2 + y**2
    p = x * (x**6 - 3 * 7 * x**4 * y**2 + 5 * 7 * x**2 * y**4 - 7 * y**6)
    p = p + 7 * z * (s**3 - 2**3 * z**2 * s**2 + 2**4 * z**4 * s) - 2**6 * z**7
    cubic = (z + 1) * s + a1 * z**3 + a2 * z**2 + a3 * z + a4
    return p - (z + a5) * cubic**2


def t8(t):
    return 128 * t**8 - 256 * t**6 + 160 * t**4 - 32 * t**2 + 1


def chmutov_octic_written(x, y, z):
    return t8(x) + t8(y) + t8(z) + 1


@surface(written=chmutov_octic_written, special=[(0, 0, 0), (1, 1, 0.9238795)])
def chmutov_octic(x, y, z):
    t = lambda v: mp.re(mp.cos(8 * mp.acos(v)))
    return t(x) + t(y) + t(z) + 1


@surface(special=[(0, 0, 0), (-2, 0, 0)])
def kummer_quartic(x, y, z):
    h = x / 2 + 1
    s = x**2 + y**2 + z**2
    return x**4 + y**4 + z**4 - h**2 * s - (x**2 * y**2 + x**2 * z**2 + y**2 * z**2) + h**4


@surface(special=[(0, 0, 0), (0, 0, -1), (1, 1, 1)], second=True)
def whitney_umbrella(x, y, z):
    return x * x - y * y * z


@surface(special=[(2, 0, 0), (0, 3.4641016, 0), (0, 0, 3.6055512)])
def hunt(x, y, z):
    return 4 * (x**2 + y**2 + z**2 - 13) ** 3 + 27 * (3 * x**2 + y**2 - 4 * z**2 - 12) ** 2


@surface(special=[(0.5, 0, 1), (0, 2, 0)])
def bohemian_dome(x, y, z):
    a, b, c = mp.mpf("0.5"), mp.mpf("1.5"), mp.mpf(1)
    u = a**2 - x**2
    v = b**2 * (1 - z**2 / c**2)
    return (y**2 + u - v) ** 2 - 4 * y**2 * u


@surface(special=[(0, 0, 0), (1, 0, 0)])
def goursat(x, y, z):
    a, b, c = mp.mpf("-0.5"), -1, mp.mpf("0.25")
    s = x**2 + y**2 + z**2
    return x**4 + y**4 + z**4 + a * s**2 + b * s + c


@surface(special=[(0.75, 0, 0), (0, 0, 0)])
def dupin_cyclide(x, y, z):
    a, c, d = mp.mpf(1), mp.mpf("0.25"), mp.mpf("0.5")
    b = rt(a**2 - c**2)
    return (x**2 + y**2 + z**2 + b * b - d * d) ** 2 - 4 * (a * x - c * d) ** 2 - 4 * (b * b) * y**2


@surface(special=[(0, 0, 0), (0, 0, 1)], second=True)
def kiss(x, y, z):
    return x**2 + y**2 - (1 - z) * z**4


@surface(special=[(0, 0, 0), (0, 1, 0)], second=True)
def zitrus(x, y, z):
    return x**2 + z**2 - y**3 * (1 - y) ** 3


@surface(special=[(0, 0, 0), (1, 1, 1)])
def limao(x, y, z):
    return x**2 - y**3 * z**3


@surface(special=[(0, 0, 0), (0, 1, 1)])
def calypso(x, y, z):
    return x**2 + y**2 * z - z**2


@surface(special=[(1, 0, 0), (0, 0, 0), (0.3, 0.3, 0)])
def distel(x, y, z):
    return x**2 + y**2 + z**2 + 1000 * (x**2 + y**2) * (x**2 + z**2) * (y**2 + z**2) - 1


@surface(special=[(0, 0, 1), (0.57735026, 0, 0)])
def dattel(x, y, z):
    return 3 * x**2 + 3 * y**2 + z**2 - 1


@surface(special=[(0, 0, 0), (1, 1, 0)], second=True)
def diabolo(x, y, z):
    return x**2 - (y**2 + z**2) ** 2


@surface(special=[(0, 0, 0), (1, 0, 0)], second=True)
def vis_a_vis(x, y, z):
    return x**2 - x**3 + y**2 + y**4 + z**3 - z**4


@surface(special=[(0, 0, 0), (-1, 0, 1)])
def kolibri(x, y, z):
    return x**3 + x**2 * z**2 - y**2


@surface(special=[(0, 0, 0)])
def daisy(x, y, z):
    return (x**2 - y**3) ** 2 - (z**2 - y**2) ** 3


@surface(special=[(0, 0, 0)])
def durchblick(x, y, z):
    return x**3 * y + x * z**3 + y**3 * z + z**3 + 5 * z


@surface(special=[(0, 0, 0), (0.70710677, 0.70710677, 0)])
def eistuete(x, y, z):
    return (x**2 + y**2) ** 3 - 4 * x**2 * y**2 * (z**2 + 1)


@surface(special=[(0, 0, 0), (0, 1, 0)])
def eve(x, y, z):
    return 5 * x**2 + 2 * x * z**2 + 5 * y**6 + 15 * y**4 + 5 * z**2 - 15 * y**5 - 5 * y**3


@surface(special=[(0, 0, 0), (1, 0, 0)])
def flirt(x, y, z):
    return x**2 - x**3 + y**2 + y**4 + z**3 - 10 * z**4


@surface(special=[(0, 0, 0), (1, 0, 0)])
def geisha(x, y, z):
    return x**2 * y * z + x**2 * z**2 - y**3 * z - y**3


@surface(special=[(0, 0, 0)])
def harlekin(x, y, z):
    return x**3 * z + 10 * x**2 * y + x * y**2 + y * z**2 - z**3


@surface(special=[(0, 0, 0), (1, 2, 1)])
def helix(x, y, z):
    return 6 * x**2 - 2 * x**4 - y**2 * z**2


@surface(special=[(0, 0, 0), (0, 0, 1)])
def herz(x, y, z):
    return y**2 + z**3 - z**4 - x**2 * z**2


def himmel_written(x, y, z):
    return (x - y * z) * (x + y * z)


@surface(written=himmel_written, special=[(0, 0, 0), (1, 1, 1)])
def himmel_und_hoelle(x, y, z):
    return x**2 - y**2 * z**2


def leopold_written(x, y, z):
    return 100 * (x * y * z) ** 2 + 3 * x**2 + 3 * y**2 + z**2 - 1


@surface(written=leopold_written, special=[(0, 0, 1)])
def leopold(x, y, z):
    return 100 * x**2 * y**2 * z**2 + 3 * x**2 + 3 * y**2 + z**2 - 1


@surface(special=[(0, 0, 0), (0, 0, 1), (0.5, 0, 0.70710677)], second=True)
def octdong(x, y, z):
    return x**2 + y**2 + z**4 - z**2


@surface(special=[(0, 0, 0), (0, 1, -1)])
def plop(x, y, z):
    return x**2 + (z + y**2) ** 3


@surface(special=[(0, 0, 0), (1, 1, 0)])
def seepferdchen(x, y, z):
    return x**4 - mp.mpf(5) / 2 * x**2 * y**3 - x * z**3 + y**6 - y**2 * z**3


@surface(special=[(0, 0, 0)])
def solitude(x, y, z):
    return x**2 * y * z + x * y**2 + y**3 + y**3 * z - x**2 * z**2


@surface(special=[(0, 0, 0), (2, 0, 0)])
def taube(x, y, z):
    return 256 * z**3 - 128 * x**2 * z**2 + 16 * x**4 * z + 144 * x * y**2 * z - 4 * x**3 * y**2 - 27 * y**4


@surface(special=[(0, 0, 0), (0, 1, 1)])
def spitz(x, y, z):
    return (y**3 - x**2 - z**2) ** 3 - 27 * x**2 * y**3 * z**2


@surface(special=[(0, 0, 0)])
def tobel(x, y, z):
    return x**3 * z + x**2 + y * z**3 + z**4 - 3 * x * y * z


@surface(special=[(0, 3.1622777, 0)])
def windkanal(x, y, z):
    return -(x**2) + y**4 + z**4 - x * y * z - 100


@surface(special=[(0, 0, 0), (0, 1, 1)])
def xano(x, y, z):
    return x**4 + z**3 - y * z**2


def stern_written(x, y, z):
    return 400 * (x**2 * y**2 + y**2 * z**2 + x**2 * z**2) + (hypot(x, y, z) ** 2 - 1) ** 3


@surface(written=stern_written, special=[(1, 0, 0), (0, 0, 0)])
def stern(x, y, z):
    return 400 * (x**2 * y**2 + y**2 * z**2 + x**2 * z**2) - (1 - x**2 - y**2 - z**2) ** 3


@surface(special=[(1, 0, -1)])
def nepali(x, y, z):
    return (x * y - z**3 - 1) ** 2 + (x**2 + y**2 - 1) ** 3


@surface(special=[(0, 1, 0), (1, 0, 1)])
def crixxi(x, y, z):
    return (y**2 + z**2 - 1) ** 2 + (x**2 + y**2 - 1) ** 3


@surface(special=[(1, 1, 1), (0, 0, 0)])
def polsterzipf(x, y, z):
    return (x**3 - 1) ** 2 + (y**3 - 1) ** 2 + (z**2 - 1) ** 3


@surface(special=[(1.7320508, 0, 1.259921)])
def twilight(x, y, z):
    return (z**3 - 2) ** 2 + (x**2 + y**2 - 3) ** 3


@surface(special=[(0, 0, 0), (0, 0, 1)])
def zeck(x, y, z):
    return x**2 + y**2 - z**3 * (1 - z)


@surface(special=[(0, 0, 0)])
def schneeflocke(x, y, z):
    return x**3 + y**2 * z**3 + y * z**4


@surface(special=[(0, 0, 0), (0, 0, 1)])
def boy(x, y, z):
    r, q = rt(2), x**2 + y**2
    first = 64 * (1 - z) ** 3 * z**3 - 48 * (1 - z) ** 2 * z**2 * (3 * x**2 + 3 * y**2 + 2 * z**2)
    second = 27 * q**2 - 24 * z**2 * q + 36 * r * y * z * (y**2 - 3 * x**2) + 4 * z**4
    third = -81 * q**2 - 72 * z**2 * q + 108 * r * x * z * (x**2 - 3 * y**2) + 4 * z**4
    return first + 12 * (1 - z) * z * second + (9 * x**2 + 9 * y**2 - 2 * z**2) * third


@surface(special=[(0, 0, 4.8733971)])
def chair(x, y, z):
    k, a, b = 5, mp.mpf("0.95"), mp.mpf("0.8")
    return (x**2 + y**2 + z**2 - a * k**2) ** 2 - b * ((z - k) ** 2 - 2 * x**2) * ((z + k) ** 2 - 2 * y**2)


@surface(special=[(0, 0, 0), (0.2, 0.2, 0.2)])
def nordstrand(x, y, z):
    cubic = x**3 * (y + z) + y**3 * (x + z) + z**3 * (x + y)
    even = x**2 * y**2 + x**2 * z**2 + y**2 * z**2
    odd = x**2 * y * z + y**2 * x * z + z**2 * x * y
    return 25 * cubic + 50 * even - 125 * odd + 60 * x * y * z - 4 * (x * y + x * z + y * z)


@surface(special=[(0, 1, 0), (0, 0, 0)])
def klein_bottle(x, y, z):
    s = x**2 + y**2 + z**2
    inner = s - 2 * y - 1
    return (s + 2 * y - 1) * (inner**2 - 8 * z**2) + 16 * x * z * inner


@surface(special=[(0, 0, 0), (0, 1, 0)])
def miter(x, y, z):
    return 4 * x**2 * (x**2 + y**2 + z**2) - y**2 * (1 - y**2 - z**2)


@surface(special=[(0, 0, 0), (1, 0, 0)])
def piriform(x, y, z):
    return x**4 - x**3 + y**2 + z**2


@surface(special=[(0, 0, 0), (0, 0, -1)])
def cross_cap(x, y, z):
    return 4 * x**2 * (x**2 + y**2 + z**2 + z) + y**2 * (y**2 + z**2 - 1)


@surface(special=[(1, 0, 0), (1, 1, 1)], exact=[(6.5, 0, 0), (1e7, 1, 1)])
def fermat(x, y, z):
    return x**50 + y**50 + z**50 - 1
