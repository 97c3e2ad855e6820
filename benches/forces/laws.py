"""Laws of the engines as first Piola-Kirchhoff stress of a deformation gradient (3, 3, ...); mu and lambda [Pa] are
those of Hooke's law, to which each reduces at small strain.
"""

import numpy as np

IDENTITY = np.eye(3)[:, :, None, None]


def _cofactor(f):
    return np.array([np.cross(f[1], f[2], axis=0), np.cross(f[2], f[0], axis=0), np.cross(f[0], f[1], axis=0)])


def _determinant(f):
    return (f[0] * np.cross(f[1], f[2], axis=0)).sum(axis=0)


def _rotation(f):
    """Of the polar decomposition, by Newton's iteration [Higham 1986], which the complex step passes through."""
    turned = f
    for _ in range(20):
        last, turned = turned, 0.5 * (turned + _cofactor(turned) / _determinant(turned))
        if np.abs(turned - last).max() < 1e-14:
            break
    # Once more for the derivative, whose error the last step squares as well.
    return 0.5 * (turned + _cofactor(turned) / _determinant(turned))


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


PLANE = [(0, 0), (0, 1), (1, 0), (1, 1), (2, 2)]  # components that deform an axisymmetric body
SPACE = list(np.ndindex(3, 3))


class Material:
    """A law as FElupe asks for it; its tangent by `components` is by the complex step. mu and lambda may be arrays of
    points."""

    def __init__(self, law, mu, lam, components):
        self.law, self.mu, self.lam, self.components = law, mu, lam, components
        self.x = [np.eye(3), np.zeros(0)]

    def gradient(self, x, **_):
        return [self.law(x[0], self.mu, self.lam), x[-1]]

    def hessian(self, x, **_):
        f = x[0]
        tangent = np.zeros((3, 3, *f.shape))
        for k, l in self.components:
            moved = f.astype(complex)
            moved[k, l] += 1e-30j
            tangent[:, :, k, l] = self.law(moved, self.mu, self.lam).imag / 1e-30
        return [tangent]
