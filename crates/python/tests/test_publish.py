"""`palpate simulate --publish`: a client of another language reads poses, forces and the organ as ROS has them."""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

client = pytest.importorskip("websockets.sync.client")

SCENE = """\
format = 1
organ = { builtin = "liver", triangles = 2000, builtin_tissue = "pig-liver" }
model = { kind = "local" }
tool = [{ name = "right", device = "virtual", tip = { shape = "flat", radius_m = 0.002 } }]
"""


@pytest.fixture
def address(tmp_path: Path) -> Iterator[str]:
    """Where a simulation is published whose tool palpates by itself."""
    palpate = os.environ.get("PALPATE_COMMAND")
    if not palpate:
        pytest.skip("PALPATE_COMMAND does not name the command")
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE)
    line = [palpate, "simulate", str(scene), "--headless", "--publish=0"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        said = running.stdout.readline()
        yield said.removeprefix("shown at ").split(",")[0]
        running.terminate()


def published(socket: Any, topic: str) -> dict[str, Any]:
    socket.send(json.dumps({"op": "subscribe", "topic": topic}))
    while True:
        found = json.loads(socket.recv(timeout=20))
        if found.get("topic") == topic:
            socket.send(json.dumps({"op": "unsubscribe", "topic": topic}))
            message: dict[str, Any] = found["msg"]
            return message


def test_a_client_reads_the_simulation(address: str) -> None:
    assert address.startswith("127.0.0.1:")
    with client.connect(f"ws://{address}", max_size=None) as socket:
        pose = published(socket, "/palpate/right/pose")["pose"]
        assert np.isclose(np.linalg.norm(list(pose["orientation"].values())), 1.0)
        mesh = published(socket, "/palpate/organ")
        vertices = np.array([[vertex[axis] for axis in "xyz"] for vertex in mesh["vertices"]])
        corners = np.array([triangle["vertex_indices"] for triangle in mesh["triangles"]])
        assert len(corners) == 2000 and corners.max() == len(vertices) - 1
        # Outward triangles: the volume is that of a liver [m3].
        a, b, c = vertices[corners].swapaxes(0, 1)
        volume = np.einsum("ni,ni->", a, np.cross(b, c)) / 6.0
        assert 0.5e-3 < volume < 3e-3
        # The tip presses the organ in the course of a second: the force points out of it.
        socket.send(json.dumps({"op": "subscribe", "topic": "/palpate/right/wrench"}))
        forces: list[list[float]] = []
        while len(forces) < 150:
            found = json.loads(socket.recv(timeout=20))
            if found.get("topic") == "/palpate/right/wrench":
                forces.append(list(found["msg"]["wrench"]["force"].values()))
        assert np.linalg.norm(forces, axis=1).max() > 0.01
