#!/usr/bin/env python3
"""Times factors and solutions of our matrices beside CHOLMOD and UMFPACK; prints tables in Markdown.

Needs: Python 3 (standard library only), cargo, and of Debian: gcc, libsuitesparse-dev,
libopenblas0-serial (the reference BLAS would slow CHOLMOD down); gnuplot-nox for the picture.
Run from anywhere: benches/peers/cholmod/compare.py [--rounds N] [--picture FILE.png]
Minutes. Not run in CI. Results: docs/comparisons/sparse_factors.md.

Codes take turns, on one thread, and each keeps its least time on the processor.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
MIXED = ["punch_0", "punch_1", "punch_2", "punch_3", "solid_4", "solid_6", "solid_8"]
DEFINITE = ["displacement_punch_1", "displacement_punch_2", "displacement_solid_6"]
TIMES = ["order_s", "factor_s", "solve_s"]


def run(command):
    """Answer of a program that prints a dictionary, with its peak memory [bytes]."""
    environment = dict(os.environ, OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1")
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen([str(word) for word in command], stdout=out, env=environment)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            raise SystemExit(f"{command} failed")
        out.seek(0)
        return json.loads(out.read()) | {"peak_bytes": 1024 * usage.ru_maxrss}


def least(best, new):
    """Both together: least times, all else of the new one."""
    return new | {key: min(best[key], new[key]) for key in new if best and key.endswith("_s")}


def build(folder):
    package = ["--package", "palpate-mechanics", "--example", "peer_cholmod"]
    subprocess.run(["cargo", "build", "--quiet", "--release", *package], cwd=ROOT, check=True)
    libraries = ["-I/usr/include/suitesparse", "-lcholmod", "-lumfpack", "-lm"]
    theirs = folder / "theirs"
    subprocess.run(["gcc", "-O2", "-o", theirs, HERE / "theirs.c", *libraries], check=True)
    target = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    return target / "release/examples/peer_cholmod", theirs


def measure(name, programs, folder, rounds):
    ours, theirs = programs
    file = folder / "matrix.mtx"
    subprocess.run([ours, "write", name, file], check=True)
    definite = name.startswith("displacement")
    codes = ["llt" if definite else "ldlt", "dominant", "umfpack"]
    codes = [code for code in codes if not (definite and code == "dominant")]
    best = {}
    for turn in range(rounds):
        best["ours"] = least(best.get("ours"), run([ours, "time", name, 3]))
        for code in codes:
            # Simplicial factors take up to a minute; one is enough.
            slow = code == "ldlt"
            if not (slow and turn):
                answer = run([theirs, code, file, 1 if slow else 3])
                best[code] = least(best.get(code), answer)
        print(name, turn + 1, best, flush=True)
    return best


def table(results, codes):
    print("\n| matrix | unknowns | numbers in L | order, factor, solve [ms] |", end="")
    print("".join(f" {code}: L, factor, solve |" for code in codes), "residuals |")
    print("|---" * (5 + len(codes)) + "|")
    for name, best in results.items():
        mine = best["ours"]
        times = ", ".join(f"{1e3 * mine[key]:.3g}" for key in TIMES)
        cells = [name, f"{mine['unknowns']:,}", f"{mine['factor_entries']:,}", times]
        for code in codes:
            ratios = [best[code][key] / mine[key] for key in ["factor_entries", *TIMES[1:]]]
            cells.append(", ".join(f"{ratio:.2g}" for ratio in ratios))
        cells.append(", ".join(f"{best[code]['residual']:.0e}" for code in ["ours", *codes]))
        print("| " + " | ".join(cells) + " |")


def picture(results, file, folder):
    series = {"punch": "axisymmetric, quadrilaterals", "solid": "solid, hexahedra"}
    lines = []
    for kind in series:
        lines.append(f"${kind} << EOD")
        for name, best in results.items():
            if name.startswith(kind):
                mine = best["ours"]
                memory = [8 * mine["factor_entries"] / 2**20, mine["peak_bytes"] / 2**20]
                times = [mine["assembly_s"], mine["factor_s"], mine["solve_s"]]
                lines.append(" ".join(str(x) for x in [mine["unknowns"], *times, *memory]))
        lines.append("EOD")
    curves = lambda columns: ", ".join(
        f"${kind} using 1:{column} with linespoints pt {5 + 2 * i} lc {j + 1} dt {i + 1} title '{name}, {title}'"
        for i, (kind, title) in enumerate(series.items())
        for j, (column, name) in enumerate(columns)
    )
    lines += [
        "set terminal pngcairo size 1000,460 font 'sans,10'",
        f"set output '{file}'",
        "set multiplot layout 1,2",
        "set logscale xy; set grid; set key top left reverse Left; set format y '10^{%T}'",
        "set format x '10^{%T}'; set xlabel 'unknowns'; set ylabel 'time on one processor [s]'; set yrange [1e-4:1e2]",
        "plot " + curves([(2, "assembly"), (3, "factor"), (4, "solve")]),
        "set ylabel 'memory [MiB]'; set yrange [1:1e5]",
        "plot " + curves([(5, "factors"), (6, "process at its peak")]),
    ]
    script = folder / "picture.gp"
    script.write_text("\n".join(lines) + "\n")
    subprocess.run(["gnuplot", script], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--picture", type=pathlib.Path, help="time and memory against unknowns")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        programs = build(folder)
        measured = lambda names: {
            name: measure(name, programs, folder, arguments.rounds) for name in names
        }
        mixed, definite = measured(MIXED), measured(DEFINITE)
        table(mixed, ["ldlt", "dominant", "umfpack"])
        table(definite, ["llt", "umfpack"])
        if arguments.picture:
            picture(mixed, arguments.picture.resolve(), folder)


if __name__ == "__main__":
    main()
