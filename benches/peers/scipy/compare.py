#!/usr/bin/env python3
"""Our bounded least squares beside SciPy's on the same residual; prints a table in Markdown.

Needs: Python 3 with NumPy and SciPy from PyPI, cargo. One core.
Run from anywhere: benches/peers/scipy/compare.py
Seconds. Not run in CI. Results: docs/comparisons/least_squares.md.

Both take differences for derivatives and keep their least time of twenty runs.
"""

import json
import os
import pathlib
import subprocess
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
import numpy
import scipy
from scipy.optimize import least_squares

ROOT = pathlib.Path(__file__).resolve().parents[3]
RAMP = 0.2
TIME = 0.02 * numpy.arange(1501)
TRUTH = [0.02, 0.2866, numpy.log(1.537), 0.2022, numpy.log(6.090)]
START = [0.01, 0.1, 0.0, 0.1, 2.5]
BOUNDS = ([0, 0, -4, 0, -4], [1, 1, 6, 1, 6])


def force(p):
    def risen(t):
        t = numpy.maximum(t, 0.0)
        terms = [(p[1], numpy.exp(p[2])), (p[3], numpy.exp(p[4]))]
        return t - sum(g * (t + tau * numpy.expm1(-t / tau)) for g, tau in terms)

    return p[0] * (risen(TIME) - risen(TIME - RAMP)) / RAMP


DATA = force(TRUTH) + 2e-5 * numpy.sin(12.9898 * numpy.arange(1501))


def ours():
    package = ["--package", "palpate-characterize", "--example", "peer_scipy"]
    subprocess.run(["cargo", "build", "--quiet", "--release", *package], cwd=ROOT, check=True)
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return json.loads(subprocess.check_output([target / "release/examples/peer_scipy"]))


def theirs(method):
    best = None
    for _ in range(20):
        began = time.perf_counter()
        bounds = {} if method == "lm" else {"bounds": BOUNDS}
        found = least_squares(
            lambda p: force(p) - DATA, START, method=method, x_scale="jac",
            ftol=1e-12, xtol=1e-10, gtol=1e-12, **bounds,
        )
        seconds = time.perf_counter() - began
        best = min(best or seconds, seconds)
    return {"seconds": best, "sum_of_squares": 2 * found.cost, "evaluations": found.nfev, "values": list(found.x)}


def main():
    rows = {"palpate": ours()}
    for method in ["trf", "dogbox", "lm"]:
        rows[f"SciPy {scipy.__version__}, {method}"] = theirs(method)
    print("| | time [ms] | Σ r² [N²] | stiffness, g₁, τ₁, g₂, τ₂ |")
    print("|---|---|---|---|")
    for name, row in rows.items():
        p = row["values"]
        terms = sorted([(numpy.exp(p[2]), p[1]), (numpy.exp(p[4]), p[3])])
        shown = ", ".join(f"{x:.5g}" for x in [p[0], *(v for tau, g in terms for v in (g, tau))])
        print(f"| {name} | {1e3 * row['seconds']:.2f} | {row['sum_of_squares']:.9e} | {shown} |")


if __name__ == "__main__":
    main()
