"""CalculiX: axisymmetric quadratic elements under a flat punch, by the decks of `benches/peers/calculix`."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

from engines import felupe_axisymmetric
from scene import HERE

sys.path.append(str(HERE.parent / "peers" / "calculix"))
import compare

if shutil.which("ccx") is None:
    raise ImportError("no program `ccx` (Debian: calculix-ccx)")

LAW = "linear"
MESHES = ["own"]
SETTINGS = """CAX8R, small strain (`*STATIC` without NLGEOM), the mesh of the adapter of FElupe; a solution is taken for
all depths, to which the force is proportional. A reference code: the time is that of the one solution."""


def version():
    done = subprocess.run(["ccx", "-v"], capture_output=True, text=True)
    return done.stdout.split()[-1]


def unfit(scene):
    if scene.tool["shape"] != "flat":
        return "no contact in this adapter"
    return "no relaxation in this adapter" if scene.prony else None


def run(scene, _mesh):
    began = time.perf_counter()
    across, down = felupe_axisymmetric.parameters(scene, felupe_axisymmetric.EDGE)
    nodes, elements = compare.quadratic_grid(list(across), [-z for z in reversed(down)])
    where = lambda holds: [n for n, (r, z) in nodes.items() if holds(r, z)]
    sets = {
        "FACE": where(lambda r, z: abs(z) < 1e-12 and r <= scene.radius * (1 + 1e-9)),
        "BOTTOM": where(lambda r, z: z < -scene.height * (1 - 1e-9)),
        "AXIS": where(lambda r, z: r == 0.0),
        "TOP": where(lambda r, z: abs(z) < 1e-12),
    }
    deepest = scene.path.max()
    step = ["*BOUNDARY", f"FACE,2,2,{compare.field(-deepest)}", "BOTTOM,1,2", "AXIS,1,1"]
    step += ["*NODE PRINT,NSET=FACE,TOTALS=ONLY", "RF", "*NODE PRINT,NSET=TOP", "U"]
    tissue = scene.tissue
    law = f"linear:{tissue['youngs_modulus_pa']}:{tissue['poissons_ratio']}"
    with tempfile.TemporaryDirectory() as folder:
        deck = compare.axisymmetric(law, nodes, elements, sets, step)
        found = compare.calculix(deck, pathlib.Path(folder), "flat")
    stiffness = -compare.WEDGES * found["FACE"][-1][1] / deepest
    top = sorted((nodes[int(number)][0], -sunk) for number, _, sunk, _ in found["TOP"])
    settled = felupe_axisymmetric.np.interp(scene.probe, *zip(*top)) / deepest
    seconds = time.perf_counter() - began
    times = scene.times(0.005)
    depth = scene.depth(times)
    answer = {"time": times, "force": stiffness * depth, "settled": settled * depth}
    return answer | {"steps_s": [seconds], "first_s": seconds, "nodes": len(nodes)}
