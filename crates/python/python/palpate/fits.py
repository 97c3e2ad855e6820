"""What was found about specimens, as objects over the answer that ``palpate characterize --json`` prints."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palpate import _palpate
from palpate.errors import PalpateError

if TYPE_CHECKING:
    import matplotlib.axes
    import matplotlib.figure
    import pandas

Floats: TypeAlias = NDArray[np.float64]


class Parameter(dict[str, Any]):
    """A number with its error: the entry of the answer, and what else the fit says about it.

    ``value`` and ``standard_error`` are in the unit of the parameter's name.
    """

    name: str
    #: Least and largest value that was sought; none: without a bound.
    bound: tuple[float | None, float | None]
    #: Correlations with the other parameters of the law and of the relaxation [-], by their names.
    correlation: dict[str, float]

    def __init__(self, name: str, answer: Mapping[str, Any]) -> None:
        super().__init__(answer)
        self.name = name
        self.bound = (None, None)
        self.correlation = {}

    @property
    def value(self) -> float:
        """The value."""
        return float(self["value"])

    @property
    def standard_error(self) -> float | None:
        """The standard error by noise, zeros and model; none where the parameter is no estimate."""
        error: float | None = self["standard_error"]
        return error

    @property
    def interval(self) -> tuple[float, float] | None:
        """What holds the truth with a probability of 95 %."""
        bounds = self.get("interval_95")
        return None if bounds is None else (bounds[0], bounds[1])

    @property
    def verdict(self) -> str | None:
        """``"known"``, ``"correlated"``, ``"hardly_known"`` or ``"on_bound"``."""
        verdict: str | None = self.get("verdict")
        return verdict

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        error = self.standard_error
        return f"<{self.name} = {self.value:.5g}{'' if error is None else f' ± {error:.2g}'}>"


class Relaxation(dict[str, Any]):
    """The relaxation of a specimen: G(t) = G₀ (1 − Σ gᵢ (1 − exp(−t/τᵢ)))."""

    #: ``g_1``, ``tau_1_s`` and so on.
    parameters: dict[str, Parameter]

    def __init__(self, answer: Mapping[str, Any]) -> None:
        super().__init__(answer)
        self["g"] = [Parameter(f"g_{place}", one) for place, one in enumerate(answer["g"], start=1)]
        self["tau_s"] = [Parameter(f"tau_{place}_s", one) for place, one in enumerate(answer["tau_s"], start=1)]
        pairs = zip(self["g"], self["tau_s"], strict=True)
        self.parameters = {one.name: one for pair in pairs for one in pair}

    @property
    def terms(self) -> list[tuple[float, float]]:
        """Pairs of gᵢ [-] and τᵢ [s]."""
        return [(g.value, tau.value) for g, tau in zip(self["g"], self["tau_s"], strict=True)]

    def evaluate(self, time: ArrayLike) -> Floats:
        """Return G(t)/G₀ [-] at times [s] after a step."""
        times = np.asarray(time, dtype=np.float64)
        lost = [g * (1.0 - np.exp(-times / tau)) for g, tau in self.terms]
        return np.asarray(1.0 - sum(lost), dtype=np.float64)


class FittedRecording:
    """What of a recording was fitted, from first contact to where the indenter goes back.

    Attributes
    ----------
    file : str
        As it was named.
    is_piece : bool
        Whether a piece was pressed or pulled along one axis.
    time : array
        From first contact [s].
    course : array
        Depths [m]; of a piece, stretches [-].
    measured : array
        Forces [N]; of a piece, nominal stresses [Pa].
    """

    def __init__(self, samples: Mapping[str, Any], law: str) -> None:
        self.file: str = samples["file"]
        self.is_piece: bool = samples["is_piece"]
        self.time: Floats = samples["time"]
        self.course: Floats = samples["course"]
        self.measured: Floats = samples["measured"]
        self.best_fit: Floats
        #: How far up and down the band of 95 % reaches.
        self.reach: Floats
        self.best_fit, self.reach = samples["laws"][law]

    @property
    def residual(self) -> Floats:
        """What the law gives less what was measured."""
        return np.asarray(self.best_fit - self.measured)


class Law(dict[str, Any]):
    """An elastic law of a specimen: the entry of ``laws`` of the answer, and the fit that it comes from.

    ``law["c10_pa"]`` and ``law.parameters["c10_pa"]`` are the same `Parameter`.
    """

    name: str
    parameters: dict[str, Parameter]
    #: The relaxation that the law was found with; none of a piece.
    relaxation: Relaxation | None
    _fit: dict[str, Any]
    _samples: list[dict[str, Any]] | None

    def __init__(
        self,
        name: str,
        answer: Mapping[str, Any],
        fit: Mapping[str, Any],
        relaxation: Relaxation | None,
        samples: list[dict[str, Any]] | None,
    ) -> None:
        super().__init__(answer)
        self.name = name
        self.relaxation = relaxation if fit["elastic"] is not None else None
        self._fit = dict(fit)
        self._samples = samples
        self.parameters = {}
        correlation = self.correlation
        names = self.variable_names
        # Those with an error first, in the law's order; then those that ended on a bound.
        for key in sorted(fit["bounds"], key=lambda key: names.index(key) if key in names else len(names)):
            parameter = self[key] = self.parameters[key] = Parameter(key, answer[key])
            least, largest = fit["bounds"][key]
            parameter.bound = (least, largest)
            if key in names:
                row = correlation[names.index(key)]
                parameter.correlation = {other: float(of) for other, of in zip(names, row, strict=True) if other != key}

    @property
    def variable_names(self) -> list[str]:
        """The parameters of rows and columns of `covariance`: the law's, and ``g_1``, ``tau_1_s`` and so on."""
        names: list[str] = self._fit["covariance"]["parameters"]
        return names

    @property
    def covariance(self) -> Floats:
        """The covariance of `variable_names` [products of their units]; its roots are the standard errors."""
        count = len(self.variable_names)
        return np.array(self._fit["covariance"]["matrix"], dtype=np.float64).reshape(count, count)

    @property
    def correlation(self) -> Floats:
        """The correlations of `variable_names` [-]."""
        covariance = self.covariance
        errors = np.sqrt(covariance.diagonal())
        return np.asarray(covariance / np.outer(errors, errors))

    @property
    def information_criterion(self) -> float | None:
        """Akaike's, with the correction for few samples [-]; comparable between the laws of a specimen."""
        criterion: float | None = self._fit["information_criterion"]
        return criterion

    @property
    def is_piece(self) -> bool:
        """Whether the law is of a piece that was pressed or pulled along one axis."""
        return self._fit["elastic"] is None

    @property
    def recordings(self) -> list[FittedRecording]:
        """The recordings beside the law; of a study, at those samples that its folder keeps.

        Raises
        ------
        PalpateError
            When the answer was read from JSON, which has no samples.
        """
        if self._samples is None:
            raise PalpateError("the answer was read from JSON, which has no samples; characterize the recordings again")
        return [FittedRecording(samples, self.name) for samples in self._samples]

    @property
    def best_fit(self) -> Floats:
        """Forces of the law [N], or nominal stresses [Pa] of a piece, of all recordings one after the other."""
        return np.concatenate([recording.best_fit for recording in self.recordings])

    @property
    def measured(self) -> Floats:
        """What was measured, as `best_fit`."""
        return np.concatenate([recording.measured for recording in self.recordings])

    @property
    def residual(self) -> Floats:
        """`best_fit` less `measured`."""
        return np.asarray(self.best_fit - self.measured)

    def evaluate(
        self, time: ArrayLike | None = None, depth: ArrayLike | None = None, *, stretch: ArrayLike | None = None
    ) -> Floats:
        """Return forces [N] at depths [m], or nominal stresses [Pa] of a piece at stretches [-].

        Parameters
        ----------
        time : array, optional
            Times [s] of the depths, ascending; without it forces are those of a press that leaves no time to relax.
        depth : array
            Depths [m] of the indenter of the recordings; beyond the deepest of them force goes on along its tangent.
        stretch : array
            Of a piece, deformed over undeformed length.
        """
        return self._evaluated(time, depth, stretch)[0]

    def evaluate_error(
        self, time: ArrayLike | None = None, depth: ArrayLike | None = None, *, stretch: ArrayLike | None = None
    ) -> Floats:
        """Return the standard errors of what `evaluate` returns, from `covariance`."""
        return self._evaluated(time, depth, stretch)[1]

    def _evaluated(
        self, time: ArrayLike | None, depth: ArrayLike | None, stretch: ArrayLike | None
    ) -> tuple[Floats, Floats]:
        name, course = ("stretch", stretch) if self.is_piece else ("depth", depth)
        if course is None:
            from palpate.errors import InputError

            raise InputError(f"the law is asked for no {name}; give `{name}`")
        known = {
            "law": self.name,
            "values": {key: parameter.value for key, parameter in self.parameters.items()},
            "series": [] if self.relaxation is None else self.relaxation.terms,
            "covariance": self._fit["covariance"],
            "elastic": self._fit["elastic"],
            "test": self._fit.get("test"),
        }
        return _palpate._evaluate(
            json.dumps(known), None if time is None else np.atleast_1d(time), np.atleast_1d(course)
        )

    def report(self) -> str:
        """Return the fit as text: parameters with errors, intervals and bounds, then correlations."""
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        unit = "of the largest stress" if self.is_piece else "of the largest force"
        yield f"[[{self.name}]]"
        yield f"    samples            = {self._fit['samples']} (as many as {self._fit['effective_samples']:.0f} independent)"
        yield f"    misfit             = {100 * self['misfit']:.3g} % {unit}"
        if self.information_criterion is not None:
            yield f"    information crit.  = {self.information_criterion:.6g}"
        yield "[[parameters]]"
        everything = dict(self.parameters)
        if self.relaxation is not None:
            everything |= self.relaxation.parameters
        width = max(map(len, everything))
        for name, parameter in everything.items():
            yield f"    {name:{width}} {_in_words(parameter)}"
        names, correlation = self.variable_names, self.correlation
        pairs = [(abs(correlation[i, j]), i, j) for i in range(len(names)) for j in range(i)]
        telling = sorted((pair for pair in pairs if pair[0] >= 0.1), reverse=True)
        if telling:
            yield "[[correlations]] (below 0.1 left out)"
        for _, i, j in telling:
            yield f"    {names[j]}, {names[i]} = {correlation[i, j]:+.3f}"

    def to_frame(self) -> pandas.DataFrame:
        """Return a row for each parameter of the law and of its relaxation."""
        import pandas

        everything = self.parameters | ({} if self.relaxation is None else self.relaxation.parameters)
        rows = []
        for parameter in everything.values():
            low, high = parameter.interval or (None, None)
            error, (least, largest) = parameter.standard_error, parameter.bound
            rows.append([parameter.value, error, low, high, least, largest])
        columns = ["value", "standard_error", "low_95", "high_95", "least", "largest"]
        index = pandas.Index(everything, name="parameter")
        frame = pandas.DataFrame(rows, index=index, columns=columns, dtype=np.float64)
        verdicts = pandas.Series([parameter.verdict for parameter in everything.values()], index=index, dtype=object)
        return frame.assign(verdict=verdicts)

    def samples_frame(self) -> pandas.DataFrame:
        """Return a row for each sample: file, time, depth or stretch, what was measured, fit and residual."""
        import pandas

        course, measured = ("stretch", "stress_pa") if self.is_piece else ("depth_m", "force_n")
        parts = [
            pandas.DataFrame(
                {
                    "file": own.file,
                    "time_s": own.time,
                    course: own.course,
                    measured: own.measured,
                    "best_fit": own.best_fit,
                    "residual": own.residual,
                    "reach_95": own.reach,
                }
            )
            for own in self.recordings
        ]
        return pandas.concat(parts, ignore_index=True)

    def plot(
        self, against: Literal["time", "course"] | None = None, figure: matplotlib.figure.Figure | None = None
    ) -> matplotlib.figure.Figure:
        """Draw measured and fitted values of all recordings, with the band of 95 %, and below them the residual.

        Parameters
        ----------
        against : {"time", "course"}, optional
            Times, or depths and stretches; by default times, and stretches of a piece.
        figure : Figure, optional
            One of its own by default.
        """
        from palpate import drawing

        return drawing.draw_fit(self, against, figure)

    def __reduce__(self) -> tuple[Any, ...]:
        answer = {key: dict(value) if isinstance(value, Parameter) else value for key, value in self.items()}
        return (Law, (self.name, answer, self._fit, self.relaxation, self._samples))


