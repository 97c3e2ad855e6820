"""What the command does, as functions: their answers are those of ``--json``, digit for digit."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from palpate import _palpate
from palpate.errors import InputError
from palpate.fits import Characterization

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

PathLike: TypeAlias = str | os.PathLike[str]
Document: TypeAlias = PathLike | Mapping[str, Any]
Recordings: TypeAlias = PathLike | Iterable[PathLike]
Progress: TypeAlias = Callable[[float, str], object] | Literal[False] | None


class Solution(dict[str, Any]):
    """What ``palpate solve --json`` prints, and what comes with it.

    Attributes
    ----------
    text : str
        The same as a table.
    vtu : bytes or None
        The deformed body for ParaView, if it was asked for.
    recording : str or None
        The forces over a ramp as the text of a recording.
    """

    text: str
    vtu: bytes | None
    recording: str | None
    _plot: dict[str, Any]

    def draw(self, axes: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draw force against depth, or what the problem asks for instead, with Matplotlib."""
        from palpate import drawing

        return drawing.draw(self._plot, axes)


class Analysis(dict[str, Any]):
    """What ``palpate analyze --json`` prints."""

    def to_frame(self, part: str = "static") -> pandas.DataFrame:
        """Return a row for each hold (``"static"``), relaxation or sine (``"sinusoid"``) of each recording."""
        import pandas

        rows = []
        for file in self["files"]:
            found = file[part]
            for row in found if isinstance(found, list) else [found]:
                if row is not None:
                    rows.append({"file": file["file"], "organ": file["organ"], **row})
        return pandas.DataFrame(rows)


class Measurement(dict[str, Any]):
    """What ``palpate measure --json`` prints."""

    @property
    def files(self) -> list[Path]:
        """The recordings that were made."""
        return [Path(recording["file"]) for recording in self["recordings"]]


class Design(dict[str, Any]):
    """What ``palpate design --json`` prints, and the protocol.

    Attributes
    ----------
    protocol : str
        The text of a protocol's file, for `measure`.
    """

    protocol: str


def solve(
    problem: Document,
    *,
    vtu: bool = False,
    progress: Progress = None,
) -> Solution:
    """Solve a problem by finite elements, refined until the estimated error is what was asked for.

    Parameters
    ----------
    problem : path or mapping
        A problem's file, or the same keys as a mapping; see ``palpate solve --help``.
    vtu : bool
        Whether the deformed body is wanted, for ParaView.
    progress : callable, False or None
        Hears ``(part, words)``; ``False`` for silence.

    Returns
    -------
    Solution
        ``force_n``, ``depth_m`` and so on, by the problem's kind; ``estimated_error`` is relative, and
        ``observed_order`` the order of convergence behind it.
    """
    answer, text, plot, body, recording = _palpate._solve(given(problem, "problem"), True, vtu, progress)
    solution = Solution(json.loads(answer))
    solution.text = text
    solution.vtu = body
    solution.recording = recording
    solution._plot = json.loads(plot)
    return solution


def analyze(recordings: Recordings, *, progress: Progress = None, **columns: Any) -> Analysis:
    """Show what recordings hold without any model: steady forces, relaxation, sines and chirps.

    Parameters
    ----------
    recordings : path or iterable of paths
        Files, or folders of them.
    progress : callable, False or None
        Hears ``(part, words)``.
    **columns
        As of `characterize`: ``time``, ``depth``, ``force``, ``depth_unit``, ``force_unit``, ``known``.
    """
    return Analysis(json.loads(_palpate._analyze(asked(recordings, **columns), progress)))


def characterize(
    recordings: Recordings,
    *,
    law: str | None = None,
    order: int | None = None,
    terms: int | None = None,
    draws: int = 100,
    seed: int = 1,
    in_loop: bool = False,
    closed_forms: bool = False,
    study: PathLike | None = None,
    overwrite: bool = False,
    progress: Progress = None,
    **columns: Any,
) -> Characterization:
    """Find the tissue behind recordings, with how well it is known.

    Parameters
    ----------
    recordings : path or iterable of paths
        Files, also of instruments, or folders of them; those of the same organ, subject and site are one specimen.
    law : {"neo_hookean", "mooney_rivlin", "exponential", "ogden", "reduced_polynomial", "holzapfel_gasser_ogden"}, optional
        The only law that is sought; by default the first three are, and of pieces that state ``fibre_axis_angle_deg`` also the
        last. Its answer stands under this name in ``Specimen.laws``.
    order : int, optional
        Terms of ``"ogden"``, by default 1, or of ``"reduced_polynomial"``, by default 2: 1 to 3.
    terms : int, optional
        Terms of the relaxation, 1 to 4; by default as many as the recordings can tell.
    draws : int
        How often fits are made again to see how well parameters are known; 0 for never, else 10 or more.
    seed : int
        Of these draws.
    in_loop : bool
        Whether full viscoelastic runs of finite elements are solved in the loop of the fit: for deep and fast presses, of
        one specimen and one ``law``, in seconds for each run. ``solves`` counts the runs.
    closed_forms : bool
        Whether only linear elastic contact and adhesion are fitted, in closed form, as a map of many curves needs it.
    study : path, optional
        A folder that keeps every finished specimen; a study that was stopped goes on.
    overwrite : bool
        Whether specimens in the folder may be lost that other recordings or settings led to.
    progress : callable, False or None
        Hears ``(part, words)``.
    **columns
        ``time``, ``depth``, ``force``: columns of tables of other programs; ``depth_unit``, ``force_unit``;
        ``known``: what the files do not say, such as ``{"indenter_radius_m": 0.001}``.
    """
    if order is not None and law is None:
        raise InputError("order is given without a law; name ogden or reduced_polynomial")
    settings = {
        "law": law,
        "order": order,
        "terms": terms,
        "draws": draws,
        "seed": seed,
        "in_loop": in_loop,
        "closed_forms": closed_forms,
    }
    asked_for = asked(recordings, **columns)
    answer, tissues, samples = _palpate._characterize(asked_for, settings, study, overwrite, progress)
    found = Characterization(json.loads(answer), samples)
    found.tissues = [text for text, _ in tissues]
    found.reasons = [why for _, why in tissues]
    return found


