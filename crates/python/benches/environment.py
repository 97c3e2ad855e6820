"""Steps of the environments per second of processor time, alone and vectorised, by the same actions at random.

Processor time is that of all threads together, so that other programs on the machine hardly matter; a vector divides its
work among all cores. A step of an environment is ten of the model. An argument "local", "hybrid" or "nonlinear" takes that
model (some minutes, once) in place of each environment's own.
"""

from __future__ import annotations

import sys
import time

import numpy as np
import palpate.gym as touch
from numpy.typing import NDArray

FORMS: list[tuple[type[touch.TouchEnv], type[touch.TouchVectorEnv]]] = [
    (touch.PalpationEnv, touch.PalpationVectorEnv),
    (touch.TractionEnv, touch.TractionVectorEnv),
    (touch.CuttingEnv, touch.CuttingVectorEnv),
]
COUNT = 16
STEPS = 50


def actions() -> NDArray[np.float32]:
    """The same for both: (steps, episodes, 4)."""
    return np.random.default_rng(0).uniform(-1.0, 1.0, (STEPS, COUNT, 4)).astype(np.float32)


def alone(environment: touch.TouchEnv) -> float:
    """Steps per second of processor time, one episode after the other."""
    begin = time.process_time()
    for number, own in enumerate(actions().swapaxes(0, 1)):
        environment.reset(seed=number)
        for action in own:
            _, _, terminated, truncated, _ = environment.step(action)
            if terminated or truncated:
                environment.reset()
    return STEPS * COUNT / (time.process_time() - begin)


def together(environment: touch.TouchVectorEnv) -> float:
    """The same, all episodes side by side."""
    begin = time.process_time()
    environment.reset(seed=0)
    for action in actions():
        environment.step(action)
    return STEPS * COUNT / (time.process_time() - begin)


def main() -> None:
    """Prints both for each task."""
    model = sys.argv[1] if len(sys.argv) > 1 else None
    print(f"{model or 'own'} model, {COUNT} together; a step is ten of the model's; per second of one core")
    for single, vector in FORMS:
        begin = time.process_time()
        one = single(model=model)
        prepared = time.process_time() - begin
        simulation = one.touch.simulation
        name = single.__name__.removesuffix("Env")
        rates = [(alone(one), together(vector(COUNT, simulation=simulation))) for _ in range(3)]
        best = np.max(rates, axis=0)
        print(f"{name:<10} alone {best[0]:7.1f} /s, together {best[1]:7.1f} /s  (prepared in {prepared:.1f} s)")


if __name__ == "__main__":
    main()
