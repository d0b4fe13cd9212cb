"""Functions of a complex variable."""
import mpmath as mp

from jets import asin, atan, cos, digamma, exp, gamma, log, modulus, sin, sqrt, tan, tanh
from . import formula


def holomorphic(**more):
    return formula("z", **more)


@holomorphic(special=[1 + 0j, 2 + 1j, 0.4551j - 1.0986841])
def cplot_test_function(z):
    return (z**2 - 1) * (z - mp.mpc(2, 1)) ** 2 / (z**2 + mp.mpc(2, 2))


@holomorphic(special=[0.001 + 0j, 1.4645919 + 0j])
def sine_of_cube(z):
    return sin(z**3) / z


@formula("z̄", special=[1 + 0j, 0.001j])
def phase(z):
    return z / modulus(z)


def log_power(z, w):
    """z^w; the compiler may compute it in one piece."""
    return exp(w * log(z))


@holomorphic(special=[1 + 0j, 0.5j])
def z_to_inverse(z):
    return log_power(z, 1 / z)


@holomorphic(special=[1 + 0j, 0.5j])
def inverse_to_z(z):
    return log_power(1 / z, z)


@holomorphic(special=[1 + 0j, -1 + 0.001j])
def cube_root(z):
    return exp(log(z) * (mp.mpf(1) / 3))


@holomorphic(special=[1.5 + 0j, 0.001 + 0j, 5j])
def tangent_over_z(z):
    return tan(z) / z


@holomorphic(special=[1.5707964 + 0j, 0.001 + 0j])
def cosine_over_z(z):
    return cos(z) / z


@holomorphic(special=[0.99 + 0j, 0.001j])
def inverse_sine(z):
    return asin(z)


@holomorphic(special=[0.99j, 0.001j])
def inverse_tangent(z):
    return atan(z)


@holomorphic(special=[1.5j, 3 + 0j])
def hyperbolic_tangent(z):
    return tanh(z)


@holomorphic(special=[1 + 0j, -2.5 + 0.001j, 0.001 + 0j])
def gamma_function(z):
    return gamma(z)


@holomorphic(special=[1.4616321 + 0j, -0.5 + 0.001j])
def digamma_function(z):
    return digamma(z)


@holomorphic(special=[0.70710677 + 0.70710677j, 0.001j])
def laurent(z):
    return z**3 + 1 / z


@holomorphic(special=[0j, 3.1415927 + 0j], second=True)
def secant(z):
    return 1 / cos(z)


@holomorphic(special=[-1 + 0j, 1.001 + 0j], second=True)
def moebius(z):
    return (z + 1) / (z - 1)


@holomorphic(special=[0j, -1 + 0j, 0.99 + 0j], second=True)
def koebe(z):
    return z / (1 - z) ** 2


@holomorphic(special=[0j, 0.99 + 0j, 1j], second=True)
def circle_root(z):
    return sqrt(1 - z**2)


@holomorphic(special=[1j, 0j], second=True)
def cayley_transform(z):
    return (z - mp.j) / (z + mp.j)


@holomorphic(special=[1 + 0j, 1j], second=True)
def cylinder_flow(z):
    return z + 1 / z - mp.mpc(0, 2) / mp.pi * log(z)


@holomorphic(special=[1.5 + 0j, 1j], second=True)
def inverse_joukowski(z):
    return z + sqrt(z - 1) * sqrt(z + 1)


@holomorphic(special=[0j, 1j], near=False)
def icosahedral_function(z):
    vertices = z * (z**10 + 11 * z**5 - 1)
    faces = -(z**20 + 1) + 228 * (z**15 - z**5) - 494 * z**10
    return 1728 * vertices**5 / faces**3


@holomorphic(special=[0.31830987 + 0j, 0.05 + 0.05j])
def sine_of_inverse(z):
    return sin(1 / z)


@holomorphic(special=[1 + 0j, -0.5 + 0.8660254j], second=True)
def wegert(z):
    return (z - 1) / (z**2 + z + 1)


@holomorphic(special=[0.001 + 0j, 1.5707964 + 0j], second=True)
def log_sine(z):
    return log(sin(z))


@holomorphic(special=[0j, 2j], second=True)
def gaussian(z):
    return exp(-(z**2))


@holomorphic(special=[0.5 + 0j, 1 + 0j])
def beta_function(z):
    return gamma(z) * mp.sqrt(mp.pi) / gamma(z + mp.mpf("0.5"))


@holomorphic(special=[3.1415927j, 0j], second=True)
def maxwell_fringe(z):
    return z + exp(z)
