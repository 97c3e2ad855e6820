"""Steps, states and snapshots."""

from __future__ import annotations

import csv
import os
import signal
import threading
from pathlib import Path

import numpy as np
import palpate
import pytest
from conftest import Command, above, local, press
from numpy.typing import NDArray


def test_a_press_is_felt(simulation: palpate.Simulation) -> None:
    """Judges: no force in the air, a force outward that grows with depth in the tissue."""
    poses = press(simulation)
    forces = np.array([simulation.step(row) for row in poses])
    state = simulation.state
    assert forces.shape == (60, 1, 3) and (forces[0] == 0.0).all()
    assert forces[-1, 0] @ state.normals[0] > forces[30, 0] @ state.normals[0] > 0.0
    assert np.array_equal(state.forces, forces[-1]) and np.array_equal(state.positions, poses[-1])
    assert state.contacts.tolist() == [True] and state.depths[0] == pytest.approx(0.004, abs=5e-4)
    assert state.time == pytest.approx(59 * simulation.step_length)
    assert state.stiffnesses.shape == (1, 3, 3) and state.orientations.shape == (1, 4)
    moved = np.linalg.norm(simulation.vertices - palpate.Mesh.builtin("liver", 2000).vertices, axis=1)
    assert 1e-3 < moved.max() < 6e-3
    assert len(simulation.triangles) == 2000


def test_events_are_those_of_a_session(simulation: palpate.Simulation) -> None:
    top = above(simulation)
    assert simulation.step(top + [0, 0, 0.01]).shape == (1, 3) and simulation.state.events == [[]]
    simulation.step(top - [0, 0, 0.002])
    assert simulation.state.events == [["contact"]]
    simulation.step(top - [0, 0, 0.002], mark=True)
    assert simulation.state.events == [["mark"]]
    simulation.step(top + [0, 0, 0.01])
    assert simulation.state.events == [["release"]]


def test_a_replay_is_its_steps(simulation: palpate.Simulation) -> None:
    poses = press(simulation)
    forces = np.array([simulation.step(row) for row in poses])
    simulation.reset()
    assert np.array_equal(simulation.replay(poses), forces)


def test_the_clock_takes_what_it_is_given(simulation: palpate.Simulation) -> None:
    top = above(simulation)
    times = []
    for elapsed in (None, None, 0.5, None, 0.0):
        simulation.step(top, elapsed)
        times.append(simulation.time)
    assert times == [0.0, 0.005, 0.505, 0.51, 0.51]
    for wrong in (-1.0, np.nan, np.inf):
        with pytest.raises(palpate.InputError, match="`elapsed` is"):
            simulation.step(top, wrong)
    assert simulation.time == 0.51


def test_a_snapshot_is_exact(simulation: palpate.Simulation) -> None:
    poses = press(simulation)
    simulation.replay(poses[:40])
    kept = simulation.snapshot()
    first, after = simulation.replay(poses[40:]), simulation.vertices
    simulation.replay(poses[::-1])
    simulation.restore(kept)
    assert (simulation.time, kept.time) == (39 * 0.005, 39 * 0.005)
    assert np.array_equal(simulation.replay(poses[40:]), first)
    assert np.array_equal(simulation.vertices, after)
    with pytest.raises(palpate.InputError, match="another simulation"):
        palpate.Simulation(local()).restore(kept)


def test_a_snapshot_is_exact_where_tissue_is_cut() -> None:
    """Two ways from the same state, each twice: what one has cut the other does not meet."""
    simulation = palpate.Simulation(local(tool=[{"kind": "scissors", "tip": {"shape": "flat", "radius_m": 0.001}}]))
    top = above(simulation)
    part = np.linspace(0.0, 1.0, 40)[:, None]
    begin = np.vstack([top + [0, 0, 0.001], top - [0, 0, 0.003]])
    simulation.replay(np.hstack([begin, [[0, 0], [0, 1]]])[:, None])
    kept = simulation.snapshot()
    ways = [
        np.hstack([top + part * aside - [0, 0, 0.003], np.zeros_like(part), np.ones_like(part)])[:, None]
        for aside in ([0.01, 0.0, 0.0], [0.0, 0.01, 0.0])
    ]
    found: list[tuple[NDArray[np.float64], NDArray[np.float64], float]] = []
    for way in (ways[0], ways[1], ways[0], ways[1]):
        simulation.restore(kept)
        forces = simulation.replay(way)
        found.append((forces, simulation.vertices, simulation.state.cut_length))
    assert found[0][2] > 2e-3 and len(found[0][1]) > 1002
    for one, other in ((0, 2), (1, 3)):
        assert np.array_equal(found[one][0], found[other][0]) and np.array_equal(found[one][1], found[other][1])
        assert found[one][2] == found[other][2]
    assert not np.array_equal(found[0][0], found[1][0])


