"""One episode at a time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal

import gymnasium
import numpy as np
from numpy.typing import NDArray

import palpate
from palpate.gym.randomization import Distribution
from palpate.gym.tasks import Cutting, Palpation, Task, Traction
from palpate.gym.touch import EpisodeState, Seen, Touch


class TouchEnv(gymnasium.Env[Seen, NDArray[np.float32]]):
    """A tip on an organ.

    **Action**, four numbers from -1 to 1: how far the tip goes along x, y and z, of the most that `speed` allows; and
    what the hand does, which the task says. With `action="remote_center"` five: yaw, pitch, insertion and roll of a shaft
    that passes through the tool's trocar, and the hand. Its limits are about those of a dVRK arm: 1.6, 0.93 and 4.5 rad,
    and 5 to 240 mm; at most `speed` along the shaft, `speed`/0.2 m about yaw and pitch [rad/s], and a roll of 1.5 rad/s.

    **Observation**: the tip's place [m] (3), the force on it [N] (3), its depth below the rest surface [m], the part of
    the time limit that is gone, the part of the task that is done (0 where that cannot be told), whether it touches or
    holds tissue, and what is seen of the goal. With `observation="dict"` that is `"state"`, and there are `"force"` [N] on
    the tool and its `"torque"` [N m] about a sensor in the shaft, 50 mm from the tip, in the scene's frame, and
    `"force_camera"` and `"torque_camera"` in the camera's: x to the right, y down, z ahead. The tip transmits
    no torque; a shaft does, where tissue of the nonlinear model bears on it. `images` adds `"rgb"`, `"depth"` [m] and
    `"segmentation"` of the endoscope, as `palpate.Renderer` draws them.

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
        Another model than the scene's; in its built-in scene, `TractionEnv` has "hybrid" unless "nonlinear" is asked for.
    substeps : int, optional
        Steps of the model in an action; ten, or half a second in a press.
    speed : float
        The most along each axis [m/s].
    observation : {"vector", "dict"}
        One array, or a dictionary with force and torque.
    images : list of {"rgb", "depth", "segmentation"}
        Images of the endoscope in the observation, which is a dictionary then. They need a graphics adapter, or
        `mesa-vulkan-drivers`.
    image_size : (int, int)
        Width and height of these images [pixels].
    action : {"cartesian", "remote_center", "press"}
        How an action moves the tool; "press" is for palpation, see `PalpationEnv`.
    randomization : mapping of str to a range or a distribution, optional
        What each episode draws by its seed, see `Randomization`: `tissue.stiffness` and `tissue.relaxation_time`, factors
        of all moduli and relaxation times [-]; `anchor.size`, a factor of the boxes and balls of the scene's
        `organ.anchor` [-]; `light.brightness` of the endoscope's lamp [-]; `camera.azimuth`, `camera.elevation` and
        `camera.roll`, turns about what it looks at [rad]; `camera.distance`, a factor [-]; `camera.field_of_view` [rad].
        `reset` tells what was drawn in `info["drawn"]`. A tissue or an anchor prepares its model anew at each reset; of
        `one_of` only once.
    render_mode : {"rgb_array"}, optional
        Whether `render` draws what the endoscope shows, 640 x 480 pixels.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 20}
    kind: ClassVar[type[Task]]

    def __init__(
        self,
        scene: palpate.Scene | None = None,
        *,
        simulation: palpate.Simulation | None = None,
        model: str | None = None,
        substeps: int | None = None,
        speed: float = 0.05,
        observation: Literal["vector", "dict"] = "vector",
        images: Sequence[Literal["rgb", "depth", "segmentation"]] = (),
        image_size: tuple[int, int] = (128, 128),
        action: Literal["cartesian", "remote_center", "press"] = "cartesian",
        randomization: Mapping[str, Distribution] | None = None,
        render_mode: str | None = None,
    ) -> None:
        self.render_mode = render_mode
        self.touch = Touch(
            self.kind,
            1,
            scene=scene,
            simulation=simulation,
            model=model,
            substeps=substeps,
            speed=speed,
            threads=1,
            observation=observation,
            images=images,
            image_size=image_size,
            action=action,
            randomization=randomization,
            render_mode=render_mode,
        )
        self.action_space = self.touch.action_space()
        self.observation_space = self.touch.observation_space()
        self._all = np.ones(1, dtype=bool)

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Seen, dict[str, Any]]:
        """A new episode; what is drawn is drawn by the seed. `options={"state": …}` goes on from a `state()` instead."""
        super().reset(seed=seed, options=options)
        if options is not None and "state" in options:
            self.touch.restore(0, options["state"], self.np_random)
        else:
            self.touch.begin(0, self.np_random)
        return self.touch.seen_by(0), self.touch.began(0)

    def state(self) -> EpisodeState:
        """The episode as it is: `reset(options={"state": state})` goes on from there to the same bit, as often as wanted,
        also in another environment that was made with the same `simulation`."""
        return self.touch.state(0, self.np_random)

    def render(self) -> NDArray[np.uint8] | None:
        """What the endoscope shows: uint8, shape (480, 640, 3); None without a `render_mode`."""
        return None if self.render_mode is None else self.touch.picture(0)

    def step(self, action: NDArray[np.float32]) -> tuple[Seen, float, bool, bool, dict[str, Any]]:
        """An action, which lasts `substeps` steps of the model."""
        worth, terminated, truncated = self.touch.step(np.asarray(action)[None], self._all)
        over, late = bool(terminated[0]), bool(truncated[0])
        return self.touch.seen_by(0), float(worth[0]), over, late, self.touch.told(0) if over or late else {}


class PalpationEnv(TouchEnv):
    """Find the stiff spot under the surface; see `TouchEnv`.

    The seed draws where it is, within 5 cm of the scene's own place on the same side, and where the tip begins. The hand
    says with a fourth number above zero: here; in the air nothing is meant. **Reward** for it: 1 where it is within the
    task's tolerance, else minus how far beside it is, in decimetres; minus 1 when the time ends without it. Nothing is seen
    of the goal. With `action="press"` an action is a press, of half a second unless `substeps` states another duration:
    two numbers for the place within 5 cm of the scene's own, from -1 to 1 along two axes of the task's side; the depth,
    from 0 at -1 to 8 mm at 1; and the hand, which says "here" without moving. The force of the observation is that at
    the end of the press.
    """

    kind = Palpation


class TractionEnv(TouchEnv):
    """Grasp tissue and hold an even pull; see `TouchEnv`.

    The seed draws the wanted force, a quarter around the scene's, and where the tip begins. The jaws are open at a
    fourth number of -1 and shut at 1. **Reward**: the part of the time that was held within the tolerance, and 1 for the
    whole. Of the goal the wanted force [N] is seen. The built-in scene is taken with the "hybrid" model, which is linear
    and some tens of times as fast as the one that trainees pull at.
    """

    kind = Traction


class CuttingEnv(TouchEnv):
    """Cut along a line, and no deeper; see `TouchEnv`.

    The seed moves the line by up to 4 mm along and 0.5 mm aside, and draws where the tip begins. A fourth number above
    zero cuts. **Reward**: the part of the straight line that was cut within the task's tolerance, and 1 for the whole. Of the goal
    the ends of the line [m] are seen (6).
    """

    kind = Cutting
