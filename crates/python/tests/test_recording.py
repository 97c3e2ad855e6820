"""Recordings, motions and sessions as files and frames."""

from __future__ import annotations

import pickle
import sys
from pathlib import Path

import numpy as np
import palpate
import pytest
from conftest import Command

HEADER = {"organ": "liver", "stimulus": "ramp_and_hold", "indenter_radius_m": 0.001, "repeat": 2}
TIME = np.linspace(0.0, 1.0, 11)


def recording() -> palpate.Recording:
    return palpate.Recording(TIME, 0.001 * TIME, 0.05 * TIME, HEADER)


def test_a_recording_comes_back_from_its_file(tmp_path: Path) -> None:
    own = recording()
    own.write(tmp_path / "own.csv")
    read = palpate.Recording.read(tmp_path / "own.csv")
    assert read == own == pickle.loads(pickle.dumps(own))
    assert np.array_equal(read.depth, 0.001 * TIME) and len(read) == 11
    assert read.header == HEADER and not read.is_foreign and read.remarks == []


def test_a_recording_is_a_frame() -> None:
    frame = recording().to_frame()
    assert list(frame.columns) == ["time_s", "depth_m", "force_n"]
    assert frame.attrs == HEADER and np.array_equal(frame["force_n"].to_numpy(), 0.05 * TIME)


def test_a_frame_without_pandas_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install palpate\[pandas\]"):
        recording().to_frame()


def test_tables_of_others_are_read(tmp_path: Path) -> None:
    path = tmp_path / "other.csv"
    path.write_text("Time (s),Pos A,Pos B,Load (mN)\n0,0,1,0\n1,1,2,30\n")
    read = palpate.Recording.read(path, depth="Pos A", depth_unit="mm")
    assert read.is_foreign and read.remarks
    assert np.allclose(read.depth, [0.0, 0.001]) and np.allclose(read.force, [0.0, 0.03])
    assert list(read.to_frame()["Pos B"]) == [1.0, 2.0]
    with pytest.raises(palpate.InputError, match="depth=NAME"):
        palpate.Recording.read(path)
    with pytest.raises(palpate.InputError, match="the unit of `Pos A` is not known"):
        palpate.Recording.read(path, depth="Pos A")


@pytest.mark.parametrize(
    ("columns", "header", "said"),
    [
        (([0, 1], [0, 1], [0, 1, 2]), None, "force_n is 3 numbers for 2 times"),
        (([0, 0], [0, 1], [0, 1]), None, "time_s of sample 1 is 0"),
        (([0, 1], [0, np.nan], [0, 1]), None, "depth_m of sample 1 is NaN"),
        (([], [], []), None, "a recording is empty"),
        (([0, 1], [[0, 1]], [0, 1]), None, r"`depth` has the shape \(1, 2\)"),
        (([0, 1], [0, 1], [0, 1]), {"indenter_radius_m": -1.0}, "`indenter_radius_m` is -1"),
        (([0, 1], [0, 1], [0, 1]), {"indenter_radus_m": 1.0}, "indenter_radius_m"),
    ],
)
def test_what_is_no_recording_is_told(
    columns: tuple[list[float], list[float], list[float]], header: dict[str, object] | None, said: str
) -> None:
    with pytest.raises(palpate.InputError, match=said):
        palpate.Recording(*columns, header)


def test_errors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    for name, text in (
        ("absent.csv", None),
        ("bad.csv", "# format = 1\ntime_s,depth_m,force_n\n0,0,0\n0,0,0\n"),
        ("worse.csv", "# format = 1\ntime_s,depth_m\n0,0\n"),
    ):
        path = tmp_path / name
        if text is not None:
            path.write_text(text)
        said = command("analyze", path)
        with pytest.raises(palpate.InputError) as raised:
            palpate.Recording.read(path)
        assert said.returncode == 2 and str(raised.value) in said.stderr


def test_a_motion_comes_back_from_its_file(tmp_path: Path) -> None:
    poses = np.array([[0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0, 0.5, 1.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 0.0]])
    motion = palpate.Motion({"right": ([0.0, 1.0], poses), "left": ([0.5], [[0.0, 0.0, 0.0]])})
    assert pickle.loads(pickle.dumps(motion)) == motion
    assert (motion.tools, motion.begin, motion.end) == (["right", "left"], 0.0, 1.0)
    there = motion.poses([0.0, 0.5, 1.0], ["left", "right", "third"])
    assert there.shape == (3, 3, 9)
    assert np.isnan(there[0, 0]).all() and np.isnan(there[:, 2]).all()
    assert np.array_equal(there[[0, 2], 1], poses)
    assert np.allclose(there[1, 1], [0, 0, 0.05, 0, 0, 0.5**0.5, 0.5**0.5, 0.5, 1.0])
    motion.write(tmp_path / "motion.csv")
    read = palpate.Motion.read(tmp_path / "motion.csv")
    assert np.array_equal(read.poses([0.0, 1.0], ["right"])[:, 0], poses)
    frame = motion.to_frame()
    assert list(frame.columns)[:5] == ["time_s", "tool", "x_m", "y_m", "z_m"] and len(frame) == 3


@pytest.mark.parametrize(
    ("tools", "said"),
    [
        ({}, "a motion is without a tool"),
        ({"right": ([0.0, 0.0], [[0, 0, 0]] * 2)}, "a time after that of the row before"),
        ({"right": ([0.0], [[0, 0, np.nan]])}, "a position of finite numbers"),
        ({"right": ([0.0], [[np.nan] * 3])}, "row 0 of `poses` is no place"),
        ({"right": ([0.0], [[0, 0, 0, 0, 0, 0, 0]])}, "a quaternion that is not zero"),
        ({"right": ([0.0], [[0, 0, 0, 0, 0.5]])}, "0 or 1 for whether it cuts"),
        ({"right": ([0.0, 1.0], [[0, 0, 0]])}, r"`poses` has the shape \(1, 3\)"),
    ],
)
def test_what_is_no_motion_is_told(tools: dict[str, object], said: str) -> None:
    with pytest.raises(palpate.InputError, match=said):
        palpate.Motion(tools)  # type: ignore[arg-type]
