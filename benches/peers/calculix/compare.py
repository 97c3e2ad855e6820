#!/usr/bin/env python3
"""Compares palpate with CalculiX on the same problems and prints a table in Markdown.

Needs: Python 3 (standard library only), CalculiX (Debian: calculix-ccx), and cargo.
Run from anywhere: benches/peers/calculix/compare.py [--keep FOLDER] [name ...]
Minutes. Not run in CI. Results: docs/comparisons/calculix.md.

CalculiX reads 20 characters per field, and expands axisymmetric elements to a wedge of two degrees,
whose reactions it prints. Set CARGO_TARGET_DIR as for cargo.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
WEDGES = 180  # in a ring
PUNCH = 1e-3  # radius [m]
BLOCK = (0.05642, 0.1)  # radius, height [m]
TUBE = (0.06, 0.005, 0.0075)  # length, inner and outer radius [m]


def field(number):
    text = f"{number:.11e}"
    assert len(text) <= 20, text
    return text


# --- ours ---


def build():
    package = ["--package", "palpate-mechanics", "--example", "peer_calculix"]
    subprocess.run(["cargo", "build", "--quiet", "--release", *package], cwd=ROOT, check=True)


def ours(*words):
    """Answer of ours.rs, a dictionary."""
    example = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    command = [example / "release/examples/peer_calculix", *map(str, words)]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True).stdout)


# --- CalculiX ---


def law_cards(law):
    """The material TISSUE: of a law with its numbers, or a whole card as palpate writes it."""
    if "*MATERIAL" in law:
        return law.rstrip()
    return f"*MATERIAL,NAME=TISSUE\n{numbered_card(law)}"


def numbered_card(law):
    name, *numbers = law.split(":")
    numbers = [float(number) for number in numbers]
    if name == "linear":
        return f"*ELASTIC\n{field(numbers[0])},{field(numbers[1])}"
    *constants, kappa = numbers
    kind = {"neo_hookean": "NEO HOOKE", "mooney_rivlin": "MOONEY-RIVLIN"}[name]
    constants = ",".join(field(number) for number in [*constants, 2.0 / kappa])
    return f"*HYPERELASTIC,{kind}\n{constants}"


def calculix(deck, folder, name):
    """Runs a deck; answers the totals and values of its .dat file, label -> lists of numbers."""
    (folder / f"{name}.inp").write_text(deck)
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    done = subprocess.run(
        ["ccx", name], cwd=folder, env=environment, capture_output=True, text=True
    )
    if done.returncode or "*ERROR" in done.stdout:
        sys.exit(f"{name}: CalculiX failed\n{done.stdout[-2000:]}")
    blocks, label = {}, None
    for line in (folder / f"{name}.dat").read_text().splitlines():
        words = line.split()
        if "for set" in line:
            # The last increment overwrites those before it.
            label = words[words.index("set") + 1]
            blocks[label] = []
        elif words and label:
            blocks[label].append([float(word) for word in words])
    return blocks


def graded(first, growth, length):
    """Places from 0 to length whose intervals begin with about `first` and grow."""
    steps, reach, step = [], 0.0, first
    while reach < length:
        steps.append(step)
        reach += step
        step *= growth
    places, at = [0.0], 0.0
    for step in steps:
        at += step * length / reach
        places.append(at)
    places[-1] = length
    return places


def quadratic_grid(columns, rows):
    """Eight-noded quadrilaterals: nodes {number: (r, z)}, elements, and the number at (2 i, 2 j)."""
    halved = lambda line: [x for a, b in zip(line, line[1:]) for x in (a, 0.5 * (a + b))] + [line[-1]]
    across, up = halved(columns), halved(rows)
    width = len(across)
    number = lambda i, j: 1 + i + j * width
    nodes = {
        number(i, j): (r, z)
        for j, z in enumerate(up)
        for i, r in enumerate(across)
        if i % 2 == 0 or j % 2 == 0
    }
    elements = [
        [number(i + a, j + b) for a, b in [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)]]
        for j in range(0, len(up) - 1, 2)
        for i in range(0, width - 1, 2)
    ]
    return nodes, elements


def listed(name, numbers):
    lines = [",".join(map(str, numbers[i : i + 8])) for i in range(0, len(numbers), 8)]
    return f"*NSET,NSET={name}\n" + ",\n".join(lines)


def axisymmetric(law, nodes, elements, sets, step, longest="0.2"):
    """A deck; `sets` are node sets, `step` the cards after *STATIC, `longest` the longest increment."""
    finite = not law.startswith("linear")
    lines = ["*NODE,NSET=ALL"]
    lines += [f"{n},{field(r)},{field(z)},0." for n, (r, z) in nodes.items()]
    lines += [f"*ELEMENT,TYPE=CAX8R,ELSET=BODY"]
    lines += [f"{e + 1}," + ",".join(map(str, ns)) for e, ns in enumerate(elements)]
    lines += [listed(name, numbers) for name, numbers in sets.items()]
    lines += [law_cards(law), "*SOLID SECTION,ELSET=BODY,MATERIAL=TISSUE"]
    lines += ["*STEP,NLGEOM,INC=1000" if finite else "*STEP"]
    # The default stops at half a percent of the mean force.
    lines += ["*STATIC", f"{longest},1.,1.e-6,{longest}" if finite else "1.,1."]
    if finite:
        lines += ["*CONTROLS,PARAMETERS=FIELD", "1.e-7,1.e-5"]
    return "\n".join([*lines, *step, "*END STEP", ""])


def punch_deck(law, depth, edge, growth):
    """A block under a bonded punch with elements of `edge` radii at its edge."""
    radius, height = BLOCK
    inward = graded(edge * PUNCH, growth, PUNCH)
    outward = graded(edge * PUNCH, growth, radius - PUNCH)
    columns = [PUNCH - x for x in reversed(inward)] + [PUNCH + x for x in outward[1:]]
    columns[0] = 0.0
    rows = [-z for z in reversed(graded(edge * PUNCH, growth, height))]
    nodes, elements = quadratic_grid(columns, rows)
    where = lambda holds: [n for n, (r, z) in nodes.items() if holds(r, z)]
    sets = {
        "FACE": where(lambda r, z: z == 0.0 and r <= PUNCH * (1 + 1e-9)),
        "BOTTOM": where(lambda r, z: z == -height),
        "AXIS": where(lambda r, z: r == 0.0),
    }
    step = ["*BOUNDARY", "FACE,1,1", f"FACE,2,2,{field(-depth * PUNCH)}", "BOTTOM,1,2", "AXIS,1,1"]
    step += ["*NODE PRINT,NSET=FACE,TOTALS=ONLY", "RF"]
    return axisymmetric(law, nodes, elements, sets, step), 2 * len(nodes)


def tube_deck(law, pressure, across, growth, longest="0.2"):
    """Half a tube with a held end: `across` elements in the wall, graded towards end and surfaces."""
    length, inner, outer = TUBE
    wall = outer - inner
    half = graded(wall / across / 4, growth, 0.5 * wall)
    columns = [inner + x for x in half] + [outer - x for x in reversed(half[:-1])]
    rows = [0.5 * length - z for z in reversed(graded(half[1], growth, 0.5 * length))]
    limit = 0.4 * outer * 8 / across  # longest element
    rows = [z for a, b in zip(rows, rows[1:]) for z in split(a, b, limit)] + [rows[-1]]
    rows[0] = 0.0
    nodes, elements = quadratic_grid(columns, rows)
    where = lambda holds: [n for n, (r, z) in nodes.items() if holds(r, z)]
    sets = {
        "END": where(lambda r, z: z == 0.5 * length),
        "MIDDLE": where(lambda r, z: z == 0.0),
        "INNER": where(lambda r, z: z == 0.0 and r == inner),
    }
    step = ["*BOUNDARY", "END,1,2", "MIDDLE,2,2", "*DLOAD"]
    step += [f"{1 + j * (len(columns) - 1)},P4,{field(pressure)}" for j in range(len(rows) - 1)]
    step += ["*NODE PRINT,NSET=INNER", "U"]
    return axisymmetric(law, nodes, elements, sets, step, longest), 2 * len(nodes)


def split(a, b, longest):
    count = math.ceil((b - a) / longest)
    return [a + (b - a) * i / count for i in range(count)]


def cube_deck(law, how, amount):
    """One C3D20 element; sides free under a stretch along z, all held in simple shear of z along x."""
    corners = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    places = corners + [tuple((p + q) // 2 for p, q in zip(corners[a], corners[b])) for a, b in edges]
    lines = ["*NODE,NSET=ALL"]
    lines += [f"{n + 1},{x / 2},{y / 2},{z / 2}" for n, (x, y, z) in enumerate(places)]
    lines += ["*ELEMENT,TYPE=C3D20,ELSET=BODY"]
    lines += ["1," + ",".join(map(str, range(1, 16))) + ",", "16,17,18,19,20"]
    where = lambda axis, at: [n + 1 for n, place in enumerate(places) if place[axis] == at]
    for name, axis in [("X", 0), ("Y", 1), ("Z", 2)]:
        lines.append(listed(name, where(axis, 0)))
    lines.append(listed("TOP", where(2, 2)))
    lines += [law_cards(law), "*SOLID SECTION,ELSET=BODY,MATERIAL=TISSUE"]
    lines += ["*STEP,NLGEOM,INC=1000", "*STATIC", "0.1,1.,1.e-5,0.2"]
    lines += ["*CONTROLS,PARAMETERS=FIELD", "1.e-9,1.e-7", "*BOUNDARY"]
    if how == "stretch":
        lines += ["X,1,1", "Y,2,2", "Z,3,3", f"TOP,3,3,{field(amount - 1)}"]
    else:
        for n, (_, _, z) in enumerate(places):
            lines += [f"{n + 1},1,1,{field(amount * z / 2)}", f"{n + 1},2,3"]
    lines += ["*NODE PRINT,NSET=TOP,TOTALS=ONLY", "RF", "*END STEP", ""]
    return "\n".join(lines)


# --- the comparison ---

ROWS = []


def row(problem, unit, theirs, mine, meshes, note=""):
    difference = 100 * (mine / theirs - 1)
    ROWS.append((problem, unit, theirs, mine, difference, meshes, note))
    print(f"{problem}: CalculiX {theirs:.6g} {unit}, palpate {mine:.6g}, {difference:+.3f} %", flush=True)


def cubes(folder):
    laws = ["neo_hookean:1000:40000", "mooney_rivlin:400:600:40000"]
    cases = [("stretch", 1.5), ("stretch", 0.7), ("shear", 0.5)]
    for law in laws:
        for how, amount in cases:
            name = f"cube_{law.split(':')[0]}_{how}"
            theirs = calculix(cube_deck(law, how, amount), folder, name)["TOP"][-1]
            mine = ours("cube", law, how, amount)
            title = f"cube, {law.split(':')[0]}, {how} {amount}"
            if how == "shear":
                row(f"{title}, along", "N", theirs[0], mine["fx"], "1 / 1 element")
            row(f"{title}, normal" if how == "shear" else title, "N", theirs[2], mine["fz"], "1 / 1 element")


def cards(folder):
    """The material card that `palpate characterize` writes, read by CalculiX: the stress of a cube against the
    closed form of the incompressible law that the card means, 2 (C10 + C01 / s) (s - 1 / s^2)."""
    package = ["--package", "palpate", "--bin", "palpate"]
    subprocess.run(["cargo", "build", "--quiet", "--release", *package], cwd=ROOT, check=True)
    palpate = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release/palpate"
    stress = lambda s, c10, c01: 2 * (c10 + c01 / s) * (s - s**-2)
    for law, c10, c01 in [("neo_hookean", 1000, 0), ("mooney_rivlin", 400, 600)]:
        rows = [f"{1 + i / 100},{stress(1 + i / 100, c10, c01)}" for i in range(51)]
        (folder / "piece.csv").write_text("\n".join(["stretch,stress_pa", *rows]) + "\n")
        words = ["characterize", "piece.csv", "--law", law, "--abaqus", "card.inp", "--json"]
        subprocess.run([palpate, *words], cwd=folder, check=True, capture_output=True)
        card = (folder / "card.inp").read_text()
        name = card.split("NAME=")[1].splitlines()[0]
        for amount in [1.2, 1.5, 0.7]:
            deck = cube_deck(card, "stretch", amount).replace("MATERIAL=TISSUE", f"MATERIAL={name}")
            theirs = calculix(deck, folder, f"card_{law}")["TOP"][-1][2]
            row(f"card, {law}, stretch {amount}", "N", theirs, stress(amount, c10, c01), "1 element")


def extrapolated(values):
    """The limit of the last three of values whose steps of refinement are alike."""
    a, b, c = values[-3:]
    ratio = (c - b) / (b - a)
    return c + (c - b) * ratio / (1 - ratio) if 0 < ratio < 0.9 else c


def punches(folder):
    cases = [
        ("linear:6000:0.3", 0.1, [0.016, 0.008, 0.004]),
        ("linear:6000:0.45", 0.1, [0.016, 0.008, 0.004]),
        ("neo_hookean:1000:99333.333", 0.2, [0.032, 0.016, 0.008]),
    ]
    for law, depth, edges in cases:
        name = law.split(":")[0]
        theirs, mine = [], []
        for edge in edges:
            deck, sizes = punch_deck(law, depth, edge, 1.25)
            force = -calculix(deck, folder, f"punch_{name}")["FACE"][-1][1]
            theirs.append(WEDGES * force)
            print(f"  CalculiX, edge {edge} a, {sizes} unknowns: {theirs[-1]:.8g}", flush=True)
        for halvings in range(4):
            answer = ours("punch", law, halvings, depth)
            mine.append(answer["force_n"])
            print(f"  palpate, {answer['unknowns']} unknowns: {mine[-1]:.8g}", flush=True)
        meshes = f"{sizes} / {answer['unknowns']} unknowns"
        title = f"punch, {law}, d/a = {depth}"
        row(title, "N", theirs[-1], mine[-1], meshes, "finest meshes")
        row(title, "N", extrapolated(theirs), extrapolated(mine), meshes, "extrapolated")


def tubes(folder):
    cases = [("linear:5200:0.3", 500, [1]), ("linear:5200:0.45", 500, [1])]
    # The other code's pressure follows the surface from one increment to the next.
    cases += [("neo_hookean:870:86420", 300, [0.2, 0.05, 0.0125])]
    for law, pressure, increments in cases:
        trials = [(across, increments[0]) for across in [4, 8, 16]]
        trials += [(8, longest) for longest in increments[1:]]
        theirs = []
        for across, longest in trials:
            deck, sizes = tube_deck(law, pressure, across, 1.3, longest)
            theirs.append(calculix(deck, folder, "tube")["INNER"][-1][1])
            print(f"  CalculiX, {sizes} unknowns, increments of {longest}: {theirs[-1]:.8g}", flush=True)
        for accuracy in [1e-3, 1e-5]:
            answer = ours("tube", law, pressure, accuracy)
            print(f"  palpate: {answer}", flush=True)
        meshes = f"{sizes} / {answer['unknowns']} unknowns"
        row(f"tube, {law}, {pressure} Pa", "m", theirs[-1], answer["widening_m"], meshes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--keep", help="folder for the decks and their answers")
    parser.add_argument("name", nargs="*", help="cubes, cards, punches, tubes; all without")
    arguments = parser.parse_args()
    build()
    groups = {"cubes": cubes, "cards": cards, "punches": punches, "tubes": tubes}
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(arguments.keep or scratch)
        folder.mkdir(exist_ok=True)
        for name in arguments.name or groups:
            groups[name](folder)
    print("\n| problem | CalculiX | palpate | difference | sizes, CalculiX / palpate | |")
    print("|---|---|---|---|---|---|")
    for problem, unit, theirs, mine, difference, meshes, note in ROWS:
        print(f"| {problem} | {theirs:.6g} {unit} | {mine:.6g} {unit} | {difference:+.3f} % | {meshes} | {note} |")


if __name__ == "__main__":
    main()
