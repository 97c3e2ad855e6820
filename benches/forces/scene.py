"""Scenes of the force table: a body, its tissue, a rigid tool without friction, and its motion.

The tool is pressed along -z into the top of the body, whose highest point is the origin. Its base is fixed. Lengths
are in metres, forces in newtons; depth is that of the tool's lowest point below the undeformed top.
"""

import json
import pathlib
import tomllib

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE / "scenes"
ANSWERS = HERE / "answers"


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
        self.probe = content.get("probe_m", 0.02)

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
        return self.body.get("height_m", self.body.get("radius_m"))

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


def lame(youngs_modulus, poissons_ratio):
    mu = 0.5 * youngs_modulus / (1 + poissons_ratio)
    return mu, 2 * mu * poissons_ratio / (1 - 2 * poissons_ratio)


def names():
    return sorted(path.stem for path in SCENES.glob("*.toml"))
