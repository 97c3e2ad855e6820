#!/usr/bin/env python3
"""Times our factors of a dense matrix in single precision beside OpenBLAS; prints a table in Markdown.

Needs: Python 3 with NumPy from PyPI (which brings OpenBLAS), cargo. Both use all cores.
Run from anywhere: benches/peers/openblas/compare.py [--rounds N] [TRIANGLES ...]
A minute, and three with 5146. Not run in CI. Results: docs/comparisons/dense_factors.md.

Codes take turns, and each keeps its least time.
"""

import argparse
import json
import os
import pathlib
import subprocess
import time

import numpy

ROOT = pathlib.Path(__file__).resolve().parents[3]


def ours(triangles):
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    program = target / "release/examples/peer_openblas"
    return json.loads(subprocess.check_output([program, str(triangles)]))


def theirs(unknowns):
    """sgesv with one right side, whose solution takes next to nothing."""
    random = numpy.random.default_rng(1)
    matrix = random.standard_normal((unknowns, unknowns), dtype=numpy.float32)
    right = numpy.ones(unknowns, dtype=numpy.float32)
    start = time.perf_counter()
    numpy.linalg.solve(matrix, right)
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("triangles", type=int, nargs="*", default=[688, 2000])
    arguments = parser.parse_args()
    package = ["--package", "palpate-mechanics", "--example", "peer_openblas"]
    subprocess.run(["cargo", "build", "--quiet", "--release", *package], cwd=ROOT, check=True)
    print("| triangles | unknowns | ours [s] | OpenBLAS [s] | ours [Gflop/s] | OpenBLAS [Gflop/s] |")
    print("|---|---|---|---|---|---|")
    for triangles in arguments.triangles:
        pairs = []
        for _ in range(arguments.rounds):
            mine = ours(triangles)
            pairs.append((mine["factor_s"], theirs(mine["unknowns"])))
        unknowns = mine["unknowns"]
        times = [min(column) for column in zip(*pairs)]
        rates = [2e-9 / 3 * unknowns**3 / value for value in times]
        cells = [*(f"{value:.3f}" for value in times), *(f"{value:.0f}" for value in rates)]
        print("|", " | ".join([str(triangles), str(unknowns), *cells]), "|", flush=True)


if __name__ == "__main__":
    main()
