"""Every notebook and every example of `examples` runs to its end; each asserts what it shows."""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import palpate
import pytest

EXAMPLES = Path(__file__).parents[3] / "examples"
NOTEBOOKS = sorted((EXAMPLES / "notebooks").glob("*.ipynb"))
#: What each script is given, and what it needs besides NumPy.
SCRIPTS: dict[str, tuple[list[str], list[str]]] = {
    "palpate_a_liver.py": ([], []),
    "look_at_an_organ.py": (["liver.png"], ["pyvista"]),
    "study_on_a_cluster.py": (["recordings", "--laws", "neo_hookean", "--draws", "0"], ["distributed", "pandas"]),
    "couple_to_mujoco.py": ([], ["mujoco"]),
    "teleoperate.py": (["--device", "virtual", "--seconds", "1"], []),
    "see_the_environments.py": (["environments.png"], ["gymnasium", "PIL"]),
    "learn_to_palpate.py": (
        ["train", "--presses", "640", "--limit", "30", "--out", "run.json"],
        ["gymnasium", "torch"],
    ),
}


@pytest.fixture(scope="module")
def surroundings(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """No display, and what takes long is kept for these tests alone."""
    own = {name: value for name, value in os.environ.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    return own | {"PALPATE_CACHE": str(tmp_path_factory.mktemp("kept")), "MPLBACKEND": "agg"}


def needs(*names: str) -> None:
    """Skips where a package is missing."""
    for name in names:
        if importlib.util.find_spec(name) is None:
            pytest.skip(f"{name} is not installed")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_to_its_end(path: Path, tmp_path: Path, surroundings: dict[str, str]) -> None:
    needs("nbclient", "ipykernel", "matplotlib", "pandas", "pyvista", "distributed")
    import nbclient
    import nbformat

    notebook: Any = nbformat.read(path, as_version=4)  # type: ignore[no-untyped-call]
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    )
    # The kernel's own back end draws in a notebook.
    client.execute(env={name: value for name, value in surroundings.items() if name != "MPLBACKEND"})
    last = [cell for cell in notebook.cells if cell.cell_type == "code"][-1]
    assert "assert " in last.source


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_kept_without_outputs(path: Path) -> None:
    needs("nbformat")
    import nbformat

    notebook: Any = nbformat.read(path, as_version=nbformat.NO_CONVERT)  # type: ignore[no-untyped-call]
    nbformat.validate(notebook)
    assert (notebook.nbformat, notebook.nbformat_minor) == (4, 5)
    assert notebook.metadata.kernelspec.name == "python3"
    for cell in notebook.cells:
        assert not cell.get("outputs") and cell.get("execution_count") is None and not cell.metadata


@pytest.mark.parametrize("name", SCRIPTS)
def test_an_example_runs_to_its_end(name: str, tmp_path: Path, surroundings: dict[str, str]) -> None:
    arguments, packages = SCRIPTS[name]
    needs(*packages)
    if "recordings" in arguments:
        specimen = {"builtin_tissue": "pig-esophagus", "organ": "esophagus", "subject": "1"}
        stimulus = {"kind": "ramp_and_hold", "depths_m": [2e-3], "ramp_s": 0.5, "hold_s": 5.0}
        palpate.measure({"specimen": [specimen], "stimulus": [stimulus]}, out=tmp_path / "recordings", progress=False)
    ran = subprocess.run(
        [sys.executable, str(EXAMPLES / "python" / name), *arguments],
        check=False,
        cwd=tmp_path,
        env=surroundings,
        capture_output=True,
        text=True,
        timeout=300,
    )
    if "there is no OpenGL here" in ran.stderr:
        pytest.skip("there is no OpenGL here")
    assert ran.returncode == 0, ran.stderr
    assert any(word in ran.stdout for word in ("N", "neo_hookean", "depth [m]", "unseen"))


def test_every_script_is_tried() -> None:
    assert {path.name for path in (EXAMPLES / "python").glob("*.py")} == set(SCRIPTS)
    assert len(NOTEBOOKS) == 5


def test_the_printed_table_is_the_published_one() -> None:
    """A notebook that is carried away alone holds the table; it is that of `published`."""
    published = EXAMPLES.parent / "published" / "table_5_1_static_force.csv"
    lines = [line for line in published.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    own = json.loads((EXAMPLES / "notebooks" / "virtual_chapter_5.ipynb").read_text(encoding="utf-8"))
    sources = ["".join(cell["source"]) for cell in own["cells"]]
    assert any("\n".join(lines) in source for source in sources)