def test_tools_may_be_away() -> None:
    two = palpate.Simulation(local(tool=[{"name": "right"}, {"name": "left"}]))
    top = above(two)
    alone = two.step([top - [0, 0, 0.002], None])
    assert (alone[1] == 0.0).all() and np.isnan(two.state.positions[1]).all()
    two.reset()
    array = np.array([top - [0, 0, 0.002], [np.nan] * 3])
    assert np.array_equal(two.step(array), alone)
    two.reset()
    mixed = two.step([[*top - [0, 0, 0.002], 0, 0, 0, 1], [0.0, 0.0, 0.3, 0.5, 0]])
    assert np.array_equal(mixed, alone)
    with pytest.raises(palpate.InputError, match='"right" and "left"'):
        two.step(array, mark="middle")


@pytest.mark.parametrize(
    ("poses", "said"),
    [
        (np.zeros((2, 3)), r"`poses` has the shape \(2, 3\); give \(1, 3\)"),
        (np.zeros((1, 4)), r"`poses` has the shape \(1, 4\)"),
        (np.zeros((1, 1, 3)), r"`poses` has the shape \(1, 1, 3\)"),
        ([[0.0, np.nan, 0.0]], "a position of finite numbers"),
        ([[0.0, np.inf, 0.0]], "a position of finite numbers"),
        ([[0.0, 0.0, 0.0, 1.5, 0.0]], "a grip from 0 to 1"),
        ([[0.0, 0.0, 0.0, np.nan, 0.0]], "a grip from 0 to 1"),
        ([[0.0, 0.0, 0.0, 0.0, np.nan]], "0 or 1 for whether it cuts"),
        ([[0.0] * 7], "a quaternion that is not zero"),
        ([["a", "b", "c"]], "`poses` is no array of numbers"),
        ([[0.0, 0.0, 0.0], [0.0]], "`poses` is no array of numbers"),
        (None, "`poses` has the shape"),
    ],
)
def test_what_are_no_poses_is_told(simulation: palpate.Simulation, poses: object, said: str) -> None:
    simulation.reset()
    with pytest.raises(palpate.InputError, match=said):
        simulation.step(poses)  # type: ignore[arg-type]
    assert simulation.state.positions.shape == (1, 3) and np.isnan(simulation.state.positions).all()


def test_any_numbers_will_do(simulation: palpate.Simulation) -> None:
    top = above(simulation) - [0, 0, 0.002]
    forces = simulation.step(top)
    for same in (top[None], [list(top)], np.asfortranarray(np.vstack([top, top]))[:1], top.astype(object)[None]):
        simulation.reset()
        assert np.array_equal(simulation.step(same), forces)
    simulation.reset()
    simulation.step(np.zeros((1, 3), dtype=np.int32))


def test_an_inclusion_is_felt_where_a_reset_puts_it(simulation: palpate.Simulation) -> None:
    """One model serves organs that differ in their estimated inclusions: as a model made for it, to the bit."""
    top = above(simulation)
    ball = {"center_m": (top - [0, 0, 0.012]).tolist(), "radius_m": 0.008}
    there = local({"inclusion": [{"ball": ball, "stiffness_ratio": 10.0}]})
    poses = press(simulation)
    plain = simulation.replay(poses)
    simulation.reset(there)
    found = simulation.replay(poses)
    assert np.linalg.norm(found[-1]) > 1.1 * np.linalg.norm(plain[-1])
    assert np.array_equal(palpate.Simulation(there).replay(poses), found)
    simulation.reset()
    assert np.array_equal(simulation.replay(poses), plain)


def write_scene(folder: Path) -> tuple[Path, Path]:
    """A scene of two tools, and a motion of both."""
    top = above(palpate.Simulation(local()))
    scene = folder / "scene.toml"
    scene.write_text(
        'format = 1\n[organ]\nbuiltin = "liver"\ntriangles = 2000\nbuiltin_tissue = "pig-kidney"\n'
        '[model]\nkind = "local"\n[[tool]]\nname = "right"\n[[tool]]\nname = "left"\nkind = "grasper"\n'
        '[task]\ntitle = "press"\nforce_limit_n = 0.05\n'
    )
    motion = folder / "motion.csv"
    motion.write_text(
        "# format = 1\ntime_s,tool,x_m,y_m,z_m,grip,cut\n"
        + "".join(
            f"{time},{tool},{x!r},{y!r},{z!r},{grip},0\n"
            for time, tool, (x, y, z), grip in (
                (0.0, "right", (top + [0, 0, 0.002]).tolist(), 0.0),
                (0.5, "right", (top + [0.002, 0, -0.004]).tolist(), 0.0),
                (0.75, "right", (top + [0.004, 0.001, -0.004]).tolist(), 0.0),
                (0.1, "left", (top + [0.03, 0, 0.002]).tolist(), 0.0),
                (0.4, "left", (top + [0.03, 0, -0.008]).tolist(), 0.9),
                (0.75, "left", (top + [0.03, 0, 0.004]).tolist(), 0.9),
            )
        )
    )
    return scene, motion


