"""Jobs answer as the command does, digit for digit, and refuse in its words."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import palpate
import pytest

PROBLEMS = Path(__file__).parents[3] / "assets" / "problems"

#: A quick specimen: linear tissue needs no finite elements.
PROTOCOL: dict[str, Any] = {
    "specimen": [{"organ": "soft", "tissue": {"law": "linear", "youngs_modulus_pa": 3000.0, "poissons_ratio": 0.45}}],
    "stimulus": [{"kind": "ramp_and_hold", "depth_m": 0.002, "ramp_s": 0.5, "hold_s": 2.0}],
}


def command(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run the command; without one that was built the test is skipped."""
    built = os.environ.get("PALPATE_COMMAND")
    if not built:
        pytest.skip("PALPATE_COMMAND names no built command")
    return subprocess.run([built, *arguments], cwd=folder, capture_output=True, text=True, check=False)


def without_times(answer: Any) -> Any:
    """An answer without how long it took."""
    return {key: value for key, value in answer.items() if key != "seconds"}


def test_a_solution_is_the_commands(tmp_path: Path) -> None:
    told = command(tmp_path, "solve", str(PROBLEMS / "punch.toml"), "--json", "--vtu", "punch.vtu")
    solution = palpate.solve(PROBLEMS / "punch.toml", vtu=True, progress=False)
    assert without_times(solution) == without_times(json.loads(told.stdout))
    assert solution.vtu == (tmp_path / "punch.vtu").read_bytes()
    assert "half-space" in solution.text


def test_a_problem_is_a_file_or_the_same_keys() -> None:
    """Judge: F/A = 2 C10 (stretch - 1/stretch^2) of a bar."""
    stretches = np.linspace(0.8, 1.3, 6)
    problem = {"kind": "uniaxial", "tissue": {"law": "neo_hookean", "c10_pa": np.float64(500)}, "stretches": stretches}
    solution = palpate.solve(problem, progress=False)
    closed = 2 * 500 * (stretches - stretches**-2)
    np.testing.assert_allclose(solution["nominal_stress_pa"], closed, rtol=1e-12, atol=1e-9)


def test_recordings_are_measured_analyzed_and_characterized_as_by_the_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    made = palpate.measure(PROTOCOL, out="here", progress=False)
    (tmp_path / "protocol.toml").write_text(
        'format = 1\n[[specimen]]\norgan = "soft"\ntissue = { law = "linear", youngs_modulus_pa = 3000.0, '
        'poissons_ratio = 0.45 }\n[[stimulus]]\nkind = "ramp_and_hold"\ndepth_m = 0.002\nramp_s = 0.5\nhold_s = 2.0\n'
    )
    told = command(tmp_path, "measure", "protocol.toml", "--headless", "--out", "there", "--json")
    there = [tmp_path / one["file"] for one in json.loads(told.stdout)["recordings"]]
    assert [file.read_bytes() for file in made.files] == [file.read_bytes() for file in there]

    told = command(tmp_path, "analyze", "here", "--json")
    analysis = palpate.analyze("here", progress=False)
    assert analysis == json.loads(told.stdout)
    assert analysis.to_frame()["depth_m"].iloc[0] == pytest.approx(0.002, rel=0.02)

    told = command(
        tmp_path, "characterize", "here", "--json", "--draws", "10", "--out", "tissue.toml", "--law", "neo_hookean"
    )
    found = palpate.characterize("here", draws=10, law="neo_hookean", progress=False)
    assert found == json.loads(told.stdout)
    assert found.tissue() == (tmp_path / "tissue.toml").read_text()
    assert palpate.Tissue.parse(found.tissue()).law == "neo_hookean"
    assert len(found.to_frame()) == 1
    specimen = found.specimens[0]
    assert specimen.preferred is not None
    law = specimen.laws[specimen.preferred]
    assert specimen[specimen.preferred] == law
    low, high = law["c10_pa"]["interval_95"]
    assert low < law["c10_pa"]["value"] < high
    assert specimen["mean_elastic_modulus"] == specimen.lumped["mean_elastic_modulus"]
    written = palpate.Tissue.parse(found.tissue())
    assert written.law == specimen.preferred


def test_the_same_seed_is_the_same_bytes(tmp_path: Path) -> None:
    texts = []
    for seed in (3, 3, 4):
        made = palpate.measure(PROTOCOL, out=tmp_path / "out", seed=seed, overwrite=True, progress=False)
        texts.append(made.files[0].read_bytes())
    assert texts[0] == texts[1] != texts[2]


def test_nothing_is_lost_without_being_asked(tmp_path: Path) -> None:
    palpate.measure(PROTOCOL, out=tmp_path, progress=False)
    with pytest.raises(palpate.InputError, match="is there already"):
        palpate.measure(PROTOCOL, out=tmp_path, progress=False)


