#!/usr/bin/env python3
"""The force table: runs every engine that is installed on every scene and writes the table and its plot.

    benches/forces/table.py [--engine NAME]... [--scene NAME]... [--python ENGINE=PATH]... [--fresh] [--write]

Runs are kept in target/forces and not repeated without --fresh. Engines may be installed apart: --python says which
interpreter runs one. --write renews docs/comparisons/forces.md and its picture; without it the tables are printed.
An engine that is not installed, and a scene that it cannot do, are rows that say so. With --scene, --write keeps the
sections of the other scenes as they are in the page; the scenes of the call get a picture of their own. With --engine it
keeps the rows of the other engines, and the pictures.
"""

import argparse
import ast
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import textwrap
import time

import numpy as np

from scene import HERE, Scene, names

ROOT = HERE.parents[1]
KEPT = ROOT / "target" / "forces"
PAGE = ROOT / "docs" / "comparisons" / "forces.md"
PICTURE = PAGE.with_suffix(".png")
ENGINES = {
    "palpate_local": "palpate local",
    "palpate_global": "palpate hybrid",
    "palpate_nonlinear": "palpate nonlinear",
    "felupe_axisymmetric": "FElupe",
    "calculix_axisymmetric": "CalculiX",
    "newton_vbd": "Newton VBD",
    "drake_sap": "Drake SAP",
    "mujoco_flex": "MuJoCo flex",
    "pybullet_soft": "PyBullet",
    "sofa_corotational": "SOFA corotational",
    "sofa_linear": "SOFA linear",
}
OWN = {"palpate_local", "palpate_global", "palpate_nonlinear", "felupe_axisymmetric", "calculix_axisymmetric"}
FINE = {"sphere_cube_045"}  # scenes that are run on the fine mesh too: minutes with some engines
LIMIT = 900  # seconds of processor time for a run
HELD = 0.05  # seconds before a judged time whose mean is taken, where the depth does not change


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--engine", action="append", choices=list(ENGINES))
    parser.add_argument("--scene", action="append", choices=names())
    parser.add_argument("--python", action="append", default=[], metavar="ENGINE=PATH")
    parser.add_argument("--fresh", action="store_true", help="run again what was run")
    parser.add_argument("--write", action="store_true", help="renew the page and its picture")
    return parser.parse_args()


def ran(engine, scene, mesh, python, fresh):
    """The answer of `run.py`, or why there is none."""
    path = KEPT / f"{engine}-{scene}-{mesh}.json"
    if fresh or not path.exists() or "missing" in json.loads(path.read_text()):
        path.unlink(missing_ok=True)
        command = [python, HERE / "run.py", engine, scene, mesh, path]
        threads = ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"]
        environment = os.environ | {name: "1" for name in threads}
        core = min(os.sched_getaffinity(0))
        began = time.perf_counter()
        done = subprocess.run(
            ["taskset", "-c", str(core), "prlimit", f"--cpu={LIMIT}", *command],
            env=environment,
            cwd=KEPT,
            capture_output=True,
            text=True,
        )
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            path.write_text(json.dumps({"failed": f"not done within {LIMIT} s"}))
        elif not path.exists():
            last = (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1]
            path.write_text(json.dumps({"failed": last}))
        print(f"{engine}, {scene}, {mesh}: {time.perf_counter() - began:.0f} s", file=sys.stderr, flush=True)
    return json.loads(path.read_text())


def judged(scene, answer, key="force"):
    """The mean over the hold before each judged time, or the value at it; NaN where it is missing."""
    time_, values = np.array(answer["time"]), np.array(answer[key], dtype=float)
    means = []
    for now in scene.judged:
        held = abs(scene.depth(now - HELD) - scene.depth(now)) < 1e-12 and not scene.prony
        span = (time_ > now - HELD + 1e-9) & (time_ < now + 1e-9)
        means.append(values[span].mean() if held else np.interp(now, time_, values))
    return np.array(means)


