"""The estimate while tissue is pressed. Judge: the relaxed force of a neo-Hookean half-space, by quadrature here."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import palpate
import pytest
from numpy.typing import NDArray

_Floats: TypeAlias = NDArray[np.float64]

RADIUS = 1e-3
TRUTH = {"c10_pa": 450.0, "g_1": 0.2866, "tau_1_s": 0.6, "g_2": 0.2022, "tau_2_s": 4.0}


def press(seconds: float) -> tuple[_Floats, _Floats, _Floats]:
    """Time, depth from above the tissue, and force of a ramp of half a second to half a radius and a hold.

    To half a radius the elastic force under a bonded punch is that of a linear half-space to 2 %: 8 G a d, G = 2 C10.
    """
    time = np.arange(-1.0, seconds, 0.002)
    depth = RADIUS * np.minimum(time, 0.5)
    elastic = 16.0 * TRUTH["c10_pa"] * RADIUS * np.maximum(depth, 0.0)
    force = elastic.copy()
    for g, tau in (("g_1", "tau_1_s"), ("g_2", "tau_2_s")):
        kept = np.exp(-0.002 / TRUTH[tau])
        state = 0.0
        for place, drive in enumerate(elastic):
            state = kept * state + (1.0 - kept) * drive
            force[place] -= TRUTH[g] * state
    noise = np.random.default_rng(1).normal(scale=1e-6, size=len(time))
    return time, depth, force + noise


def test_a_press_is_estimated_while_it_lasts() -> None:
    online = palpate.OnlineEstimate({"indenter_radius_m": RADIUS})
    time, depth, force = press(20.0)
    assert not online.touching
    assert all(not own["known"] for own in online.estimate.values())
    halves = []
    for part in np.array_split(np.arange(len(time)), 7):
        online.add(time[part], depth[part], force[part])
        interval = online.estimate["tau_2_s"]["interval"]
        halves.append(np.inf if interval is None else interval[1] - interval[0])
    assert online.touching and online.skipped == 0
    assert abs(online.time - 20.0) < 0.05
    assert halves[-1] < halves[2]
    for name, own in online.estimate.items():
        assert own["known"] and own["interval"] is not None and own["value"] is not None
        # 2 % of the linear force, and what the interval says of the model.
        assert abs(own["value"] / TRUTH[name] - 1.0) < 0.08, name
    assert online.is_enough(0.5) and not online.is_enough(1e-6)
    online.restart()
    assert not online.touching


def test_single_samples_are_those_of_arrays() -> None:
    time, depth, force = press(2.0)
    whole = palpate.OnlineEstimate({"indenter_radius_m": RADIUS})
    whole.add(time, depth, force)
    single = palpate.OnlineEstimate({"indenter_radius_m": RADIUS})
    for sample in zip(time, depth, force, strict=True):
        single.add(*sample)
    assert single.estimate == whole.estimate


def test_what_is_no_sample_is_skipped() -> None:
    online = palpate.OnlineEstimate({"indenter_radius_m": RADIUS}, contact_error=1e-5)
    online.add([0.0, 0.0, 1.0, np.nan], [0.0, 0.0, np.inf, 0.0], [0.0, 0.0, 0.0, 0.0])
    assert online.skipped == 3
    assert online.estimate["c10_pa"] == {"value": None, "interval": None, "known": False}


def test_what_is_no_press_is_told() -> None:
    with pytest.raises(palpate.InputError, match="indenter_radius_m"):
        palpate.OnlineEstimate({})
    with pytest.raises(palpate.InputError, match="`contact_error` is -1"):
        palpate.OnlineEstimate({"indenter_radius_m": RADIUS}, contact_error=-1.0)
    online = palpate.OnlineEstimate({"indenter_radius_m": RADIUS})
    with pytest.raises(palpate.InputError, match="`time_s` has 2 numbers, `depth_m` 1"):
        online.add([0.0, 1.0], [0.0], [0.0, 0.0])
