"""SOFA's linear tetrahedra at small strain; the rest is that of `sofa_corotational`."""

from engines import sofa_corotational
from engines.sofa_corotational import MESHES, unfit, version  # noqa: F401

LAW = "linear"
SETTINGS = """TetrahedronFEMForceField, method `small`; the rest as for the corotational elements."""


def run(scene, mesh):
    return sofa_corotational.run(scene, mesh, method="small")
