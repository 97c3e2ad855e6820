"""palpate, `model.kind = "hybrid"`: the whole linear organ."""

from engines import palpate_local
from engines.palpate_local import MESHES, SETTINGS, unfit, version  # noqa: F401

LAW = "linear"


def run(scene, mesh):
    return palpate_local.run(scene, mesh, "hybrid")
