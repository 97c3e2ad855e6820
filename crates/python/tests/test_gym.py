"""Environments: what gymnasium asks for, seeds, vectors, and that the tasks can be done."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import palpate
import pytest
from numpy.typing import NDArray

gymnasium = pytest.importorskip("gymnasium")

import palpate.gym as touch
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

KINDS = ["Palpation", "Traction", "Cutting"]
FORMS: dict[str, tuple[type[touch.TouchEnv], type[touch.TouchVectorEnv]]] = {
    "Palpation": (touch.PalpationEnv, touch.PalpationVectorEnv),
    "Traction": (touch.TractionEnv, touch.TractionVectorEnv),
    "Cutting": (touch.CuttingEnv, touch.CuttingVectorEnv),
}


@pytest.fixture(scope="module", params=KINDS)
def kind(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def single(kind: str) -> touch.TouchEnv:
    """Under the local model, which is prepared at once."""
    made = gymnasium.make(f"palpate/{kind}-v0", model="local").unwrapped
    assert isinstance(made, FORMS[kind][0])
    return made


def test_gymnasium_finds_nothing_wrong(single: touch.TouchEnv) -> None:
    """Infinite bounds of forces are meant: there is none that a scene could not exceed."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        check_env(single, skip_render_check=True)
    unexpected = [str(one.message) for one in told if "infinity" not in str(one.message)]
    assert [message for message in unexpected if "unwrapped" not in message] == []


def played(environment: touch.TouchEnv, seed: int, steps: int = 25) -> list[Any]:
    found: list[Any] = [environment.reset(seed=seed)[0]]
    draw = np.random.default_rng(seed)
    for _ in range(steps):
        action = draw.uniform(-1.0, 1.0, 4).astype(np.float32)
        seen, worth, terminated, truncated, _ = environment.step(action)
        found.append((seen, worth, terminated, truncated))
        if terminated or truncated:
            break
    return found


def test_a_seed_is_an_episode_to_the_bit(single: touch.TouchEnv) -> None:
    first, other, again = played(single, 7), played(single, 8), played(single, 7)
    assert repr(first) == repr(again) and not np.array_equal(first[0], other[0])
    for (one, *rest), (two, *same) in zip(first[1:], again[1:], strict=True):
        assert np.array_equal(one, two) and rest == same


@pytest.mark.parametrize("mode", list(AutoresetMode))
def test_vectors_are_singles_to_the_bit(kind: str, single: touch.TouchEnv, mode: AutoresetMode) -> None:
    """Each of three through an end and a new beginning, beside one alone that is reset by hand."""
    count, seed, steps = 3, 11, 40
    short = _hurried(single.touch.simulation.scene)
    many = FORMS[kind][1](count, short, threads=2, autoreset_mode=mode)
    draw = np.random.default_rng(seed)
    actions = draw.uniform(-1.0, 1.0, (steps, count, 4)).astype(np.float32)
    actions[..., 3] = -1.0
    seen = [many.reset(seed=seed)[0]]
    ends = []
    for action in actions:
        now, worth, terminated, truncated, told = many.step(action)
        seen.append(now)
        ends.append(terminated | truncated)
        assert worth.shape == (count,) and now.dtype == np.float32
        if mode == AutoresetMode.SAME_STEP and ends[-1].any():
            assert told["_final_obs"].tolist() == ends[-1].tolist()
        if mode == AutoresetMode.DISABLED and ends[-1].any():
            seen[-1] = many.reset(options={"reset_mask": ends[-1]})[0]
    assert np.any(ends), "an episode ends within the test"
    for number in range(count):
        alone = FORMS[kind][0](simulation=palpate.Simulation(short, show_every=1e9))
        own, _ = alone.reset(seed=seed + number)
        assert np.array_equal(own, seen[0][number])
        has_ended = False
        for step in range(steps):
            if has_ended and mode == AutoresetMode.NEXT_STEP:
                own, _ = alone.reset()
                has_ended = False
            else:
                own, _, over, late, _ = alone.step(actions[step, number])
                has_ended = over or late
                if has_ended and mode != AutoresetMode.NEXT_STEP:
                    own, _ = alone.reset()
            assert np.array_equal(own, seen[step + 1][number]), (number, step)


def _hurried(scene: palpate.Scene) -> palpate.Scene:
    """The same task with a second to do it in."""
    content = scene.to_dict()
    content["task"]["time_limit_s"] = 1.0
    return palpate.Scene(content)


def test_a_vector_is_made_by_its_name(single: touch.TouchEnv, kind: str) -> None:
    many = gymnasium.make_vec(
        f"palpate/{kind}-v0", num_envs=2, vectorization_mode="vector_entry_point", simulation=single.touch.simulation
    )
    seen, _ = many.reset(seed=3)
    assert many.observation_space.contains(seen) and many.num_envs == 2
    assert many.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP


