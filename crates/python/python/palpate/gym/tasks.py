"""What there is to do, drawn by a seed: where it begins, what is seen, what it is worth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

import palpate

Floats = NDArray[np.float64]
Truths = NDArray[np.bool_]

#: Way of a tip over the surface at the begin [m].
CLEAR = 0.010
#: No hand goes deeper [m]: an episode ends there.
DEEPEST = 0.020
#: Time that a task may take where its scene does not say [s].
TIME_LIMIT = 60.0
#: Tables of a scene that an episode may draw, or that its task refers to.
OF_EPISODE = ("organ", "tool", "task")
#: What a rise of the force above its limit costs, and any other error.
COST_OF_FORCE = 0.1
COST_OF_ERROR = 0.5


@dataclass(frozen=True)
class Scenario:
    """An episode: the scene with what was drawn, the place of the tip [m], and what else is seen of it."""

    scene: palpate.Scene
    start: Floats
    goal: Floats


@dataclass(frozen=True)
class Deeds:
    """What hands do beside moving: shut their jaws (0 to 1), cut, or say: here."""

    grip: Floats
    cut: Truths
    mark: Truths


#: In place of the nonlinear model of a task's scene, which takes some milliseconds a step.
LINEAR = MappingProxyType({"kind": "hybrid", "mechanical_triangles": 2500})


class Task:
    """What all tasks have in common."""

    #: The table of the scene's task.
    word: str
    #: The built-in scene.
    builtin: str
    #: The model that learners get in the built-in scene, where it is another than that scene's.
    model: ClassVar[Mapping[str, Any] | None] = None
    #: Numbers that are seen of the goal.
    goal_size = 0

    def __init__(self, scene: palpate.Scene, rest: palpate.Mesh) -> None:
        self.content = scene.to_dict()
        task = self.content.setdefault("task", {})
        if self.word not in task:
            raise palpate.InputError(
                f"the scene has no `task.{self.word}`; give one, or the environment of the task that it has"
            )
        task.setdefault("time_limit_s", TIME_LIMIT)
        self.wanted: dict[str, Any] = task[self.word]
        self.time_limit = float(task["time_limit_s"])
        self.vertices, self.normals = rest.vertices, rest.normals
        self.tool = self.chosen_tool(scene)

    def chosen_tool(self, scene: palpate.Scene) -> int:
        """The number of the tool that acts."""
        return 0

    def first_tool(self, scene: palpate.Scene, kinds: tuple[str, ...]) -> int:
        """The first tool of these kinds."""
        for number, tool in enumerate(self.content.get("tool", [])):
            if tool.get("kind", "probe") in kinds:
                return number
        raise palpate.InputError(f"the scene has no tool of the kind {' or '.join(kinds)}; give it one")

    def scenario(self, draw: np.random.Generator) -> Scenario:
        """What `draw` draws."""
        raise NotImplementedError

    def deeds(self, wish: Floats) -> Deeds:
        """What the last numbers of the actions mean, from -1 to 1."""
        raise NotImplementedError

    def with_task(self, **changed: object) -> dict[str, Any]:
        """What an episode needs of the scene's content, with other words for the goal: a small scene is read sooner."""
        content = {name: self.content[name] for name in OF_EPISODE if name in self.content}
        content["organ"] = dict(content["organ"])
        content["task"] = {**content["task"], self.word: {**self.wanted, **changed}}
        return content

    def near(self, place: Floats, reach: float, facing: Floats) -> NDArray[np.intp]:
        """Vertices within `reach` [m] of a place, on the side that faces somewhere."""
        way = np.linalg.norm(self.vertices - place, axis=1)
        found = np.flatnonzero((way < reach) & (self.normals @ facing > 0.5))
        if len(found) == 0:
            nearest = int(way.argmin())
            found = np.array([nearest], dtype=np.intp)
        return found


class Palpation(Task):
    """Find the stiff spot: it is somewhere on the side that the scene has it on."""

    word = "find"
    builtin = "palpation"
    #: How far from the scene's own place it may be [m].
    REACH = 0.05

    def __init__(self, scene: palpate.Scene, rest: palpate.Mesh) -> None:
        super().__init__(scene, rest)
        inclusions = self.content["organ"].get("inclusion", [])
        hidden = [inclusion for inclusion in inclusions if "stiffness_ratio" in inclusion and "ball" in inclusion]
        if len(hidden) != 1:
            raise palpate.InputError(
                f"the scene has {len(hidden)} `organ.inclusion`s with a `ball` and a `stiffness_ratio`; give it one, which is to "
                "be found"
            )
        self.inclusion = hidden[0]
        self.others = [inclusion for inclusion in inclusions if inclusion is not self.inclusion]
        self.target = np.array(self.wanted["target_m"], dtype=float)
        out = self.target - np.array(self.inclusion["ball"]["center_m"], dtype=float)
        self.below = float(np.linalg.norm(out))
        self.facing = out / max(self.below, 1e-12)
        self.places = self.near(self.target, self.REACH, self.facing)
        # The organ may be too thin in places.
        self.centers = self.vertices - self.below * self.normals
        self.hidden = self.places[rest.signed_distances(self.centers[self.places]) < 0.0]
        if len(self.hidden) == 0:
            raise palpate.InputError(
                f"nowhere is the organ so thick that something could be hidden {1e3 * self.below:.1f} mm deep; move "
                "the inclusion's `ball` nearer to `task.find.target_m`"
            )

    def scenario(self, draw: np.random.Generator) -> Scenario:
        """The spot, and where the tip begins."""
        start, place = draw.choice(self.places), draw.choice(self.hidden)
        content = self.with_task(target_m=self.vertices[place].tolist())
        # An agent marks a place, and states no size.
        for key in ("radius_m", "diameter_tolerance_m"):
            content["task"][self.word].pop(key, None)
        ball = {**self.inclusion["ball"], "center_m": self.centers[place].tolist()}
        content["organ"]["inclusion"] = [*self.others, {**self.inclusion, "ball": ball}]
        above = self.vertices[start] + CLEAR * self.normals[start]
        return Scenario(palpate.Scene(content), above, np.empty(0))

    def deeds(self, wish: Floats) -> Deeds:
        """Above zero the hand says: here."""
        no = np.zeros(len(wish), dtype=bool)
        return Deeds(np.zeros(len(wish)), no, wish > 0.0)


