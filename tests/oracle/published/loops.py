"""Series, products and iterations. Where there is a closed form, it is the definition, and the loop is what is written."""
import mpmath as mp

from jets import (
    absolute, acos, atan2, below, clamp, conj, cos, exp, floor, function, greatest, hypot, im, least, log, modulus, re, sin, sqrt,
)
from . import formula
from .fields import box_distance, log2, rotated

Q = mp.mpf


def line(**more):
    return formula("x", **more)


def plane(**more):
    return formula("xy", **more)


def space(**more):
    return formula("xyz", **more)


def holomorphic(**more):
    return formula("z", **more)


def escaped(z, bound):
    return below(bound, modulus(z), branch=False)


def total(terms):
    terms = list(terms)
    s = terms[0]
    for t in terms[1:]:
        s = s + t
    return s


def whole(z, n):
    """z^n for a whole number n that is not a constant: a power of its own, rounded once."""
    fall = lambda j: mp.fprod(n - i for i in range(j))
    return function(*[lambda v, j=j: fall(j) * (v ** (n - j) if n >= j else 0) for j in range(4)])(z)


def tested(names):
    """Numbers of float32 on both sides of a circle, a unit in the last place apart."""
    import struct

    out = []
    for x in names:
        bits = struct.unpack("I", struct.pack("f", x))[0]
        out += [struct.unpack("f", struct.pack("I", bits + d))[0] for d in (-1, 0, 1)]
    return out


# ------------------------------------------------------------------------------------------------------------------
# Fourier series and kernels.
@line(special=[0, 1.5707964, 3.1415927], second=True)
def fourier_square(x):
    return 4 / mp.pi * total(sin(k * x) / k for k in range(1, 50, 2))


@line(special=[0, 3.1415927], second=True)
def fourier_sawtooth(x):
    sigma = lambda k: mp.sinc(mp.pi * k / 21)
    return Q("0.5") - 1 / mp.pi * total(sigma(k) * sin(k * x) / k for k in range(1, 21))


def fejer_written(x):
    return total((1 - Q(abs(k)) / 11) * cos(k * x) for k in range(-10, 11))


@line(written=fejer_written, special=[0.5711987, 2.5], second=True)
def fejer_kernel(x):
    return (mp.sin(11 * x / 2) / mp.sin(x / 2)) ** 2 / 11


def dirichlet_written(x):
    return 1 + 2 * total(cos(k * x) for k in range(1, 13))


@line(written=dirichlet_written, special=[0.2513274, 3.1415927], second=True)
def dirichlet_kernel(x):
    return mp.sin(Q("12.5") * x) / mp.sin(x / 2)


def poisson_written(x, y):
    return 1 + 2 * total(whole(x, n) * cos(n * y) for n in range(1, 31))


@plane(written=poisson_written, special=[(0.5, 0), (0.5, 3.1415927)], exact=[(0, 1), (0, 0)])
def poisson_kernel(x, y):
    z = mp.expj(y) * x
    return mp.re(1 + 2 * z * (1 - z**30) / (1 - z))


def weierstrass_written(x):
    return total(cos(3**n * mp.pi * x) / 2**n for n in range(9))


@line(written=weierstrass_written, special=[0, 0.5, 1])
def weierstrass_function(x):
    return mp.fsum(mp.cospi(3**n * x) * Q("0.5") ** n for n in range(9))


@line(special=[0, 3.1415927], second=True)
def riemann_function(x):
    return total(sin(n * n * x) / (n * n) for n in range(1, 41))


@line(special=[0.33333334, 0.2], exact=[(0.5,), (0.0,)])
def takagi(x):
    tooth = lambda t: absolute(t - floor(t + Q("0.5")))
    return total(tooth(2**n * x) / 2**n for n in range(13))


# ------------------------------------------------------------------------------------------------------------------
# Special functions by recurrences, series, fractions and means.
def bessel_written(x):
    u = -(x * x) / 4
    return total([1 + 0 * x] + [whole(u, k) / mp.factorial(k) ** 2 for k in range(1, 31)])


@line(written=bessel_written, special=[2.4048256, 3.8317060], exact=[(0.0,), (1e-20,)])
def bessel_j0(x):
    # the rest of the series is below 4^31/31!² < 1e-47
    return mp.besselj(0, x)