Policy = Callable[[touch.TouchEnv, NDArray[np.float32], int], NDArray[np.float64]]


def towards(environment: touch.TouchEnv, seen: NDArray[np.float32], place: NDArray[np.float64]) -> NDArray[np.float64]:
    """The action that goes to a place as fast as it may."""
    way: NDArray[np.float64] = np.clip((place - seen[:3]) / environment.touch.reach, -1.0, 1.0)
    return way


def hidden(environment: touch.TouchEnv) -> dict[str, Any]:
    """What an agent does not see."""
    scenario = environment.touch.scenarios[0]
    assert scenario is not None
    return scenario.scene.to_dict()


def palpates(environment: touch.TouchEnv, seen: NDArray[np.float32], step: int) -> NDArray[np.float64]:
    """Goes over the place, then down, then says: here."""
    content = hidden(environment)
    target = np.array(content["task"]["find"]["target_m"])
    out = target - np.array(content["organ"]["inclusion"][0]["ball"]["center_m"])
    out /= np.linalg.norm(out)
    place = target + 0.03 * out if step < 60 else target - 0.003 * out
    here = step > 60 and seen[9] > 0 and np.linalg.norm(seen[:3] - place) < 1e-3
    return np.append(towards(environment, seen, place), 1.0 if here else -1.0)


def pulls(environment: touch.TouchEnv, seen: NDArray[np.float32], step: int) -> NDArray[np.float64]:
    """Goes in, shuts its jaws, and goes back until it feels the force."""
    start = np.array([-0.001, -0.016, 0.002])
    if step < 20:
        return np.append(towards(environment, seen, start), -1.0)
    if step < 40:
        return np.append(0.4 * towards(environment, seen, start + [0, 0.0098, 0]), -1.0)
    if step < 50:
        return np.append(np.zeros(3), 1.0)
    lacks = float(seen[10]) - float(np.linalg.norm(seen[3:6]))
    return np.array([0.0, np.clip(-lacks, -0.15, 0.15), 0.0, 1.0])


def cuts(environment: touch.TouchEnv, seen: NDArray[np.float32], step: int) -> NDArray[np.float64]:
    """Goes to a beginning of the line, a little below the surface, then along it."""
    ends = seen[10:].reshape(2, 3).astype(np.float64)
    along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    into = np.array([0.0, 0.0015, 0.0])
    if step < 15:
        return np.append(towards(environment, seen, ends[0] - 0.001 * along - 5 * into), -1.0)
    if step < 30:
        return np.append(towards(environment, seen, ends[0] - 0.001 * along + into), -1.0)
    place = ends[0] + min(0.0004 * (step - 30), 0.027) * along + into
    return np.append(towards(environment, seen, place), 1.0)


POLICIES: dict[str, tuple[Policy, int]] = {
    "Palpation": (palpates, 200),
    "Traction": (pulls, 600),
    "Cutting": (cuts, 150),
}


def done(environment: touch.TouchEnv, policy: Policy, seed: int, steps: int) -> tuple[float, bool, dict[str, Any]]:
    seen, told = environment.reset(seed=seed)
    total = 0.0
    for step in range(steps):
        seen, worth, terminated, truncated, told = environment.step(policy(environment, seen, step).astype(np.float32))
        total += worth
        if terminated or truncated:
            return total, terminated, told
    return total, False, told


def test_the_tasks_can_be_done(kind: str, single: touch.TouchEnv) -> None:
    """A script that knows what to do passes; one that does nothing gets nothing."""
    policy, steps = POLICIES[kind]
    content = single.touch.simulation.scene.to_dict()
    if kind == "Traction":
        # What is held takes longer than all else.
        content["task"]["traction"]["hold_s"] = 2.0
    if kind == "Cutting":
        # The script makes one stroke, which is one muscle.
        content["task"]["cut"]["layers"] = 1
    environment = FORMS[kind][0](palpate.Scene(content))
    for seed in range(1 if kind == "Traction" else 3):
        total, terminated, told = done(environment, policy, seed, steps)
        assert terminated and told["passed"] and total > 0.5, (seed, total, told)
        total, terminated, told = done(environment, lambda *_: np.array([0.0, 0.0, 0.0, -1.0]), seed, 20)
        assert not terminated and told == {} and total == 0.0


