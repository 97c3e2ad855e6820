"""palpate, `model.kind = "local"`; the other two models are in its siblings."""

import tempfile
import time

import numpy as np
import palpate

from scene import organ_surface

LAW = "linear"
MESHES = ["own"]
SETTINGS = "The defaults of a scene, tip without friction (`contact = \"slip\"`); a step is 5 ms."
KIND = "local"


def version():
    return palpate.__version__


def unfit(_scene):
    return None


def tube(scene):
    """A closed surface of the tube: outside, end, inside, end."""
    radius, length, edge = scene.body["radius_m"], scene.body["length_m"], 0.6 * scene.body["wall_m"]
    along = np.linspace(-0.5 * length, 0.5 * length, round(length / edge) + 1)
    inner = radius - scene.body["wall_m"]
    middle = np.full(1, 0.5 * (radius + inner))
    across = np.concatenate([np.full(len(along), radius), middle, np.full(len(along), inner), middle])
    along = np.concatenate([along, along[-1:], along[::-1], along[:1]])
    rows, columns = len(along), round(2 * np.pi * radius / edge)
    angle = 2 * np.pi * np.arange(columns) / columns
    grid = [np.repeat(along, columns), np.outer(across, np.sin(angle)).ravel(), np.outer(across, np.cos(angle)).ravel() - radius]
    i, j = [index.ravel() for index in np.mgrid[:rows, :columns]]
    here, aside = i * columns + j, i * columns + (j + 1) % columns
    further, both = (i + 1) % rows * columns + j, (i + 1) % rows * columns + (j + 1) % columns
    triangles = np.concatenate([np.column_stack([here, further, both]), np.column_stack([here, both, aside])])
    return np.column_stack(grid), triangles


def surface(scene):
    """Vertices [m] and triangles of the body in the scene's frame."""
    if scene.body["shape"] == "organ":
        return organ_surface(scene)
    if scene.body["shape"] == "tube":
        return tube(scene)
    cube = palpate.Mesh.builtin("cube", 12000 if scene.slit else None)
    assert scene.body["side_m"] == 0.1
    return (cube.vertices - [0.0, 0.0, 0.05]) * [1.0, 1.0, scene.height / 0.1], cube.triangles


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
        path = f"{folder}/body.ply"
        palpate.Mesh(*surface(scene)).write(path)
        planes = [{"point_m": point, "normal": normal} for point, normal in scene.planes]
        content, top = {"mesh": path, "anchor": {"planes": planes}}, 0.0
    content["tissue"] = tissue
    if scene.inclusion:
        ball = {"center_m": [0.0, 0.0, top - scene.inclusion["depth_m"]], "radius_m": scene.inclusion["radius_m"]}
        stiff = tissue | {"youngs_modulus_pa": scene.inclusion["youngs_modulus_pa"]}
        content["inclusion"] = [{"name": "inclusion", "ball": ball, "tissue": stiff}]
    if scene.layer:
        stiff = tissue | {"youngs_modulus_pa": scene.layer["youngs_modulus_pa"]}
        content["layer"] = [{"name": "layer", "thickness_m": scene.layer["thickness_m"], "tissue": stiff}]
    return content, top


def tools(scene):
    """The tool, and a hook that cuts the slit before."""
    if scene.gripped:
        # Square jaws of the same area, which hold whatever pulls.
        side = float(np.sqrt(np.pi) * scene.radius)
        jaws = {"length_m": side, "width_m": side, "force_n": 100.0, "friction": 10.0}
        return [{"name": "right", "kind": "grasper", "jaws": jaws, "tip": {"shape": "flat", "radius_m": scene.radius}}]
    right = {"name": "right", "tip": {"shape": scene.tool["shape"], "radius_m": scene.radius, "contact": "slip"}}
    hook = {"name": "left", "kind": "hook", "tip": {"shape": "flat", "radius_m": 0.001}}
    return [right, hook] if scene.slit else [right]


def prepare(scene, simulation, at):
    """Closes the jaws on the surface at `at` [m], or cuts the slit."""
    nowhere = [np.nan] * 5
    if scene.gripped:
        for grip in np.concatenate([np.zeros(20), np.linspace(0.0, 1.0, 40)]):
            simulation.step([*at, grip, 0.0])
    if scene.slit:
        half = 0.5 * scene.slit["length_m"]
        for along in np.linspace(-half, half, 400):
            simulation.step([nowhere, [scene.slit["aside_m"], along, at[2] - 0.001, 0.0, 1.0]])
        for _ in range(20):
            simulation.step([nowhere, nowhere])


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
        content = {"organ": content, "model": {"kind": kind or KIND}, "tool": tools(scene)}
        if scene.slit:
            # Little toughness: the hook is not measured.
            content["cutting"] = {"depth_m": scene.slit["depth_m"], "toughness_j_per_m2": 1.0}
        simulation = palpate.Simulation(palpate.Scene(content), progress=False, cache=False)
    step = simulation.step_length
    times = scene.times(step)
    forces, durations, settled = [], [], []
    rest, first = simulation.vertices, None
    if scene.probe is not None:
        corners, weights = probed(rest, simulation.triangles, scene)
    prepare(scene, simulation, [0.0, 0.0, top])
    middle = top + (scene.radius if scene.tool["shape"] == "sphere" else 0.0)
    for now in times:
        place = [0.0, 0.0, middle + scene.along * scene.depth(now)]
        if scene.gripped:
            pose = [*place, 1.0, 0.0]
        else:
            pose = [[*place, 0.0, 0.0], [np.nan] * 5] if scene.slit else place
        before = time.perf_counter()
        force = simulation.step(pose)
        after = time.perf_counter()
        durations.append(after - before)
        first = first or after - began
        forces.append(-scene.along * float(np.asarray(force).reshape(-1)[2]))
        if scene.probe is None:
            settled.append(np.nan)
        elif simulation.vertices.shape == rest.shape:
            settled.append(weights @ (rest[corners] - simulation.vertices[corners])[:, 2])
        else:
            settled.append(np.nan)
    return {
        "time": times,
        "force": np.array(forces),
        "settled": np.array(settled),
        "steps_s": durations,
        "first_s": first,
        "warnings": list(simulation.warnings),
    }
