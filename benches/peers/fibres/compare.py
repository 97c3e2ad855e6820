#!/usr/bin/env python3
"""Our fit of the law of Holzapfel, Gasser and Ogden beside SciPy's; prints a table in Markdown.

Needs: Python 3 with NumPy and SciPy from PyPI, a built `palpate` (PALPATE, else target/release/palpate).
Run from anywhere: benches/peers/fibres/compare.py [--write FOLDER]
Minutes. Not run in CI. Results: docs/comparisons/least_squares.md.

Stresses are written from the law's formula in Cauchy stresses, the sides of a strip made free by root finding; palpate
takes the least energy. With --write the strips of the tutorial are made again (assets/first/strip-*.csv).
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
from scipy.optimize import brentq, least_squares

ROOT = pathlib.Path(__file__).resolve().parents[3]
PALPATE = os.environ.get("PALPATE", str(ROOT / "target/release/palpate"))
NAMES = ["c10_pa", "k1_pa", "k2", "dispersion"]
#: C10 [Pa], k1 [Pa], k2, dispersion of one family of fibres.
TRUTH = np.array([1500.0, 9000.0, 2.5, 0.08])
#: Angle of the fibres to the load [degrees], and the largest stretch.
STRIPS = {"strip-0": (0.0, 1.25), "strip-45": (45.0, 1.3), "strip-90": (90.0, 1.35)}
AREA, HEIGHT, ROWS, NOISE = 2e-5, 0.02, 60, 0.003


def cauchy(p, angle, f):
    """Cauchy stress without pressure [Pa]; both families have the direction of the axis."""
    c10, k1, k2, kappa = p
    a0 = np.array([np.cos(angle), np.sin(angle), 0.0])
    b, a = f @ f.T, f @ a0
    strain = kappa * (np.trace(b) - 3.0) + (1.0 - 3.0 * kappa) * (a @ a - 1.0)
    sigma = 2.0 * c10 * b
    if strain > 0.0:
        pull = 2.0 * k1 * strain * np.exp(k2 * strain**2)
        sigma += 2.0 * pull * (kappa * b + (1.0 - 3.0 * kappa) * np.outer(a, a))
    return sigma


def stresses(p, angle, stretches):
    """Nominal stress [Pa] of a strip with free sides."""
    found = []
    for stretch in stretches:

        def sigma(shear, wide):
            f = np.array([[stretch, shear, 0.0], [0.0, wide, 0.0], [0.0, 0.0, 1.0 / (stretch * wide)]])
            return cauchy(p, angle, f)

        def shear_of(wide):
            # Along and across the fibres nothing shears.
            askew = abs(np.sin(2.0 * angle)) > 1e-9
            return brentq(lambda shear: sigma(shear, wide)[0, 1], -1.0, 1.0, xtol=1e-14) if askew else 0.0

        def left(wide):
            side = sigma(shear_of(wide), wide)
            return side[1, 1] - side[2, 2]

        wide = brentq(left, 0.4, 1.1, xtol=1e-14)
        side = sigma(shear_of(wide), wide)
        found.append((side[0, 0] - side[2, 2]) / stretch)
    return np.array(found)


def made(seed):
    """Stretches and stresses with noise of each strip."""
    random = np.random.default_rng(seed)
    exact = {}
    for name, (angle, most) in STRIPS.items():
        stretches = np.linspace(1.0, most, ROWS)
        exact[name] = (stretches, stresses(TRUTH, np.radians(angle), stretches))
    noise = NOISE * max(stress.max() for _, stress in exact.values())
    return {name: (x, stress + noise * random.normal(size=ROWS)) for name, (x, stress) in exact.items()}


def table(name, stretches, stress):
    """What a testing machine writes."""
    lines = [
        "# organ = \"muscle\"",
        "# stimulus = \"uniaxial_tension\"",
        f"# area_m2 = {AREA}",
        f"# height_m = {HEIGHT}",
        f"# fibre_axis_angle_deg = {STRIPS[name][0]:g}",
        "# fibre_angle_deg = 0",
        "Time (s);Extension (mm);Load (N)",
    ]
    for row, (x, s) in enumerate(zip(stretches, stress, strict=True)):
        lines.append(f"{0.5 * row:g};{1e3 * HEIGHT * (x - 1.0):.4f};{AREA * s:.6f}")
    return "\n".join(lines) + "\n"


def theirs(data):
    """SciPy's fit, with one standard error of independent noise."""

    def residual(p):
        parts = [stresses(p, np.radians(STRIPS[name][0]), x) - s for name, (x, s) in data.items()]
        return np.concatenate(parts)

    bounds = ([1e-3, 0.0, 0.0, 0.0], [np.inf, np.inf, np.inf, 1.0 / 3.0])
    found = least_squares(residual, 0.7 * TRUTH, bounds=bounds, x_scale=TRUTH, xtol=1e-10, ftol=1e-12)
    freedom = len(found.fun) - len(TRUTH)
    covariance = np.linalg.inv(found.jac.T @ found.jac) * (found.fun @ found.fun) / freedom
    return found.x, np.sqrt(covariance.diagonal()), found.fun @ found.fun


def ours(data):
    with tempfile.TemporaryDirectory() as folder:
        for name, columns in data.items():
            (pathlib.Path(folder) / f"{name}.csv").write_text(table(name, *columns))
        words = [PALPATE, "characterize", folder, "--law", "holzapfel_gasser_ogden", "--draws", "0", "--json"]
        answer = json.loads(subprocess.run(words, check=True, capture_output=True, text=True).stdout)
    law = answer["specimens"][0]["laws"]["holzapfel_gasser_ogden"]
    known = [law[name] for name in NAMES]
    return [k["value"] for k in known], [k["standard_error"] for k in known], law["sum_squared_error"]


if len(sys.argv) == 3 and sys.argv[1] == "--write":
    for name, columns in made(1).items():
        (pathlib.Path(sys.argv[2]) / f"{name}.csv").write_text(table(name, *columns))
    sys.exit()

print("| | " + " | ".join(NAMES) + " | sum of squares [Pa²] |")
print("|---|---|---|---|---|---|")
print("| truth | " + " | ".join(f"{value:g}" for value in TRUTH) + " | |")
for seed in (1, 2, 3):
    data = made(seed)
    # As the tables hold them.
    data = {name: (1.0 + np.round(1e3 * HEIGHT * (x - 1.0), 4) / (1e3 * HEIGHT), np.round(AREA * s, 6) / AREA)
            for name, (x, s) in data.items()}
    for who, fit in (("palpate", ours), ("SciPy", theirs)):
        values, errors, squares = fit(data)
        cells = [f"{value:.5g} ± {error:.2g}" for value, error in zip(values, errors, strict=True)]
        print(f"| {who}, noise {seed} | " + " | ".join(cells) + f" | {squares:.6g} |")
