"""Scenes of the force table: a body, its tissue, a rigid tool, and its motion.

The origin is the point of the surface that the tool touches; the body lies below it. A sphere or a flat punch is
pressed along -z, without friction; its depth is that of its lowest point below the origin. A grip holds a disc of the
surface rigidly and is pulled along +z; what is called depth is then the length of the pull. Forces resist the motion.
Lengths are in metres, forces in newtons.
"""

import json
import pathlib
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE / "scenes"
ANSWERS = HERE / "answers"
BODIES = HERE.parents[1] / "target" / "forces" / "bodies"


class Scene:
    """A file of `scenes`, and its file of `answers` once `answers.py` has written it."""

    def __init__(self, name):
        self.name = name
        content = tomllib.loads((SCENES / f"{name}.toml").read_text())
        self.title = content["title"]
        self.body = content["body"]
        self.tissue = content["tissue"]
        self.tool = content["tool"]
        self.radius = self.tool["radius_m"]
        motion = content["motion"]
        self.time = np.array(motion["time_s"])
        self.path = np.array(motion["depth_m"])
        self.judged = np.array(motion["judged_s"])
        # Distance along x at which the settling of the surface is read, on bodies whose top is known.
        self.probe = None if self.body["shape"] == "organ" else content.get("probe_m", 0.02)

    @property
    def end(self):
        return float(self.time[-1])

    def depth(self, time):
        """Depth [m] at a time [s]."""
        return np.interp(time, self.time, self.path)

    def speed(self, time, step):
        """Mean speed [m/s] of the step that ends at `time`."""
        return (self.depth(time) - self.depth(time - step)) / step

    def times(self, step):
        """End of each step [s]."""
        return step * np.arange(1, round(self.end / step) + 1)

    @property
    def height(self):
        """Of the body below the origin [m]; of an organ, that of the mesh around the tool."""
        return self.body.get("height_m", self.body.get("radius_m"))

    @property
    def planes(self):
        """What holds the body: all that is behind one of these planes, point [m] and normal in the scene's frame."""
        shape = self.body["shape"]
        if shape == "tube":
            end = 0.5 * self.body["length_m"] - 1e-4
            return [([side * end, 0.0, 0.0], [-side, 0.0, 0.0]) for side in (-1.0, 1.0)]
        if shape == "organ":
            turn = self.turn
            moved = [(np.subtract(plane["point_m"], self.body["place_m"]), plane["normal"]) for plane in self.body["planes"]]
            return [((turn @ point).tolist(), (turn @ normal).tolist()) for point, normal in moved]
        return [([0.0, 0.0, 1e-4 - self.height], [0.0, 0.0, 1.0])]

    @property
    def turn(self):
        """Rotation from an organ's frame to the scene's: the tool's direction becomes -z."""
        down = np.array(self.body["direction"]) / np.linalg.norm(self.body["direction"])
        aside = np.cross([0.0, 1.0, 0.0] if abs(down[1]) < 0.9 else [0.0, 0.0, 1.0], -down)
        aside /= np.linalg.norm(aside)
        return np.array([aside, np.cross(-down, aside), -down])

    def fixed(self, nodes):
        """Whether points [m] of the body are held."""
        return np.any([(nodes - point) @ normal <= 0.0 for point, normal in map(np.array, self.planes)], axis=0)

    @property
    def gripped(self):
        return self.tool["shape"] == "grip"

    @property
    def axisymmetric(self):
        """As far as a cylinder may stand for a box."""
        return self.body["shape"] in ("box", "hemisphere") and not self.slit

    @property
    def along(self):
        """Sense of the motion along z."""
        return 1.0 if self.gripped else -1.0

    @property
    def slit(self):
        """A cut of the top along y: its distance from the tool along x, length and depth, none without."""
        return self.body.get("slit")

    def not_a_press(self, grip="no grip in this adapter"):
        """Why an adapter cannot do it that only presses elastic tissue without a slit; None if it can."""
        if self.gripped:
            return grip
        if self.slit:
            return "no contact of a slit's sides in this adapter"
        return "no relaxation" if self.prony else None

    @property
    def lame(self):
        """mu and lambda [Pa] of Hooke's law."""
        return lame(self.tissue["youngs_modulus_pa"], self.tissue["poissons_ratio"])

    @property
    def prony(self):
        """(g, tau [s]) of the relaxation, none without."""
        return [tuple(term) for term in self.tissue.get("prony", [])]

    @property
    def inclusion(self):
        return self.body.get("inclusion")

    @property
    def layer(self):
        """A layer of the top with its own modulus, none without."""
        return self.body.get("layer")

    @property
    def second(self):
        """The part of the body that is not `tissue`: the inclusion or the layer, none in one material."""
        return self.inclusion or self.layer

    def in_second(self, across, height):
        """Whether points at these distances from the axis and heights above the top [m] are in that part."""
        if self.layer:
            return height > -self.layer["thickness_m"]
        return np.hypot(height + self.inclusion["depth_m"], across) < self.inclusion["radius_m"]

    @property
    def answers(self):
        path = ANSWERS / f"{self.name}.json"
        return json.loads(path.read_text())["laws"] if path.exists() else {}


def organ_surface(scene, triangles=None):
    """Vertices [m] and triangles of an organ in the scene's frame. Engines that are installed apart need no palpate:
    `table.py` writes the file before."""
    triangles = triangles or scene.body["triangles"]
    path = BODIES / f"{scene.name}-{triangles}.npz"
    if not path.exists():
        import palpate

        mesh = palpate.Mesh.builtin(scene.body["builtin"], triangles)
        vertices = (mesh.vertices - scene.body["place_m"]) @ scene.turn.T
        BODIES.mkdir(parents=True, exist_ok=True)
        np.savez(path, vertices=vertices, triangles=mesh.triangles)
    with np.load(path) as surface:
        return surface["vertices"], surface["triangles"].astype(int)


def lame(youngs_modulus, poissons_ratio):
    mu = 0.5 * youngs_modulus / (1 + poissons_ratio)
    return mu, 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio)


def names():
    return sorted(path.stem for path in SCENES.glob("*.toml"))
