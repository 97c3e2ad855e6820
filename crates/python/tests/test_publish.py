"""`palpate simulate --publish`: the client library of ROS reads poses, forces and the organ."""

from __future__ import annotations

import os
import queue
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

roslibpy = pytest.importorskip("roslibpy")

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


@pytest.fixture
def ros(address: str) -> Iterator[Any]:
    host, port = address.split(":")
    assert host == "127.0.0.1"
    connected = roslibpy.Ros(host=host, port=int(port))
    connected.run(timeout=20)
    yield connected
    connected.terminate()


def published(ros: Any, topic: str, count: int = 1) -> list[dict[str, Any]]:
    """The first messages of a topic, whose type the server names."""
    messages: queue.Queue[dict[str, Any]] = queue.Queue()
    listener = roslibpy.Topic(ros, topic, ros.get_topic_type(topic))
    listener.subscribe(messages.put)
    found = [messages.get(timeout=20) for _ in range(count)]
    listener.unsubscribe()
    return found


def test_a_client_reads_the_simulation(ros: Any) -> None:
    assert set(ros.get_topics()) == {f"/palpate/{name}" for name in ["right/pose", "right/wrench", "organ", "status"]}
    pose = published(ros, "/palpate/right/pose")[0]["pose"]
    assert np.isclose(np.linalg.norm(list(pose["orientation"].values())), 1.0)
    mesh = published(ros, "/palpate/organ")[0]
    vertices = np.array([[vertex[axis] for axis in "xyz"] for vertex in mesh["vertices"]])
    corners = np.array([triangle["vertex_indices"] for triangle in mesh["triangles"]])
    assert len(corners) == 2000 and corners.max() == len(vertices) - 1
    # Outward triangles: the volume is that of a liver [m3].
    a, b, c = vertices[corners].swapaxes(0, 1)
    volume = np.einsum("ni,ni->", a, np.cross(b, c)) / 6.0
    assert 0.5e-3 < volume < 3e-3
    # The tip presses the organ in the course of a second: the force points out of it.
    wrenches = published(ros, "/palpate/right/wrench", count=150)
    forces = [list(message["wrench"]["force"].values()) for message in wrenches]
    assert np.linalg.norm(forces, axis=1).max() > 0.01
