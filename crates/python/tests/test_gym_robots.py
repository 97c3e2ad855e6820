"""What robot learners expect of the environments: images, forces by name, remote centres, draws, states."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import palpate
import pytest

gymnasium = pytest.importorskip("gymnasium")

import palpate.gym as touch
from gymnasium.utils.env_checker import check_env

TABLE: dict[str, Any] = {
    "tissue.stiffness": {"one_of": [0.5, 2.0]},
    "light.brightness": (0.5, 1.5),
    "camera.azimuth": {"normal": (0.0, 0.2)},
    "camera.distance": {"log_uniform": (0.8, 1.25)},
}
FORMS: list[dict[str, Any]] = [
    {},
    {"observation": "dict", "randomization": TABLE},
    {"action": "remote_center", "observation": "dict"},
]


@pytest.fixture(scope="module", params=["Palpation", "Traction", "Cutting"])
def kind(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def simulation(kind: str) -> palpate.Simulation:
    """Under the local model, which is prepared at once."""
    return made(kind, model="local").touch.simulation


@pytest.fixture(scope="session")
def adapter() -> str:
    """The name of the graphics adapter; without one, what draws is not tested."""
    scene = palpate.Scene({"organ": {"builtin": "liver", "triangles": 500, "builtin_tissue": "pig-liver"}})
    try:
        return palpate.Renderer(palpate.Simulation(_local(scene)), (8, 8)).adapter
    except palpate.PalpateError as error:
        if "there is no graphics adapter" not in str(error):
            raise
        pytest.skip("there is no graphics adapter")


def _local(scene: palpate.Scene) -> palpate.Scene:
    return palpate.Scene({**scene.to_dict(), "model": {"kind": "local"}})


def made(kind: str, **options: Any) -> touch.TouchEnv:
    found = gymnasium.make(f"palpate/{kind}-v0", **options).unwrapped
    assert isinstance(found, touch.TouchEnv)
    return found


def same(one: Any, other: Any) -> bool:
    """Whether two observations are the same bits."""
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[name], other[name]) for name in one)
    return bool(np.array_equal(one, other)) and one.dtype == other.dtype


def actions(environment: touch.TouchEnv, steps: int, seed: int = 0) -> list[Any]:
    draw = np.random.default_rng(seed)
    size = environment.touch.action_size
    wishes = draw.uniform(-1.0, 1.0, (steps, size)).astype(np.float32)
    # No place is marked, or the episode ends.
    wishes[:, -1] = -1.0
    return list(wishes)


@pytest.mark.parametrize("images", [(), ("rgb", "depth", "segmentation")])
def test_gymnasium_finds_nothing_wrong_with_pictures(
    kind: str, simulation: palpate.Simulation, adapter: str, images: tuple[str, ...]
) -> None:
    """Of every form, with its picture; infinite bounds of forces are meant."""
    for form in FORMS:
        environment = made(
            kind, simulation=simulation, render_mode="rgb_array", images=images, image_size=(32, 24), **form
        )
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            check_env(environment)
        assert [str(one.message) for one in told if "infinity" not in str(one.message)] == []
        picture = environment.render()
        assert picture is not None and picture.shape == (480, 640, 3) and picture.std() > 10.0


@pytest.mark.parametrize("form", FORMS)
def test_vectors_states_and_pictures_change_no_bit(
    kind: str, simulation: palpate.Simulation, form: dict[str, Any]
) -> None:
    """The same seed alone, in a batch, and after a state was kept and taken back."""
    alone = made(kind, simulation=simulation, **form)
    vector = {"Palpation": touch.PalpationVectorEnv, "Traction": touch.TractionVectorEnv}.get(
        kind, touch.CuttingVectorEnv
    )
    many = vector(3, simulation=simulation, threads=2, **form)
    seen, told = alone.reset(seed=5)
    together, told_together = many.reset(seed=4)
    own = {name: part[1] for name, part in together.items()} if isinstance(together, dict) else together[1]
    assert same(seen, own)
    if "randomization" in form:
        assert told["drawn"] == {name: value[1] for name, value in told_together["drawn"].items() if name[0] != "_"}
    wishes = actions(alone, 12)
    first = [alone.step(wish)[0] for wish in wishes[:4]]
    kept = alone.state()
    later = [alone.step(wish) for wish in wishes[4:]]
    alone.reset(seed=99)
    assert same(alone.reset(options={"state": kept})[0], first[-1])
    for wish, (seen, worth, *ends, _) in zip(wishes[4:], later, strict=True):
        again = alone.step(wish)
        assert same(again[0], seen) and again[1] == worth and list(again[2:4]) == ends
    for step, wish in enumerate(wishes):
        seen = many.step(np.tile(wish, (3, 1)))[0]
        own = {name: part[1] for name, part in seen.items()} if isinstance(seen, dict) else seen[1]
        assert same(own, first[step] if step < 4 else later[step - 4][0])
    # And from the state of the single one in the batch.
    many.reset(seed=1, options={"state": [None, None, kept]})
    seen = many.step(np.tile(wishes[4], (3, 1)))[0]
    own = {name: part[2] for name, part in seen.items()} if isinstance(seen, dict) else seen[2]
    assert same(own, later[0][0])
    # What the seed draws next follows from the state too.
    alone.reset(options={"state": kept})
    next_one = alone.reset()[0]
    alone.reset(seed=3)
    alone.reset(options={"state": kept})
    assert same(alone.reset()[0], next_one)


def test_vector_environments_of_gymnasium_take_them(kind: str) -> None:
    """Each in a process of its own, and one after the other: the same episodes."""
    options = {"model": "local", "observation": "dict"}
    several = [
        gymnasium.make_vec(f"palpate/{kind}-v0", num_envs=2, vectorization_mode=mode, **options)
        for mode in ("sync", "async")
    ]
    found = [environments.reset(seed=2)[0] for environments in several]
    assert same(*found)
    wishes = np.full((2, 4), 0.5, dtype=np.float32)
    assert same(*(environments.step(wishes)[0] for environments in several))
    for environments in several:
        environments.close()


def test_forces_are_turned_into_the_frame_of_the_camera() -> None:
    """Judges: a rotation keeps lengths; a torque is the lever's cross product; stiffer tissue answers so much harder."""
    forces = {}
    for factor in (1.0, 2.0):
        environment = made(
            "Palpation",
            model="local",
            observation="dict",
            action="remote_center",
            randomization={"tissue.stiffness": (factor, factor)},
        )
        # The first episode whose tool stands where the shaft leads to the organ.
        for seed in range(10):
            seen, _ = environment.reset(seed=seed)
            for _ in range(20):
                seen = environment.step(np.array([0.0, 0.0, 1.0, 0.0, -1.0], dtype=np.float32))[0]
                if seen["state"][6] > 0.002:
                    break
            if seen["state"][6] > 0.002:
                break
        assert np.linalg.norm(seen["force"]) > 0.01
        rotation = np.array(environment.touch.cameras[0].rotation)
        # Float32 has seven digits.
        assert np.allclose(rotation @ rotation.T, np.eye(3), atol=1e-12) and np.linalg.det(rotation) > 0.0
        for name in ("force", "torque"):
            assert np.allclose(rotation @ seen[name], seen[f"{name}_camera"], rtol=1e-5, atol=1e-7)
        arm = environment.touch.arm
        assert arm is not None
        shaft = arm.center - environment.touch.tips[0]
        lever = -0.05 * shaft / np.linalg.norm(shaft)
        assert np.allclose(np.cross(lever, seen["force"]), seen["torque"], rtol=1e-5, atol=1e-7)
        forces[factor] = seen["force"]
    # The law is linear in its modulus.
    assert np.allclose(forces[2.0], 2.0 * forces[1.0], rtol=1e-5)


