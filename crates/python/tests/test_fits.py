"""What was found, as objects: the numbers of the answer, and what follows from them."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import palpate
import pytest

matplotlib.use("Agg")

SERIES = [{"g": 0.3, "tau_s": 0.5}, {"g": 0.2, "tau_s": 4.0}]
#: No finite elements in the specimen: its force is that of the simulator's linear law.
PROTOCOL: dict[str, Any] = {
    "specimen": [
        {
            "organ": "soft",
            "tissue": {"law": "linear", "youngs_modulus_pa": 3000.0, "poissons_ratio": 0.49, "prony": SERIES},
        }
    ],
    "stimulus": [{"kind": "ramp_and_hold", "depths_m": [0.001, 0.002], "ramp_s": 0.3, "hold_s": 10.0}],
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("recordings")
    palpate.measure(PROTOCOL, out=folder, progress=False)
    return folder


@pytest.fixture(scope="module")
def found(folder: Path) -> palpate.Characterization:
    return palpate.characterize(folder, draws=0, progress=False)


@pytest.fixture(scope="module")
def piece(tmp_path_factory: pytest.TempPathFactory) -> palpate.Law:
    """A bar of Mooney-Rivlin tissue, with noise of 0.2 % of the largest stress."""
    path = tmp_path_factory.mktemp("piece") / "bar.csv"
    stretch = np.linspace(1.0, 1.5, 400)
    stress = 2.0 * (stretch - stretch**-2) * (300.0 + 200.0 / stretch)
    area, height = 1e-4, 0.02
    noise = 2e-3 * stress.max() * np.random.default_rng(1).normal(size=400)
    rows = np.column_stack([np.linspace(0.0, 10.0, 400), -height * (stretch - 1.0), -area * (stress + noise)])
    header = (
        f"# format = 1\n# stimulus = 'uniaxial'\n# area_m2 = {area}\n# height_m = {height}\ntime_s,depth_m,force_n\n"
    )
    path.write_text(header + "\n".join(",".join(f"{value:.9g}" for value in row) for row in rows) + "\n")
    return palpate.characterize(path, law="mooney_rivlin", draws=0, progress=False).specimens[0].laws["mooney_rivlin"]


def test_errors_are_the_roots_of_the_covariance(found: palpate.Characterization) -> None:
    for law in found.specimens[0].laws.values():
        errors = dict(zip(law.variable_names, np.sqrt(law.covariance.diagonal()), strict=True))
        for name, parameter in law.parameters.items():
            assert law[name] is parameter
            if parameter.standard_error is None:
                continue
            assert errors[name] == pytest.approx(parameter.standard_error, rel=1e-9)
            assert parameter.interval is not None
            low, high = parameter.interval
            assert low < float(parameter) < high
            assert set(parameter.correlation) == set(law.variable_names) - {name}
            assert parameter.bound[0] is not None


def test_the_misfit_is_that_of_the_residual(found: palpate.Characterization) -> None:
    for law in found.specimens[0].laws.values():
        assert np.sum(law.residual**2) == pytest.approx(law["sum_squared_error"], rel=1e-9)
        assert np.sqrt(np.mean(law.residual**2)) / law.measured.max() == pytest.approx(law["misfit"], rel=1e-9)


def test_a_law_at_the_recorded_depths_is_the_best_fit(found: palpate.Characterization) -> None:
    for law in found.specimens[0].laws.values():
        for recording in law.recordings:
            force = law.evaluate(recording.time, recording.course)
            # Relaxation is given with the digits of its terms.
            np.testing.assert_allclose(force, recording.best_fit, rtol=0, atol=1e-9 * force.max())


def test_a_law_is_its_elastic_force_relaxed(found: palpate.Characterization) -> None:
    """Judge: after a step, the elastic force times G(t)."""
    specimen = found.specimens[0]
    law, relaxation = specimen.law, specimen.relaxation
    assert relaxation is not None
    time = np.concatenate([[0.0, 1e-6], np.geomspace(1e-3, 20.0, 60)])
    depth = np.where(time > 0.0, 0.0015, 0.0)
    elastic = law.evaluate(depth=[0.0015])[0]
    np.testing.assert_allclose(law.evaluate(time, depth)[2:], elastic * relaxation.evaluate(time[2:]), rtol=1e-4)


def test_standard_errors_are_those_of_drawn_parameters(piece: palpate.Law) -> None:
    """Judge: stresses in closed form of parameters drawn from the covariance."""
    stretch = np.linspace(1.05, 1.6, 12)
    values = [piece.parameters[name].value for name in piece.variable_names]
    drawn = np.random.default_rng(2).multivariate_normal(values, piece.covariance, size=4000)
    first, second = drawn.T[:, :, None]
    stresses = 2.0 * (stretch - stretch**-2) * (first + second / stretch)
    # A standard deviation of 4000 draws is known to 1.1 %, the largest of twelve to three times that.
    np.testing.assert_allclose(piece.evaluate_error(stretch=stretch), stresses.std(axis=0), rtol=0.035)
    np.testing.assert_allclose(piece.evaluate(stretch=stretch), stresses.mean(axis=0), rtol=0.01)


def test_errors_of_forces_are_those_of_moved_parameters(found: palpate.Characterization) -> None:
    """Judge: the force of a law is linear in its modulus, so that its error is the modulus's."""
    law = found.specimens[0].laws["neo_hookean"]
    modulus = law.parameters["c10_pa"]
    assert modulus.standard_error is not None
    share = law.evaluate_error(depth=[0.001]) / law.evaluate(depth=[0.001])
    assert share[0] == pytest.approx(modulus.standard_error / modulus.value, rel=1e-9)


