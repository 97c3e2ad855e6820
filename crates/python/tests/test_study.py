"""Studies: the same bits wherever they are done, and nothing that was done is lost."""

from __future__ import annotations

import json
import os
import signal
import threading
import time
from pathlib import Path
from typing import Any

import palpate
import pytest
from palpate import study
from palpate.study.task import execute, unpacked

distributed = pytest.importorskip("distributed")

#: Some tenths of a second each.
PUNCH: dict[str, Any] = {
    "kind": "indentation",
    "block": {"radius_m": 0.05, "height_m": 0.05},
    "indenter": {"radius_m": 0.002, "face": "slip", "side": "none"},
    "depths_m": [0.0005],
    "accuracy": 0.05,
    "tissue": {"law": "linear", "youngs_modulus_pa": 1000.0, "poissons_ratio": 0.4},
}

SWEEP = {"tissue.youngs_modulus_pa": [500.0, 1000.0, 2000.0, 4000.0], "tissue.poissons_ratio": [0.3, 0.4]}


@pytest.fixture(scope="module")
def local() -> study.Study:
    """The sweep, done here."""
    return study.run(study.solves(PUNCH, SWEEP), progress=False)


def bits(found: study.Study) -> list[str]:
    return [json.dumps(answer) for answer in found.answers]


def test_a_sweep_is_every_combination(local: study.Study) -> None:
    """Judge: at small strain the force is proportional to the modulus."""
    assert len(local.tasks) == 8 and not local.failures
    frame = local.to_frame()
    soft = frame[frame["tissue.poissons_ratio"] == 0.3].sort_values("tissue.youngs_modulus_pa")
    forces = soft["force_n[0]"].to_numpy()
    assert forces[1:] / forces[:-1] == pytest.approx([2.0, 2.0, 2.0], rel=1e-9)


def test_workers_answer_to_the_last_bit(local: study.Study, tmp_path: Path) -> None:
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = study.run(local.tasks, tmp_path, client, progress=False)
    assert bits(found) == bits(local)
    by = {json.loads(file.read_text())["run"]["worker"] for file in tmp_path.glob("*.json")}
    assert len(by) == 2 and all(worker.startswith("tcp://127.0.0.1") for worker in by)


@pytest.mark.parametrize("allowed_failures", [3, 0])
def test_a_killed_worker_loses_nothing(local: study.Study, tmp_path: Path, allowed_failures: int) -> None:
    """Also where the scheduler gives a task up that lost its worker."""
    import dask

    # Long enough for one to be killed within.
    tasks = study.solves({**PUNCH, "accuracy": 0.005}, SWEEP)
    killed: list[int] = []
    with (
        dask.config.set({"distributed.scheduler.allowed-failures": allowed_failures}),
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):

        def kill(part: float, _words: str) -> None:
            if part > 0.2 and not killed:
                pid = client.run(os.getpid)
                killed.append(next(iter(pid.values())))
                os.kill(killed[0], signal.SIGKILL)

        found = study.run(tasks, tmp_path, client, progress=kill)
    assert killed and not found.failures
    assert bits(found) == bits(study.run(tasks, progress=False))


def test_a_study_goes_on_where_it_was_stopped(local: study.Study, tmp_path: Path) -> None:
    def stop(part: float, _words: str) -> None:
        if part > 0.4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        study.run(local.tasks, tmp_path, progress=stop)
    kept = {file.name: file.stat().st_mtime_ns for file in tmp_path.glob("*.json")}
    assert 3 <= len(kept) < 8
    heard: list[str] = []
    found = study.run(local.tasks, tmp_path, progress=lambda _part, words: heard.append(words))
    assert heard[0] == f"{len(kept)} of 8 tasks are kept"
    assert bits(found) == bits(local)
    assert all((tmp_path / name).stat().st_mtime_ns == time_of for name, time_of in kept.items())
    table = (tmp_path / "study.csv").read_text().splitlines()
    assert table[0] == "# format = 1" and len(table) == 2 + 8


def test_a_damaged_answer_is_found_again(local: study.Study, tmp_path: Path) -> None:
    study.run(local.tasks[:2], tmp_path, progress=False)
    files = sorted(tmp_path.glob("*.json"))
    files[0].write_text(files[0].read_text()[:100])
    other = json.loads(files[1].read_text())
    files[1].write_text(json.dumps({**other, "key": "0" * 64}))
    assert bits(study.run(local.tasks[:2], tmp_path, progress=False)) == bits(local)[:2]
    assert not list(tmp_path.glob("tmp*"))


def test_one_task_that_fails_does_not_stop_the_others(tmp_path: Path) -> None:
    tasks = study.solves(PUNCH, {"tissue.poissons_ratio": [0.3, 0.7]})
    found = study.run(tasks, tmp_path, progress=False)
    assert found.answers[0] is not None and found.answers[1] is None
    assert "poissons_ratio" in found.failures[1]
    assert "poissons_ratio" in (tmp_path / "study.csv").read_text()


def test_specimens_travel_with_their_recordings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    linear = {"law": "linear", "youngs_modulus_pa": 3000.0, "poissons_ratio": 0.45}
    palpate.measure(
        {
            "specimen": [
                {"organ": "soft", "subject": "1", "tissue": linear},
                {"organ": "soft", "subject": "2", "tissue": linear},
            ],
            "stimulus": [{"kind": "ramp_and_hold", "depth_m": 0.002, "ramp_s": 0.5, "hold_s": 2.0}],
        },
        out="recordings",
        progress=False,
    )
    tasks = study.characterizations("recordings", laws=("neo_hookean", None), seeds=(1, 2), draws=10)
    assert len(tasks) == 2 * 2 * 2 and len({task.key for task in tasks}) == 8
    whole = palpate.characterize("recordings", law="neo_hookean", draws=10, progress=False)
    for file in Path("recordings").iterdir():
        file.unlink()
    answers = [json.loads(execute(task.document)) for task in tasks if task.labels["law"] and task.labels["seed"] == 1]
    assert [answer["specimens"][0] for answer in answers] == whole["specimens"]
    assert [answer["tissues"][0] for answer in answers] == whole.tissues
    assert len(tasks[0].packed) < 0.5 * len(tasks[0].document)
    assert unpacked(tasks[0].packed) == tasks[0].document


def test_a_sweep_over_files_finds_them_from_anywhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "tissue.toml").write_text('format = 1\n[tissue]\nlaw = "neo_hookean"\nc10_pa = 100.0\n')
    (tmp_path / "bar.toml").write_text('format = 1\nkind = "uniaxial"\ntissue = "tissue.toml"\nstretches = [1.1]\n')
    tasks = study.solves(tmp_path / "bar.toml", {"stretches": [[1.1], [1.2]]})
    monkeypatch.chdir("/")
    assert not study.run(tasks, progress=False).failures


def test_ctrl_c_ends_the_threads_soon(local: study.Study) -> None:
    tasks = study.solves({**PUNCH, "accuracy": 1e-4}, SWEEP)
    begin = time.monotonic()
    threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        study.run(tasks, progress=False)
    assert time.monotonic() - begin < 15.0


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: study.solves("nothing.toml"), "nothing.toml cannot be read"),
        (lambda: study.solves(PUNCH, {"accuracy.x": [1]}), "no table"),
        (lambda: study.characterizations("nothing"), "nothing"),
        (lambda: study.run([], "/proc/nothing"), "cannot be made"),
    ],
)
def test_what_is_refused_says_why(ask: Any, words: str) -> None:
    with pytest.raises(palpate.InputError, match=words):
        ask()