def measure(
    protocol: Document | None = None,
    *,
    out: PathLike = "recordings",
    seed: int = 1,
    overwrite: bool = False,
    progress: Progress = None,
) -> Measurement:
    """Carry a protocol out with the rig, and make a recording of each stimulus.

    Parameters
    ----------
    protocol : path or mapping, optional
        What is pressed, and on what; by default three depths on a virtual liver, which is `default_protocol`.
    out : path
        A folder, or the file of an only recording.
    seed : int
        Of noise, heart and breath; the same seed gives the same bytes.
    overwrite : bool
        Whether recordings that are there may be lost.
    """
    asked_for = None if protocol is None else given(protocol, "protocol")
    return Measurement(json.loads(_palpate._measure(asked_for, Path(out), overwrite, seed, progress)))


def design(
    start: Recordings,
    *,
    law: str | None = None,
    parameters: Sequence[str] = (),
    criterion: Literal["minimax", "d_optimal"] = "minimax",
    depth_m: float | None = None,
    force_n: float | None = None,
    time_s: float | None = None,
    press_s: float | None = None,
    speed_m_per_s: float | None = None,
    presses: int | None = None,
    radii_m: Sequence[float] = (),
    progress: Progress = None,
    **columns: Any,
) -> Design:
    """Find how to press, so that the parameters of a tissue are known best.

    Parameters
    ----------
    start : path or iterable of paths
        A guess, the file of a tissue; or first recordings of one specimen.
    law : str, optional
        The law that is sought in recordings; by default the preferred one.
    parameters : sequence of str
        The parameters that count, such as ``"c10_pa"`` and ``"tau_1_s"``; by default all but gᵢ.
    criterion : {"minimax", "d_optimal"}
        Whether the interval of the worst parameter is made best, or the determinant of the covariance.
    depth_m, force_n, time_s, press_s, speed_m_per_s, presses, radii_m
        Limits; by default those of the recordings or of the default protocol. ``time_s`` is of all presses together,
        ``press_s`` of one, ``radii_m`` those of the flat punches that there are.
    progress : callable, False or None
        Hears ``(part, words)``; ``False`` for silence.
    **columns
        As of `characterize`.
    """
    paths = [start] if isinstance(start, (str, os.PathLike)) else list(start)
    is_tissue = len(paths) == 1 and Path(paths[0]).suffix == ".toml"
    wish = {
        "tissue": os.fspath(paths[0]) if is_tissue else None,
        "recordings": json.loads(asked([] if is_tissue else paths, **columns)),
        "law": law,
        "parameters": list(parameters),
        "criterion": criterion,
        "within": {
            "depth_m": depth_m,
            "force_n": force_n,
            "time_s": time_s,
            "press_s": press_s,
            "speed_m_per_s": speed_m_per_s,
            "presses": presses,
            "radii_m": list(radii_m),
        },
    }
    answer, protocol = _palpate._design(json.dumps(wish, default=plain), progress)
    found = Design(json.loads(answer))
    found.protocol = protocol
    return found


def default_protocol() -> str:
    """Return the protocol that is measured without one, with every key explained."""
    return _palpate._default_protocol()


def precompute(scene: Document, *, memory: float | None = None, progress: Progress = None) -> dict[str, Any]:
    """Make the whole organ's response once and keep it, as `Simulation` would.

    Parameters
    ----------
    scene : path or mapping
        A scene.
    memory : float, optional
        That may be used [bytes]; by default four fifths of what is free.
    """
    answer: dict[str, Any] = json.loads(_palpate._precompute(given(scene, "scene"), memory, progress))
    return answer


def given(document: Document, name: str) -> tuple[Path, str | None]:
    """Return a document as the extension takes it: a file, or a text and what it is called."""
    if isinstance(document, Mapping):
        return Path(name), _palpate._toml(dict(document))
    return Path(document), None


def plain(value: Any) -> Any:
    """Return what JSON has words for: lists of arrays, numbers of NumPy's scalars, texts of paths."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} cannot stand in a document; use numbers, texts, lists and mappings")


def asked(
    recordings: Recordings,
    *,
    time: str | None = None,
    depth: str | None = None,
    force: str | None = None,
    depth_unit: str | None = None,
    force_unit: str | None = None,
    known: Mapping[str, object] | None = None,
    texts: Sequence[tuple[str, str]] = (),
) -> str:
    """Return which recordings are meant as the extension takes it."""
    paths = [recordings] if isinstance(recordings, (str, os.PathLike)) else list(recordings)
    return json.dumps(
        {
            "paths": [str(os.fspath(path)) for path in paths],
            "texts": list(texts),
            "time": time,
            "depth": depth,
            "force": force,
            "depth_unit": depth_unit,
            "force_unit": force_unit,
            "said": [f"{key}={_said(value)}" for key, value in (known or {}).items()],
        }
    )


def _said(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
