"""An action that presses a place of the surface, instead of a small motion: the unit in which palpation is planned."""

from __future__ import annotations

import numpy as np

import palpate
from palpate.gym.tasks import CLEAR, Floats, Palpation, Task

#: How long a press takes where nothing else is stated [s]; and its ends: out of the tissue, over it, into it [-].
DURATION = 0.5
PARTS = (0.2, 0.6, 1.0)
#: The largest depth of a press [m].
LARGEST_DEPTH = 0.008


class Press:
    """Lifts the tip along the normal, moves it over another place and presses there.

    The first two numbers of an action are a point of the square in the plane of the task's side, with a half-width of
    `Palpation.REACH` about the scene's own place; the tip goes to the nearest vertex of the organ at rest, as if the
    surface were known from a scan. The third is the depth below it, from 0 to `LARGEST_DEPTH`. With the fourth above zero
    the hand says "here", and the tip stays where it is.
    """

    def __init__(self, task: Task, substeps: int) -> None:
        if not isinstance(task, Palpation):
            raise palpate.InputError('`action="press"` is for the task `find` only; leave it out')
        self.points, self.normals = task.vertices[task.places], task.normals[task.places]
        tip = task.content["tool"][task.tool].get("tip", {})
        # The position of a flat tip is the centre of its face, that of a sphere its centre.
        self.overhang = float(tip.get("radius_m", 0.0)) if tip.get("shape") == "sphere" else 0.0
        first = np.cross(task.facing, np.eye(3)[np.abs(task.facing).argmin()])
        first /= np.linalg.norm(first)
        plane = np.stack([first, np.cross(task.facing, first)])
        self.seen: Floats = (self.points - task.target) @ plane.T / task.REACH
        self.shares = np.linspace(0.0, 1.0, substeps + 1)[1:, None, None]

    def paths(self, tips: Floats, wish: Floats) -> Floats:
        """The positions of each tip at the steps of a press [m], from where it is now: shape (substeps, count, 3)."""
        new = np.linalg.norm(self.seen - wish[:, None, :2], axis=2).argmin(axis=1)
        old = np.linalg.norm(self.points - tips[:, None], axis=2).argmin(axis=1)
        above = CLEAR + self.overhang
        height = np.einsum("ni,ni->n", tips - self.points[old], self.normals[old])
        depth = 0.5 * (wish[:, 2:3] + 1.0) * LARGEST_DEPTH
        corners = [
            tips,
            tips + np.maximum(above - height, 0.0)[:, None] * self.normals[old],
            self.points[new] + above * self.normals[new],
            self.points[new] + (self.overhang - depth) * self.normals[new],
        ]
        way = tips
        for begin, end, before, after in zip((0.0, *PARTS), PARTS, corners, corners[1:], strict=False):
            way = way + np.clip((self.shares - begin) / (end - begin), 0.0, 1.0) * (after - before)
        return np.where(wish[:, 3:4] > 0.0, tips, way)
