"""Laws of the engines as first Piola-Kirchhoff stress of a deformation gradient (3, 3, ...); mu and lambda [Pa] are
those of Hooke's law, to which each reduces at small strain.

`in_plane` deformations alone: rotations about the third axis, as of a body that is axisymmetric.
"""

import numpy as np

IDENTITY = np.eye(3)[:, :, None, None]


def _determinant(f):
    return f[2, 2] * (f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0])


def _cofactor(f):
    """Of an in-plane deformation."""
    zero = np.zeros_like(f[0, 0])
    plane = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    return np.array([
        [f[1, 1] * f[2, 2], -f[1, 0] * f[2, 2], zero],
        [-f[0, 1] * f[2, 2], f[0, 0] * f[2, 2], zero],
        [zero, zero, plane],
    ])


def _rotation(f):
    """Of the polar decomposition of an in-plane deformation."""
    along, across = f[0, 0] + f[1, 1], f[1, 0] - f[0, 1]
    length = np.sqrt(along * along + across * across)
    c, s, zero = along / length, across / length, np.zeros_like(along)
    return np.array([[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]])


def _trace(a):
    return a[0, 0] + a[1, 1] + a[2, 2]


def _product(a, b):
    return np.einsum("ij...,jk...->ik...", a, b)


def _transpose(a):
    return np.swapaxes(a, 0, 1)


def linear(f, mu, lam):
    """Hooke's law at small strain."""
    strain = 0.5 * (f + _transpose(f)) - IDENTITY
    return 2 * mu * strain + lam * _trace(strain) * IDENTITY


def neo_hookean(f, mu, lam):
    """mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2."""
    volume = _determinant(f)
    return mu * f + (lam * np.log(volume) - mu) / volume * _cofactor(f)


def stable_neo_hookean(f, mu, lam):
    """mu/2 (I1 - 3) + L/2 (J - 1 - mu/L)^2, L = lambda + mu [Smith et al. 2018, without the logarithm]."""
    stiff = lam + mu
    return mu * f + (stiff * (_determinant(f) - 1) - mu) * _cofactor(f)


def stable_neo_hookean_logarithm(f, mu, lam):
    """The law of Smith et al. 2018 with its logarithm, M/2 (I1 - 3 - ln(I1 + 1)) + L/2 (J - 1 - 3 M/(4 L))^2,
    M = 4/3 mu, L = lambda + 5/6 mu."""
    shear, stiff = 4 / 3 * mu, lam + 5 / 6 * mu
    first = _trace(_product(_transpose(f), f))
    return shear * (1 - 1 / (first + 1)) * f + (stiff * (_determinant(f) - 1) - 0.75 * shear) * _cofactor(f)


def corotated(f, mu, lam):
    """Hooke's law in the turned frame of each element: mu |F - R|^2 + lambda/2 tr(R^T F - 1)^2."""
    turned = _rotation(f)
    stretch = _trace(_product(_transpose(turned), f)) - 3
    return 2 * mu * (f - turned) + lam * stretch * turned


def saint_venant_kirchhoff(f, mu, lam):
    """Hooke's law between Green's strain and the second Piola-Kirchhoff stress."""
    strain = 0.5 * (_product(_transpose(f), f) - IDENTITY)
    return _product(f, 2 * mu * strain + lam * _trace(strain) * IDENTITY)


LAWS = {
    law.__name__: law
    for law in [
        linear,
        neo_hookean,
        stable_neo_hookean,
        stable_neo_hookean_logarithm,
        corotated,
        saint_venant_kirchhoff,
    ]
}


class Material:
    """A law as FElupe asks for it; its tangent is by the complex step. mu and lambda may be arrays of points."""

    def __init__(self, law, mu, lam):
        self.law, self.mu, self.lam = law, mu, lam
        self.x = [np.eye(3), np.zeros(0)]

    def gradient(self, x, **_):
        return [self.law(x[0], self.mu, self.lam), x[-1]]

    def hessian(self, x, **_):
        f = x[0]
        tangent = np.zeros((3, 3, *f.shape))
        for k, l in [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)]:
            moved = f.astype(complex)
            moved[k, l] += 1e-30j
            tangent[:, :, k, l] = self.law(moved, self.mu, self.lam).imag / 1e-30
        return [tangent]