@pytest.mark.parametrize(
    ("arguments", "ask"),
    [
        (["solve", "nothing.toml"], lambda: palpate.solve("nothing.toml")),
        (["characterize", "nothing"], lambda: palpate.characterize("nothing")),
        (["analyze", "wrong.csv"], lambda: palpate.analyze("wrong.csv")),
        (["analyze", "wrong.csv", "--set", "radius=1"], lambda: palpate.analyze("wrong.csv", known={"radius": 1})),
        (["solve", "wrong.toml"], lambda: palpate.solve("wrong.toml")),
        (["measure", "wrong.toml", "--headless"], lambda: palpate.measure("wrong.toml")),
        (["precompute", "wrong.toml"], lambda: palpate.precompute("wrong.toml")),
    ],
)
def test_what_is_refused_is_refused_in_the_commands_words(
    arguments: list[str], ask: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "wrong.toml").write_text('format = 1\nkindd = "uniaxial"\n')
    (tmp_path / "wrong.csv").write_text("# format = 1\ntime_s,depth_m,force_n\n0,0,zero\n")
    told = command(tmp_path, *arguments)
    assert told.returncode == 2
    with pytest.raises(palpate.InputError) as refused:
        ask()
    assert told.stderr == f"palpate: error: {refused.value}\n"


def test_what_no_document_holds_is_refused() -> None:
    with pytest.raises(palpate.InputError, match="stretches"):
        palpate.solve({"kind": "uniaxial", "builtin_tissue": "pig-liver", "stretches": [1.0, None]})
    with pytest.raises(palpate.InputError, match="no law `neo`"):
        palpate.characterize("recordings", law="neo")


def test_progress_is_heard_and_what_it_raises_ends_the_job() -> None:
    heard: list[tuple[float, str]] = []
    palpate.solve(PROBLEMS / "punch.toml", progress=lambda part, words: heard.append((part, words)))
    parts = [part for part, _ in heard]
    assert parts[0] == 0.0 and parts[-1] == 1.0 and max(parts) <= 1.0
    # What the solver told: each finer mesh begins anew.
    assert max(parts[1:-1]) > 0.5
    assert any("mesh" in words or "elements" in words for _, words in heard)

    def refuse(_part: float, _words: str) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        palpate.solve(PROBLEMS / "punch.toml", progress=refuse)


def test_ctrl_c_ends_a_solution_soon() -> None:
    begin = time.monotonic()
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        palpate.solve({**palpate_problem("ramp.toml"), "accuracy": 1e-4}, progress=False)
    # Half a minute's work; it is cancelled at its next step.
    assert time.monotonic() - begin < 10.0


def palpate_problem(name: str) -> dict[str, Any]:
    tomllib = pytest.importorskip("tomllib")
    read: dict[str, Any] = tomllib.loads((PROBLEMS / name).read_text())
    return read


def test_other_threads_go_on_meanwhile() -> None:
    counted = 0
    ended = threading.Event()

    def count() -> None:
        nonlocal counted
        while not ended.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    palpate.solve(PROBLEMS / "punch.toml", progress=False)
    ended.set()
    thread.join()
    # Some seconds of work; an interpreter that was held would have counted a few.
    assert counted > 100


def test_a_design_is_the_commands(tmp_path: Path) -> None:
    tissue = tmp_path / "liver.toml"
    terms = "[{ g = 0.2866, tau_s = 1.537 }, { g = 0.2022, tau_s = 6.09 }]"
    tissue.write_text(f'format = 1\n[tissue]\nlaw = "mooney_rivlin"\nc10_pa = 386.0\nc01_pa = 226.0\nprony = {terms}\n')
    asked = ("design", "liver.toml", "--json", "--parameters", "tau_1_s", "--radii-mm", "1,2", "--out", "protocol.toml")
    told = command(tmp_path, *asked)
    found = palpate.design(tissue, parameters=["tau_1_s"], radii_m=[1e-3, 2e-3], progress=False)
    assert found == json.loads(told.stdout)
    assert found.protocol == (tmp_path / "protocol.toml").read_text()
    with pytest.raises(palpate.InputError, match="no criterion"):
        palpate.design(tissue, criterion="best", progress=False)  # type: ignore[arg-type]


#: A law that softens so soon that Newton's method finds no equilibrium under the punch.
WITHOUT_EQUILIBRIUM: dict[str, Any] = {
    "kind": "indentation",
    "block": {"radius_m": 0.01, "height_m": 0.01},
    "tissue": {"law": "mooney_rivlin", "c10_pa": 1000.0, "c01_pa": -950.0},
    "indenter": {"radius_m": 0.001},
    "depths_m": [0.004],
    "accuracy": 0.2,
}


def test_a_failure_is_no_input_error(tmp_path: Path) -> None:
    """What ends the command with status 1 is a PalpateError, and an InputError what ends it with 2."""
    with pytest.raises(palpate.PalpateError, match="no equilibrium") as raised:
        palpate.solve(WITHOUT_EQUILIBRIUM, progress=False)
    assert not isinstance(raised.value, palpate.InputError)
    scene = Path(__file__).parents[3] / "assets" / "esophagus" / "scene.toml"
    with pytest.raises(palpate.PalpateError, match="of memory") as raised:
        palpate.precompute(scene, memory=1000, progress=False)
    assert not isinstance(raised.value, palpate.InputError)
    wrong = {**WITHOUT_EQUILIBRIUM, "tissue": {"law": "mooney_rivlin", "c10_pa": 1000.0, "c01_pa": -1050.0}}
    with pytest.raises(palpate.InputError, match="c01"):
        palpate.solve(wrong, progress=False)
    with pytest.raises(palpate.InputError, match="none.toml"):
        palpate.solve(tmp_path / "none.toml", progress=False)
