"""Laws that were found, with their parameters: objects over the answer that ``palpate characterize --json`` prints."""

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
        """``"known"``, ``"correlated"``, ``"hardly_known"``, ``"on_bound"`` or, where recordings state it, ``"stated"``."""
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
        Whether a piece was pressed, pulled or sheared.
    test : {"uniaxial", "planar_tension", "simple_shear"} or None
        How the piece was deformed.
    fibre_axis_angle_deg : float or None
        The angle of its loading to the axis of its fibres, where the recording states it.
    time : array
        From first contact [s].
    course : array
        Depths [m]; of a piece, stretches or amounts of shear [-].
    measured : array
        Forces [N]; of a piece, nominal stresses [Pa].
    """

    def __init__(self, samples: Mapping[str, Any], law: str) -> None:
        self.file: str = samples["file"]
        self.is_piece: bool = samples["is_piece"]
        self.test: str | None = samples["test"]
        self.fibre_axis_angle_deg: float | None = samples["fibre_axis_angle_deg"]
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
        self,
        time: ArrayLike | None = None,
        depth: ArrayLike | None = None,
        *,
        stretch: ArrayLike | None = None,
        test: str | None = None,
        fibre_axis_angle_deg: float | None = None,
    ) -> Floats:
        """Return forces [N] at depths [m], or nominal stresses [Pa] of a piece at stretches [-].

        Parameters
        ----------
        time : array, optional
            Times [s] of the depths, ascending; without it forces are those of a press that leaves no time to relax.
        depth : array
            Depths [m] of the indenter of the recordings; beyond the deepest of them force goes on along its tangent.
        stretch : array
            Of a piece, deformed over undeformed length; in simple shear, amounts of shear.
        test : {"uniaxial", "planar_tension", "simple_shear"}, optional
            How the piece is deformed; by default as that of the first recording.
        fibre_axis_angle_deg : float, optional
            Of a law with fibres, the angle from the loading to their axis; by default that of the first recording.
        """
        return self._evaluated(time, depth, stretch, test, fibre_axis_angle_deg)[0]

    def evaluate_error(
        self,
        time: ArrayLike | None = None,
        depth: ArrayLike | None = None,
        *,
        stretch: ArrayLike | None = None,
        test: str | None = None,
        fibre_axis_angle_deg: float | None = None,
    ) -> Floats:
        """Return the standard errors of what `evaluate` returns, from `covariance`."""
        return self._evaluated(time, depth, stretch, test, fibre_axis_angle_deg)[1]

    def _evaluated(
        self,
        time: ArrayLike | None,
        depth: ArrayLike | None,
        stretch: ArrayLike | None,
        test: str | None,
        fibre_axis_angle_deg: float | None,
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
            "test": self._fit.get("test") if test is None else test,
            "fibre_axis_angle_deg": self._fit.get("fibre_axis_angle_deg")
            if fibre_axis_angle_deg is None
            else fibre_axis_angle_deg,
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
