"""Presses 4 mm into a liver and holds for 40 s; the same as `examples/palpate_a_liver.rs` and `.c`.

python examples/python/palpate_a_liver.py
"""

import numpy as np
import palpate

SCENE = """
format = 1
organ = { builtin = "liver", builtin_tissue = "pig-liver" }
tool = [{ name = "right", tip = { shape = "flat", radius_m = 0.001 } }]
"""


def main() -> None:
    simulation = palpate.Simulation(palpate.Scene.parse(SCENE))
    surface = palpate.Mesh(simulation.vertices, simulation.triangles)

    # 4 mm below the first vertex, along its inward normal.
    tip = surface.vertices[0] - 0.004 * surface.normals[0]

    forces = []
    for k in range(401):
        elapsed = 0.0 if k == 0 else 0.1
        forces.append(np.linalg.norm(simulation.step(tip, elapsed)[0]))  # [N]
    first, last = forces[0], forces[400]
    print(f"{first:.4f} N at once, {last:.4f} N after 40 s")

    # 1 − g₁ − g₂ of the tissue (table 6-3), plus the remaining relaxation of the slower term.
    assert abs(last / first - 0.5115) < 1e-3


if __name__ == "__main__":
    main()