def test_a_shaft_passes_through_its_remote_center() -> None:
    environment = made("Traction", model="local", action="remote_center")
    environment.reset(seed=1)
    arm, tool = environment.touch.arm, environment.touch.task.tool
    assert arm is not None
    trocar = environment.touch.task.content["tool"][tool]["trocar_m"]
    for wish in actions(environment, 20):
        environment.step(wish)
        tip = environment.touch.tips[0]
        x, y, z, w = environment.touch.batch.orientations[0, tool]
        along = np.array([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        way = np.array(trocar) - tip
        assert np.allclose(along, way / np.linalg.norm(way), atol=1e-9)
        # Joints and tips are two ways to say the same.
        assert np.allclose(arm.joints(tip)[:3], environment.touch.joints[0, :3], atol=1e-9)


def test_depth_and_labels_are_those_of_the_scene(adapter: str) -> None:
    """Judge: the organ's own vertices, projected by the camera's intrinsics."""
    environment = made("Traction", model="local", images=("depth", "segmentation"), image_size=(160, 120))
    seen, _ = environment.reset(seed=1)
    camera = environment.touch.camera
    assert set(np.unique(seen["segmentation"])) >= {0, 1, 2, 3}
    assert ((seen["depth"] > 0.0) == (seen["segmentation"] > 0)).all()
    places = (environment.touch.task.vertices - camera.eye) @ camera.rotation.T
    pixels = places @ camera.intrinsics(160, 120).T
    columns, rows = (pixels[:, :2] / pixels[:, 2:]).astype(int).T
    inside = (columns >= 0) & (columns < 160) & (rows >= 0) & (rows < 120)
    depths, labels = seen["depth"][..., 0], seen["segmentation"][..., 0]
    shown = depths[rows[inside], columns[inside]]
    # What is seen there is the vertex or before it, up to the slope of the surface within a pixel of 1 mm.
    assert np.mean(shown < places[inside, 2] + 0.003) > 0.98
    near = np.abs(shown - places[inside, 2]) < 0.001
    assert near.sum() > 100 and np.mean(labels[rows[inside], columns[inside]][near] == 1) > 0.9


def test_a_picture_leaves_the_simulation_as_it_is(kind: str, simulation: palpate.Simulation, adapter: str) -> None:
    plain = made(kind, simulation=simulation)
    drawn = made(kind, simulation=simulation, render_mode="rgb_array")
    assert same(plain.reset(seed=2)[0], drawn.reset(seed=2)[0])
    for wish in actions(plain, 15):
        assert same(plain.step(wish)[0], drawn.step(wish)[0])
        drawn.render()


def test_what_is_no_option_is_told_in_a_sentence(simulation: palpate.Simulation, kind: str) -> None:
    for options, words in [
        ({"observation": "tuple"}, "`observation` has no 'tuple'"),
        ({"action": "polar"}, "`action` has no 'polar'"),
        ({"images": ("infrared",)}, "`images` has no 'infrared'"),
        ({"images": ("rgb",), "image_size": (0, 64)}, "0 x 64 pixels"),
        ({"render_mode": "ansi"}, "`render_mode` has no 'ansi'"),
        ({"randomization": {"tissue.colour": (0, 1)}}, "called `tissue.colour`"),
        ({"randomization": {"tissue.stiffness": (2.0, 0.5)}}, "from 2 down to 0.5"),
        ({"randomization": {"light.brightness": (-1.0, 0.5)}}, "stay between 0"),
        ({"randomization": {"light.brightness": ("a", "b")}}, "give numbers"),
        ({"randomization": {"light.brightness": {"gamma": (1, 2)}}}, "no known distribution"),
    ]:
        with pytest.raises(palpate.InputError, match=words):
            made(kind, simulation=simulation, disable_env_checker=True, **options)  # type: ignore[arg-type]
    environment = made(kind, simulation=simulation)
    with pytest.raises(palpate.InputError, match="no episode has begun"):
        environment.state()
    with pytest.raises(palpate.InputError, match="no state of an episode"):
        environment.reset(options={"state": 3})


def test_without_an_adapter_there_is_a_sentence(
    monkeypatch: pytest.MonkeyPatch, simulation: palpate.Simulation
) -> None:
    """An interface that no machine of Linux has takes all adapters away."""
    monkeypatch.setenv("WGPU_BACKEND", "dx12")
    with pytest.raises(palpate.PalpateError, match="no graphics adapter.*mesa-vulkan-drivers"):
        palpate.Renderer(simulation)
