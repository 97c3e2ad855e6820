"""What several tests stand on."""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import palpate
import pytest
from numpy.typing import NDArray

Command = Callable[..., "subprocess.CompletedProcess[str]"]


@pytest.fixture(scope="session", autouse=True)
def _ctrl_c_is_heard() -> Iterator[None]:
    """A shell has what it starts in the background ignore Ctrl-C."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session")
def command() -> Command:
    """The command `palpate`, which the variable PALPATE_COMMAND names."""
    path = os.environ.get("PALPATE_COMMAND")
    if not path:
        pytest.skip("PALPATE_COMMAND does not name the command")

    def run(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
        line = [path, *map(str, arguments)]
        return subprocess.run(line, capture_output=True, text=True, check=False)

    return run


def local(organ: dict[str, object] | None = None, **more: object) -> palpate.Scene:
    """A coarse liver under the local model, which is prepared at once."""
    whole = {"builtin": "liver", "triangles": 2000, "builtin_tissue": "pig-kidney", **(organ or {})}
    return palpate.Scene({"organ": whole, "model": {"kind": "local"}, **more})


@pytest.fixture(scope="session")
def simulation() -> palpate.Simulation:
    """One that tests may step after a `reset`."""
    return palpate.Simulation(local())


def above(simulation: palpate.Simulation) -> NDArray[np.float64]:
    """The highest vertex of the organ at rest [m]."""
    simulation.reset()
    rest = simulation.vertices
    top: NDArray[np.float64] = rest[rest[:, 2].argmax()]
    return top


def press(simulation: palpate.Simulation, steps: int = 60, depth: float = 0.004) -> NDArray[np.float64]:
    """Poses that go from 1 mm above the highest vertex to `depth` below it and aside [m]: (steps, 1, 3)."""
    part = np.linspace(0.0, 1.0, steps)[:, None]
    way = np.array([0.002, 0.001, -0.001 - depth])
    poses: NDArray[np.float64] = (above(simulation) + [0.0, 0.0, 0.001] + part * way)[:, None]
    return poses
