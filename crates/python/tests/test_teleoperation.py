"""Hands on devices, on the machine's clock."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
import palpate
import pytest
from conftest import above


def until(touch: palpate.Teleoperation, end: float) -> None:
    """Waits for the model's time, at most half a minute on a busy machine."""
    limit = time.monotonic() + 30.0
    while touch.is_running and touch.time < end and time.monotonic() < limit:
        time.sleep(0.01)
    assert touch.time >= end


def test_a_scripted_hand_leaves_a_session_that_plays_again(simulation: palpate.Simulation, tmp_path: Path) -> None:
    """Judge: the same poses, played headless, give the same forces."""
    devices = {"right": "virtual"}
    with palpate.Teleoperation(simulation, tmp_path / "touch", devices=devices) as touch:
        until(touch, 1.0)
        assert touch.positions.shape == touch.forces.shape == touch.felt_forces.shape == (1, 3)
        assert touch.faults == [None] and touch.grips.shape == (1,)
        session = touch.end()
        assert session is not None and touch.end() is None
    assert not touch.is_running
    assert session.tools == ["right"] and session.incomplete is None
    # Every row again, by plain steps of the same lengths.
    columns = session.columns
    simulation.reset()
    times, places = columns["time_s"], np.column_stack([columns[f"{axis}_m"] for axis in "xyz"])
    recorded = np.column_stack([columns[f"f{axis}_n"] for axis in "xyz"])
    elapsed = np.diff(times, prepend=times[0])
    again = [simulation.step(place, step)[0] for place, step in zip(places, elapsed, strict=True)]
    assert np.linalg.norm(recorded, axis=1).max() > 0.0
    assert np.allclose(again, recorded, atol=1e-6)
    simulation.reset()
    with pytest.raises(palpate.InputError, match="has ended"):
        touch.mark()
    # The simulation's own state stayed at rest.
    assert simulation.time == 0.0 and not simulation.state.contacts.any()


def test_a_program_moves_a_tool(simulation: palpate.Simulation) -> None:
    """Judges: no force in the air and none without a hand, a force in the tissue, none after an end of the touch."""
    with palpate.Teleoperation(simulation, devices={"right": "mouse"}) as touch:
        assert np.isnan(touch.positions).all()
        touch.move("right", above(simulation) + [0.0, 0.0, 0.01])
        until(touch, touch.time + 0.3)
        assert (
            np.allclose(touch.positions[0], above(simulation) + [0.0, 0.0, 0.01], atol=1e-4) and not touch.forces.any()
        )
        touch.move("right", above(simulation) - [0.0, 0.0, 0.003], grip=0.5)
        until(touch, touch.time + 0.3)
        assert np.linalg.norm(touch.forces[0]) > 0.0 and touch.grips[0] == 0.5
        # At rest the hand is commanded the force on the tool.
        assert np.allclose(touch.felt_forces, touch.forces, rtol=0.05)
        touch.move("right", None)
        until(touch, touch.time + 0.3)
        assert not touch.forces.any()


def test_what_is_wrong_is_said(simulation: palpate.Simulation, tmp_path: Path) -> None:
    refused = [
        ({"left": "virtual"}, "no tool `left`"),
        ({"right": "violin"}, "no device `violin`"),
        ({"right": "none"}, "moved by a device"),
    ]
    for devices, words in refused:
        with pytest.raises(palpate.InputError, match=words):
            palpate.Teleoperation(simulation, devices=devices)
    with palpate.Teleoperation(simulation, tmp_path / "touch", devices={"right": "mouse"}) as touch:
        for bad in ([np.nan, 0.0, 0.0], [0.0, np.inf, 0.0]):
            with pytest.raises(palpate.InputError, match="not finite"):
                touch.move("right", bad)
        with pytest.raises(palpate.InputError, match="no mouse moves a tool `left`"):
            touch.move("left", [0.0, 0.0, 0.0])
        until(touch, 0.1)
    with pytest.raises(palpate.InputError, match="overwrite"):
        palpate.Teleoperation(simulation, tmp_path / "touch", devices={"right": "mouse"})
