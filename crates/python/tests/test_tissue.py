"""Tissues in and out."""

from __future__ import annotations

import pickle
from pathlib import Path

import palpate
import pytest
from conftest import Command


def test_a_tissue_of_words_is_that_of_a_file() -> None:
    made = palpate.Tissue(
        law="mooney_rivlin",
        name="mine",
        c10_pa=700.0,
        c01_pa={"value": 300, "standard_error": 20},
        prony=[(0.3, 1.5), {"g": 0.1, "tau_s": 9.0}],
    )
    assert (made.law, made.name, made.density) == ("mooney_rivlin", "mine", 1060.0)
    assert made.parameters == {"c10_pa": 700.0, "c01_pa": 300.0}
    assert made.standard_errors == {"c01_pa": 20.0}
    assert made.prony == [(0.3, 1.5), (0.1, 9.0)]
    assert palpate.Tissue.parse(made.to_toml()) == made == pickle.loads(pickle.dumps(made))


def test_builtin_tissues_bring_their_warnings(tmp_path: Path) -> None:
    liver = palpate.Tissue.builtin("pig-liver")
    assert liver.law == "neo_hookean" and liver.warnings
    liver.write(tmp_path / "liver.toml")
    assert palpate.Tissue.read(tmp_path / "liver.toml") == liver
    assert "*HYPERELASTIC" in liver.to_abaqus().upper() and "<material" in liver.to_febio()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"law": "neo_hookean"}, "`tissue.c10_pa` is missing"),
        ({"law": "neo_hookean", "c10_pa": -1.0}, "`tissue.c10_pa` is -1"),
        ({"law": "neo_hokean", "c10_pa": 1.0}, "`tissue.law` is"),
        ({"law": "neo_hookean", "c1_pa": 1.0}, "the nearest known key is `tissue.c10_pa`"),
        ({"law": "neo_hookean", "c10_pa": None}, "`c10_pa` is None"),
        ({"law": "neo_hookean", "c10_pa": 1.0, "prony": [(0.7, 1.0), (0.4, 1.0)]}, "add up to 1.1"),
        ({"law": "neo_hookean", "c10_pa": float("nan")}, "`tissue.c10_pa` is"),
    ],
)
def test_what_is_no_tissue_is_told(words: dict[str, object], said: str) -> None:
    with pytest.raises(palpate.InputError, match=said):
        palpate.Tissue(**words)  # type: ignore[arg-type]


def test_a_package_without_the_law_is_told() -> None:
    exponential = palpate.Tissue(law="exponential", gamma_pa=100.0, alpha=3.0)
    with pytest.raises(palpate.InputError, match="has no law like `exponential`"):
        exponential.to_abaqus()
    # The name of the first version is read, and not written.
    assert palpate.Tissue(law="blatz", gamma_pa=100.0, alpha=3.0).law == "exponential"


def test_errors_are_those_of_the_command(command: Command, tmp_path: Path) -> None:
    tissue = tmp_path / "tissue.toml"
    tissue.write_text('format = 1\n[tissue]\nlaw = "neo_hookean"\nc10_pa = "soft"\n')
    scene = tmp_path / "scene.toml"
    scene.write_text('format = 1\norgan = { builtin = "liver", tissue = "tissue.toml" }\n')
    motion = tmp_path / "motion.csv"
    motion.write_text("# format = 1\ntime_s,tool,x_m,y_m,z_m\n0,right,0,0,0.2\n")
    said = command("simulate", scene, "--headless", "--motion", motion, "--out", tmp_path / "out")
    with pytest.raises(palpate.InputError) as raised:
        palpate.Tissue.read(tissue)
    assert said.returncode == 2 and str(raised.value) in said.stderr
    with pytest.raises(palpate.InputError) as raised:
        palpate.Simulation(palpate.Scene.read(scene))
    assert str(raised.value) in said.stderr


def test_laws_of_several_terms_keep_their_order(tmp_path: Path) -> None:
    ogden = palpate.Tissue(law="ogden", mu_1_pa=500.0, alpha_1=2.5, mu_2_pa=-60.0, alpha_2=-4.0)
    assert list(ogden.parameters) == ["mu_1_pa", "alpha_1", "mu_2_pa", "alpha_2"]
    ogden.write(tmp_path / "ogden.toml")
    assert palpate.Tissue.read(tmp_path / "ogden.toml") == ogden
    assert "OGDEN, N=2" in ogden.to_abaqus() and 'type="Ogden"' in ogden.to_febio()
    yeoh = palpate.Tissue(law="reduced_polynomial", c10_pa=500.0, c20_pa=-20.0, c30_pa=3.0)
    assert "REDUCED POLYNOMIAL, N=3" in yeoh.to_abaqus() and 'type="Yeoh"' in yeoh.to_febio()
    artery = palpate.Tissue(
        law="holzapfel_gasser_ogden", c10_pa=3820.0, k1_pa=996600.0, k2=524.6, dispersion=0.226, fibre_angle_deg=49.98
    )
    assert "HOLZAPFEL, LOCAL DIRECTIONS=2" in artery.to_abaqus() and "<gamma>49.98</gamma>" in artery.to_febio()
    with pytest.raises(palpate.InputError, match="`tissue.alpha_1` is missing"):
        palpate.Tissue(law="ogden", mu_1_pa=500.0)