def off(values, answer, key):
    """Errors in percent against a converged answer, none where there is no such answer."""
    if answer is None:
        return None
    exact = np.array([np.nan if value is None else value for value in answer[key]])
    return 100 * (values / exact - 1)


def over_motion(scene, answer, exact):
    """The largest difference to the converged force at the same depth, in percent of the largest force."""
    if exact is None or not exact.get("curve_m_n"):
        return None
    depths, forces = np.array(exact["curve_m_n"]).T
    if depths[-1] < scene.path.max() * (1 - 1e-9):
        return None
    at = np.interp(scene.depth(np.array(answer["time"])), depths, forces)
    return 100 * np.nanmax(np.abs(np.array(answer["force"], dtype=float) - at)) / forces.max()


def signed(values):
    if values is None:
        return "–"
    return " / ".join("–" if not np.isfinite(value) else f"{value:+.1f}" for value in values).replace("-", "−")


def milli(values):
    return " / ".join("–" if not np.isfinite(value) else f"{1e3 * value:.1f}" for value in values)


def row(scene, engine, mesh, answer):
    title = ENGINES[engine] + (
        "" if mesh == "own" else f", {answer['nodes']} nodes" if "nodes" in answer else f", {mesh}"
    )
    for key, words in [("missing", "not installed"), ("skipped", "not run"), ("unfit", "cannot"), ("failed", "failed")]:
        if key in answer:
            return f"| {title} | {words}: {answer[key]} | | | | | | | |"
    force = judged(scene, answer)
    own, linear, finite = [scene.answers.get(law) for law in (answer["law"], "linear", "neo_hookean")]
    motion = over_motion(scene, answer, own)
    settled = None
    if "settled" in answer and own:
        exact = np.array([np.nan if value is None else value for value in own["settled_m"]])
        settled = 100 * (judged(scene, answer, "settled") - exact) / scene.depth(scene.judged)
    low, middle, high = answer["step_ms"]
    broken = answer["not_finite"]
    cells = [
        title,
        milli(force),
        signed(off(force, own, "force_n")),
        "–" if motion is None else f"{motion:.0f}",
        signed(off(force, linear, "force_n")),
        signed(off(force, finite, "force_n")),
        signed(settled),
        f"{middle:.3g} ({low:.3g} to {high:.3g})",
        f"{answer['first_s']:.2g}" + (f"; {broken} not finite" if broken else ""),
    ]
    return "| " + " | ".join(cells) + " |"


HEADER = """| engine | force, mN | own law, % | over the motion, % | linear, % | neo-Hooke, % | settling, % of depth | ms a step (quartiles) | first step, s |
|---|---|---|---|---|---|---|---|---|"""


def converged(scene):
    """A line with the converged answers of a scene."""
    parts = []
    for law, answer in scene.answers.items():
        forces = milli([np.nan if value is None else value for value in answer["force_n"]])
        parts.append(f"{law.replace('_', ' ')} {forces} (±{100 * answer['error']:.2f} %)")
    return "Converged: " + "; ".join(parts) + "."


