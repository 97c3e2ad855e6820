"""Domain randomization: what the seed of an episode draws of tissue, anchor, light and camera."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

import palpate

Distribution: TypeAlias = Sequence[float] | Mapping[str, Sequence[float]]

#: What can be drawn, and between which bounds it makes sense.
NAMES: dict[str, tuple[float, float]] = {
    "tissue.stiffness": (1e-3, 1e3),
    "tissue.relaxation_time": (1e-3, 1e3),
    "anchor.size": (0.1, 10.0),
    "light.brightness": (0.0, 1e3),
    "camera.azimuth": (-math.pi, math.pi),
    "camera.elevation": (-0.5 * math.pi, 0.5 * math.pi),
    "camera.distance": (0.1, 10.0),
    "camera.roll": (-math.pi, math.pi),
    "camera.field_of_view": (0.05, 3.0),
}
#: Those that change the model, which is then prepared anew.
OF_MODEL = ("tissue.stiffness", "tissue.relaxation_time", "anchor.size")
WORDS = ("uniform", "log_uniform", "normal", "one_of")


@dataclass(frozen=True)
class Drawn:
    """A distribution that was checked: its kind and its numbers."""

    kind: str
    numbers: tuple[float, ...]

    def draw(self, generator: np.random.Generator) -> float:
        """One value, in the unit of its name."""
        if self.kind == "one_of":
            return self.numbers[int(generator.integers(len(self.numbers)))]
        low, high = self.numbers
        if self.kind == "normal":
            return float(generator.normal(low, high))
        if self.kind == "log_uniform":
            return math.exp(generator.uniform(math.log(low), math.log(high)))
        return float(generator.uniform(low, high))


class Randomization:
    """A table of names and distributions; see `TouchEnv` for the names and their units.

    Parameters
    ----------
    table : mapping of str to a range or a distribution
        A range ``(low, high)`` is uniform. A distribution is a mapping with one of ``uniform``, ``log_uniform`` (both of
        low and high), ``normal`` (mean and standard deviation, cut off at the name's bounds) and ``one_of`` (values).

    Raises
    ------
    palpate.InputError
        For an unknown name, a range upside down, or a value outside of the name's bounds.
    """

    def __init__(self, table: Mapping[str, Distribution] | None) -> None:
        self.table = {name: _checked(name, given) for name, given in sorted((table or {}).items())}
        self.changes_model = any(name in OF_MODEL for name in self.table)

    def draw(self, generator: np.random.Generator) -> dict[str, float]:
        """A value for each name, drawn in the order of the alphabet."""
        return {name: float(np.clip(own.draw(generator), *NAMES[name])) for name, own in self.table.items()}


def _checked(name: str, given: Distribution) -> Drawn:
    if name not in NAMES:
        raise palpate.InputError(f"there is nothing to draw that is called `{name}`; there are {', '.join(NAMES)}")
    kind, numbers = "uniform", given
    if isinstance(given, Mapping):
        if len(given) != 1 or next(iter(given)) not in WORDS:
            raise palpate.InputError(f"`{name}` has no known distribution; give one of {', '.join(WORDS)}")
        kind, numbers = next(iter(given.items()))
    try:
        values = tuple(float(number) for number in numbers)
    except (TypeError, ValueError):
        raise palpate.InputError(f"`{name}` is drawn from {numbers!r}; give numbers") from None
    low, high = NAMES[name]
    if kind == "one_of":
        if not values or not all(low <= value <= high for value in values):
            raise palpate.InputError(f"`{name}` is one of {list(values)}; give values from {low:g} to {high:g}")
        return Drawn(kind, values)
    if len(values) != 2 or not all(map(math.isfinite, values)):
        raise palpate.InputError(f"`{name}` is drawn from {list(values)}; give two numbers")
    if kind == "normal":
        if not low <= values[0] <= high or values[1] < 0.0:
            raise palpate.InputError(
                f"`{name}` has the mean {values[0]:g} and the standard deviation {values[1]:g}; give a mean from "
                f"{low:g} to {high:g} and a deviation that is not negative"
            )
        return Drawn(kind, values)
    if values[0] > values[1]:
        raise palpate.InputError(
            f"the range of `{name}` goes from {values[0]:g} down to {values[1]:g}; give the lower bound first"
        )
    if values[0] < low or values[1] > high:
        raise palpate.InputError(
            f"the range of `{name}` goes from {values[0]:g} to {values[1]:g}; stay between {low:g} and {high:g}"
        )
    if kind == "log_uniform" and values[0] <= 0.0:
        raise palpate.InputError(f"the logarithm of `{name}` is drawn; give a lower bound above zero")
    return Drawn(kind, values)


def scene_with(scene: palpate.Scene, drawn: Mapping[str, float]) -> palpate.Scene:
    """The scene with the drawn tissue and anchor."""
    content = copy.deepcopy(scene.to_dict())
    organ = content["organ"]
    stiffness, time = drawn.get("tissue.stiffness", 1.0), drawn.get("tissue.relaxation_time", 1.0)
    if stiffness != 1.0 or time != 1.0:
        parts = [part for key in ("layer", "inclusion", "region") for part in organ.get(key, [])]
        # A layer without a tissue has that of the organ, and a cavity has none.
        for part in (organ, *(own for own in parts if "tissue" in own or "builtin_tissue" in own)):
            _soften(part, stiffness, time)
    if "anchor.size" in drawn:
        if "anchor" not in organ:
            raise palpate.InputError("the scene has no `organ.anchor` whose size could be drawn; give it one")
        _resize(organ["anchor"], drawn["anchor.size"])
    return palpate.Scene(content)


def _soften(part: dict[str, Any], stiffness: float, time: float) -> None:
    """Writes the tissue of a part of an organ out, with other stresses and times."""
    if "builtin_tissue" in part:
        found = palpate.Tissue.builtin(part.pop("builtin_tissue"))
        part["tissue"] = {"law": found.law, **found.parameters}
        if found.prony:
            part["tissue"]["prony"] = [{"g": g, "tau_s": tau} for g, tau in found.prony]
    tissue = part.get("tissue")
    if not isinstance(tissue, dict):
        raise palpate.InputError("the scene's tissue is not written out, so that it cannot be drawn; write its table")
    for name, value in tissue.items():
        if name.endswith("_pa"):
            tissue[name] = stiffness * (value["value"] if isinstance(value, dict) else value)
    for term in tissue.get("prony", []):
        term["tau_s"] = time * (term["tau_s"]["value"] if isinstance(term["tau_s"], dict) else term["tau_s"])


def _resize(region: dict[str, Any], factor: float) -> None:
    for ball in region.get("spheres", []):
        ball["radius_m"] *= factor
    for box in region.get("boxes", []):
        low, high = np.array(box["min_m"]), np.array(box["max_m"])
        half = 0.5 * factor * (high - low)
        box["min_m"], box["max_m"] = (0.5 * (low + high) - half).tolist(), (0.5 * (low + high) + half).tolist()


def camera_with(camera: palpate.Camera, drawn: Mapping[str, float]) -> palpate.Camera:
    """The camera with what was drawn of it and of its light: turned about its target, nearer or farther."""
    if not any(name.startswith(("camera.", "light.")) for name in drawn):
        return camera
    target = np.array(camera.target)
    right, down, ahead = camera.rotation
    distance = drawn.get("camera.distance", 1.0) * float(np.linalg.norm(target - camera.eye))
    azimuth, elevation = drawn.get("camera.azimuth", 0.0), drawn.get("camera.elevation", 0.0)
    out = math.cos(elevation) * (math.sin(azimuth) * right - math.cos(azimuth) * ahead) - math.sin(elevation) * down
    roll = drawn.get("camera.roll", 0.0)
    # Up as it was, turned with the elevation, so that looking along it is no special case.
    level = math.cos(azimuth) * right + math.sin(azimuth) * ahead
    up = np.cross(out, level)
    turned: NDArray[np.float64] = math.cos(roll) * up + math.sin(roll) * level
    return palpate.Camera(
        (target + distance * out).tolist(),
        target.tolist(),
        turned.tolist(),
        drawn.get("camera.field_of_view", camera.field_of_view),
        endoscope=camera.endoscope,
        brightness=drawn.get("light.brightness", camera.brightness),
    )
