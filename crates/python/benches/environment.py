"""Steps of the environments per second, alone and vectorised, by actions at random.

A step of an environment is ten of the model. With an argument "hybrid" the whole organs are prepared (minutes, once);
without one the local model answers.
"""

from __future__ import annotations

import os
import sys
import time

import numpy as np
import palpate
import palpate.gym as touch

FORMS: list[tuple[type[touch.TouchEnv], type[touch.TouchVectorEnv]]] = [
    (touch.PalpationEnv, touch.PalpationVectorEnv),
    (touch.TractionEnv, touch.TractionVectorEnv),
    (touch.CuttingEnv, touch.CuttingVectorEnv),
]
COUNT = 16
STEPS = 400


def alone(environment: touch.TouchEnv) -> float:
    """Steps per second of one."""
    draw = np.random.default_rng(0)
    environment.reset(seed=0)
    begin = time.perf_counter()
    for _ in range(STEPS):
        action = draw.uniform(-1.0, 1.0, 4).astype(np.float32)
        _, _, terminated, truncated, _ = environment.step(action)
        if terminated or truncated:
            environment.reset()
    return STEPS / (time.perf_counter() - begin)


def together(environment: touch.TouchVectorEnv) -> float:
    """Steps per second over all."""
    draw = np.random.default_rng(0)
    environment.reset(seed=0)
    rounds = STEPS // COUNT * 2
    begin = time.perf_counter()
    for _ in range(rounds):
        environment.step(draw.uniform(-1.0, 1.0, (COUNT, 4)).astype(np.float32))
    return rounds * COUNT / (time.perf_counter() - begin)


def main() -> None:
    """Prints both for each task."""
    model = sys.argv[1] if len(sys.argv) > 1 else "local"
    print(f"{model} model, {COUNT} together on {os.cpu_count()} cores; a step is ten of the model's")
    for single, vector in FORMS:
        scene = palpate.Scene.builtin(single.kind.builtin)
        begin = time.perf_counter()
        one = single(scene, model=model)
        prepared = time.perf_counter() - begin
        simulation = one.touch.simulation
        name = single.__name__.removesuffix("Env")
        rates = [(alone(one), together(vector(COUNT, simulation=simulation))) for _ in range(3)]
        best = np.max(rates, axis=0)
        print(f"{name:<10} alone {best[0]:7.1f} /s, together {best[1]:7.1f} /s  (prepared in {prepared:.1f} s)")


if __name__ == "__main__":
    main()
