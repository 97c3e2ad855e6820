"""Scenes of dicts, texts and files."""

from __future__ import annotations

import pickle
from pathlib import Path

import numpy as np
import palpate
import pytest
from conftest import Command, local


def test_a_dict_is_read_as_the_file_is() -> None:
    made = palpate.Scene(
        {
            "organ": {"builtin": "liver", "triangles": np.int64(2000), "builtin_tissue": "pig-liver"},
            "model": {"kind": "local", "step_s": np.float64(0.004)},
            "tool": ({"name": "probe", "trocar_m": np.array([0.0, 0.0, 0.3])},),
        }
    )
    text = (
        'format = 1\n[organ]\nbuiltin = "liver"\ntriangles = 2000\nbuiltin_tissue = "pig-liver"\n'
        '[model]\nkind = "local"\nstep_s = 0.004\n[[tool]]\nname = "probe"\ntrocar_m = [0.0, 0.0, 0.3]\n'
    )
    assert made.to_dict() == palpate.Scene.parse(text).to_dict()
    assert (made.tools, made.step, made.task) == (["probe"], 0.004, {})
    assert palpate.Scene.parse(made.to_toml()) == made == pickle.loads(pickle.dumps(made))
    assert palpate.Scene(made.to_dict()).to_dict() == made.to_dict()


def test_paths_begin_in_the_folder(tmp_path: Path) -> None:
    palpate.Mesh.builtin("liver", 1000).write(tmp_path / "organ.ply")
    text = 'format = 1\n[organ]\nmesh = "organ.ply"\nmesh_unit = "m"\nbuiltin_tissue = "pig-liver"\n[model]\nkind = "local"\n'
    scene = palpate.Scene.parse(text, folder=tmp_path)
    assert scene.to_dict()["organ"]["mesh"] == str(tmp_path / "organ.ply")
    assert len(palpate.Simulation(scene).triangles) == 1000
    (tmp_path / "scene.toml").write_text(text)
    assert palpate.Scene.read(tmp_path / "scene.toml").to_dict() == scene.to_dict()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ({}, "`organ` is missing"),
        ({"organ": {"builtin": "liver", "bultin_tissue": "pig-liver"}}, "nearest known key is `organ.builtin_tissue`"),
        ({"organ": {"builtin": "livr", "builtin_tissue": "pig-liver"}}, "`organ.builtin` is"),
        ({"organ": {"builtin": "liver", "tissue": None}}, "`organ.tissue` is None"),
        ({"organ": {"builtin": "liver", "tissue": {"law": object()}}}, "`organ.tissue.law` is of the type object"),
        ({1: 2}, "a key is 1; give the keys as texts"),
        ({"format": 2, "organ": {}}, "format is 2"),
    ],
)
def test_what_is_no_scene_is_told(content: dict[str, object], said: str) -> None:
    with pytest.raises(palpate.InputError, match=said):
        palpate.Scene(content)


def test_builtin_scenes_are_there() -> None:
    assert palpate.Scene.builtin("palpation").task["title"] == "Palpation"
    for name in ("esophagus", "traction", "retraction", "cutting", "myotomy"):
        assert palpate.Scene.builtin(name).tools
    with pytest.raises(palpate.InputError, match="the nearest is `traction`"):
        palpate.Scene.builtin("tractions")


def test_errors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    motion = tmp_path / "motion.csv"
    motion.write_text("# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,right,0,0,0.2\n")
    organ = 'builtin = "liver", builtin_tissue = "pig-liver"'
    local = 'model = { kind = "local" }\n'
    for text in (
        "format = 1\n",
        f"format = 1\norgan = {{ {organ}, triangels = 5 }}\n",
        f"organ = {{ {organ} }}\n",
        "format = 1\norgan = \n",
        f"format = 1\n{local}organ = {{ {organ}, inclusion = [{{ ball = {{ center_m = [1, 0, 0], radius_m = 0.01 }}, stiffness_ratio = 3 }}] }}\n",
    ):
        scene = tmp_path / "scene.toml"
        scene.write_text(text)
        said = command("simulate", scene, "--headless", "--motion", motion, "--out", tmp_path / "out")
        with pytest.raises(palpate.InputError) as raised:
            palpate.Simulation(palpate.Scene.read(scene))
        assert said.returncode == 2 and str(raised.value) in said.stderr


def test_an_inclusion_outside_is_reported_at_a_reset(simulation: palpate.Simulation) -> None:
    ball = {"center_m": [1.0, 0.0, 0.0], "radius_m": 0.01}
    with pytest.raises(palpate.InputError, match=r"the middle of the organ's part \"inclusion 1\" lies"):
        simulation.reset(local({"inclusion": [{"ball": ball, "stiffness_ratio": 3.0}]}))