def test_a_wrong_place_is_worth_less() -> None:
    palpation = touch.PalpationEnv(model="local")

    def beside(environment: touch.TouchEnv, seen: NDArray[np.float32], step: int) -> NDArray[np.float64]:
        rest = environment.touch.task
        target = np.array(hidden(environment)["task"]["find"]["target_m"])
        far = rest.places[np.linalg.norm(rest.vertices[rest.places] - target, axis=1).argmax()]  # type: ignore[attr-defined]
        place = rest.vertices[far] + (0.03 if step < 60 else -0.002) * rest.normals[far]
        return np.append(towards(environment, seen, place), 1.0)

    total, terminated, told = done(palpation, beside, 1, 200)
    assert terminated and not told["passed"] and -1.6 < total < 0.0
    assert told["score"]["measures"]["beside_m"] > 0.02


def test_what_is_no_action_or_task_is_told(kind: str, single: touch.TouchEnv) -> None:
    single.reset(seed=0)
    for wrong in (np.zeros(3), np.full(4, np.nan)):
        with pytest.raises(palpate.InputError, match="4"):
            single.step(wrong.astype(np.float32))
    with pytest.raises(palpate.InputError, match="the scene has no `task"):
        FORMS[kind][0](palpate.Scene({"organ": {"builtin": "liver", "builtin_tissue": "pig-liver"}}), model="local")
    with pytest.raises(palpate.InputError, match="substeps"):
        FORMS[kind][0](simulation=single.touch.simulation, substeps=0)


def test_a_circle_is_no_straight_line() -> None:
    with pytest.raises(palpate.InputError, match="is a circle"):
        touch.CuttingEnv(palpate.Scene.builtin("cutting"), model="local")


def over(environment: touch.TouchEnv, place: NDArray[np.float64]) -> NDArray[np.float32]:
    """The press of 4 mm nearest to a place."""
    press = environment.touch.press
    assert press is not None
    nearest = np.linalg.norm(press.points - place, axis=1).argmin()
    return np.append(press.seen[nearest], [0.0, -1.0]).astype(np.float32)


def test_a_press_feels_the_lump_and_marks_it() -> None:
    """The force over the lump is that of the healthy place times the stiffening that the model states, at least a sixth;
    a mark there is right, and one elsewhere is not. Alone and in a vector it is the same to the bit."""
    alone = touch.PalpationEnv(model="local", action="press")
    many = touch.PalpationVectorEnv(2, simulation=alone.touch.simulation, action="press", threads=2)
    assert alone.touch.substeps == 100
    first, _ = alone.reset(seed=3)
    assert np.array_equal(many.reset(seed=3)[0][0], first)
    target = np.array(hidden(alone)["task"]["find"]["target_m"])
    press = alone.touch.press
    assert press is not None
    far = press.points[np.linalg.norm(press.points - target, axis=1).argmax()]
    forces = []
    for place in (far, target):
        action = over(alone, place)
        seen, worth, terminated, _, _ = alone.step(action)
        both = many.step(np.stack([action, action]))
        assert np.array_equal(both[0][0], seen) and both[1][0] == worth == 0.0 and not terminated
        # Flat faces: the tip is where it was asked for, 4 mm below the nearest vertex.
        nearest = np.linalg.norm(press.points - place, axis=1).argmin()
        wanted = press.points[nearest] - 0.004 * press.normals[nearest]
        assert np.allclose(seen[:3], wanted, atol=1e-7) and seen[9] == 1.0
        forces.append(np.linalg.norm(seen[3:6]))
    assert forces[1] > 7 / 6 * forces[0]
    seen, worth, terminated, _, told = alone.step(np.array([0.0, 0.0, 0.0, 1.0], dtype=np.float32))
    assert terminated and told["passed"] and worth == 1.0
    assert np.allclose(seen[:3], alone.touch.tips[0]), "who says here stays"
    alone.reset(seed=3)
    alone.step(over(alone, far))
    _, worth, terminated, _, told = alone.step(np.array([0.0, 0.0, 0.0, 1.0], dtype=np.float32))
    assert terminated and not told["passed"] and worth < -0.02


def test_time_without_a_mark_costs_as_much_as_the_worst() -> None:
    short = palpate.Scene.builtin("palpation").to_dict()
    short["task"]["time_limit_s"] = 1.0
    environment = touch.PalpationEnv(palpate.Scene(short), model="local", action="press")
    environment.reset(seed=0)
    press = np.array([0.0, 0.0, 0.0, -1.0], dtype=np.float32)
    worths = []
    for _ in range(4):
        _, worth, _, truncated, _ = environment.step(press)
        worths.append(worth)
        if truncated:
            break
    assert truncated and worths[-1] == -1.0 and not any(worths[:-1])


def test_presses_are_for_palpation() -> None:
    with pytest.raises(palpate.InputError, match="for the task `find` only"):
        touch.TractionEnv(model="local", action="press")