def test_what_was_found_is_pickled_and_read_again(found: palpate.Characterization) -> None:
    again = pickle.loads(pickle.dumps(found))
    assert again == found and isinstance(again, palpate.Characterization)
    assert again.tissue() == found.tissue()
    law, other = found.specimens[0].law, again.specimens[0].law
    np.testing.assert_array_equal(law.residual, other.residual)
    np.testing.assert_array_equal(law.evaluate([0.0, 1.0], [0.0, 0.001]), other.evaluate([0.0, 1.0], [0.0, 0.001]))
    assert again.report() == found.report()
    alone = pickle.loads(pickle.dumps(law))
    assert alone == law and alone.parameters["c10_pa" if "c10_pa" in law else "gamma_pa"].bound[0] == 0.0


def test_json_has_the_same_numbers(found: palpate.Characterization) -> None:
    again = palpate.Characterization.parse(json.dumps(found))
    assert again == found
    law, other = found.specimens[0].law, again.specimens[0].law
    np.testing.assert_array_equal(law.covariance, other.covariance)
    np.testing.assert_array_equal(law.evaluate(depth=[0.001]), other.evaluate(depth=[0.001]))
    assert law.report() == other.report()
    with pytest.raises(palpate.PalpateError, match="no samples"):
        _ = other.residual
    with pytest.raises(palpate.InputError, match="no answer"):
        palpate.Characterization.parse("{}")


def test_a_study_keeps_fewer_samples(found: palpate.Characterization, folder: Path, tmp_path: Path) -> None:
    kept = palpate.characterize(folder, draws=0, study=tmp_path / "study", progress=False)
    again = palpate.characterize(folder, draws=0, study=tmp_path / "study", progress=False)
    law, whole = kept.specimens[0].law, found.specimens[0].law
    np.testing.assert_array_equal(law.residual, again.specimens[0].law.residual)
    assert 100 < len(law.residual) < len(whole.residual)
    assert set(law.residual) <= set(whole.residual)


def test_tables_have_the_numbers(found: palpate.Characterization) -> None:
    pytest.importorskip("pandas")
    specimen = found.specimens[0]
    law = specimen.law
    table = specimen.to_frame()
    name = next(iter(law.parameters))
    assert table.loc[(law.name, name), "value"] == law.parameters[name].value
    samples = law.samples_frame()
    np.testing.assert_array_equal(samples["residual"], law.residual)
    assert not [column for column in found.to_frame().columns if column.startswith("fits")]


