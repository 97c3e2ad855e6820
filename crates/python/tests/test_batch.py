"""Many states of one model."""

from __future__ import annotations

import numpy as np
import palpate
import pytest
from conftest import local, press

COUNT = 5


@pytest.mark.parametrize("threads", [1, 2, 4])
def test_a_batch_is_its_states_to_the_bit(simulation: palpate.Simulation, threads: int) -> None:
    poses = press(simulation)
    batch = palpate.SimulationBatch(simulation, COUNT, threads)
    assert (len(batch), batch.threads) == (COUNT, threads)
    asides = np.linspace(0.0, 0.004, COUNT)
    many = np.repeat(poses[:, None], COUNT, axis=1)
    many[..., 0] += asides[:, None]
    stepped = np.array([batch.step(row) for row in many])
    depths, times = batch.depths, batch.times
    batch.reset()
    assert np.array_equal(batch.replay(many), stepped)
    for number in range(COUNT):
        simulation.reset()
        assert np.array_equal(simulation.replay(many[:, number]), stepped[:, number])
        assert simulation.state.depths[0] == depths[number, 0] and simulation.time == times[number]
        assert np.array_equal(batch.state(number).forces, simulation.state.forces)
    assert batch.contacts.all() and np.array_equal(batch.forces, stepped[-1]) and not batch.holds.any()


def test_states_are_reset_and_restored_one_by_one(simulation: palpate.Simulation) -> None:
    poses = np.repeat(press(simulation)[:, None], COUNT, axis=1)
    batch = palpate.SimulationBatch(simulation, COUNT)
    batch.replay(poses[:40])
    kept = batch.snapshot(2)
    batch.reset([False, True, False, False, True])
    assert batch.times.tolist() == pytest.approx([0.195, 0.0, 0.195, 0.195, 0.0])
    batch.reset(-1)
    batch.reset(np.array([0, 3]))
    assert np.count_nonzero(batch.times) == 1
    batch.restore(0, kept)
    both = batch.replay(poses[40:])
    assert np.array_equal(both[:, 0], both[:, 2]) and not np.array_equal(both[:, 0], both[:, 1])
    simulation.restore(kept)
    assert np.array_equal(simulation.replay(poses[40:, 0]), both[:, 0])


def test_only_some_go_on(simulation: palpate.Simulation) -> None:
    poses = np.repeat(press(simulation)[:, None], COUNT, axis=1)
    batch = palpate.SimulationBatch(simulation, COUNT)
    batch.replay(poses[:30])
    before = batch.forces
    after = batch.replay(poses[30:], which=[1, -1])
    assert np.array_equal(after[-1], batch.forces)
    stayed = [0, 2, 3]
    assert np.array_equal(batch.forces[stayed], before[stayed])
    assert np.count_nonzero(batch.times == batch.times.max()) == 2


def test_states_differ_in_their_inclusions(simulation: palpate.Simulation) -> None:
    poses = press(simulation)
    top = poses[0, 0]
    ball = {"center_m": (top - [0, 0, 0.013]).tolist(), "radius_m": 0.008}
    batch = palpate.SimulationBatch(simulation, 2)
    batch.reset(1, local({"inclusion": [{"ball": ball, "stiffness_ratio": 10.0}]}))
    forces = batch.replay(np.repeat(poses[:, None], 2, axis=1))[-1]
    assert np.linalg.norm(forces[1]) > 1.1 * np.linalg.norm(forces[0])


def test_tasks_are_judged_in_each_state() -> None:
    task = {"title": "find", "find": {"target_m": [0.0, 0.0, 0.0], "tolerance_m": 0.5}, "time_limit_s": 0.2}
    simulation = palpate.Simulation(local(task=task))
    poses = np.repeat(press(simulation, steps=20)[:, None], 3, axis=1)
    batch = palpate.SimulationBatch(simulation, 3)
    batch.replay(poses, marks=[[False], [True], [False]])
    assert batch.over.tolist() == [False, True, False] and not batch.late.any()
    batch.replay(poses[-1:].repeat(30, axis=0))
    assert batch.over.all() and batch.late.tolist() == [True, False, True]
    score = batch.score(1)
    assert score is not None and score["passed"] is True and score["measures"]["beside_m"] < 0.5
    assert simulation.score() is not None and batch.errors.shape == (3, 4)


def test_what_does_not_fit_is_told(simulation: palpate.Simulation) -> None:
    batch = palpate.SimulationBatch(simulation, 3)
    bad = np.zeros((3, 1, 3))
    bad[1, 0, 2] = np.nan
    for poses, said in (
        (np.zeros((2, 1, 3)), r"\(2, 1, 3\); give \(3, 1, n\)"),
        (np.zeros((3, 1, 4)), "4"),
        (bad, "a position of finite numbers"),
    ):
        with pytest.raises(palpate.InputError, match=said):
            batch.step(poses)
    assert not batch.times.any() and np.isnan(batch.state(0).positions).all(), "nothing has moved"
    with pytest.raises(palpate.InputError, match=r"`marks` has the shape \(3,\)"):
        batch.step(np.zeros((3, 1, 3)), marks=[1, 0, 0])
    for index in (3, -4):
        with pytest.raises(palpate.InputError, match="there is no state"):
            batch.state(index)
    with pytest.raises(palpate.InputError, match="2 truths"):
        batch.reset([True, False])
    with pytest.raises(palpate.InputError, match="does nothing"):
        palpate.SimulationBatch(simulation, 0)
