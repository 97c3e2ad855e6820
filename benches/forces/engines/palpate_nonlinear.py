"""palpate, `model.kind = "nonlinear"`: the whole organ at large deformation."""

from engines import palpate_local
from engines.palpate_local import MESHES, SETTINGS, unfit, version  # noqa: F401

# Of the stated tissue, which is the tip's; the organ around it, and so all that a grip pulls, is neo-Hookean of the same moduli.
LAW = "linear"


def run(scene, mesh):
    found = palpate_local.run(scene, mesh, "nonlinear")
    return found | {"law": "neo_hookean"} if scene.gripped else found