def test_results_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    """Judge: session.csv, to the last bit, by three ways: played, replayed and stepped. The motion ends at a whole
    step, for steps know no end that falls between two.
    """
    scene, motion = write_scene(tmp_path)
    out = tmp_path / "session"
    said = command("simulate", scene, "--headless", "--motion", motion, "--out", out)
    assert said.returncode == 0, said.stderr
    theirs = palpate.Session.read(out)
    simulation, moved = palpate.Simulation(palpate.Scene.read(scene)), palpate.Motion.read(motion)
    played = simulation.play(moved)
    played.write(tmp_path / "own")
    assert (tmp_path / "own" / "session.csv").read_bytes() == (out / "session.csv").read_bytes()
    assert played.incomplete is None and theirs.incomplete is None
    with pytest.raises(palpate.InputError, match="is there already"):
        played.write(tmp_path / "own")
    played.write(tmp_path / "own", overwrite=True)
    cut = tmp_path / "cut.csv"
    cut.write_text("".join((out / "session.csv").read_text().splitlines(keepends=True)[:100]))
    missing = palpate.Session.read(cut).incomplete
    assert missing is not None and "no end mark" in missing
    with pytest.raises(palpate.InputError, match="incomplete"):
        palpate.Session.read(cut).write(tmp_path / "again")
    assert played.header == theirs.header and played.score() == theirs.score()
    assert theirs.summary["steps"] == played.summary["steps"]

    with (out / "session.csv").open() as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    times = np.array([float(row["time_s"]) for row in rows if row["tool"] == "right"])
    poses = moved.poses(times, simulation.tools)
    forces = simulation.replay(poses)
    simulation.reset()
    stepped = np.array([simulation.step(row) for row in poses])
    assert np.array_equal(stepped, forces)
    numbers = {name: index for index, name in enumerate(simulation.tools)}
    at = {time: index for index, time in enumerate(times)}
    assert len(rows) == len(played) > 200
    for row in rows:
        own = forces[at[float(row["time_s"])], numbers[row["tool"]]]
        assert own.tolist() == [float(row[name]) for name in ("fx_n", "fy_n", "fz_n")]
    frame = theirs.to_frame()
    assert len(frame) == len(rows) and frame["contact"].any() and "contact" in set(frame["event"])


def test_a_session_without_its_folder_is_told(tmp_path: Path) -> None:
    with pytest.raises(palpate.InputError, match="cannot be read"):
        palpate.Session.read(tmp_path / "absent")


def hybrid(triangles: int) -> palpate.Scene:
    """A whole liver, which takes seconds with few triangles and minutes with many."""
    return palpate.Scene(
        {
            "organ": {"builtin": "liver", "triangles": triangles, "builtin_tissue": "pig-kidney"},
            "model": {"kind": "hybrid"},
        }
    )


def test_ctrl_c_breaks_a_preparation_off() -> None:
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        palpate.Simulation(hybrid(6000), progress=False, cache=False)


def test_a_preparation_is_told_and_kept(tmp_path: Path) -> None:
    told: list[str] = []
    simulation = palpate.Simulation(hybrid(600), progress=lambda part, words: told.append(words), cache=tmp_path)
    assert any("response" in words for words in told) and list(tmp_path.iterdir())
    again = palpate.Simulation(hybrid(600), cache=tmp_path)
    rest = simulation.vertices
    place = rest[rest[:, 2].argmax()] - [0.0, 0.0, 0.002]
    assert np.array_equal(simulation.step(place), again.step(place)) and np.abs(again.state.forces).max() > 0.0


def test_memory_that_is_not_there_is_told() -> None:
    with pytest.raises(palpate.PalpateError, match="memory|GiB|GB|MB") as raised:
        palpate.Simulation(hybrid(600), memory=1000, cache=False)
    assert not isinstance(raised.value, palpate.InputError)