def _in_words(parameter: Parameter) -> str:
    words = f"= {parameter.value:.6g}"
    error, interval = parameter.standard_error, parameter.interval
    if error is not None:
        words += (
            f" ± {error:.2g} ({100 * error / abs(parameter.value):.2g} %)" if parameter.value else f" ± {error:.2g}"
        )
    if interval is not None:
        words += f", 95 % from {interval[0]:.5g} to {interval[1]:.5g}"
    least, largest = parameter.bound
    if least is not None or largest is not None:
        words += f", sought from {'-inf' if least is None else f'{least:g}'} to {'inf' if largest is None else f'{largest:g}'}"
    if parameter.verdict not in (None, "known"):
        words += f" ({str(parameter.verdict).replace('_', ' ')})"
    return words


class Specimen(dict[str, Any]):
    """One specimen of a `Characterization`: the entry of ``specimens`` that ``--json`` prints.

    ``specimen.laws[specimen.preferred]`` is the preferred law; ``specimen[specimen.preferred]`` is the same.

    The keys of the first version (``specimen["neo_hookean"]``, ``["mooney_rivlin"]``, ``["exponential"]``,
    ``["kelvin"]``, ``["nonlinear_springs"]``, ``["mean_elastic_modulus"]`` and ``["blatz"]``, which is
    ``specimen.lumped["column"]``) stay for one release.
    """

    def __init__(self, answer: Mapping[str, Any], samples: list[dict[str, Any]] | None = None) -> None:
        super().__init__(answer)
        self._samples = samples
        found = answer.get("relaxation")
        relaxation = None if found is None else Relaxation(found)
        self["relaxation"] = relaxation
        fits = answer["fits"]
        self["laws"] = {name: Law(name, law, fits[name], relaxation, samples) for name, law in answer["laws"].items()}
        for name, law in self["laws"].items():
            if name in answer:
                self[name] = law

    @property
    def laws(self) -> dict[str, Law]:
        """The laws that were found, by their names in a tissue's file."""
        found: dict[str, Law] = self["laws"]
        return found

    @property
    def relaxation(self) -> Relaxation | None:
        """The relaxation, if one was found."""
        found: Relaxation | None = self["relaxation"]
        return found

    @property
    def lumped(self) -> dict[str, Any]:
        """What was found without geometry: ``kelvin``, ``column``, ``nonlinear_springs``, ``mean_elastic_modulus``,
        ``linear_elastic``, ``adhesion``."""
        found: dict[str, Any] = self["lumped"]
        return found

    @property
    def preferred(self) -> str | None:
        """The name of the law to be preferred, a key of `laws`; none where no law was found."""
        name: str | None = self["preferred"]
        return name

    @property
    def warnings(self) -> list[str]:
        """Warnings, in recordings and in what was found."""
        said: list[str] = self["warnings"]
        return said

    @property
    def law(self) -> Law:
        """The law to be preferred.

        Raises
        ------
        PalpateError
            When no law was found; the message says why.
        """
        if self.preferred is None:
            raise PalpateError(next(iter(self["reasons"].values()), "no law was found"))
        return self.laws[self.preferred]

    def plot(
        self, against: Literal["time", "course"] | None = None, figure: matplotlib.figure.Figure | None = None
    ) -> matplotlib.figure.Figure:
        """Draw the preferred law beside the recordings, as `Law.plot`."""
        return self.law.plot(against, figure)

    def report(self) -> str:
        """Return the preferred law as text, then the warnings."""
        said = [f"    {sentence}" for sentence in self.warnings]
        return "\n".join([f"{self['title']}", self.law.report(), *(["[[warnings]]", *said] if said else [])])

    def to_frame(self) -> pandas.DataFrame:
        """Return a row for each parameter of each law, and of the relaxation."""
        import pandas

        return pandas.concat({name: law.to_frame() for name, law in self.laws.items()}, names=["law"])

    def __reduce__(self) -> tuple[Any, ...]:
        return (Specimen, (plain(self), self._samples))


