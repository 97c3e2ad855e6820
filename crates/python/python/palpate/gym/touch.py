"""Many episodes of one task side by side, on one prepared model: what both forms of the environments stand on."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias, cast

import numpy as np
from gymnasium.spaces import Box, Dict, Space
from numpy.typing import NDArray

import palpate
from palpate.gym import press
from palpate.gym.randomization import Distribution, Randomization, camera_with, scene_with
from palpate.gym.remote_center import LIMITS, ROLL_SPEED, TYPICAL_INSERTION, RemoteCenter, rotated
from palpate.gym.tasks import COST_OF_ERROR, COST_OF_FORCE, DEEPEST, Floats, Scenario, Task, Truths

#: An array, or arrays by their names.
Seen: TypeAlias = Any

IMAGES = ("rgb", "depth", "segmentation")
#: Width and height of what `render` draws [pixels].
RENDER_SIZE = (640, 480)
#: From the tip along the shaft to the sensor that feels torques [m].
SENSOR = 0.05
#: A remote centre where the scene has no trocar: from the organ towards the eye, and to its right [m].
PORT = (0.16, 0.05)
#: So many prepared models are kept at most.
KEPT_MODELS = 32

#: Steps of the model in an action that moves the tool.
SUBSTEPS = 10
#: How far a tip may leave the organ's box [m].
MARGIN = 0.03
#: Lengths of an observation before what is seen of the goal.
COMMON = 10


@dataclass(frozen=True)
class EpisodeState:
    """An episode as it is, to go on from there to the same bit: with the organ, the tool, what was drawn, and the
    generator of the seeds. It lasts as long as its process."""

    snapshot: palpate.Snapshot
    simulation: palpate.Simulation
    scenario: Scenario
    camera: palpate.Camera
    drawn: Mapping[str, float]
    tip: Floats
    joints: Floats
    part: float
    errors: NDArray[np.int64]
    generator: Mapping[str, Any]


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
        substeps: int | None = None,
        speed: float = 0.05,
        threads: int | None = None,
        observation: str = "vector",
        images: Sequence[str] = (),
        image_size: tuple[int, int] = (128, 128),
        action: str = "cartesian",
        randomization: Mapping[str, Distribution] | None = None,
        render_mode: str | None = None,
    ) -> None:
        if (substeps is not None and substeps < 1) or not speed > 0.0:
            raise palpate.InputError("`substeps` and `speed` say how far an action goes; give numbers above zero")
        _check(observation, "observation", ("vector", "dict"))
        _check(action, "action", ("cartesian", "remote_center", "press"))
        if render_mode is not None:
            _check(render_mode, "render_mode", ("rgb_array",))
        for image in images:
            _check(image, "images", IMAGES)
        self.randomization = Randomization(randomization)
        self.images, self.has_parts = tuple(images), observation == "dict" or len(images) > 0
        if simulation is None:
            own = None
            if scene is None:
                scene, own = palpate.Scene.builtin(kind.builtin), kind.model
            # The surface is not looked at.
            simulation = palpate.Simulation(_of_model(scene, model, own), show_every=1e9)
        if substeps is None:
            substeps = max(1, round(press.DURATION / simulation.step_length)) if action == "press" else SUBSTEPS
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
        self.speed, self.render_mode = speed, render_mode
        self.models = {(): simulation}
        self.simulations = [simulation] * count
        self.drawn: list[dict[str, float]] = [{} for _ in range(count)]
        self.image_size = (int(image_size[0]), int(image_size[1]))
        self.renderer = palpate.Renderer(simulation, self.image_size) if self.images else None
        self.film = palpate.Renderer(simulation, RENDER_SIZE) if render_mode is not None else None
        width, height = self.image_size if self.images else RENDER_SIZE
        self.camera = simulation.camera(width / height)
        self.cameras = [self.camera] * count
        self.joints: Floats = np.zeros((count, 4))
        self.arm = self._arm() if action == "remote_center" else None
        self.press = press.Press(self.task, substeps) if action == "press" else None

    def _arm(self) -> RemoteCenter:
        """Through the tool's trocar, else through one beside the endoscope."""
        tool = self.task.content.get("tool", [{}])[self.task.tool]
        target = np.array(self.camera.target)
        out = np.array(self.camera.eye) - target
        beside = target + PORT[0] * out / np.linalg.norm(out) + PORT[1] * self.camera.rotation[0]
        return RemoteCenter(np.array(tool.get("trocar_m", beside), dtype=float), target)

    @property
    def action_size(self) -> int:
        """Numbers of an action: those that move the tool, and one for the hand."""
        return 4 if self.arm is None else 5

    def action_space(self) -> Space[Seen]:
        """How the tool moves, and what the hand does."""
        return cast("Space[Seen]", Box(-1.0, 1.0, (self.action_size,), np.float32))

    def observation_space(self) -> Space[Seen]:
        """See the environments."""
        far = np.full(3, np.inf)
        low = np.concatenate([self.low, -far, [0.0, 0.0, 0.0, 0.0], np.full(self.task.goal_size, -np.inf)])
        high = np.concatenate([self.high, far, [np.inf, 1.0, 1.0, 1.0], np.full(self.task.goal_size, np.inf)])
        vector = Box(low.astype(np.float32), high.astype(np.float32), dtype=np.float32)
        if not self.has_parts:
            return cast("Space[Seen]", vector)
        any_vector: dict[str, Space[Any]] = {name: Box(-np.inf, np.inf, (3,), np.float32) for name in _WRENCHES}
        width, height = self.image_size
        pictures: dict[str, Space[Any]] = {
            "rgb": Box(0, 255, (height, width, 3), np.uint8),
            "depth": Box(0.0, np.inf, (height, width, 1), np.float32),
            "segmentation": Box(0, 255, (height, width, 1), np.uint8),
        }
        return cast(
            "Space[Seen]", Dict({"state": vector, **any_vector, **{name: pictures[name] for name in self.images}})
        )

    def begin(self, number: int, draw: np.random.Generator) -> None:
        """A new episode in one of the states, with its tip in the air."""
        drawn = self.randomization.draw(draw)
        if self.randomization.changes_model:
            self._replace(number, self._model(drawn))
        self.drawn[number], self.cameras[number] = drawn, camera_with(self.camera, drawn)
        scenario = self.task.scenario(draw)
        self.batch.reset(number, scenario.scene)
        self.tips[number] = np.clip(scenario.start, self.low, self.high)
        turned = None
        if self.arm is not None:
            self.joints[number] = self.arm.joints(self.tips[number])
            self.tips[number] = self.arm.poses(self.joints[number])[0]
            turned = self.arm.poses(self.joints)[1][None]
        self.goals[number] = scenario.goal
        still = np.zeros(self.count)
        self.batch.step(self._poses(self.tips[None], turned, still, still > 0.0)[0], which=number)
        self.parts[number] = 0.0
        self.errors[number] = 0
        self.scenarios[number] = scenario

    def _model(self, drawn: Mapping[str, float]) -> palpate.Simulation:
        """The model of what was drawn, prepared if it is not there yet."""
        own = {name: drawn[name] for name in drawn if not name.startswith(("camera.", "light."))}
        key: tuple[Any, ...] = tuple(own.items())
        if key not in self.models:
            if len(self.models) >= KEPT_MODELS:
                # The first one is the scene's own.
                del self.models[list(self.models)[1]]
            self.models[key] = palpate.Simulation(scene_with(self.simulation.scene, own), show_every=1e9)
        return self.models[key]

    def _replace(self, number: int, simulation: palpate.Simulation) -> None:
        self.simulations[number] = simulation
        self.batch.replace(number, simulation)

    def state(self, number: int, draw: np.random.Generator) -> EpisodeState:
        """An episode as it is."""
        scenario = self.scenarios[number]
        if scenario is None:
            raise palpate.InputError("no episode has begun whose state could be kept; reset the environment first")
        return EpisodeState(
            self.batch.snapshot(number),
            self.simulations[number],
            scenario,
            self.cameras[number],
            dict(self.drawn[number]),
            self.tips[number].copy(),
            self.joints[number].copy(),
            float(self.parts[number]),
            self.errors[number].copy(),
            copy.deepcopy(draw.bit_generator.state),
        )

    def restore(self, number: int, state: EpisodeState, draw: np.random.Generator) -> None:
        """Goes on from a state that was kept."""
        if not isinstance(state, EpisodeState):
            raise palpate.InputError(
                "`state` is no state of an episode; give what `state()` of an environment returned"
            )
        if self.simulations[number] is not state.simulation:
            self._replace(number, state.simulation)
        self.batch.restore(number, state.snapshot)
        self.scenarios[number], self.cameras[number] = state.scenario, state.camera
        self.drawn[number] = dict(state.drawn)
        self.goals[number] = state.scenario.goal
        self.tips[number], self.joints[number] = state.tip, state.joints
        self.parts[number], self.errors[number] = state.part, state.errors
        draw.bit_generator.state = copy.deepcopy(dict(state.generator))

    def began(self, number: int) -> dict[str, Any]:
        """What there is to tell of a beginning: what was drawn."""
        return {"drawn": dict(self.drawn[number])} if self.randomization.table else {}

    def picture(self, number: int) -> NDArray[np.uint8]:
        """What `render` shows, from the camera of the episode."""
        if self.film is None:
            raise palpate.InputError('the environment draws nothing; make it with `render_mode="rgb_array"`')
        drawn: NDArray[np.uint8] = self.film.draw(self.batch, number, camera=self.cameras[number])["rgb"]
        return drawn

    def _poses(self, tips: Floats, turned: Floats | None, grip: Floats, cut: Truths) -> Floats:
        """Rows of steps and states for all tools, of which all but one are away."""
        width = 5 if turned is None else 9
        poses = np.full((len(tips), self.count, len(self.simulation.tools), width), np.nan)
        own = poses[:, :, self.task.tool]
        own[..., :3], own[..., -2], own[..., -1] = tips, grip, cut
        if turned is not None:
            own[..., 3:7] = turned
        return poses

    def _moved(self, wish: Floats) -> tuple[Floats, Floats, Floats | None, Floats]:
        """Where the wishes take the tips in the end [m], on the way, with which orientations, and the joints."""
        if self.press is not None:
            path = self.press.paths(self.tips, wish)
            return path[-1], path, None, self.joints
        if self.arm is None:
            to = np.clip(self.tips + self.reach * wish[:, :3], self.low, self.high)
            return to, self.tips + self.part_of_action * (to - self.tips), None, self.joints
        rate = np.array([self.speed / TYPICAL_INSERTION] * 2 + [self.speed, ROLL_SPEED])
        lasts = self.substeps * self.simulation.step_length
        joints = np.clip(self.joints + lasts * rate * wish[:, :4], *LIMITS)
        ends = self.arm.poses(joints)[0]
        # A shaft cannot stop at the border of a box and pass through its centre: it stays.
        outside = ((ends < self.low) | (ends > self.high)).any(axis=1)
        joints[outside] = self.joints[outside]
        tips, turned = self.arm.poses(self.joints + self.part_of_action * (joints - self.joints))
        return tips[-1], tips, turned, joints

    def step(self, actions: NDArray[Any], goes_on: Truths) -> tuple[Floats, Truths, Truths]:
        """What the actions are worth, what ended by them, and what ended because its time did."""
        actions = np.asarray(actions, dtype=np.float64)
        wanted = (self.count, self.action_size)
        if actions.shape != wanted or not np.isfinite(actions).all():
            raise palpate.InputError(
                f"the actions have the shape {actions.shape}, or one is no number; give {wanted} finite numbers"
            )
        actions = np.clip(actions, -1.0, 1.0)
        deeds = self.task.deeds(actions[:, -1])
        to, tips, turned, joints = self._moved(actions)
        marks = np.zeros((self.count, len(self.simulation.tools)), dtype=bool)
        marks[:, self.task.tool] = deeds.mark
        self.batch.replay(self._poses(tips, turned, deeds.grip, deeds.cut), marks, goes_on)
        self.tips[goes_on], self.joints[goes_on] = to[goes_on], joints[goes_on]
        return self._worth(goes_on)

    def _worth(self, goes_on: Truths) -> tuple[Floats, Truths, Truths]:
        over, late = self.batch.over, self.batch.late
        progress = self.batch.progress
        parts = np.where(late, self.parts, np.where(np.isnan(progress), 0.0, progress))
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
        if self.task.word == "find":
            gained[late & ~too_deep & ~perforated] -= 1.0
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
        vector = np.concatenate(columns, axis=1).astype(np.float32)
        if not self.has_parts:
            return vector
        parts: dict[str, NDArray[Any]] = {"state": vector}
        force = self.batch.forces[:, tool]
        lever = SENSOR * rotated(self.batch.orientations[:, tool], np.array([0.0, 0.0, 1.0]))
        torque = self.batch.torques[:, tool] + np.cross(-lever, force)
        turns = np.array([camera.rotation for camera in self.cameras])
        wrenches = (force, torque, *(np.einsum("nij,nj->ni", turns, own) for own in (force, torque)))
        parts |= {name: own.astype(np.float32) for name, own in zip(_WRENCHES, wrenches, strict=True)}
        if self.renderer is not None:
            drawn = [
                self.renderer.draw(self.batch, number, camera=self.cameras[number], images=self.images)
                for number in range(self.count)
            ]
            for name in self.images:
                stack = np.stack([own[name] for own in drawn])
                parts[name] = stack if name == "rgb" else stack[..., None]
        return parts

    def seen_by(self, number: int) -> Seen:
        """That of one state."""
        return row(self.seen(), number)

    def told(self, number: int) -> dict[str, Any]:
        """What there is to tell of a state: its score."""
        score = self.batch.score(number)
        if score is None:
            return {}
        return {"passed": bool(score["passed"]), "time": float(self.batch.times[number]), "score": score}


_WRENCHES = ("force", "torque", "force_camera", "torque_camera")


def row(seen: Seen, number: int) -> Seen:
    """What one state sees, of what all see."""
    return {name: part[number] for name, part in seen.items()} if isinstance(seen, dict) else seen[number]


def _check(word: object, name: str, known: tuple[str, ...]) -> None:
    if word not in known:
        raise palpate.InputError(f"`{name}` has no {word!r}; give one of {', '.join(map(repr, known))}")


def _of_model(scene: palpate.Scene, model: str | None, own: Mapping[str, Any] | None) -> palpate.Scene:
    """The same scene under another model: the `own` one of an environment, if none is named."""
    content = scene.to_dict()
    if own is not None and model in (None, own["kind"]):
        content["model"] = dict(own)
    elif model == "local":
        content["model"] = {"kind": "local"}
    elif model is not None:
        content["model"] = {**content.get("model", {}), "kind": model}
    else:
        return scene
    return palpate.Scene(content)