def chebyshev(n, x):
    a, b = 1, x
    for _ in range(n):
        a, b = b, 2 * x * b - a
    return a


def chebyshev_written(x):
    return chebyshev(12, x)


@line(written=chebyshev_written, special=[1, 0, 0.9914449], exact=[(1.25,)], second=True)
def chebyshev_recurrence(x):
    return mp.re(mp.cos(12 * mp.acos(x)))


def chmutov_written(x, y, z):
    return chebyshev(12, x) + chebyshev(12, y) + chebyshev(12, z) + 1


@space(written=chmutov_written, special=[(0, 0, 0), (1, 0.9659258, 0.8660254)], second=True)
def chmutov_dodecic(x, y, z):
    t = lambda v: mp.re(mp.cos(12 * mp.acos(v)))
    return t(x) + t(y) + t(z) + 1


def legendre_written(x):
    p, q = 1, 0
    for k in range(1, 11):
        p, q = ((2 * k - 1) * x * p - (k - 1) * q) / k, p
    return p


@line(written=legendre_written, special=[1, 0, 0.9739065], second=True)
def legendre_recurrence(x):
    return mp.polyval(list(reversed(legendre_coefficients(10))), x)


def legendre_coefficients(n):
    # Rodrigues' formula
    out = [mp.mpf(0)] * (n + 1)
    for k in range(n // 2 + 1):
        out[n - 2 * k] = (-1) ** k * mp.binomial(n, k) * mp.binomial(2 * n - 2 * k, n) / mp.mpf(2) ** n
    return out


def hermite_written(x):
    h, g = 1, 0
    for k in range(8):
        h, g = 2 * x * h - 2 * k * g, h
    return h


@line(written=hermite_written, special=[0, 0.3811870, 2], second=True)
def hermite_recurrence(x):
    return 256 * x**8 - 3584 * x**6 + 13440 * x**4 - 13440 * x**2 + 1680


def horner_written(z):
    s = 1
    for k in range(16, 0, -1):
        s = 1 + z * s / k
    return s


@holomorphic(written=horner_written, special=[0j, 3 + 0j, -3 + 0j, 3j], second=True)
def horner_exponential(z):
    return mp.fsum(z**k / mp.factorial(k) for k in range(17))


def lambert_written(x):
    t = 31
    for k in range(29, 0, -2):
        t = k - x * x / t
    return x / t


@line(written=lambert_written, special=[0.001, 1.5], exact=[(0.0,)], second=True)
def lambert_fraction(x):
    # the convergent as a quotient of polynomials, from the first fraction on
    (p, q), (before_p, before_q) = (x, mp.mpf(1)), (mp.mpf(0), mp.mpf(1))
    for j in range(1, 16):
        p, before_p = (2 * j + 1) * p - x * x * before_p, p
        q, before_q = (2 * j + 1) * q - x * x * before_q, q
    return p / q


def means(z, steps):
    a, g = 1, z
    for _ in range(steps):
        a, g = (a + g) / 2, sqrt(a * g)
    return a


def agm_written(z):
    return means(z, 8)


@holomorphic(written=agm_written, special=[1 + 0j, 0.1j + 1])
def agm(z):
    return mp.agm(1, z)


def elliptic_written(x):
    return mp.pi / (2 * means(sqrt(1 - x * x), 6))


@line(written=elliptic_written, special=[0.001, 0.9, -0.9])
def elliptic_k(x):
    return mp.ellipk(x * x)


def lambert_w_written(z):
    w = log(1 + z)
    for _ in range(8):
        r = w * exp(w) - z
        w = w - r / (exp(w) * (w + 1) - (w + 2) * r / (2 * w + 2))
    return w


@holomorphic(written=lambert_w_written, special=[1 + 0j, 2.7182817 + 0j])
def lambert_w(z):
    return mp.lambertw(z)


def babylonian_written(x):
    s = 1
    for _ in range(7):
        s = (s + x / s) / 2
    return s


@line(written=babylonian_written, special=[1, 4], second=True)
def babylonian_root(x):
    # in closed form: (1 + s)/(1 - s) is squared by each step
    r = mp.sqrt(x)
    q = ((1 - r) / (1 + r)) ** 128
    return r * (1 + q) / (1 - q)


def kepler_written(x, y):
    a = x
    for _ in range(8):
        a = a - (a - y * sin(a) - x) / (1 - y * cos(a))
    return a


@plane(written=kepler_written, special=[(1, 0.5), (0.1, 0.6)], exact=[(0, 0.5)])
def kepler_equation(x, y):
    return mp.findroot(lambda a: a - y * mp.sin(a) - x, x + y * mp.sin(x), tol=mp.mpf(10) ** -280)


# ------------------------------------------------------------------------------------------------------------------
# Newton's method and its relatives.
@holomorphic(special=[1 + 0j, -0.5 + 0.8660254j, 1.1 + 0.1j, -0.7937005 + 0.01j], near=True)
def newton_cubic(z):
    for _ in range(30):
        if below(modulus(z * z * z - 1), mp.mpf("1e-3"), branch=False):
            break
        z = z - (z**3 - 1) / (3 * z**2)
    return z


@holomorphic(special=[1 + 0j, -0.7 + 0j, 0.5j], second=True)
def halley_cubic(z):
    for _ in range(3):
        z = z * (z**3 + 2) / (2 * z**3 + 1)
    return z


@holomorphic(special=[0.01 + 0j, 0.5j])
def nova(z):
    w = mp.mpf(1)
    for _ in range(4):
        w = w - (w**3 - 1) / (3 * w**2) + z
    return w


def doyle_written(z):
    for _ in range(2):
        p = z**5
        z = z - 12 * z * ((p + 11) * p - 1) / (11 * p * (p + 6) - 1)
    return z


@holomorphic(written=doyle_written, special=[1 + 0j, 0.309017 + 0.9510565j, 0.5 + 0j])
def doyle_mcmullen(z):
    # the map of degree eleven, as a quotient of polynomials
    for _ in range(2):
        z = -(z**11 + 66 * z**6 - 11 * z) / (11 * z**10 + 66 * z**5 - 1)
    return z


# ------------------------------------------------------------------------------------------------------------------
# Orbits. The derivative is that of the state after the steps that were done.
BOUNDARY = [(x, 0.0) for x in tested([0.25, -2.0, -1.75487767, -1.41421356, 1.0, -1.0])]
BOUNDARY += [(a, b) for a in tested([-0.75]) for b in tested([0.1])] + [(0.0, y) for y in tested([1.0, 2.0])]


def orbit(step, z, steps, bound, stop=True):
    for _ in range(steps):
        if stop and escaped(z, bound):
            break
        z = step(z)
    return z


@holomorphic(special=[-1 + 0j, -0.12 + 0.75j, 0.3 + 0.5j, -0.75 + 0.2j], exact=BOUNDARY)
def mandelbrot(c):
    return orbit(lambda z: z * z + c, 0 * c, 50, 2)


@holomorphic(
    special=[-1 + 0j, 0.1 + 0j, -0.12 + 0.74j],
    exact=[(0.0, 0.0), (0.25, 0.0), (0.24999999, 0.0), (0.2500001, 0.0), (-0.75, 0.0), (-0.7499, 0.0), (1.0, 0.0), (-2.0, 0.0), (0.5, 0.5)],
)
def mandelbrot_thousand(c):
    z = 0 * c
    for _ in range(1000):
        z = z * z + c
    return z


@holomorphic(special=[0.5 + 0.5j, 1.2 + 0j, 0.1j], exact=[(2.5, 0.0), (4.0, 0.0), (4.0000005, 0.0)])
def julia(z):
    return orbit(lambda w: w * w + mp.mpc("-0.4", "0.6"), z, 16, 4)


@holomorphic(special=[0.5 + 0j, 0.9j], exact=[(x, 0.0) for x in tested([1.0, 1.1892071])])
def multibrot(c):
    return orbit(lambda z: z**5 + c, 0 * c, 12, 2)


@formula("z̄", special=[-1.75 - 0.03j, 0.5 - 0.5j])
def burning_ship(c):
    return orbit(lambda z: (absolute(re(z)) + absolute(im(z)) * mp.j) ** 2 + c, 0 * c, 10, 2)


@formula("z̄", special=[-1 + 0.2j, 0.25 + 0j], exact=[(x, 0.0) for x in tested([-2.0, 0.25])])
def tricorn(c):
    return orbit(lambda z: conj(z) ** 2 + c, 0 * c, 10, 2)


@plane(special=[(0.3, 0.5), (-1.5, 0.2)], exact=[(x, 0.0) for x in tested([0.2575, -2.0001])], count=24)
def mandelbrot_distance(x, y):
    c, z, d = x + mp.j * y, 0 * x, 0 * x
    for _ in range(60):
        if escaped(z, 1000):
            break
        z, d = z * z + c, 2 * z * d + 1
    return modulus(z) * log(modulus(z)) / modulus(d)


@plane(special=[(0.5, 0.5), (1, 0), (-2, 1)], count=24)
def mandelbrot_smooth(x, y):
    c, z, n = x + mp.j * y, 0 * x, 0
    while n < 60 and not escaped(z, 256):
        z, n = z * z + c, n + 1
    if n == 60:
        raise ValueError("inside of the set")
    return n - log2(log(modulus(z)) / mp.log(256))


@holomorphic(special=[0.5 + 0j, 0.5j])
def phoenix(z):
    w, v = z, 0 * z
    for _ in range(10):
        if escaped(w, 4):
            break
        w, v = w * w + Q("0.5667") + Q("-0.5") * v, w
    return w


@holomorphic(special=[1.5 + 0.5j, 0.5 + 1j])
def magnet(c):
    z = 0 * c
    for _ in range(8):
        if escaped(z, 100):
            break
        z = ((z * z + c - 1) / (2 * z + c - 2)) ** 2
    return z


@holomorphic(special=[0.5 + 0.5j, 1.1 + 0j], second=True)
def lattes(z):
    for _ in range(2):
        z = (z * z + 1) ** 2 / (4 * z * (z * z - 1))
    return z


@holomorphic(special=[0.5 + 0.5j, 0.31622776 + 0j], second=True)
def mcmullen_family(z):
    for _ in range(3):
        z = z**3 + Q("0.01") / z**3
    return z


@holomorphic(special=[0j, 1 + 0j, 1j], second=True)
def exponential_map(z):
    for _ in range(5):
        z = Q("0.3") * exp(z)
    return z


@holomorphic(special=[1 + 0j, 1.4142135 + 0j])
def power_tower(z):
    w = z
    for _ in range(4):
        w = exp(w * log(z))
    return w


@plane(special=[(3.2, 0.5), (2, 0.25), (3.5699456, 0.1)], second=True)
def logistic_map(x, y):
    for _ in range(16):
        y = x * y * (1 - y)
    return y


@plane(special=[(3.4, 2.6), (2.5, 2.5)])
def lyapunov(x, y):
    t, s = x / 4, 0 * x
    for k in range(1, 25):
        r = y if k % 2 else x
        t, s = r * t * (1 - t), s + log(absolute(r * (1 - 2 * t)))
    return s / 24


@plane(special=[(0, 0), (0.63135448, 0.18940634), (-0.5, 0.5)], second=True)
def henon(x, y):
    a, b = Q("1.4"), Q("0.3")
    for _ in range(8):
        x, y = 1 - a * (x * x) + y, b * x
    return x


@plane(special=[(3.1415927, 0), (0.5, 1)], second=True)
def standard_map(x, y):
    for _ in range(8):
        y = y + Q("0.9") * sin(x)
        x = x + y
    return x


@plane(special=[(0, 0), (0.5, -0.5)])
def ikeda(x, y):
    for _ in range(6):
        t = Q("0.4") - 6 / (1 + x * x + y * y)
        x, y = rotated(x, y, t)
        x, y = 1 + Q("0.9") * x, Q("0.9") * y
    return y


@plane(special=[(1, 1.5), (-0.1, 0)])
def gingerbread(x, y):
    for _ in range(10):
        x, y = 1 - y + absolute(x), x
    return x


@holomorphic(special=[1 + 0j, 0.5 + 0.1j])
def collatz(z):
    for _ in range(3):
        z = (2 + 7 * z - (2 + 5 * z) * cos(mp.pi * z)) / 4
    return z


# ------------------------------------------------------------------------------------------------------------------
# Series and products of a complex variable.
@holomorphic(special=[0j, 0.9 + 0j], second=True)
def lacunary(z):
    s, w = 0 * z, z
    for _ in range(7):
        s, w = s + w, w * w
    return s


def euler_written(z):
    p = 1 - z
    for k in range(2, 21):
        p = p * (1 - whole(z, k))
    return p


@holomorphic(written=euler_written, special=[0.5 + 0j, -0.4112484 + 0j], exact=[(0.0, 0.0)])
def euler_function(z):
    return mp.fprod(1 - z**k for k in range(1, 21))


def geometric_written(z):
    return total([1 + 0 * z] + [whole(z, k) for k in range(1, 10)])


@holomorphic(written=geometric_written, special=[-1 + 0j, 0.809017 + 0.5877852j], exact=[(0.0, 0.0)], second=True)
def geometric_sum(z):
    return (1 - z**10) / (1 - z)


def dilogarithm_written(z):
    return total(whole(z, k) / (k * k) for k in range(1, 31))


@holomorphic(written=dilogarithm_written, special=[0.5 + 0j, -0.7 + 0j])
def dilogarithm(z):
    return mp.fsum(z**k / k**2 for k in range(1, 31))


def theta_written(z):
    return 1 + 2 * total(Q("0.3") ** (n * n) * cos(2 * n * z) for n in range(1, 10))


@holomorphic(written=theta_written, special=[0j, 1.5707964 + 0.6j], second=True)
def jacobi_theta(z):
    # the rest is below 1e-39
    return mp.jtheta(3, z, Q("0.3"))


@holomorphic(special=[2 + 0j, 0.5 + 5j], count=16)
def zeta(z):
    eta = total((-1) ** (k - 1) * exp(-z * mp.log(k)) if k > 1 else 1 + 0 * z for k in range(1, 31))
    return eta / (1 - exp((1 - z) * mp.log(2)))


def sine_product_written(z):
    p = z
    for k in range(1, 21):
        p = p * (1 - z * z / (k * mp.pi) ** 2)
    return p


@holomorphic(written=sine_product_written, special=[3.1415927 + 0j, 1j], second=True)
def sine_product(z):
    n, w = 20, z / mp.pi
    return z * mp.gamma(n + 1 + w) * mp.gamma(n + 1 - w) / (mp.gamma(1 + w) * mp.gamma(1 - w) * mp.factorial(n) ** 2)


def gauss_written(z):
    p = z
    for k in range(1, 21):
        p = p * (z + k)
    return mp.factorial(20) * exp(z * mp.log(20)) / p


@holomorphic(written=gauss_written, special=[1 + 0j, 0.5 + 0j, -0.5 + 0.001j])
def gauss_gamma(z):
    return mp.factorial(20) * mp.power(20, z) * mp.gamma(z) / mp.gamma(z + 21)


@holomorphic(special=[0.5 + 0.5j, 0.5 + 0j])
def weierstrass_p(z):
    others = [mp.mpc(m, n) for m in range(-2, 3) for n in range(-2, 3) if m or n]
    return 1 / (z * z) + total(1 / (z - w) ** 2 - 1 / w**2 for w in others)


def blaschke_factors(z):
    p = None
    for k in range(1, 6):
        a = Q("0.7") * mp.expjpi(mp.mpf(2) * k / 5)
        q = (z - a) / (1 - mp.conj(a) * z)
        p = q if p is None else p * q
    return p


@holomorphic(written=blaschke_factors, special=[0.7 + 0j, 1 + 0j, 0j])
def blaschke_product(z):
    # the five factors, multiplied out
    r = Q("0.7") ** 5
    return (z**5 - r) / (1 - r * z**5)


def vieta_written(x):
    p = cos(x / 2)
    for k in range(2, 21):
        p = p * cos(x / 2**k)
    return p


@line(written=vieta_written, special=[3.1415927, 1], exact=[(4.0,)], second=True)
def vieta_product(x):
    return mp.sin(x) / (2**20 * mp.sin(x / 2**20))


@line(special=[1, 0.5], exact=[(0.0,), (2.0,), (1.0,)])
def wilkinson(x):
    p = x - Q(1) / 10
    for k in range(2, 21):
        p = p * (x - Q(k) / 10)
    return p


# ------------------------------------------------------------------------------------------------------------------
# Distance fields with loops. Vectors are tuples.
@space(special=[(1, 1, 1), (0.1, 0.2, -0.4)])
def sierpinski_tetrahedron(x, y, z):
    for _ in range(8):
        if below(x + y, 0):
            x, y = -y, -x
        if below(x + z, 0):
            x, z = -z, -x
        if below(y + z, 0):
            y, z = -z, -y
        x, y, z = 2 * x - 1, 2 * y - 1, 2 * z - 1
    return (hypot(x, y, z) - 2) / 256


@space(special=[(1, 0.5, 0.25), (0.3, 0.3, 1)])
def menger_sponge(x, y, z):
    d, s = box_distance((x, y, z), (1, 1, 1)), mp.mpf(1)
    for _ in range(3):
        a = [c * s - 2 * floor(c * s / 2) - 1 for c in (x, y, z)]
        s = 3 * s
        u, v, w = [absolute(1 - 3 * absolute(c)) for c in a]
        hole = (least(least(greatest(u, v), greatest(v, w)), greatest(w, u)) - 1) / s
        d = greatest(d, hole)
    return d


@space(special=[(0.5, 0.5, 0.5), (0.2, 0.7, 0.1)])
def apollonian(x, y, z):
    s = 1 + 0 * x
    for _ in range(6):
        x, y, z = [2 * (c / 2 + Q("0.5") - floor(c / 2 + Q("0.5"))) - 1 for c in (x, y, z)]
        k = Q("1.2") / (x * x + y * y + z * z)
        x, y, z, s = k * x, k * y, k * z, k * s
    return Q("0.25") * absolute(y) / s


@space(special=[(1, 0.25, 0.5), (0.5, 0.5, 0.5)])
def mandelbulb(x, y, z):
    px, py, pz, d = x, y, z, 1 + 0 * x
    for _ in range(4):
        r = hypot(x, y, z)
        if below(2, r, branch=False):
            break
        b, a = 8 * acos(y / r), 8 * atan2(x, z)
        d = 8 * r**7 * d + 1
        q = r**8
        x, y, z = px + q * sin(b) * sin(a), py + q * cos(b), pz + q * sin(b) * cos(a)
    r = hypot(x, y, z)
    return Q("0.5") * log(r) * r / d


@space(special=[(1, 1, 1), (2, 0.5, 0.1)])
def mandelbox(x, y, z):
    p, q, d = (x, y, z), (x, y, z), 1 + 0 * x
    for _ in range(6):
        v = [2 * clamp(c, -1, 1) - c for c in q]
        k = clamp(1 / (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), 1, 4)
        q = [2 * k * c + o for c, o in zip(v, p)]
        d = 2 * k * d + 1
    return hypot(*q) / d


@space(special=[(1, 0, 0), (0.5, 0.5, 0.5)])
def quaternion_julia(x, y, z):
    c = (Q("-0.2"), Q("0.6"), Q("0.2"), Q(0))
    q, d = (x, y, z, 0 * x), 1 + 0 * x
    norm = lambda q: q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    for _ in range(8):
        m = norm(q)
        if below(256, m, branch=False):
            break
        d = 4 * d * m
        a, b, u, v = q
        q = (a * a - b * b - u * u - v * v + c[0], 2 * a * b + c[1], 2 * a * u + c[2], 2 * a * v + c[3])
    m = norm(q)
    return Q("0.25") * log(m) * sqrt(m / d)


@space(special=[(1, 0, 0), (0, 0, 0)], second=True)
def metaballs(x, y, z):
    centre = lambda k: (mp.cospi(mp.mpf(2) * k / 5), mp.sinpi(mp.mpf(2) * k / 5))
    blob = lambda a, b: exp(-6 * ((x - a) ** 2 + (y - b) ** 2 + z**2))
    return total(blob(*centre(k)) for k in range(5)) - Q("0.5")


@space(special=[(1, 0.5, 0.25), (0.1, 0.2, 0.9)])
def octahedral_kifs(x, y, z):
    for _ in range(6):
        x, y, z = absolute(x), absolute(y), absolute(z)
        x, y = greatest(x, y), least(x, y)
        x, z = greatest(x, z), least(x, z)
        y, z = greatest(y, z), least(y, z)
        y, z = rotated(y, z, Q("0.25"))
        x, y, z = 2 * x - 1, 2 * y, 2 * z
    return (hypot(x, y, z) - 1) / 64
