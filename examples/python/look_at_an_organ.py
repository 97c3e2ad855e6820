"""Draws a touched liver into a PNG, coloured by the displacement of its surface; needs OpenGL, but no display.

pip install palpate[pictures]
python examples/python/look_at_an_organ.py liver.png
"""

import subprocess
import sys

import numpy as np
import palpate

PROBE = "import pyvista; pyvista.Plotter(off_screen=True, window_size=(8, 8)).screenshot(None, return_img=True)"


def main(path: str) -> None:
    scene = palpate.Scene(
        {
            "organ": {"builtin": "liver", "builtin_tissue": "pig-liver"},
            "tool": [{"name": "right", "tip": {"shape": "sphere", "radius_m": 0.006}}],
        }
    )
    simulation = palpate.Simulation(scene)
    rest, triangles = simulation.vertices, simulation.triangles
    normals = palpate.Mesh(rest, triangles).normals
    place = np.argmin(np.linalg.norm(rest - [-0.030, -0.076, 0.012], axis=1))
    point, normal = rest[place], normals[place]
    # The pose of a sphere is its centre.
    simulation.step(point + (0.006 - 0.008) * normal)
    moved = np.linalg.norm(simulation.vertices - rest, axis=1)
    print(f"{1e3 * moved.max():.2f} mm at most, {simulation.state.forces[0] @ normal:.3f} N")
    # The nearest vertex is not quite under the tip.
    assert abs(moved.max() - 0.008) < 0.0005

    # Without OpenGL, VTK ends the process; so another process tries.
    if subprocess.run([sys.executable, "-c", PROBE], capture_output=True).returncode != 0:
        raise SystemExit("no picture: there is no OpenGL here; install libegl1 and libgl1-mesa-dri")
    import pyvista

    organ = pyvista.PolyData(simulation.vertices, np.column_stack([np.full(len(triangles), 3), triangles]))
    organ["displacement [mm]"] = 1e3 * moved
    plotter = pyvista.Plotter(off_screen=True, window_size=(1200, 800))
    bar = {"color": "black", "vertical": True, "position_x": 0.88, "position_y": 0.25, "height": 0.5}
    plotter.add_mesh(organ, cmap="YlOrRd", smooth_shading=True, ambient=0.35, diffuse=0.7, scalar_bar_args=bar)
    plotter.add_mesh(pyvista.Sphere(radius=0.006, center=point - 0.002 * normal), color="steelblue", opacity=0.5)
    plotter.camera_position = [point + 0.25 * normal + [0.20, 0.0, 0.14], point + [0.03, 0.0, 0.0], (0.0, 0.0, 1.0)]
    plotter.screenshot(path)


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "liver.png")
