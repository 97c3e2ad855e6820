"""One episode at a time."""

from __future__ import annotations

from typing import Any, ClassVar

import gymnasium
import numpy as np
from numpy.typing import NDArray

import palpate
from palpate.gym.tasks import Cutting, Palpation, Task, Traction
from palpate.gym.touch import Seen, Touch


class TouchEnv(gymnasium.Env[Seen, NDArray[np.float32]]):
    """A tip on an organ.

    **Action**, four numbers from -1 to 1: how far the tip goes along x, y and z, of the most that `speed` allows; and
    what the hand does, which the task says.

    **Observation**: the tip's place [m] (3), the force on it [N] (3), its depth below the rest surface [m], the part of
    the time limit that is gone, the part of the task that is done (0 where that cannot be told), whether it touches or
    holds tissue, and what is seen of the goal.

    **Reward**: what each task says; less 0.1 whenever the force rises above the task's limit and 0.5 for a perforation
    or for tissue that is lost from the jaws; less 1 at a depth of 20 mm, where no hand goes.

    **End**: terminated when the task is done, when the innermost layer is perforated or at a depth of 20 mm; truncated
    when the task's time is over. The info of the last step tells `passed`, the `time` [s] and the `score`.

    Parameters
    ----------
    scene : palpate.Scene, optional
        One with the task; the built-in one without.
    simulation : palpate.Simulation, optional
        One that was prepared already, in place of a scene.
    model : {"local", "hybrid", "nonlinear"}, optional
        Another model than the scene's.
    substeps : int
        Steps of the model in an action.
    speed : float
        The most along each axis [m/s].
    """

    metadata: dict[str, Any] = {"render_modes": []}
    kind: ClassVar[type[Task]]

    def __init__(
        self,
        scene: palpate.Scene | None = None,
        *,
        simulation: palpate.Simulation | None = None,
        model: str | None = None,
        substeps: int = 10,
        speed: float = 0.05,
        render_mode: None = None,
    ) -> None:
        self.render_mode = render_mode
        self.touch = Touch(
            self.kind, 1, scene=scene, simulation=simulation, model=model, substeps=substeps, speed=speed, threads=1
        )
        self.action_space = self.touch.action_space()
        self.observation_space = self.touch.observation_space()
        self._all = np.ones(1, dtype=bool)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Seen, dict[str, Any]]:
        """A new episode; what is drawn is drawn by the seed."""
        super().reset(seed=seed, options=options)
        self.touch.begin(0, self.np_random)
        return self.touch.seen()[0], {}

    def step(self, action: NDArray[np.float32]) -> tuple[Seen, float, bool, bool, dict[str, Any]]:
        """An action, which lasts `substeps` steps of the model."""
        worth, terminated, truncated = self.touch.step(np.asarray(action)[None], self._all)
        over, late = bool(terminated[0]), bool(truncated[0])
        return self.touch.seen()[0], float(worth[0]), over, late, self.touch.told(0) if over or late else {}


class PalpationEnv(TouchEnv):
    """Find the stiff spot under the surface; see `TouchEnv`.

    The seed draws where it is, within 5 cm of the scene's own place on the same side, and where the tip begins. The hand
    says with a fourth number above zero: here; in the air nothing is meant. **Reward** for it: 1 where it is within the
    task's tolerance, else minus how far beside it is, in decimetres. Nothing is seen of the goal.
    """

    kind = Palpation


class TractionEnv(TouchEnv):
    """Grasp tissue and hold an even pull; see `TouchEnv`.

    The seed draws the wanted force, a quarter around the scene's, and where the tip begins. The jaws are open at a
    fourth number of -1 and shut at 1. **Reward**: the part of the time that was held within the tolerance, and 1 for the
    whole. Of the goal the wanted force [N] is seen.
    """

    kind = Traction


class CuttingEnv(TouchEnv):
    """Cut along a line, and no deeper; see `TouchEnv`.

    The seed moves the line by up to 4 mm along and 0.5 mm aside, and draws where the tip begins. A fourth number above
    zero cuts. **Reward**: the part of the line that was cut, and 1 for the whole, within the task's tolerance. Of the goal
    the ends of the line [m] are seen (6).
    """

    kind = Cutting
