"""palpate, `model.kind = "nonlinear"`: the whole organ at large deformation."""

from engines import palpate_local
from engines.palpate_local import MESHES, SETTINGS, unfit, version  # noqa: F401

# Of the stated tissue, which is the tip's; the organ around it is neo-Hookean of the same moduli: a thin wall that bends away,
# and all that a grip pulls.
LAW = "linear"


def run(scene, mesh):
    found = palpate_local.run(scene, mesh, "nonlinear")
    bends = scene.gripped or scene.body["shape"] == "tube"
    return found | {"law": "neo_hookean"} if bends else found
