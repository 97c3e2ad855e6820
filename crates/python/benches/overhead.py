"""What a step from Python costs beyond Rust's own: budget 5 µs.

The same poses are stepped one by one from Python, and by a loop in Rust (`Simulation.replay`). A tool that stays away
from the organ makes steps that are as short as any, so that the difference stands out; one in contact shows what it is
part of. Rounds take turns, and the smallest of each counts.
"""

from __future__ import annotations

import time

import numpy as np
import palpate
from numpy.typing import NDArray

BUDGET_S = 5e-6
ROUNDS = 100

SCENE = palpate.Scene(
    {
        "organ": {"builtin": "liver", "triangles": 2000, "builtin_tissue": "pig-kidney"},
        "model": {"kind": "local"},
    }
)


def step_by_step(simulation: palpate.Simulation, poses: NDArray[np.float64]) -> float:
    """Time per step from Python [s]."""
    simulation.reset()
    rows = list(poses)
    step = simulation.step
    begin = time.perf_counter()
    for row in rows:
        step(row)
    return (time.perf_counter() - begin) / len(rows)


def in_rust(simulation: palpate.Simulation, poses: NDArray[np.float64]) -> float:
    """Time per step in Rust [s]."""
    simulation.reset()
    begin = time.perf_counter()
    simulation.replay(poses)
    return (time.perf_counter() - begin) / len(poses)


def compared(simulation: palpate.Simulation, poses: NDArray[np.float64]) -> tuple[float, float]:
    """Both [s]."""
    rounds = [(step_by_step(simulation, poses), in_rust(simulation, poses)) for _ in range(ROUNDS)]
    python, rust = np.quantile(rounds, 0.1, axis=0)
    return float(python), float(rust)


def main() -> None:
    """Prints both, and fails above the budget."""
    simulation = palpate.Simulation(SCENE)
    rest = simulation.vertices
    top = rest[rest[:, 2].argmax()]
    worst = 0.0
    for name, height, steps in [("away", 0.02, 2000), ("in contact", -0.003, 40)]:
        poses = np.tile(top + [0.0, 0.0, height], (steps, 1, 1))
        python, rust = compared(simulation, poses)
        over = python - rust
        print(f"{name:<12} Python {1e6 * python:8.2f} µs, Rust {1e6 * rust:8.2f} µs, {1e6 * over:+.2f} µs a step")
        if name == "away":
            worst = over
    print(f"overhead {1e6 * worst:.2f} µs a step, budget {1e6 * BUDGET_S:.0f} µs")
    if worst > BUDGET_S:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