def summary(scenes, results, before):
    """Errors against the own law at the last judged time, engines by scenes."""
    lines = ["| engine | " + " | ".join(f"{k + 1}" for k in range(len(scenes))) + " |", "|---" * (len(scenes) + 1) + "|"]
    for engine, title in ENGINES.items():
        for mesh in ["own", "coarse", "fine"]:
            kind = title if mesh == "own" else f"{title}, {mesh}"
            cells = []
            for scene in scenes:
                answer = results.get((engine, scene.name, mesh), {"missing": ""})
                if scene.title in before.sections or "skipped" in answer:
                    cells.append(before.cells.get((kind, scene.title), ""))
                    continue
                if "force" not in answer:
                    cells.append("no" if "unfit" in answer else "failed" if "failed" in answer else "")
                    continue
                own = off(judged(scene, answer), scene.answers.get(answer["law"]), "force_n")
                cells.append("–" if own is None else signed(own[-1:]))
            if any(cells):
                lines.append(f"| {kind} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


class Before:
    """What the page has: sections of scenes that are not in the call, by title; of all, rows, cells of the summary and
    settings."""

    def __init__(self, text, renewed):
        summary_, *parts = re.split(r"^### ", text, flags=re.MULTILINE)[1:]
        *parts, settings = parts
        self.settings = dict(re.findall(r"^(- \*\*.*?\*\*)(.*)$", settings, flags=re.MULTILINE))
        titles = [part.split("\n", 1)[0].split(". ", 1)[1] for part in parts]
        self.sections = {
            title: part.split("\n", 1)[1].strip("\n") for title, part in zip(titles, parts) if title not in renewed
        }
        self.rows = {title: re.findall(r"^\| .*\|$", part, flags=re.MULTILINE) for title, part in zip(titles, parts)}
        rows = re.findall(r"^\| (.*) \|$", summary_, flags=re.MULTILINE)
        rows = [[cell.strip() for cell in row.split(" |")] for row in rows]
        self.cells = {(row[0], title): cell for row in rows for title, cell in zip(titles, row[1:])}


    def row(self, scene, engine, mesh):
        """The row of an engine that is not in the call, none where there is none."""
        rows = [row for row in self.rows.get(scene.title, []) if row.startswith(f"| {ENGINES[engine]} |") or row.startswith(f"| {ENGINES[engine]},")]
        return dict(zip(meshes_of(engine, scene), rows)).get(mesh)


def meshes_of(engine, scene):
    if engine in OWN:
        return ["own"]
    return ["coarse", "fine"] if scene.name in FINE else ["coarse"]


def settings_of(engine):
    """The settings that an adapter states itself; its engine may be installed for another interpreter."""
    for node in ast.parse((HERE / "engines" / f"{engine}.py").read_text()).body:
        if isinstance(node, ast.Assign) and node.targets[0].id == "SETTINGS":
            return " ".join(ast.literal_eval(node.value).split())
    return None


def text_of(scenes, results, before):
    parts = ["### Errors against each engine's own law, last depth or time, %\n", summary(scenes, results, before)]
    parts.append("\n" + "\n".join(f"{k + 1}. {scene.title}" for k, scene in enumerate(scenes)))
    parts.append("\nno: the engine cannot do the scene; –: its law has no converged answer there.")
    for number, scene in enumerate(scenes):
        parts.append(f"\n### {number + 1}. {scene.title}\n")
        if scene.title in before.sections:
            parts.append(before.sections[scene.title])
            continue
        depths = " / ".join(f"{1e3 * scene.depth(now):g}" for now in scene.judged)
        at = " / ".join(f"{now:g}" for now in scene.judged)
        where = f"{'Pulled by ' if scene.gripped else ''}{depths} mm{'' if scene.gripped else ' deep'}"
        where += f", at {at} s" if scene.prony else ""
        parts += [f"{where}. {converged(scene)}\n", HEADER]
        for engine, mesh in [(engine, mesh) for engine in ENGINES for mesh in meshes_of(engine, scene)]:
            answer = results[engine, scene.name, mesh]
            known = before.row(scene, engine, mesh) if "skipped" in answer else None
            parts.append(known or row(scene, engine, mesh, answer))
    parts.append("\n### Settings\n")
    for engine, title in ENGINES.items():
        own = [answer for (name, *_), answer in results.items() if name == engine]
        found = next((answer for answer in own if "version" in answer), None)
        if found:
            law = found["law"].replace("_", " ")
            parts.append(f"- **{title}** {found['version']}, {law}. {settings_of(engine) or found['settings']}")
        elif f"- **{title}**" in before.settings:
            parts.append(f"- **{title}**" + before.settings[f"- **{title}**"])
        else:
            parts.append(f"- **{title}**: not installed ({own[0].get('missing') or own[0].get('failed')})")
    return "\n".join(parts) + "\n"


def drawn(scenes, results, path):
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    columns = min(3, len(scenes))
    rows = -(-len(scenes) // columns)
    figure, axes = pyplot.subplots(rows, columns, figsize=(4.2 * columns, 3.0 * rows), squeeze=False)
    for axis in axes.flat[len(scenes):]:
        axis.axis("off")
    handles = {}
    for axis, scene in zip(axes.flat, scenes):
        axis.set_title(textwrap.fill(scene.title.replace("ν ", "ν\u00a0"), 45), fontsize=8)
        for law, style in [("linear", ":"), ("neo_hookean", "--")]:
            exact = scene.answers.get(law)
            if exact is None:
                continue
            name = f"converged, {law.replace('_', '-')}"
            if exact.get("curve_m_n"):
                time_ = np.linspace(0, scene.end, 600)
                handles[name] = axis.plot(time_, 1e3 * np.interp(scene.depth(time_), *np.array(exact["curve_m_n"]).T), "k" + style, lw=1.6, zorder=5)[0]
            else:
                handles[name] = axis.plot(scene.judged, 1e3 * np.array(exact["force_n"]), "ko", ms=4, zorder=5)[0]
        largest = 1e3 * max(max(v for v in a["force_n"] if v is not None) for a in scene.answers.values())
        for number, (engine, title) in enumerate(ENGINES.items()):
            answer = results[engine, scene.name, meshes_of(engine, scene)[-1]]
            if "force" not in answer:
                continue
            force = 1e3 * np.array(answer["force"], dtype=float)
            style = "-" if number < 10 else "-."
            handles[title] = axis.plot(answer["time"], force, style, lw=0.9, color=f"C{number}")[0]
        axis.set_ylim(0, 1.6 * largest)
        axis.set_xlabel("time [s]", fontsize=7)
        axis.set_ylabel("force [mN]", fontsize=7)
        axis.tick_params(labelsize=7)
    figure.legend(handles.values(), handles.keys(), loc="lower center", ncol=5 if columns > 1 else 2, fontsize=8)
    figure.tight_layout(rect=(0, max(0.08, 0.55 / (3.0 * rows)) if columns > 1 else 0.3, 1, 1))
    figure.savefig(path, dpi=110)


def main():
    chosen = arguments()
    KEPT.mkdir(parents=True, exist_ok=True)
    pythons = dict(pair.split("=", 1) for pair in chosen.python)
    scenes = [Scene(name) for name in chosen.scene or names()]
    for scene in scenes:
        if not scene.answers:
            print(f"{scene.name}: no converged answers yet; run answers.py {scene.name}", file=sys.stderr)
    scenes = [scene for scene in scenes if scene.answers]
    results = {}
    for scene in scenes:
        for engine in ENGINES:
            for mesh in meshes_of(engine, scene):
                fresh = chosen.fresh and (not chosen.engine or engine in chosen.engine)
                if chosen.engine and engine not in chosen.engine and not (KEPT / f"{engine}-{scene.name}-{mesh}.json").exists():
                    results[engine, scene.name, mesh] = {"skipped": "with this call"}
                    continue
                python = pythons.get(engine, sys.executable)
                results[engine, scene.name, mesh] = ran(engine, scene.name, mesh, python, fresh)
    page = PAGE.read_text()
    begin, end = "<!-- written by table.py -->", "<!-- end -->"
    written = page.partition(begin)[2].partition(end)[0]
    before = Before(written, {scene.title for scene in scenes})
    everything = [Scene(name) for name in names()]
    chosen_or_known = [s for s in everything if s.name in {own.name for own in scenes} or s.title in before.sections]
    text = text_of(chosen_or_known, results, before)
    if not chosen.write:
        print(text)
        return
    if not chosen.engine:
        name = PICTURE if not chosen.scene else PICTURE.with_stem(f"forces_{'_'.join(chosen.scene)}")
        drawn(scenes, results, name)
    page = re.sub(f"{begin}.*{end}", lambda _: f"{begin}\n{text}{end}", page, flags=re.DOTALL)
    PAGE.write_text(page)


if __name__ == "__main__":
    main()