class Characterization(dict[str, Any]):
    """What ``palpate characterize --json`` prints, and the tissues that were found.

    Attributes
    ----------
    tissues : list of str or None
        The text of the tissue file of each specimen.
    reasons : list of str or None
        Why a specimen has none.
    """

    tissues: list[str | None]
    reasons: list[str | None]

    def __init__(self, answer: Mapping[str, Any], samples: list[list[dict[str, Any]]] | None = None) -> None:
        super().__init__(answer)
        specimens = answer["specimens"]
        own = [None] * len(specimens) if samples is None else samples
        self["specimens"] = [Specimen(specimen, its) for specimen, its in zip(specimens, own, strict=True)]
        self.tissues = [None] * len(specimens)
        self.reasons = ["the answer was read from JSON, which has no tissue files"] * len(specimens)

    @classmethod
    def parse(cls, text: str) -> Characterization:
        """Return the characterization whose JSON ``text`` is; it has parameters and laws, but neither samples nor tissue files.

        Raises
        ------
        InputError
            When the text is no answer of ``palpate characterize --json``.
        """
        from palpate.errors import InputError

        try:
            answer = json.loads(text)
            return cls(answer)
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(
                f"the text is no answer of `palpate characterize --json` of this version ({error!r}); give all that it prints"
            ) from error

    @property
    def specimens(self) -> list[Specimen]:
        """The specimens, in the order of their first files."""
        found: list[Specimen] = self["specimens"]
        return found

    def tissue(self, specimen: int = 0) -> str:
        """Return the text of a specimen's tissue file, for ``Tissue.parse`` and scenes.

        Raises
        ------
        PalpateError
            When no law was found; the message says why.
        """
        text = self.tissues[specimen]
        if text is None:
            raise PalpateError(self.reasons[specimen] or "no law was found")
        return text

    def report(self) -> str:
        """Return what was found about each specimen as text."""
        return "\n\n".join(specimen.report() for specimen in self.specimens)

    def to_frame(self) -> pandas.DataFrame:
        """Return a row for each specimen: its names and every number that was found.

        Columns are named by their keys, such as ``laws.neo_hookean.c10_pa.value``; those of the first version, such
        as ``neo_hookean.c10_pa.value``, stay for one release.
        """
        import pandas

        return pandas.DataFrame([row(specimen) for specimen in self.specimens])

    def __reduce__(self) -> tuple[Any, ...]:
        samples = [specimen._samples for specimen in self.specimens]
        given = None if any(own is None for own in samples) else samples
        return (Characterization, (plain(self), given), {"tissues": self.tissues, "reasons": self.reasons})


def plain(found: Any) -> Any:
    """Return the answer alone, as mappings and lists."""
    if isinstance(found, Mapping):
        return {key: plain(value) for key, value in found.items()}
    if isinstance(found, list):
        return [plain(value) for value in found]
    return found


def row(specimen: Mapping[str, Any]) -> dict[str, Any]:
    """Return the numbers and names of a specimen's answer for a table, without how its laws were fitted."""
    return flat({key: value for key, value in specimen.items() if key != "fits"})


def flat(found: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Return numbers and texts of nested mappings under names with dots; of a parameter, value and error."""
    row: dict[str, Any] = {}
    for key, value in found.items():
        name = f"{before}{key}"
        if isinstance(value, Mapping):
            row.update(flat(value, f"{name}."))
        elif isinstance(value, list) and all(isinstance(one, Mapping) for one in value):
            for place, one in enumerate(value, start=1):
                row.update(flat(one, f"{name}_{place}."))
        elif not isinstance(value, list):
            row[name] = value
    return row
