"""palpate, `model.kind = "local"`; the other two models are in its siblings."""

import tempfile
import time

import numpy as np
import palpate

LAW = "linear"
MESHES = ["own"]
SETTINGS = "The defaults of a scene, tip without friction (`contact = \"slip\"`); a step is 5 ms."
KIND = "local"


def version():
    return palpate.__version__


def unfit(_scene):
    return None


def organ(scene, folder):
    """The table `organ`, whose top is at the height that is returned [m]."""
    tissue = {"law": "linear"} | {key: scene.tissue[key] for key in ["youngs_modulus_pa", "poissons_ratio"]}
    if scene.prony:
        tissue["prony"] = [{"g": g, "tau_s": tau} for g, tau in scene.prony]
    if scene.body["shape"] == "hemisphere":
        # Built in: 50 mm, fixed at its base.
        assert scene.body["radius_m"] == 0.05
        content, top = {"builtin": "hemisphere"}, 0.05
    else:
        cube = palpate.Mesh.builtin("cube")
        assert scene.body["side_m"] == 0.1
        lifted = cube.vertices + [0.0, 0.0, 0.05]
        mesh = palpate.Mesh(lifted * [1.0, 1.0, scene.height / 0.1], cube.triangles)
        path = f"{folder}/body.ply"
        mesh.write(path)
        plane = {"point_m": [0.0, 0.0, 1e-4], "normal": [0.0, 0.0, 1.0]}
        content, top = {"mesh": path, "anchor": {"planes": [plane]}}, scene.height
    content["tissue"] = tissue
    if scene.inclusion:
        ball = {"center_m": [0.0, 0.0, top - scene.inclusion["depth_m"]], "radius_m": scene.inclusion["radius_m"]}
        stiff = tissue | {"youngs_modulus_pa": scene.inclusion["youngs_modulus_pa"]}
        content["inclusion"] = [{"name": "inclusion", "ball": ball, "tissue": stiff}]
    if scene.layer:
        stiff = tissue | {"youngs_modulus_pa": scene.layer["youngs_modulus_pa"]}
        content["layer"] = [{"name": "layer", "thickness_m": scene.layer["thickness_m"], "tissue": stiff}]
    return content, top


def probed(vertices, triangles, scene):
    """Corners and weights of the highest point of the surface at the scene's distance from the axis."""
    a, b, c = vertices[triangles].swapaxes(0, 1)
    frame = np.stack([b - a, c - a], axis=-1)[:, :2]
    flat = np.abs(np.linalg.det(frame)) > 1e-15
    inner = np.full((len(triangles), 2), -1.0)
    inner[flat] = np.linalg.solve(frame[flat], ([scene.probe, 0.0] - a[flat, :2])[..., None])[..., 0]
    weights = np.column_stack([1 - inner.sum(axis=1), inner])
    height = np.where((weights > -1e-9).all(axis=1), (weights * vertices[triangles][..., 2]).sum(axis=1), -np.inf)
    found = int(height.argmax())
    return triangles[found], weights[found]


def run(scene, _mesh, kind=None):
    began = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        content, top = organ(scene, folder)
        tip = {"shape": scene.tool["shape"], "radius_m": scene.radius, "contact": "slip"}
        content = {"organ": content, "model": {"kind": kind or KIND}, "tool": [{"name": "right", "tip": tip}]}
        simulation = palpate.Simulation(palpate.Scene(content), progress=False, cache=False)
    middle = top + (scene.radius if scene.tool["shape"] == "sphere" else 0.0)
    step = simulation.step_length
    times = scene.times(step)
    forces, durations, settled = [], [], []
    rest = simulation.vertices
    corners, weights = probed(rest, simulation.triangles, scene)
    first = None
    for now in times:
        before = time.perf_counter()
        force = simulation.step([0.0, 0.0, middle - scene.depth(now)])
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        forces.append(float(np.asarray(force).reshape(-1)[2]))
        settled.append(weights @ (rest[corners] - simulation.vertices[corners])[:, 2])
    return {
        "time": times,
        "force": np.array(forces),
        "settled": np.array(settled),
        "steps_s": durations,
        "first_s": first,
        "warnings": list(simulation.warnings),
    }
