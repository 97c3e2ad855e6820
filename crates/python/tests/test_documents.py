"""JSON Schemas of the documents; judge: another implementation of JSON Schema."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest
import typed_dicts
from palpate import Scene, documents

if TYPE_CHECKING:
    from conftest import Command

if sys.version_info >= (3, 11):
    import tomllib
else:
    tomllib = pytest.importorskip("tomli")

ASSETS = Path(__file__).resolve().parents[3] / "assets"
KINDS = typed_dicts.KINDS
ORGAN = '[organ]\nbuiltin = "liver"\nbuiltin_tissue = "pig-liver"\n'


def schema_of(command: Command, kind: str = "scene") -> Any:
    return json.loads(command("scene", "--schema", kind).stdout)


def validator(schema: Any) -> Any:
    return jsonschema.Draft202012Validator(schema)


@pytest.mark.parametrize("kind", KINDS)
def test_a_schema_takes_its_template(command: Command, kind: str) -> None:
    schema = schema_of(command, kind)
    jsonschema.Draft202012Validator.check_schema(schema)
    template = tomllib.loads(command("scene", "--template", kind).stdout)
    assert list(validator(schema).iter_errors(template)) == []


@pytest.mark.parametrize("file", ["first/scene.toml", "esophagus/trainer.toml", "tasks/palpation.toml"])
def test_a_schema_takes_the_scenes_that_come_along(command: Command, file: str) -> None:
    scene = tomllib.loads((ASSETS / file).read_text(encoding="utf-8"))
    assert list(validator(schema_of(command)).iter_errors(scene)) == []


@pytest.mark.parametrize(
    ("more", "is_right"),
    [
        ("", True),
        ('[[tool]]\ntip = { shape = "flat", radius_mm = 1 }\n', True),
        ('[[tool]]\ntip = { shape = "flat", radius_mm = 1e9 }\n', False),
        ('[[tool]]\ntip = { shape = "flat", radius_kg = 1 }\n', False),
        ('[[tool]]\ntip = { shape = "flat" }\n', False),
        ('[model]\nkind = "nonlinear"\n', True),
        ('[model]\nkind = "nonlinaer"\n', False),
        ('[model]\nstep_s = { draw = "step" }\n[draw]\nstep = { one_of = [0.005] }\n', True),
        ("[model]\nstep_s = -1.0\n", False),
        ("[model]\nparticles = 3\n", False),
        ('[modle]\nkind = "local"\n', False),
    ],
)
def test_a_schema_and_the_reader_agree_on_a_single_key(
    command: Command, tmp_path: Path, more: str, *, is_right: bool
) -> None:
    text = f"format = 1\n{ORGAN}{more}"
    assert validator(schema_of(command)).is_valid(tomllib.loads(text)) is is_right
    scene = tmp_path / "scene.toml"
    scene.write_text(text, encoding="utf-8")
    assert (command("validate", scene).returncode == 0) is is_right


def test_typed_dictionaries_are_those_of_the_schemas(command: Command) -> None:
    """Anew after a key was added: ``python tests/typed_dicts.py PALPATE > python/palpate/documents.py``."""
    written = Path(documents.__file__).read_text(encoding="utf-8")
    assert typed_dicts.module([schema_of(command, kind) for kind in KINDS]) == written


def test_a_typed_scene_is_a_scene() -> None:
    """Judge of the errors: mypy, which refuses an ignored one that is none."""
    organ: documents.SceneOrgan = {"builtin": "liver", "builtin_tissue": "pig-liver"}
    scene: documents.Scene = {"organ": organ, "model": {"kind": "nonlinear"}}
    assert Scene(scene).to_dict()["model"]["kind"] == "nonlinear"
    scene["model"] = {"kind": "nonlinaer"}  # type: ignore[typeddict-item]
    scene["model"] = {"particels": 3}  # type: ignore[typeddict-unknown-key]
    with pytest.raises(ValueError, match="particels"):
        Scene(scene)
