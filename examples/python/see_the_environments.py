"""Draws the images of an agent in the three environments into one PNG: colour, depth and labels of the endoscope.

pip install "palpate[gym]" pillow
python examples/python/see_the_environments.py environments.png

Needs a graphics adapter, or mesa-vulkan-drivers, which draws on the processor.
"""

import sys

import gymnasium
import numpy as np
import palpate.gym  # noqa: F401
from PIL import Image

SIZE = (360, 270)
#: Colours of the background, the organ, its neighbours and the tools.
COLORS = np.array(
    [[20, 20, 24], [205, 92, 92], [120, 100, 140], [240, 200, 60], [90, 180, 220]],
    dtype=np.uint8,
)


def seen(name: str, seed: int, depth: float) -> np.ndarray:
    """A row of three images, with the tool at this depth in the organ [m]."""
    environment = gymnasium.make(
        f"palpate/{name}-v0",
        model="local",
        images=("rgb", "depth", "segmentation"),
        image_size=SIZE,
        speed=0.01,
        randomization={"camera.distance": (0.75, 0.85)},
    )
    observation, _ = environment.reset(seed=seed)
    # At first the surface is 10 mm below the tip: move away from the endoscope until the tool is deep enough.
    ahead = environment.unwrapped.touch.camera.rotation[2]
    action = np.append(ahead / np.abs(ahead).max(), -1.0).astype(np.float32)
    for _ in range(100):
        observation, *_ = environment.step(action)
        if observation["state"][6] > depth:
            break
    ahead_of_eye = observation["depth"][..., 0]
    there = ahead_of_eye > 0.0
    near, far = ahead_of_eye[there].min(), ahead_of_eye[there].max()
    grey = np.where(there, 255.0 - 200.0 * (ahead_of_eye - near) / (far - near), 0.0).astype(np.uint8)
    labels = COLORS[observation["segmentation"][..., 0]]
    return np.hstack([observation["rgb"], np.repeat(grey[..., None], 3, axis=2), labels])


def main(path: str) -> None:
    rows = [
        seen(*row)
        for row in (
            ("Palpation", 9, 0.006),
            ("Traction", 1, 0.001),
            ("Cutting", 3, 0.002),
        )
    ]
    Image.fromarray(np.vstack(rows)).save(path, optimize=True)
    print(f"{path}: Palpation, Traction and Cutting; colour, depth [m] and labels")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "environments.png")