class Traction(Task):
    """Hold a pull: the force is drawn, and where the jaws begin."""

    word = "traction"
    builtin = "traction"
    model = LINEAR
    goal_size = 1
    #: Of the force [-], and of the place [m].
    SPREAD = 0.25
    REACH = 0.008
    #: The seen place in the middle: what the task's view looks at.
    FACING = np.array([0.0, -1.0, 0.0])

    def chosen_tool(self, scene: palpate.Scene) -> int:
        """The task's tool, or the first grasper."""
        if "tool" in self.wanted:
            return scene.tools.index(self.wanted["tool"])
        return self.first_tool(scene, ("grasper",))

    def __init__(self, scene: palpate.Scene, rest: palpate.Mesh) -> None:
        super().__init__(scene, rest)
        view = self.content.get("view", {})
        middle = np.array(view.get("target_m", self.vertices.mean(axis=0)), dtype=float)
        eye = np.array(view["eye_m"], dtype=float) - middle if "eye_m" in view else self.FACING
        self.facing = eye / np.linalg.norm(eye)
        aside = np.linalg.norm(np.cross(self.vertices - middle, self.facing), axis=1)
        ahead = np.argmax(self.vertices @ self.facing - 2.0 * aside)
        self.places = self.near(self.vertices[ahead], self.REACH, self.facing)

    def scenario(self, draw: np.random.Generator) -> Scenario:
        """The force, and where the tip begins."""
        force = float(self.wanted["force_n"]) * draw.uniform(1.0 - self.SPREAD, 1.0 + self.SPREAD)
        place = draw.choice(self.places)
        start = self.vertices[place] + CLEAR * self.facing
        content = self.with_task(force_n=force)
        # Only the force is seen, so only the force counts.
        for name in ("direction", "direction_tolerance_deg"):
            content["task"][self.word].pop(name, None)
        return Scenario(palpate.Scene(content), start, np.array([force]))

    def deeds(self, wish: Floats) -> Deeds:
        """From -1, open, to 1, shut."""
        no = np.zeros(len(wish), dtype=bool)
        return Deeds(0.5 * (wish + 1.0), no, no)


class Cutting(Task):
    """Cut along a line: it is moved along itself and aside, and the blade begins over its end."""

    word = "cut"
    builtin = "myotomy"
    model = LINEAR
    goal_size = 6
    #: Along the line and aside [m].
    ALONG = 0.004
    ASIDE = 0.0005

    def chosen_tool(self, scene: palpate.Scene) -> int:
        """The first blade."""
        return self.first_tool(scene, ("scissors", "hook"))

    def __init__(self, scene: palpate.Scene, rest: palpate.Mesh) -> None:
        super().__init__(scene, rest)
        if "from_m" not in self.wanted:
            raise palpate.InputError(
                "the line of `task.cut` is a circle, and this environment cuts a straight one; give `from_m` and `to_m`"
            )
        self.ends = np.array([self.wanted["from_m"], self.wanted["to_m"]], dtype=float)
        self.along = (self.ends[1] - self.ends[0]) / np.linalg.norm(self.ends[1] - self.ends[0])
        out = self.normals[int(np.linalg.norm(self.vertices - self.ends.mean(axis=0), axis=1).argmin())]
        out = out - self.along * (out @ self.along)
        self.out = out / np.linalg.norm(out)

    def scenario(self, draw: np.random.Generator) -> Scenario:
        """The line, and where the tip begins."""
        along, out = self.along, self.out
        ends = self.ends + along * draw.uniform(-self.ALONG, self.ALONG)
        ends = ends + np.cross(out, along) * draw.uniform(-self.ASIDE, self.ASIDE)
        start = ends[0] + CLEAR * out + 0.002 * draw.uniform(-1.0, 1.0, size=3)
        scene = palpate.Scene(self.with_task(from_m=ends[0].tolist(), to_m=ends[1].tolist()))
        return Scenario(scene, start, ends.ravel())

    def deeds(self, wish: Floats) -> Deeds:
        """Above zero the blade cuts."""
        no = np.zeros(len(wish), dtype=bool)
        return Deeds(np.zeros(len(wish)), wish > 0.0, no)
