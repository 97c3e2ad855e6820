#!/usr/bin/env python3
"""Writes the converged answers of the scenes, `answers/*.json`: force and settling of the surface at the judged times,
for each law of `laws.py`, with their errors.

Needs palpate, felupe and gmsh, and for bodies that are not axisymmetric better also pypardiso
(see docs/comparisons/forces.md). Run: benches/forces/answers.py [--law LAW] [scene ...]; hours with
all scenes.

Linear tissue: `palpate solve` with contact on the deformed surface, where it has the body; its error is the largest of
its own estimate and the difference to FElupe. Other laws, bodies and the settling: FElupe on two meshes, whose
difference is the error. Relaxation: the hereditary integral of the elastic answer, exact under a flat punch.
"""

import argparse
import json

import numpy as np

from engines import felupe_axisymmetric, felupe_solid
from laws import LAWS
from scene import ANSWERS, Scene, names

FINENESS = [0.1, 0.05]  # edges under the tool [radii]
SOLID_LAWS = ["linear", "neo_hookean"]  # of bodies that are not axisymmetric: a law takes some ten minutes


def judged_depths(scene):
    return scene.depth(scene.judged)


def by_felupe(scene, law):
    """Force, settling [judged time], their errors, and the force over depth."""
    wanted = np.unique(judged_depths(scene))
    code, meshes, increments = felupe_axisymmetric, FINENESS, 10
    if not scene.axisymmetric:
        code, meshes, increments = felupe_solid, felupe_solid.MESHES[scene.name], 4
    # Small increments, for convergence, that meet the judged depths.
    stops = np.concatenate([np.linspace(a, b, increments + 1)[1:] for a, b in zip([0, *wanted], wanted)])
    found = []
    for fineness in meshes:
        force, settled, _ = code.pressed(scene, law, fineness, stops)
        at = np.searchsorted(stops, judged_depths(scene) - 1e-12)
        found.append([force[at], settled[at]])
        curve = [[0.0, 0.0], *np.column_stack([stops, force])[np.isfinite(force)].tolist()]
    coarse, fine = np.array(found)
    difference, size = np.abs(fine - coarse), np.abs(fine)
    errors = [row[ok].max() / of[ok].max() if (ok := np.isfinite(row)).any() else np.nan for row, of in zip(difference, size)]
    return fine, errors, curve


def by_palpate(scene, law, prony=False):
    """Force at the judged times and its estimated error, or none if `palpate solve` has no such problem."""
    import palpate

    if law != "linear" or scene.body["shape"] != "box" or scene.second or not scene.axisymmetric:
        return None
    indenter = {"radius_m": scene.radius, "face": "slip"}
    indenter |= {"side": "none"} if scene.tool["shape"] == "flat" else {"shape": scene.tool["shape"]}
    tissue = {"law": "linear"} | {key: scene.tissue[key] for key in ["youngs_modulus_pa", "poissons_ratio"]}
    problem = {
        "format": 1,
        "kind": "indentation",
        "block": {"radius_m": float(felupe_axisymmetric.width(scene)), "height_m": scene.height},
        "indenter": indenter,
        "accuracy": 0.002,
        "tissue": tissue,
    }
    if prony:
        tissue["prony"] = [{"g": g, "tau_s": tau} for g, tau in scene.prony]
        ramp, hold = float(scene.time[1]), float(scene.end - scene.time[1])
        problem["ramp"] = {"depth_m": float(scene.path[1]), "ramp_s": ramp, "hold_s": hold, "samples": 203, "method": "full"}
        answer = palpate.solve(problem, progress=False)
        return np.interp(scene.judged, answer["time_s"], answer["force_n"]), answer.get("estimated_error")
    depths = np.unique(judged_depths(scene))
    problem["depths_m"] = [float(depth) for depth in depths]
    answer = palpate.solve(problem, progress=False)
    return np.interp(judged_depths(scene), answer["depth_m"], answer["force_n"]), answer["estimated_error"]


def relaxed(scene):
    """What relaxation leaves of the elastic force at the judged times, of a force proportional to depth."""
    times = np.linspace(0, scene.end, 200_001)
    rates = np.diff(scene.depth(times))
    middles = 0.5 * (times[1:] + times[:-1])
    left = []
    for now in scene.judged:
        age = now - middles[middles < now]
        modulus = 1 - sum(g * (1 - np.exp(-age / tau)) for g, tau in scene.prony)
        left.append((modulus * rates[: len(age)]).sum() / scene.depth(now))
    return np.array(left)


def answer(scene, law):
    (force, settled), (error, settled_error), curve = by_felupe(scene, law)
    if not np.isfinite(error):
        return None
    source = "FElupe on two meshes"
    theirs = by_palpate(scene, law)
    if theirs:
        # FElupe's mesh error is in the difference.
        error = max(theirs[1], float(np.nanmax(np.abs(force / theirs[0] - 1))))
        force, source = theirs[0], "palpate solve, its estimate and the difference to FElupe"
    if scene.prony:
        force = force * relaxed(scene)
        curve = None
        full, _ = by_palpate(scene, law, prony=True)
        error = max(error, float(np.abs(full / force - 1).max()))
        source = "hereditary integral of the elastic force, and palpate solve over time"
    clean = lambda values: [None if not np.isfinite(value) else float(value) for value in values]
    return {
        "force_n": clean(force),
        "error": float(error),
        "settled_m": clean(settled),
        "settled_error": None if np.isnan(settled_error) else float(settled_error),
        "curve_m_n": curve,
        "source": source,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", nargs="*", help="all without")
    parser.add_argument("--law", action="append", choices=list(LAWS), help="these laws only; answers of others are kept")
    chosen = parser.parse_args()
    ANSWERS.mkdir(exist_ok=True)
    for name in chosen.scene or names():
        scene = Scene(name)
        laws = chosen.law or (LAWS if scene.axisymmetric else SOLID_LAWS)
        laws = [law for law in laws if law == "linear" or not scene.prony]
        found = scene.answers if chosen.law else {}
        found |= {law: answer(scene, law) for law in laws}
        found = {law: value for law, value in found.items() if value}
        content = {"judged_s": scene.judged.tolist(), "laws": found}
        (ANSWERS / f"{name}.json").write_text(json.dumps(content, ensure_ascii=False) + "\n")
        for law, value in found.items():
            forces = " / ".join("–" if force is None else f"{1e3 * force:.2f}" for force in value["force_n"])
            print(f"{name}, {law}: {forces} mN ± {100 * value['error']:.2f} %, {value['source']}", flush=True)


if __name__ == "__main__":
    main()
