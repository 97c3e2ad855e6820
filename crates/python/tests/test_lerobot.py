"""Recordings for robot learning: written, read back by pyarrow, with the numbers that were felt."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import palpate
import pytest

parquet = pytest.importorskip("pyarrow.parquet")

from conftest import local, press
from palpate.lerobot import LeRobotWriter, export_session, png

TABLES = ("data/chunk-000/file-000.parquet", "meta/episodes/chunk-000/file-000.parquet", "meta/tasks.parquet")


def info(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads((folder / "meta/info.json").read_text())
    return found


def test_what_was_recorded_is_read_back(tmp_path: Path) -> None:
    """Two episodes with a force, an image and a truth; judge: the arrays that were given."""
    folder = tmp_path / "set"
    draw = np.random.default_rng(0)
    frames: list[dict[str, Any]] = [
        {
            "observation.state": draw.normal(size=3).astype(np.float32),
            "observation.force": draw.normal(size=3),
            "observation.images.endoscope": draw.integers(0, 256, (6, 5, 3)).astype(np.uint8),
            "next.done": np.array([number == 4]),
            "action": draw.normal(size=4).astype(np.float32),
        }
        for number in range(7)
    ]
    with LeRobotWriter(folder, 20, "press", names={"observation.force": ["fx_n", "fy_n", "fz_n"]}) as writer:
        for number, frame in enumerate(frames):
            writer.add_frame(frame)
            if number == 2:
                writer.end_episode()
    told = info(folder)
    assert told["codebase_version"] == "v3.0" and told["fps"] == 20
    assert (told["total_episodes"], told["total_frames"], told["total_tasks"]) == (2, 7, 1)
    assert told["features"]["observation.force"] == {
        "dtype": "float32",
        "shape": [3],
        "names": ["fx_n", "fy_n", "fz_n"],
    }
    data, episodes, tasks = (parquet.read_table(folder / own) for own in TABLES)
    assert set(data.column_names) == set(told["features"])
    assert data["episode_index"].to_pylist() == [0] * 3 + [1] * 4
    assert data["frame_index"].to_pylist() == [0, 1, 2, 0, 1, 2, 3] and data["index"].to_pylist() == list(range(7))
    # Float32 has seven digits.
    assert np.allclose(data["timestamp"].to_pylist(), [0, 0.05, 0.1, 0, 0.05, 0.1, 0.15], rtol=1e-6)
    assert data["next.done"].to_pylist() == [number == 4 for number in range(7)]
    for name in ("observation.state", "observation.force", "action"):
        assert np.allclose(data[name].to_pylist(), [frame[name] for frame in frames], rtol=1e-6)
    image = pytest.importorskip("PIL.Image")
    for stored, frame in zip(data["observation.images.endoscope"].to_pylist(), frames, strict=True):
        assert np.array_equal(
            np.asarray(image.open(io.BytesIO(stored["bytes"]))), frame["observation.images.endoscope"]
        )
    assert episodes["dataset_from_index"].to_pylist() == [0, 3] and episodes["dataset_to_index"].to_pylist() == [3, 7]
    assert episodes["tasks"].to_pylist() == [["press"], ["press"]]
    assert tasks.to_pandas().loc["press", "task_index"] == 0
    assert parquet.ParquetFile(folder / TABLES[0]).num_row_groups == 2
    stats = json.loads((folder / "meta/stats.json").read_text())["observation.force"]
    forces = np.array([frame["observation.force"] for frame in frames])
    assert np.allclose(stats["mean"], forces.mean(axis=0)) and np.allclose(stats["max"], forces.max(axis=0))


def test_a_session_is_a_demonstration(tmp_path: Path) -> None:
    """Judge: the session's own rows at the times of the frames."""
    simulation = palpate.Simulation(local())
    poses = press(simulation, steps=60)[:, 0]
    motion = palpate.Motion({simulation.tools[0]: (np.linspace(0.0, 0.5, 60), poses)})
    session = simulation.play(motion)
    count = export_session(session, tmp_path / "set", fps=50)
    data = parquet.read_table(tmp_path / "set" / TABLES[0])
    assert count == len(data) == 26
    times = np.asarray(session.columns["time_s"])
    forces = np.stack([session.columns[name] for name in ("fx_n", "fy_n", "fz_n")], axis=1)
    for number, force in enumerate(data["observation.force"].to_pylist()):
        row = np.flatnonzero(times <= number / 50 + 1e-9)[-1]
        assert np.allclose(force, forces[row], rtol=1e-6)
    assert np.linalg.norm(data["observation.force"].to_pylist()[-1]) > 0.0
    states, acted = data["observation.state"].to_pylist(), data["action"].to_pylist()
    assert acted[:-1] == states[1:] and acted[-1] == states[-1]


def test_what_cannot_be_recorded_is_told(tmp_path: Path) -> None:
    with pytest.raises(palpate.InputError, match="the folder is there already"):
        LeRobotWriter(tmp_path, 20, "press")
    with pytest.raises(palpate.InputError, match="a whole number"):
        LeRobotWriter(tmp_path / "set", 12.5, "press")
    writer = LeRobotWriter(tmp_path / "set", 20, "press")
    with pytest.raises(palpate.InputError, match="without a frame"):
        writer.end_episode()
    writer.add_frame({"action": [1.0, 2.0]})
    with pytest.raises(palpate.InputError, match="give the same to each"):
        writer.add_frame({"action": [1.0]})
    assert png(np.zeros((1, 1, 3), np.uint8)).startswith(b"\x89PNG")
