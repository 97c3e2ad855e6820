"""Many episodes of one task side by side, on one prepared model: what both forms of the environments stand on."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from gymnasium.spaces import Box, Space
from numpy.typing import NDArray

import palpate
from palpate.gym.tasks import COST_OF_ERROR, COST_OF_FORCE, DEEPEST, Floats, Scenario, Task, Truths

Seen = NDArray[np.float32]

#: How far a tip may leave the organ's box [m].
MARGIN = 0.03
#: Lengths of an observation before what is seen of the goal.
COMMON = 10


class Touch:
    """States of episodes. `kind` is the class of the task; the other arguments are those of the environments."""

    def __init__(
        self,
        kind: type[Task],
        count: int,
        *,
        scene: palpate.Scene | None = None,
        simulation: palpate.Simulation | None = None,
        model: str | None = None,
        substeps: int = 10,
        speed: float = 0.05,
        threads: int | None = None,
    ) -> None:
        if substeps < 1 or not speed > 0.0:
            raise palpate.InputError("`substeps` and `speed` say how far an action goes; give numbers above zero")
        if simulation is None:
            scene = scene if scene is not None else palpate.Scene.builtin(kind.builtin)
            # The surface is not looked at.
            simulation = palpate.Simulation(_of_model(scene, model), show_every=1e9)
        self.simulation = simulation
        self.task = kind(simulation.scene, simulation.surface)
        self.count, self.substeps = count, substeps
        self.reach = speed * substeps * simulation.step_length
        self.batch = palpate.SimulationBatch(simulation, count, threads)
        self.low = self.task.vertices.min(axis=0) - MARGIN
        self.high = self.task.vertices.max(axis=0) + MARGIN
        self.tips: Floats = np.zeros((count, 3))
        self.scenarios: list[Scenario | None] = [None] * count
        self.goals: Floats = np.zeros((count, self.task.goal_size))
        self.parts: Floats = np.zeros(count)
        self.errors = self.batch.errors.astype(np.int64)
        self.part_of_action = np.linspace(0.0, 1.0, substeps + 1)[1:, None, None]

    def action_space(self) -> Space[Seen]:
        """The way of the tip along x, y and z, and what the hand does."""
        return cast("Space[Seen]", Box(-1.0, 1.0, (4,), np.float32))

    def observation_space(self) -> Space[Seen]:
        """See the environments."""
        far = np.full(3, np.inf)
        low = np.concatenate([self.low, -far, [0.0, 0.0, 0.0, 0.0], np.full(self.task.goal_size, -np.inf)])
        high = np.concatenate([self.high, far, [np.inf, 1.0, 1.0, 1.0], np.full(self.task.goal_size, np.inf)])
        return cast("Space[Seen]", Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32))

    def begin(self, number: int, draw: np.random.Generator) -> None:
        """A new episode in one of the states, with its tip in the air."""
        scenario = self.task.scenario(draw)
        self.batch.reset(number, scenario.scene)
        self.tips[number] = np.clip(scenario.start, self.low, self.high)
        self.goals[number] = scenario.goal
        still = np.zeros(self.count)
        self.batch.step(self._poses(self.tips[None], still, still > 0.0)[0], which=number)
        self.parts[number] = 0.0
        self.errors[number] = 0
        self.scenarios[number] = scenario

    def _poses(self, tips: Floats, grip: Floats, cut: Truths) -> Floats:
        """Rows of steps and states for all tools, of which all but one are away."""
        poses = np.full((len(tips), self.count, len(self.simulation.tools), 5), np.nan)
        own = poses[:, :, self.task.tool]
        own[..., :3], own[..., 3], own[..., 4] = tips, grip, cut
        return poses

    def step(self, actions: NDArray[Any], goes_on: Truths) -> tuple[Floats, Truths, Truths]:
        """What the actions are worth, what ended by them, and what ended because its time did."""
        actions = np.asarray(actions, dtype=np.float64)
        if actions.shape != (self.count, 4) or not np.isfinite(actions).all():
            raise palpate.InputError(
                f"the actions have the shape {actions.shape}, or one is no number; give {(self.count, 4)} finite numbers"
            )
        actions = np.clip(actions, -1.0, 1.0)
        deeds = self.task.deeds(actions[:, 3])
        to = np.clip(self.tips + self.reach * actions[:, :3], self.low, self.high)
        tips = self.tips + self.part_of_action * (to - self.tips)
        marks = np.zeros((self.count, len(self.simulation.tools)), dtype=bool)
        marks[:, self.task.tool] = deeds.mark
        self.batch.replay(self._poses(tips, deeds.grip, deeds.cut), marks, goes_on)
        self.tips[goes_on] = to[goes_on]
        return self._worth(goes_on)

    def _worth(self, goes_on: Truths) -> tuple[Floats, Truths, Truths]:
        over, late = self.batch.over, self.batch.late
        parts = np.where(late, self.parts, np.nan_to_num(self.batch.progress))
        gained = np.zeros(self.count) if self.task.word == "find" else parts - self.parts
        errors = self.batch.errors.astype(np.int64)
        more = errors - self.errors
        gained -= COST_OF_FORCE * more[:, 0] + COST_OF_ERROR * (more[:, 1] + more[:, 2])
        too_deep = self.batch.depths[:, self.task.tool] > DEEPEST
        perforated = more[:, 1] > 0
        done = over & ~late
        for number in np.flatnonzero(done & goes_on):
            gained[number] += self._bonus(int(number))
        gained[too_deep] -= 1.0
        terminated = (done | too_deep | perforated) & goes_on
        truncated = late & ~terminated & goes_on
        self.parts[goes_on], self.errors[goes_on] = parts[goes_on], errors[goes_on]
        gained[~goes_on] = 0.0
        return gained, terminated, truncated

    def _bonus(self, number: int) -> float:
        """One for a task that was passed; of a place that was marked wrongly, minus how far beside it is."""
        score = self.batch.score(number)
        if score is not None and score["passed"]:
            return 1.0
        if score is not None and "beside_m" in score["measures"]:
            return -min(1.0, score["measures"]["beside_m"] / 0.1)
        return 0.0

    def seen(self) -> Seen:
        """A row for each state."""
        tool = self.task.tool
        touches = self.batch.contacts[:, tool] | self.batch.holds[:, tool]
        columns = [
            self.tips,
            self.batch.forces[:, tool],
            self.batch.depths[:, tool, None],
            np.minimum(self.batch.times / self.task.time_limit, 1.0)[:, None],
            self.parts[:, None],
            touches[:, None],
            self.goals,
        ]
        return np.concatenate(columns, axis=1).astype(np.float32)

    def told(self, number: int) -> dict[str, Any]:
        """What there is to tell of a state: its score."""
        score = self.batch.score(number)
        if score is None:
            return {}
        return {"passed": bool(score["passed"]), "time": float(self.batch.times[number]), "score": score}


def _of_model(scene: palpate.Scene, model: str | None) -> palpate.Scene:
    """The same scene under another model, if one is named."""
    if model is None:
        return scene
    content = scene.to_dict()
    content["model"] = {**content.get("model", {}), "kind": model}
    if model == "local":
        content["model"] = {"kind": "local"}
    return palpate.Scene(content)
