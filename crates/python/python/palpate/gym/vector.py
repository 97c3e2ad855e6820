"""Many episodes at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

import palpate
from palpate.gym.randomization import Distribution
from palpate.gym.tasks import Cutting, Floats, Palpation, Task, Traction, Truths
from palpate.gym.touch import EpisodeState, Seen, Touch, row


class TouchVectorEnv(VectorEnv[Seen, NDArray[np.float32], Any]):
    """Many organs of one prepared model, stepped on several threads; each episode is to the bit that of the single form
    with the same seed. Spaces and rewards are those of `TouchEnv`.

    Parameters
    ----------
    num_envs : int
        How many.
    scene, simulation, model, substeps, speed, observation, images, image_size, action, randomization, render_mode
        As for `TouchEnv`.
    threads : int, optional
        At most so many; without, as many as there are cores.
    autoreset_mode : gymnasium.vector.AutoresetMode
        When an episode that has ended begins anew; by its next action without.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}
    kind: ClassVar[type[Task]]

    def __init__(
        self,
        num_envs: int = 1,
        scene: palpate.Scene | None = None,
        *,
        simulation: palpate.Simulation | None = None,
        model: str | None = None,
        substeps: int | None = None,
        speed: float = 0.05,
        threads: int | None = None,
        autoreset_mode: str | AutoresetMode = AutoresetMode.NEXT_STEP,
        observation: Literal["vector", "dict"] = "vector",
        images: Sequence[Literal["rgb", "depth", "segmentation"]] = (),
        image_size: tuple[int, int] = (128, 128),
        action: Literal["cartesian", "remote_center", "press"] = "cartesian",
        randomization: Mapping[str, Distribution] | None = None,
        render_mode: str | None = None,
    ) -> None:
        self.num_envs, self.render_mode = num_envs, render_mode
        self.autoreset_mode = AutoresetMode(autoreset_mode)
        self.metadata = {**type(self).metadata, "autoreset_mode": self.autoreset_mode}
        self.touch = Touch(
            self.kind,
            num_envs,
            scene=scene,
            simulation=simulation,
            model=model,
            substeps=substeps,
            speed=speed,
            threads=threads,
            observation=observation,
            images=images,
            image_size=image_size,
            action=action,
            randomization=randomization,
            render_mode=render_mode,
        )
        self.single_action_space = self.touch.action_space()
        self.single_observation_space = self.touch.observation_space()
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._draws = [seeding.np_random()[0] for _ in range(num_envs)]
        self._ended = np.zeros(num_envs, dtype=bool)

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Seen, dict[str, Any]]:
        """New episodes: all, or those of `options["reset_mask"]`. A seed is that of the first, the next ones follow.
        `options={"state": [state, …]}` goes on from a `state()` for each environment; None there starts a new episode."""
        if seed is None:
            seeds: list[int | None] = [None] * self.num_envs
        elif isinstance(seed, int):
            seeds = [seed + number for number in range(self.num_envs)]
        else:
            seeds = list(seed)
        if len(seeds) != self.num_envs:
            raise palpate.InputError(
                f"there are {len(seeds)} seeds for {self.num_envs} environments; give one for each"
            )
        states: Sequence[EpisodeState | None] = [None] * self.num_envs
        if options is not None and "state" in options:
            states = options["state"]
            if not isinstance(states, Sequence) or len(states) != self.num_envs:
                raise palpate.InputError(
                    f"`state` is no list of {self.num_envs} states; give one for each environment, or None"
                )
        chosen = np.ones(self.num_envs, dtype=bool)
        if options is not None and "reset_mask" in options:
            chosen = np.asarray(options["reset_mask"])
            if chosen.shape != (self.num_envs,) or chosen.dtype != np.bool_ or not chosen.any():
                raise palpate.InputError(
                    "`reset_mask` chooses none; give a truth for each environment, one of them true"
                )
        told: dict[str, Any] = {}
        for number in np.flatnonzero(chosen):
            if seeds[number] is not None:
                self._draws[number] = seeding.np_random(seeds[number])[0]
            state = states[int(number)]
            if state is None:
                self._begin(number)
            else:
                self.touch.restore(int(number), state, self._draws[number])
            told = self._add_info(told, self.touch.began(int(number)), int(number))
        self._ended[chosen] = False
        return self.touch.seen(), told

    def state(self, number: int) -> EpisodeState:
        """The episode of one environment as it is, to `reset` to."""
        if not 0 <= number < self.num_envs:
            raise palpate.InputError(f"there is no environment {number}; give a number from 0 to {self.num_envs - 1}")
        return self.touch.state(number, self._draws[number])

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """What each endoscope shows: uint8, shape (480, 640, 3) each; None without a `render_mode`."""
        if self.render_mode is None:
            return None
        return tuple(self.touch.picture(number) for number in range(self.num_envs))

    def _begin(self, number: np.intp) -> None:
        self.touch.begin(int(number), self._draws[number])

    def step(self, actions: NDArray[np.float32]) -> tuple[Seen, Floats, Truths, Truths, dict[str, Any]]:
        """An action of each."""
        if self.autoreset_mode == AutoresetMode.DISABLED and self._ended.any():
            raise palpate.InputError("an episode has ended; reset it before its next action")
        begins = self._ended.copy()
        worth, terminated, truncated = self.touch.step(actions, ~begins)
        told: dict[str, Any] = {}
        for number in np.flatnonzero(begins):
            self._begin(number)
            told = self._add_info(told, self.touch.began(int(number)), int(number))
        self._ended = terminated | truncated
        last = self.touch.seen()
        at_once = self.autoreset_mode == AutoresetMode.SAME_STEP
        for number in np.flatnonzero(self._ended):
            own = self.touch.told(int(number))
            told = self._add_info(
                told, {"final_obs": row(last, int(number)), "final_info": own} if at_once else own, int(number)
            )
            if at_once:
                self._begin(number)
                told = self._add_info(told, self.touch.began(int(number)), int(number))
        if at_once and self._ended.any():
            self._ended[:] = False
            last = self.touch.seen()
        return last, worth, terminated, truncated, told


class PalpationVectorEnv(TouchVectorEnv):
    """Many of `PalpationEnv`."""

    kind = Palpation


class TractionVectorEnv(TouchVectorEnv):
    """Many of `TractionEnv`."""

    kind = Traction


class CuttingVectorEnv(TouchVectorEnv):
    """Many of `CuttingEnv`."""

    kind = Cutting
