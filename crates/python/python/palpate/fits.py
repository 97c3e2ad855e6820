"""What was found about specimens, as objects over the answer that ``palpate characterize --json`` prints."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

from palpate.errors import PalpateError
from palpate.laws import Law, Relaxation

if TYPE_CHECKING:
    import matplotlib.figure
    import pandas


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
