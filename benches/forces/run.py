#!/usr/bin/env python3
"""Runs one engine on one scene and mesh and writes what it gave as JSON; `table.py` calls it.

Run: benches/forces/run.py ENGINE SCENE MESH FILE.json, MESH being `coarse`, `fine`, or `own` for an engine's own.
An engine is a module of `engines` with

- `LAW`, the name of its law in `laws.py`, `MESHES`, those that it needs, `SETTINGS`, what was set and why;
- `version()`;
- `unfit(scene)`, a reason why it cannot do a scene, else None;
- `run(scene, mesh)`, a dictionary of arrays `time` [s], `force` [N], `settled` [m] of the probe, `steps_s`, the duration
  of each step on the clock [s], and `first_s`, from the scene to the end of the first step [s].
"""

import importlib
import json
import pathlib
import sys
import time

import numpy as np

from scene import Scene


def main():
    engine, name, fineness, path = sys.argv[1:]
    scene = Scene(name)
    began = time.perf_counter()
    try:
        adapter = importlib.import_module(f"engines.{engine}")
    except ImportError as error:
        pathlib.Path(path).write_text(json.dumps({"missing": str(error).splitlines()[0]}))
        return
    importing = time.perf_counter() - began
    reason = adapter.unfit(scene)
    answer = {"law": adapter.LAW, "version": adapter.version(), "settings": " ".join(adapter.SETTINGS.split())}
    if reason:
        answer["unfit"] = reason
    else:
        mesh = None
        if fineness != "own":
            from meshes import Tetrahedra

            mesh = Tetrahedra(scene, fineness)
            answer["nodes"] = len(mesh.nodes)
        found = adapter.run(scene, mesh)
        steps = 1e3 * np.array(found.pop("steps_s"))
        answer["step_ms"] = [float(value) for value in np.percentile(steps, [25, 50, 75])]
        answer["first_s"] = found.pop("first_s") + importing
        answer["not_finite"] = int((~np.isfinite(found["force"])).sum())
        for key, value in found.items():
            answer[key] = np.round(value, 12).tolist() if isinstance(value, np.ndarray) else value
    # NaN is no JSON.
    text = json.dumps(answer).replace("NaN", "null").replace("-Infinity", "null").replace("Infinity", "null")
    pathlib.Path(path).write_text(text)


if __name__ == "__main__":
    main()