def test_a_report_says_every_parameter(found: palpate.Characterization, piece: palpate.Law) -> None:
    law = found.specimens[0].law
    for name in law.variable_names:
        assert name in law.report()
    assert "sought from 0 to inf" in law.report()
    assert "of the largest stress" in piece.report()
    assert found.specimens[0].warnings[0] in found.report()


def test_a_plot_shows_the_recordings_and_the_fit(found: palpate.Characterization, piece: palpate.Law) -> None:
    law = found.specimens[0].law
    for against in ("time", "course"):
        above, below = law.plot(against).axes
        lines = above.get_lines()
        assert len(lines) == 2 * len(law.recordings) and len(below.get_lines()) == len(law.recordings) + 1
        np.testing.assert_array_equal(lines[1].get_ydata(), 1e3 * law.recordings[0].best_fit)
    assert "stretch" in piece.plot().axes[1].get_xlabel()
    matplotlib.pyplot.close("all")


def test_what_cannot_be_evaluated_is_refused(found: palpate.Characterization, piece: palpate.Law) -> None:
    law = found.specimens[0].law
    with pytest.raises(palpate.InputError, match="3 times and 2 depths"):
        law.evaluate([0.0, 1.0, 2.0], [0.001, 0.001])
    with pytest.raises(palpate.InputError, match="ascend"):
        law.evaluate([0.0, 0.0], [0.001, 0.001])
    with pytest.raises(palpate.InputError, match="give `depth`"):
        law.evaluate(stretch=[1.1])
    with pytest.raises(palpate.InputError, match="give `stretch`"):
        piece.evaluate(depth=[0.001])
    with pytest.raises(palpate.InputError):
        piece.evaluate(stretch=[-1.0])


def strips(folder: Path) -> list[Path]:
    """Strips of one family of fibres, along and across them, whose stresses have a closed form without dispersion."""
    stretch = np.linspace(1.0, 1.3, 100)
    strain = stretch**2 - 1.0
    matrix = 2.0 * 1500.0 * (stretch - stretch**-2)
    fibres = 4.0 * 8000.0 * stretch * strain * np.exp(2.0 * strain**2)
    paths = []
    # Across the load fibres are slack.
    for angle, stress in ((0, matrix + fibres), (90, matrix)):
        path = folder / f"strip-{angle}.csv"
        header = "# organ = 'muscle'\n# stimulus = 'uniaxial_tension'\n# fibre_angle_deg = 0\n# dispersion = 0\n"
        rows = "\n".join(f"{x:.9g},{s:.9g}" for x, s in zip(stretch, stress, strict=True))
        path.write_text(f"{header}# fibre_axis_angle_deg = {angle}\nstretch,stress (Pa)\n{rows}\n")
        paths.append(path)
    return paths


def test_strips_along_and_across_their_fibres_are_fitted_together(tmp_path: Path) -> None:
    found = palpate.characterize(strips(tmp_path), draws=0, progress=False)
    assert len(found.specimens) == 1
    law = found.specimens[0].laws["holzapfel_gasser_ogden"]
    for name, truth in (("c10_pa", 1500.0), ("k1_pa", 8000.0), ("k2", 2.0)):
        assert law[name].value == pytest.approx(truth, rel=1e-4)
    assert law["dispersion"].verdict == "stated"
    assert [own.fibre_axis_angle_deg for own in law.recordings] == [0.0, 90.0]
    assert {own.test for own in law.recordings} == {"uniaxial"}
    along, across = (law.evaluate(stretch=[1.2], fibre_axis_angle_deg=angle)[0] for angle in (0.0, 90.0))
    assert across == pytest.approx(3000.0 * (1.2 - 1.2**-2), rel=1e-4)
    assert along > 3.0 * across
    # F = 1 + γ e₁ ⊗ e₂ leaves fibres along e₁ as long as they are.
    sheared = law.evaluate(stretch=[0.3], test="simple_shear", fibre_axis_angle_deg=0.0)[0]
    assert sheared == pytest.approx(3000.0 * 0.3, rel=1e-4)
    with pytest.raises(palpate.InputError, match="torsion"):
        law.evaluate(stretch=[1.2], test="torsion")
